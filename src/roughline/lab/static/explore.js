// Explore: a random surface under both models, as sliders move.
import {Controls} from "./controls.js";
import {exploreFigures} from "./explore-figures.js";
import {onDraw} from "./hands.js";
import {embedded, points} from "./plots.js";
import {Strip} from "./strip.js";
import {fillTable, markKeys} from "./tables.js";
import {bindTabs} from "./tabs.js";
import {TakeAlong} from "./take_along.js";
import {Waiting} from "./waiting.js";

const REST = 250; // without a move, until the full grid is computed [ms]
const LABELS = {
  pressure: "pressure over E*; blank where nothing touches",
  gap: "gap in rms heights; blank where they touch",
  displacement: "deflection of the half-space in rms heights",
};
const DASHES = ["– –", "· · ·", "– ·"]; // as theories are drawn
const MOST_THEORIES = DASHES.length;
const CONTACT = ["topography", "contact"], CURVES = ["stiffness", "area", "spectrum"]; // panels
const STRIP = ["stiffness_3d", "unloading", "stiffness_1d", "area", "plastic", "pressure", "depth", "indentation",
  "force", "roughness"];
const FINER = ["full", "curve", "unloading"]; // what is asked at rest
const OF_YIELD = ["unloading", "plastic", "indentation"];

export async function open(link, address, said) {
  const view = new Explore(link, address);
  await view.open(said);
  return view;
}

class Explore {
  #link; #address; #root = document.querySelector("#explore");
  #controls; #plots; #waiting; #rest = null; #strip; #last = null; #fromCursor = false;

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    this.#controls = new Controls(this.#root, (key, isFinal) => this.#changed(key, isFinal));
    this.#waiting = new Waiting(this.#root.querySelector(".status"), link, (works) => this.#cancelled(works));
    new TakeAlong(this.#root, link, () => ({state: this.#controls.used}), this.#waiting, (...said) => this.#refuse(...said));
    this.#strip = new Strip(this.#root.querySelector(".strip"), STRIP);
    this.#bindButtons();
  }

  async open(said) {
    this.#take(said);
    this.#dim([...CONTACT, ...CURVES]);
    this.#askNow();
    this.#plots = await embedded(exploreFigures);
    for (const name of ["stiffness", "area"]) {
      this.#plots.onMove(`${name} cursor`, (force) => this.#cursorMoved(force));
      onDraw(this.#plots.root(`explore-${name}`), this.#root.querySelector(`[data-draw="${name}"]`),
        (from, {x}) => { this.#plots.model(`${name} cursor`).location = x; });
    }
    this.#plots.frame(["explore-topography", "explore-contact"], [1, 1]);
    for (const draw of this.#missed.splice(0)) draw();
    this.#sharpen();
  }

  // Take the texts of an address, or none.
  #take({view, theme, H, ...texts}) {
    this.#controls.take(H === undefined ? texts : {...texts, D_f: `H = ${H}`});
    this.#showHeightOrSlope();
    this.#showHardness();
  }

  shown() { this.#address.write("explore", this.#last?.state ?? {}); }

  #missed = []; // answers that came before the plots were there
  #draw(action) { if (this.#plots) action(); else this.#missed.push(action); }

  #changed(key, isFinal) {
    if (key === "shown") {
      if (this.#last) { this.#drawField(this.#last); this.#writeAddress(this.#last.state); }
      return;
    }
    this.#ofLink = "";
    if (key === "rms") this.#showHeightOrSlope();
    if (key === "hardness_bar") this.#showHardness();
    this.#forgetWayBack();
    this.#stale = key !== "F" || this.#stale;
    this.#dim(key === "F" ? CONTACT : [...CONTACT, ...CURVES]);
    this.#askNow();
    clearTimeout(this.#rest);
    this.#waiting.stop(FINER);
    this.#rest = setTimeout(() => this.#sharpen(), isFinal ? 0 : REST);
  }

  #cancelled(works) {
    this.#stopped = this.#turn;
    const left = {full: "the coarse answer is shown", curve: "the marks of the curves belong to the previous surface",
      unloading: "the way back is not shown", download: "nothing was saved"};
    this.#say(`stopped: ${works.map((work) => left[work]).join(", and ")}`, true);
  }

  #askNow() {
    const turn = ++this.#turn, args = this.#controls.asked;
    const error = (sentence, at) => this.#refuse(sentence, at, turn);
    this.#link.stop("finer lines");
    this.#link.ask("explore.reduced", "reduced", args, {
      answer: (header) => {
        this.#draw(() => this.#drawLine(header, args, turn));
        if (header.is_coarse && turn === this.#turn) { // many ask at once
          this.#link.ask("explore.reduced", "finer lines", {...args, refines: true}, {
            answer: (finer) => this.#draw(() => this.#drawLine(finer, args, turn))});
        }
      },
      error,
    });
    this.#link.ask("explore.coarse", "coarse", args, {
      answer: (header) => this.#draw(() => this.#drawContact(header, args, turn)), error});
  }

  #sharpen(refines = false) {
    if (!this.#plots) return;
    const turn = this.#turn, args = {...this.#controls.asked, refines};
    const error = (sentence, at) => {
      if (turn === this.#turn) this.#waiting.stop(FINER);
      this.#refuse(sentence, at, turn);
    };
    const ask = (what, asked, answer) => this.#waiting.ask(`explore.${what}`, what, asked, {answer, error});
    ask("full", args, (header) => {
      this.#drawContact(header, args, turn);
      if (header.is_coarse && !refines) { this.#sharpen(true); return; } // many ask at once
      if (this.#stale) ask("curve", {...args, refines: true}, (curve) => this.#drawCurve(curve));
      if (header.state.hardness_bar) ask("unloading", args, (back) => this.#drawWayBack(back));
    });
  }

  #drawLine(header, asked, turn) {
    const {numbers, line, table, strip} = header;
    this.#settled(header, asked, turn);
    this.#plots.shows("explore-stiffness", {what: "line", numbers});
    this.#plots.set("stiffness line", {x: line.force_bar, y: line.stiffness_bar, low: line.low, high: line.high});
    this.#strip.add(strip);
    this.#lineTable = table;
  }

  #drawContact(header, asked, turn) {
    if (header.is_coarse && this.#last && !this.#last.is_coarse && sameState(this.#last.state, header.state)) return;
    this.#last = header;
    this.#settled(header, asked, turn);
    const what = {what: "contact", points: header.points, numbers: header.numbers};
    for (const plot of ["explore-topography", "explore-contact"]) this.#plots.shows(plot, what);
    this.#plots.setMap("topography", header.arrays.topography, [1, 1], header.heights);
    this.#drawField(header);
    const {force_bar: x, stiffness_bar, area} = header.curve;
    this.#plots.set("stiffness here", {x, y: stiffness_bar});
    this.#plots.set("area here", {x, y: area});
    this.#strip.add(header.strip, header.curve.unloading_bar === null ? OF_YIELD : []);
    this.#fillTables(header.strip);
    const wasStopped = header.is_coarse && turn === this.#stopped; // and says so already
    if (!wasStopped) this.#say(header.status, !header.is_coarse);
    this.#undim(CONTACT);
    if (!header.is_coarse) this.#drawSpectrum(header);
  }

  #fillTables(strip) {
    const rows = (kept) => strip.filter(kept).map(({symbol, value, below, meaning}) => [symbol, value, below, meaning]);
    const columns = ["quantity", "value", "with unit, interval", "meaning"];
    fillTable("explore-topography", columns, rows(({key}) => key === "roughness"));
    fillTable("explore-contact", columns, rows(({key}) => key !== "roughness"));
  }

  #drawSpectrum({spectrum: {waves, C_2d, law}, spectrum_table}) {
    this.#plots.span("explore-spectrum", "x", waves);
    this.#plots.span("explore-spectrum", "y", C_2d);
    this.#plots.set("spectrum", {x: waves, y: C_2d, law: law.map((value) => value ?? NaN)});
    fillTable("explore-spectrum", ["waves along the side", "C_2d [m⁴]", "law [m⁴]"], spectrum_table);
  }

  #drawField(header) {
    const shown = this.#controls.said.shown ?? "area";
    const field = header.arrays[shown];
    if (shown === "area") markKeys(this.#captionOf("shown"), header.curve.unloading_bar !== null);
    else this.#caption("shown", LABELS[shown]);
    if (!field) return;
    let high = 2; // gap, contact, at the hardness
    if (shown !== "area") { high = 0; for (const value of field.values) if (value > high) high = value; }
    this.#plots.colours("contact", shown === "area" ? "marks" : shown === "pressure" ? "Viridis256" : "Cividis256");
    const low = shown === "pressure" ? 1e-6 * high : 0; // where nothing presses, the paper shows
    this.#plots.setMap("contact", field, [1, 1], [low, high || 1]);
  }

  #stale = true; // whether the whole curve belongs to another surface

  #dim(panels) { for (const name of panels) this.#root.querySelector(`#explore-${name}`).classList.add("dimmed"); }
  #undim(panels) { for (const name of panels) this.#root.querySelector(`#explore-${name}`).classList.remove("dimmed"); }

  #drawCurve({curve, grid, theories, stiffness_table, area_table}) {
    this.#stale = false;
    this.#undim(CURVES);
    const rows = (wanted, values) => points(curve.force_bar, values, (i) => curve.converged[i] && curve.resolved[i] === wanted);
    this.#setMarks("stiffness unloading", curve.force_bar, curve.unloading_bar ?? []);
    for (const plot of ["explore-stiffness", "explore-area"]) this.#plots.shows(plot, {what: "curve", grid});
    for (const [name, values] of [["stiffness", curve.stiffness_bar], ["area", curve.area]]) {
      this.#plots.set(`${name} curve`, rows(true, values));
      const few = rows(false, values);
      this.#plots.set(`${name} unsure`, few);
      this.#plots.model(`${name} unsure label`).visible = few.x.length > 0;
    }
    for (let i = 0; i < MOST_THEORIES; i++) {
      const {force_bar = [], stiffness_bar = null, area = []} = theories[i] ?? {};
      this.#plots.set(`stiffness theory ${i}`, {x: stiffness_bar ? force_bar : [], y: stiffness_bar ?? []});
      this.#plots.set(`area theory ${i}`, {x: force_bar, y: area});
    }
    this.#plots.span("explore-stiffness", "y", [...curve.stiffness_bar, ...(curve.unloading_bar ?? [])], [1e-3, 1.3]);
    this.#plots.span("explore-area", "y", curve.area, [1e-4, 1]);
    const failed = curve.converged.filter((each) => !each).length;
    const unsure = curve.resolved.some((each) => !each) ? "; hollow, and * in the table: fewer than ten cells touch" : "";
    const note = unsure + (failed ? `; ${failed} loads were not solved` : "");
    const called = (name) => this.#root.querySelector(`[data-key="theories"][value="${name}"]`).parentElement.textContent.trim();
    const drawn = theories.map(({name, validity}, i) => `${DASHES[i]} ${called(name)}: ${validity}`);
    this.#caption("stiffness", `marks of the curve on ${grid} points${note}`);
    this.#caption("area", `marks of the curve on ${grid} points${note}`);
    this.#caption("theories", drawn.map((each) => `${each}.`).join(" "));
    this.#curveTables = [stiffness_table, area_table];
    this.#fillCurveTables();
  }

  #drawWayBack({curve, stiffness_table, area_table}) {
    this.#setMarks("stiffness back", curve.force_bar, curve.unloading_bar);
    this.#setMarks("area back", curve.force_bar, curve.area);
    this.#backTables = [stiffness_table, area_table.map(([force, area]) => [force, `${area} (way back)`])];
    this.#fillCurveTables();
  }

  #forgetWayBack() {
    if (!this.#backTables[0].length) return;
    for (const name of ["stiffness", "area"]) this.#setMarks(`${name} back`, [], []);
    this.#backTables = [[], []];
    this.#fillCurveTables();
  }

  // Draw what is positive, as logarithmic axes can, and name it in the legend if there is any.
  #setMarks(name, x, y) {
    const marks = points(x, y, (i) => x[i] > 0 && y[i] > 0);
    this.#plots.set(name, marks);
    this.#plots.model(`${name} label`).visible = marks.x.length > 0;
  }

  #lineTable = []; #curveTables = [[], []]; #backTables = [[], []];

  #fillCurveTables() {
    const [stiffness, area] = [0, 1].map((i) => [...this.#curveTables[i], ...this.#backTables[i]]);
    fillTable("explore-stiffness", ["F̄", "k̄", "model"], [...stiffness, ...this.#lineTable]);
    fillTable("explore-area", ["F̄", "A/A_0"], area);
  }

  #stopped = null; // turn whose finer answer was cancelled
  #turn = 0; // of the questions: controls and cursor follow the answer to the newest alone

  #settled(header, asked, turn) {
    if (turn !== this.#turn) return;
    const elsewhere = this.#controls.answered(asked, header);
    this.#controls.refuse("", [this.#ofLink, elsewhere].filter(Boolean).join(" "));
    this.#cursorTo(header.numbers.F);
    this.#writeAddress(header.state);
  }

  #writeAddress(state) {
    this.#address.write("explore", {...state, ...(this.#controls.said.shown ? {shown: this.#controls.said.shown} : {})});
  }

  #cursorTo(force) {
    this.#fromCursor = true;
    for (const name of ["stiffness", "area"]) this.#plots.model(`${name} cursor`).location = force;
    this.#fromCursor = false;
  }

  #cursorMoved(force) {
    if (this.#fromCursor) return;
    this.#controls.put("F", this.#controls.within("F", force), false);
  }

  #refuse(sentence, at, turn = this.#turn) {
    if (turn !== this.#turn) return;
    clearTimeout(this.#rest);
    if (at === "v") this.#begin(sentence);
    else if (!this.#controls.refuse(at, sentence)) this.#controls.refuse("", sentence);
  }

  #ofLink = ""; // why the link that was opened is not shown

  // Begin with the defaults in the place of a link that cannot be read.
  #begin(sentence) {
    if (this.#ofLink) return;
    this.#ofLink = sentence;
    this.#take({});
    this.#askNow();
    this.#sharpen();
  }

  // Write the status; at rest it is spoken too, with the numbers.
  #say(text, atRest) {
    this.#root.querySelector("[data-status]").textContent = text;
    if (atRest) this.#root.querySelector("[data-spoken]").textContent = `${text}; ${this.#strip.spoken}`;
  }
  #captionOf(name) { return this.#root.querySelector(`[data-caption="${name}"]`); }
  #caption(name, text) { this.#captionOf(name).textContent = text; }

  #showHardness() {
    const yields = Boolean(this.#controls.said.hardness_bar);
    this.#root.querySelector("#explore-yields").checked = yields;
    this.#root.querySelector('[data-control="hardness_bar"]').hidden = !yields;
  }

  #showHeightOrSlope() {
    const bySlope = this.#controls.said.rms === "slope";
    this.#root.querySelector('[data-control="h"]').hidden = bySlope;
    this.#root.querySelector('[data-control="slope"]').hidden = !bySlope;
  }

  #bindButtons() {
    const find = (selector) => this.#root.querySelector(selector);
    find("#another").addEventListener("click", () => {
      this.#controls.put("seed", String(Math.floor(Math.random() * 1e6)));
    });
    find("#explore-yields").addEventListener("change", ({target}) => {
      const slider = find("#explore-hardness_bar");
      const text = find("#explore-hardness_bar-text").value || slider.dataset.default;
      this.#controls.set("hardness_bar", target.checked ? text : "");
    });
    bindTabs(this.#root);
  }
}

function sameState(first, second) { return JSON.stringify(first) === JSON.stringify(second); }
