// Explore: a random surface under both models, as sliders move.
import {Controls} from "./controls.js";
import {exploreFigures} from "./explore-figures.js";
import {onDraw, onPoint} from "./hands.js";
import {embedded, points} from "./plots.js";
import {Strip} from "./strip.js";
import {fillCaption, fillTable} from "./tables.js";
import {bindTabs} from "./tabs.js";
import {TakeAlong} from "./take_along.js";
import {Waiting} from "./waiting.js";

const REST = 250; // without a move, until the full grid is computed [ms]
const DASHES = ["– –", "· · ·", "– ·"]; // as theories are drawn
const MOST_THEORIES = DASHES.length;
const CONTACT = ["topography", "contact"], CURVES = ["stiffness", "area", "spectrum"]; // panels
const OVER_FORCE = {stiffness: "stiffness_bar", area: "area", aperture: "aperture"}; // panels with loads, what they show
const CURSORS = [...Object.keys(OVER_FORCE), "cycle"]; // panels with the line of the load
const STRIP = ["stiffness_3d", "unloading", "stiffness_1d", "area", "aperture", "channel", "plastic", "pressure", "depth",
  "indentation", "force", "roughness", "retreat", "pull_off", "pulling", "zone"];
const FINER = ["full", "curve", "flow", "unloading", "cycle"]; // what is asked at rest
const NOT_ALWAYS = ["unloading", "plastic", "indentation", "aperture", "channel", "retreat", "pull_off", "pulling", "zone"]; // in the strip
const FOOT = 0.04; // of an axis: how far above its end sealed loads stand
const ROOM_ABOUT = 0.06; // of what is drawn on linear axes
const ROOM = 3; // between them and the smallest aperture

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
    new TakeAlong(this.#root, link, () => this.#seen, this.#waiting, (...said) => this.#refuse(...said));
    this.#strip = new Strip(this.#root.querySelector(".strip"), STRIP);
    this.#bindButtons();
  }

  async open(said) {
    this.#take(said);
    this.#dimAll();
    this.#askNow();
    this.#plots = await embedded(exploreFigures);
    for (const name of CURSORS) {
      this.#plots.onMove(`${name} cursor`, (force) => this.#cursorMoved(force));
      onDraw(this.#plots.root(`explore-${name}`), this.#root.querySelector(`[data-draw="${name}"]`),
        (from, {x, y}) => { this.#plots.model(`${name} cursor`).location = name === "cycle" ? y : x; });
    }
    onPoint(this.#plots.root("explore-contact"), (at) => this.#tell(at));
    this.#plots.frame(["explore-topography", "explore-contact"], [1, 1]);
    for (const draw of this.#missed.splice(0)) draw();
    this.#sharpen();
  }

  // Take the texts of an address, or none.
  #take({view, theme, H, ...texts}) {
    this.#controls.take(H === undefined ? texts : {...texts, D_f: `H = ${H}`});
    this.#showHeightOrSlope();
    this.#showHardness();
    this.#showFluid();
    this.#showSticking();
    if (this.#sticks) this.#root.querySelector("#tab-cycle").click();
  }

  shown() { this.#address.write("explore", this.#last?.state ?? {}); }

  // What is seen: the texts of the last answer, as they were typed where they counted, and the map that is chosen.
  get #seen() {
    const {state, texts, points} = this.#last ?? {state: {}, texts: this.#controls.used};
    return {state: {...state, ...texts, shown: this.#controls.said.shown ?? "area"}, points};
  }

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
    if (key === "fluid") {
      this.#controls.put("shown", this.#flows ? "flux" : "area");
      this.#showFluid();
    }
    if (key === "w" && this.#sticks === this.#root.querySelector('[data-control="w"]').hidden) { // on or off
      if (this.#controls.said.shown === "retreat") this.#controls.put("shown", "area");
      this.#showSticking();
      this.#root.querySelector(this.#sticks ? "#tab-cycle" : "#tab-area").click();
    }
    this.#forgetWayBack();
    if (key === "F") this.#dim([...CONTACT, ...(this.#sticks ? ["cycle"] : [])]);
    else this.#dimAll();
    this.#askNow();
    clearTimeout(this.#rest);
    this.#waiting.stop(FINER);
    this.#rest = setTimeout(() => this.#sharpen(), isFinal ? 0 : REST);
  }

  #cancelled(works) {
    this.#stopped = this.#turn;
    const left = {full: "the coarse answer is shown", curve: "the marks of the curves belong to the previous surface",
      flow: "the apertures belong to the previous surface",
      unloading: "the way back is not shown", cycle: "both ways belong to the contact before", download: "nothing was saved"};
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
      if (header.state.w) {
        ask("cycle", {...args, refines: false}, (cycle) => {
          this.#drawCycle(cycle);
          if (cycle.is_coarse) ask("cycle", {...args, refines: true}, (finer) => this.#drawCycle(finer));
        });
      }
      if (this.#stale.has("curve")) ask("curve", {...args, refines: true}, (curve) => this.#drawCurve(curve));
      if (this.#stale.has("flow") && header.state.fluid) ask("flow", {...args, refines: true}, (flow) => this.#drawFlow(flow));
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
    const counted = Object.entries(asked.state).filter(([key]) => !(key in header.refused));
    this.#last = {...header, texts: Object.fromEntries(counted)};
    this.#settled(header, asked, turn);
    const what = {what: "contact", points: header.points, numbers: header.numbers};
    for (const plot of ["explore-topography", "explore-contact"]) this.#plots.shows(plot, what);
    this.#plots.setMap("topography", header.arrays.topography, [1, 1], header.heights);
    this.#drawField(header);
    this.#drawHere(header.curve);
    const said = header.strip.map(({key}) => key);
    this.#strip.add(header.strip, NOT_ALWAYS.filter((key) => !said.includes(key)));
    this.#fillTables(header.strip);
    const wasStopped = header.is_coarse && turn === this.#stopped; // and says so already
    if (!wasStopped) this.#say(header.status, !header.is_coarse);
    this.#undim([...CONTACT, ...(header.state.fluid ? [] : ["aperture"])]);
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

  #drawField({maps, arrays}) {
    const {shown: wanted} = this.#controls.said, shown = wanted in maps ? wanted : "area";
    if (!(shown in maps)) return; // the load was not solved
    const {palette, low, high, caption, marks, ring} = maps[shown];
    fillCaption(this.#captionOf("shown"), caption, marks);
    this.#plots.colours("contact", palette);
    this.#plots.setMap("contact", arrays[shown], [1, 1], [low, high]);
    this.#plots.set("ring", {x: ring ? [ring[0]] : [], y: ring ? [ring[1]] : []});
    this.#tell(this.#at);
  }

  #at = null; // where the mouse is on the map, or a finger was

  // Tell what is at a point of the map: place, gap, and flux if a fluid flows.
  #tell(at) {
    this.#at = at;
    const place = this.#root.querySelector("[data-at]"), {gap, flux} = this.#last?.arrays ?? {};
    place.hidden = !at || !gap || Math.min(at.x, at.y) < 0 || Math.max(at.x, at.y) >= 1;
    if (place.hidden) return;
    const [rows, columns] = gap.shape, cell = Math.floor(at.y * rows) * columns + Math.floor(at.x * columns);
    const said = [`x ${at.x.toFixed(3)} L, y ${at.y.toFixed(3)} L`];
    said.push(gap.values[cell] > 0 ? `gap ${gap.values[cell].toPrecision(3)} h` : "in contact");
    if (flux && gap.values[cell] > 0) said.push(this.#fluxInWords(flux.values[cell]));
    place.textContent = said.join("; ");
  }

  #fluxInWords(value) {
    const {palette, low} = this.#last.maps.flux;
    if (palette !== "flux") return value === 0 ? "no fluid comes here" : "no flow";
    if (value < low) return "no flow";
    return value > low ? `flux ${(10 ** value).toPrecision(3)} of its mean` : `flux below ${10 ** low} of its mean`;
  }

  #stale = new Set(["curve", "flow"]); // what belongs to another surface

  #dimAll() {
    this.#stale = new Set(["curve", "flow"]);
    this.#dim([...CONTACT, ...CURVES, ...(this.#flows ? ["aperture"] : []), ...(this.#sticks ? ["cycle"] : [])]);
  }

  #dim(panels) { for (const name of panels) this.#root.querySelector(`#explore-${name}`).classList.add("dimmed"); }
  #undim(panels) { for (const name of panels) this.#root.querySelector(`#explore-${name}`).classList.remove("dimmed"); }

  #drawCurve({curve, grid, theories, stiffness_table, area_table}) {
    this.#stale.delete("curve");
    this.#undim(CURVES);
    this.#setMarks("stiffness unloading", curve.force_bar, curve.unloading_bar ?? []);
    for (const plot of ["explore-stiffness", "explore-area"]) this.#plots.shows(plot, {what: "curve", grid});
    for (const name of ["stiffness", "area"]) this.#drawLoads(name, curve);
    for (let i = 0; i < MOST_THEORIES; i++) {
      const {force_bar = [], stiffness_bar = null, area = []} = theories[i] ?? {};
      this.#plots.set(`stiffness theory ${i}`, {x: stiffness_bar ? force_bar : [], y: stiffness_bar ?? []});
      this.#plots.set(`area theory ${i}`, {x: force_bar, y: area});
    }
    this.#plots.span("explore-stiffness", "y", [...curve.stiffness_bar, ...(curve.unloading_bar ?? [])], [1e-3, 1.3]);
    this.#plots.span("explore-area", "y", curve.area, [1e-4, 1]);
    const called = (name) => this.#root.querySelector(`[data-key="theories"][value="${name}"]`).parentElement.textContent.trim();
    const drawn = theories.map(({name, validity}, i) => `${DASHES[i]} ${called(name)}: ${validity}`);
    for (const name of ["stiffness", "area"]) this.#caption(name, noteOf(curve, grid));
    this.#caption("theories", drawn.map((each) => `${each}.`).join(" "));
    this.#curveTables = [stiffness_table, area_table];
    this.#fillCurveTables();
  }

  #drawFlow({curve, grid, theories, table, words}) {
    this.#stale.delete("flow");
    this.#undim(["aperture"]);
    const known = curve.aperture.filter((value) => value > 0);
    this.#plots.span("explore-aperture", "y", [...known, ...theories.map(({aperture}) => aperture[0]), Math.min(...known) / ROOM]);
    this.#plots.shows("explore-aperture", {what: "flow", grid});
    this.#drawLoads("aperture", curve);
    this.#drawSealed("aperture sealed", [curve]);
    this.#plots.model("aperture sealed label").visible = curve.aperture.includes(0);
    for (const [i, {force_bar, aperture}] of theories.entries()) {
      this.#plots.set(`aperture theory ${i}`, points(force_bar, aperture, (j) => aperture[j] > 0));
    }
    this.#drawSealed("aperture theory sealed", theories.map(({force_bar, aperture}) => {
      const first = aperture.indexOf(0); // of a theory the first sealed load alone
      return first < 0 ? {force_bar: [], aperture: []} : {force_bar: [force_bar[first]], aperture: [0]};
    }));
    if (this.#last) this.#drawHere(this.#last.curve);
    this.#caption("aperture", `${words}; ${noteOf(curve, grid)}`);
    this.#caption("theories of the flow", theories.map(({name, validity}, i) => `${DASHES[i]} ${name}: ${validity}.`).join(" "));
    this.#flowTable = table;
    this.#fillCurveTables();
  }

  // Draw both ways of bodies that stick, and what the strip and the map have of them.
  #drawCycle({curve, turn, on_approach, here, pull_off, grid, strip, maps, arrays, table}) {
    this.#undim(["cycle"]);
    this.#plots.shows("explore-cycle", {what: "cycle", grid});
    const ways = {there: (i) => on_approach[i], back: (i) => !on_approach[i]};
    for (const [way, isOn] of Object.entries(ways)) this.#plots.set(`cycle ${way}`, points(curve.depth, curve.force_bar, isOn));
    this.#plots.set("cycle here", here);
    this.#plots.set("cycle pull-off", pull_off);
    const label = {value: `pull-off, ${strip.find(({key}) => key === "pull_off").value}`};
    this.#plots.model("cycle pull-off label").setv({label, visible: pull_off.x.length > 0});
    const borne = points(curve.depth, curve.force_bar, (i) => curve.force_bar[i] !== 0);
    for (const [axis, known] of [["x", borne.x], ["y", borne.y]]) {
      const [low, high] = [Math.min(...known), Math.max(...known)], room = ROOM_ABOUT * (high - low);
      this.#plots.range("explore-cycle", axis, low - room, high + room);
    }
    for (const name of ["stiffness", "area"]) this.#setMarks(`${name} back`, turn.force_bar, turn[OVER_FORCE[name]]);
    this.#caption("cycle", `by depths to twice this load and back, on ${grid} points; under a force bodies jump where it falls`);
    fillTable("explore-cycle", ["d/h", "F̄", "A/A_0", "k̄", "way"], table);
    this.#strip.add(strip);
    if (!this.#last) return;
    Object.assign(this.#last.maps, maps);
    Object.assign(this.#last.arrays, arrays);
    this.#drawField(this.#last);
  }

  // Draw sealed loads at the foot of the axis.
  #drawSealed(name, curves) {
    const x = curves.flatMap(({force_bar, aperture}) => force_bar.filter((_, i) => aperture[i] === 0));
    this.#plots.set(name, {x, y: x.map(() => this.#foot)});
  }

  get #foot() {
    const {start, end} = this.#plots.root("explore-aperture").y_range;
    return start * (end / start) ** FOOT;
  }

  // Draw the loads of a curve; those with too few cells in contact are hollow.
  #drawLoads(name, curve) {
    const values = curve[OVER_FORCE[name]], isKnown = (i) => curve.converged[i] && values[i] > 0;
    const few = points(curve.force_bar, values, (i) => isKnown(i) && !curve.resolved[i]);
    this.#plots.set(`${name} curve`, points(curve.force_bar, values, (i) => isKnown(i) && curve.resolved[i]));
    this.#plots.set(`${name} unsure`, few);
    this.#plots.model(`${name} unsure label`).visible = few.x.length > 0;
  }

  // Draw the present load, at the foot where it is sealed.
  #drawHere(curve) {
    for (const [name, quantity] of Object.entries(OVER_FORCE)) {
      const values = curve[quantity] ?? [], y = name === "aperture" ? values.map((value) => value || this.#foot) : values;
      this.#plots.set(`${name} here`, {x: y.length ? curve.force_bar : [], y});
    }
  }

  #drawWayBack({curve, stiffness_table, area_table, aperture_table}) {
    this.#setMarks("stiffness back", curve.force_bar, curve.unloading_bar);
    this.#setMarks("area back", curve.force_bar, curve.area);
    this.#setMarks("aperture back", curve.force_bar, curve.aperture ?? []);
    this.#backTables = [stiffness_table, area_table.map(([force, area]) => [force, `${area} (way back)`]), aperture_table];
    this.#fillCurveTables();
  }

  #forgetWayBack() {
    if (!this.#plots?.model("area back").data.x.length) return;
    for (const name of Object.keys(OVER_FORCE)) this.#setMarks(`${name} back`, [], []);
    this.#backTables = [[], [], []];
    this.#fillCurveTables();
  }

  // Draw what is positive, as logarithmic axes can, and name it in the legend if there is any.
  #setMarks(name, x, y) {
    const marks = points(x, y, (i) => x[i] > 0 && y[i] > 0);
    this.#plots.set(name, marks);
    this.#plots.model(`${name} label`).visible = marks.x.length > 0;
  }

  #lineTable = []; #curveTables = [[], []]; #backTables = [[], [], []]; #flowTable = [];

  #fillCurveTables() {
    const [stiffness, area] = [0, 1].map((i) => [...this.#curveTables[i], ...this.#backTables[i]]);
    fillTable("explore-stiffness", ["F̄", "k̄", "model"], [...stiffness, ...this.#lineTable]);
    fillTable("explore-area", ["F̄", "A/A_0"], area);
    fillTable("explore-aperture", ["F̄", "u_h/h", "model"], [...this.#flowTable, ...this.#backTables[2]]);
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
    for (const name of CURSORS) this.#plots.model(`${name} cursor`).location = force;
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

  get #sticks() { return Boolean(this.#controls.said.w); }

  // Show what there is of bodies that stick alone.
  #showSticking() {
    const sticks = this.#sticks;
    this.#root.querySelector("#explore-sticks").checked = sticks;
    for (const key of ["w", "h0"]) this.#root.querySelector(`[data-control="${key}"]`).hidden = !sticks;
    this.#showOf("w", sticks);
    if (!sticks) this.#undim(["cycle"]);
  }

  get #flows() { return Boolean(this.#controls.said.fluid); }

  // Show what there is with a fluid alone, and its curve.
  #showFluid() {
    const flows = this.#flows;
    this.#showOf("fluid", flows);
    this.#root.querySelector(flows ? "#tab-aperture" : "#tab-area").click();
    this.#caption("theories of the flow", "");
    if (!flows) this.#undim(["aperture"]);
  }

  // Show or hide what belongs to a control that is set; a hidden choice is left.
  #showOf(key, isSet) {
    for (const each of this.#root.querySelectorAll(`[data-of="${key}"]`)) each.hidden = !isSet;
    for (const select of this.#root.querySelectorAll(`select:has([data-of="${key}"]:checked)`)) if (!isSet) select.selectedIndex = 0;
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
    for (const [tick, key] of [["#explore-yields", "hardness_bar"], ["#explore-sticks", "w"]]) {
      find(tick).addEventListener("change", ({target}) => {
        const text = find(`#explore-${key}-text`).value || find(`#explore-${key}`).dataset.default;
        this.#controls.set(key, target.checked ? text : "");
      });
    }
    bindTabs(this.#root);
  }
}

// Say of a curve what its marks are, and which loads have none.
function noteOf({converged, resolved}, grid) {
  const failed = converged.filter((each) => !each).length;
  const unsure = resolved.some((each) => !each) ? "; hollow, and * in the table: fewer than ten cells touch" : "";
  return `marks of the curve on ${grid} points${unsure}${failed ? `; ${failed} loads were not solved` : ""}`;
}

function sameState(first, second) { return JSON.stringify(first) === JSON.stringify(second); }
