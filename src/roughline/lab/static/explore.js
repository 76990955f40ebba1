// Explore: a random surface under both models, as sliders move.
import {Controls} from "./controls.js";
import {embedded, fillTable} from "./plots.js";
import {Strip} from "./strip.js";
import {Waiting} from "./waiting.js";

const REST = 250; // without a move, until the full grid is computed [ms]
const LABELS = {
  area: "black: in contact",
  pressure: "pressure over E*; blank where nothing touches",
  gap: "gap in rms heights; blank where they touch",
  displacement: "deflection of the half-space in rms heights",
};
const DASHES = ["– –", "· · ·", "– ·"]; // as theories are drawn
const MOST_THEORIES = DASHES.length;
const CONTACT = ["topography", "contact"], CURVES = ["stiffness", "area", "spectrum"]; // panels
const STRIP = ["stiffness_3d", "stiffness_1d", "area", "pressure", "depth", "force", "roughness"];

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
    this.#waiting = new Waiting(this.#root.querySelector(".status"), () => {
      link.stop("full");
      link.stop("curve");
      this.#say("stopped; the coarse answer is shown");
    });
    this.#strip = new Strip(this.#root.querySelector(".strip"), STRIP);
    this.#bindButtons();
  }

  async open(said) {
    const {view, ...texts} = said;
    this.#controls.take(texts);
    this.#showHeightOrSlope();
    const theories = (texts.theories ?? "").split(",");
    for (const box of this.#root.querySelectorAll("[data-theory]")) box.checked = theories.includes(box.dataset.theory);
    this.#askNow();
    this.#plots = await embedded("explore");
    for (const name of ["stiffness", "area"]) {
      this.#plots.onMove(`${name} cursor`, (force) => this.#cursorMoved(force));
    }
    this.#plots.frame(["explore-topography", "explore-contact"], [1, 1]);
    for (const draw of this.#missed.splice(0)) draw();
    this.#sharpen();
  }

  shown() { this.#address.write("explore", this.#last?.state ?? {}); }

  reconnected() { this.#askNow(); this.#sharpen(); }

  #missed = []; // answers that came before the plots were there
  #draw(action) { if (this.#plots) action(); else this.#missed.push(action); }

  #changed(key, isFinal) {
    if (key === "shown") {
      if (this.#last) this.#drawField(this.#last);
      this.#writeAddress();
      return;
    }
    if (key === "rms") this.#showHeightOrSlope();
    this.#stale = key !== "F" || this.#stale;
    this.#dim(key === "F" ? CONTACT : [...CONTACT, ...CURVES]);
    this.#askNow();
    clearTimeout(this.#rest);
    this.#link.stop("full");
    this.#link.stop("curve");
    this.#rest = setTimeout(() => this.#sharpen(), isFinal ? 0 : REST);
  }

  #arguments() { return {state: this.#controls.said}; }

  #askNow() {
    const error = (sentence, at) => this.#refuse(sentence, at), args = this.#arguments();
    this.#link.stop("finer lines");
    this.#link.ask("explore.reduced", "reduced", args, {
      answer: (header) => {
        this.#draw(() => this.#drawLine(header));
        if (header.is_coarse) { // many ask at once
          this.#link.ask("explore.reduced", "finer lines", {...args, refines: true}, {
            answer: (finer) => this.#draw(() => this.#drawLine(finer))});
        }
      },
      error,
    });
    this.#link.ask("explore.coarse", "coarse", this.#arguments(), {
      answer: (header) => this.#draw(() => this.#drawContact(header)), error});
  }

  #sharpen(refines = false) {
    if (!this.#plots) return;
    const error = (sentence, at) => { this.#waiting.end(); this.#refuse(sentence, at); };
    const progress = (message) => this.#waiting.progress(message);
    const args = {...this.#arguments(), refines};
    this.#waiting.begin();
    this.#link.ask("explore.full", "full", args, {
      answer: (header) => {
        this.#drawContact(header);
        if (header.is_coarse && !args.refines) { this.#sharpen(true); return; } // many ask at once
        if (!this.#stale) { this.#waiting.end(); return; }
        this.#link.ask("explore.curve", "curve", {...args, refines: true}, {
          answer: (curve) => { this.#waiting.end(); this.#drawCurve(curve); }, error, progress});
      },
      error,
      progress,
    });
  }

  #drawLine({state, numbers, line, table, strip}) {
    this.#settled(state, numbers);
    this.#plots.shows("explore-stiffness", {what: "line", numbers});
    this.#plots.set("stiffness line", {x: line.force_bar, y: line.stiffness_bar, low: line.low, high: line.high});
    this.#strip.add(strip);
    this.#cursorTo(numbers.F);
    this.#lineTable = table;
  }

  #drawContact(header) {
    if (header.is_coarse && this.#last && !this.#last.is_coarse && sameState(this.#last.state, header.state)) return;
    this.#last = header;
    this.#settled(header.state, header.numbers);
    const what = {what: "contact", points: header.points, numbers: header.numbers};
    for (const plot of ["explore-topography", "explore-contact"]) this.#plots.shows(plot, what);
    this.#plots.setMap("topography", header.arrays.topography, [1, 1], header.heights);
    this.#drawField(header);
    const {force_bar: x, stiffness_bar, area} = header.curve;
    this.#plots.set("stiffness here", {x, y: stiffness_bar});
    this.#plots.set("area here", {x, y: area});
    this.#strip.add(header.strip);
    this.#say(header.status);
    this.#undim(CONTACT);
    if (!header.is_coarse) this.#drawRest(header);
  }

  // What follows at rest: the spectrum and the tables.
  #drawRest({spectrum: {waves, C_2d, law}, spectrum_table, strip}) {
    this.#plots.span("explore-spectrum", "x", waves);
    this.#plots.span("explore-spectrum", "y", C_2d);
    this.#plots.set("spectrum", {x: waves, y: C_2d, law: law.map((value) => value ?? NaN)});
    fillTable("explore-spectrum", ["waves in the side", "C_2d [m⁴]", "law [m⁴]"], spectrum_table);
    const rows = (kept) => strip.filter(kept).map(({symbol, value, below}) => [symbol, value, below]);
    fillTable("explore-topography", ["quantity", "value", ""], rows(({key}) => key === "roughness"));
    fillTable("explore-contact", ["quantity", "value", ""], rows(({key}) => key !== "roughness"));
  }

  #drawField(header) {
    const shown = this.#controls.said.shown ?? "area";
    const field = header.arrays[shown];
    this.#caption("shown", LABELS[shown]);
    if (!field) return;
    let high = 1;
    if (shown !== "area") { high = 0; for (const value of field.values) if (value > high) high = value; }
    this.#plots.colours("contact", shown === "area" ? "marks" : shown === "pressure" ? "viridis" : "cividis");
    const low = shown === "pressure" ? 1e-6 * high : 0; // where nothing presses, the paper shows
    this.#plots.setMap("contact", field, [1, 1], [low, high || 1]);
  }

  #stale = true; // whether the whole curve belongs to another surface

  #dim(panels) { for (const name of panels) this.#root.querySelector(`#explore-${name}`).classList.add("dimmed"); }
  #undim(panels) { for (const name of panels) this.#root.querySelector(`#explore-${name}`).classList.remove("dimmed"); }

  #drawCurve({curve, grid, theories, stiffness_table, area_table}) {
    this.#stale = false;
    this.#undim(CURVES);
    const rows = (wanted, values) => {
      const kept = curve.force_bar.flatMap((x, i) => curve.converged[i] && values[i] !== null && curve.resolved[i] === wanted ? [i] : []);
      return {x: kept.map((i) => curve.force_bar[i]), y: kept.map((i) => values[i])};
    };
    for (const plot of ["explore-stiffness", "explore-area"]) this.#plots.shows(plot, {what: "curve", grid});
    for (const [name, values] of [["stiffness", curve.stiffness_bar], ["area", curve.area]]) {
      this.#plots.set(`${name} curve`, rows(true, values));
      this.#plots.set(`${name} unsure`, rows(false, values));
    }
    for (let i = 0; i < MOST_THEORIES; i++) {
      const {force_bar = [], stiffness_bar = null, area = []} = theories[i] ?? {};
      this.#plots.set(`stiffness theory ${i}`, {x: stiffness_bar ? force_bar : [], y: stiffness_bar ?? []});
      this.#plots.set(`area theory ${i}`, {x: force_bar, y: area});
    }
    this.#plots.span("explore-stiffness", "y", curve.stiffness_bar, [1e-3, 1.3]);
    this.#plots.span("explore-area", "y", curve.area, [1e-4, 1]);
    const failed = curve.converged.filter((each) => !each).length;
    const note = failed ? `; ${failed} loads were not solved` : "";
    const drawn = theories.map(({name, validity}, i) => `${DASHES[i]} ${name}: ${validity}`);
    this.#caption("stiffness", `marks of the curve on ${grid} points${note}`);
    this.#caption("area", `marks of the curve on ${grid} points${note}`);
    this.#caption("theories", drawn.map((each) => `${each}.`).join(" "));
    fillTable("explore-stiffness", ["F̄", "k̄", "model"], [...stiffness_table, ...this.#lineTable]);
    fillTable("explore-area", ["F̄", "A/A_0"], area_table);
  }
  #lineTable = [];

  #settled(state, numbers) {
    this.#controls.showNumbers(numbers);
    for (const place of this.#root.querySelectorAll("[data-error]")) place.textContent = "";
    this.#address.write("explore", {...state, ...(this.#controls.said.shown ? {shown: this.#controls.said.shown} : {})});
  }

  #writeAddress() {
    if (this.#last) this.#settled(this.#last.state, this.#last.numbers);
  }

  #cursorTo(force) {
    this.#fromCursor = true;
    for (const name of ["stiffness", "area"]) this.#plots.model(`${name} cursor`).location = force;
    this.#fromCursor = false;
  }

  #cursorMoved(force) {
    if (this.#fromCursor) return;
    const limited = Math.min(10, Math.max(1e-4, force));
    this.#controls.take({...this.#controls.said, F: String(Number(limited.toPrecision(4)))});
    this.#changed("F", false);
  }

  #refuse(sentence, at) {
    clearTimeout(this.#rest);
    if (!this.#controls.refuse(at, sentence)) this.#controls.refuse("", sentence);
  }

  #say(text) { this.#root.querySelector("[data-status]").textContent = text; }
  #caption(name, text) { this.#root.querySelector(`[data-caption="${name}"]`).textContent = text; }

  #showHeightOrSlope() {
    const bySlope = this.#controls.said.rms === "slope";
    this.#root.querySelector('[data-control="h"]').hidden = bySlope;
    this.#root.querySelector('[data-control="slope"]').hidden = !bySlope;
  }

  #bindButtons() {
    const find = (selector) => this.#root.querySelector(selector);
    find("#another").addEventListener("click", () => {
      this.#controls.take({...this.#controls.said, seed: String(Math.floor(Math.random() * 1e6))});
      this.#changed("seed", true);
    });
    const tabs = [...this.#root.querySelectorAll('[role="tab"]')];
    const choose = (chosen) => {
      for (const tab of tabs) {
        tab.setAttribute("aria-selected", String(tab === chosen));
        tab.tabIndex = tab === chosen ? 0 : -1;
        find(`#${tab.getAttribute("aria-controls")}`).hidden = tab !== chosen;
      }
    };
    for (const tab of tabs) {
      tab.addEventListener("click", () => choose(tab));
      tab.addEventListener("keydown", ({key}) => {
        if (key !== "ArrowLeft" && key !== "ArrowRight") return;
        const other = tabs[(tabs.indexOf(tab) + 1) % tabs.length];
        choose(other);
        other.focus();
      });
    }
    choose(tabs[0]);
    for (const box of this.#root.querySelectorAll("[data-theory]")) {
      box.addEventListener("change", () => {
        const chosen = [...this.#root.querySelectorAll("[data-theory]:checked")].map((each) => each.dataset.theory);
        this.#controls.set("theories", chosen.join(","), true);
      });
    }
    for (const [id, which] of [["#as-python", "python"], ["#as-command", "command"]]) {
      find(id).addEventListener("click", () => this.#showCode(which));
    }
    find("#copy-code").addEventListener("click", () => navigator.clipboard.writeText(find("#code pre").textContent));
    find("#save").addEventListener("change", ({target}) => {
      const name = target.value;
      target.value = "";
      if (name) this.#save(name);
    });
  }

  #showCode(which) {
    this.#link.ask("explore.code", "code", {...this.#arguments(), which}, {
      answer: ({text}) => {
        this.#root.querySelector("#code pre").textContent = text;
        this.#root.querySelector("#code").showModal();
      },
      error: (sentence, at) => this.#refuse(sentence, at),
    });
  }

  #save(name) {
    this.#waiting.begin();
    this.#link.ask("explore.download", "download", {...this.#arguments(), name}, {
      answer: ({file}) => {
        this.#waiting.end();
        const anchor = document.createElement("a");
        anchor.href = `/results/${this.#link.session}/${file}?save=1`;
        anchor.download = name;
        anchor.click();
      },
      error: (sentence, at) => { this.#waiting.end(); this.#refuse(sentence, at); },
      progress: (message) => this.#waiting.progress(message),
    });
  }
}

function sameState(first, second) { return JSON.stringify(first) === JSON.stringify(second); }
