// Explore: a random surface under both models, as sliders move.
import {Controls} from "./controls.js";
import {embedded, fillTable} from "./plots.js";
import {Waiting} from "./waiting.js";

const REST = 250; // without a move, until the full grid is computed [ms]
const LABELS = {
  area: "black: in contact",
  pressure: "pressure over E*",
  gap: "gap in rms heights",
  displacement: "deflection of the half-space in rms heights",
};
const STRIP = ["stiffness_3d", "stiffness_1d", "area", "pressure", "depth", "force", "roughness"];

export async function open(link, address, said) {
  const view = new Explore(link, address);
  await view.open(said);
  return view;
}

class Explore {
  #link; #address; #root = document.querySelector("#explore");
  #controls; #plots; #waiting; #rest = null; #strip = {}; #last = null; #fromCursor = false;

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    this.#controls = new Controls(this.#root, (key, isFinal) => this.#changed(key, isFinal));
    this.#waiting = new Waiting(this.#root.querySelector(".status"), () => {
      link.stop("full");
      link.stop("curve");
      this.#say("stopped; the coarse answer is shown");
    });
    this.#bindButtons();
  }

  async open(said) {
    const {view, ...texts} = said;
    this.#controls.take(texts);
    this.#showHeightOrSlope();
    this.#askNow(false);
    this.#plots = await embedded("explore");
    for (const name of ["stiffness", "area"]) {
      this.#plots.onMove(`${name} cursor`, (force) => this.#cursorMoved(force));
    }
    for (const draw of this.#missed.splice(0)) draw();
    this.#sharpen();
  }

  shown() { this.#address.write("explore", this.#last?.state ?? {}); }

  reconnected() { this.#askNow(true); }

  #missed = []; // answers that came before the plots were there
  #draw(action) { if (this.#plots) action(); else this.#missed.push(action); }

  #changed(key, isFinal) {
    if (key === "shown") {
      if (this.#last) this.#drawField(this.#last);
      this.#writeAddress();
      return;
    }
    if (key === "rms") this.#showHeightOrSlope();
    this.#askNow(key === "n");
    clearTimeout(this.#rest);
    this.#link.stop("full");
    this.#link.stop("curve");
    this.#rest = setTimeout(() => this.#sharpen(), isFinal ? 0 : REST);
  }

  #arguments() { return {state: this.#controls.said}; }

  #askNow() {
    const error = (sentence, at) => this.#refuse(sentence, at);
    this.#link.ask("explore.reduced", "reduced", this.#arguments(), {
      answer: (header) => this.#draw(() => this.#drawLine(header)), error});
    this.#link.ask("explore.coarse", "coarse", this.#arguments(), {
      answer: (header) => this.#draw(() => this.#drawContact(header)), error});
  }

  #sharpen() {
    if (!this.#plots) return;
    const error = (sentence, at) => { this.#waiting.end(); this.#refuse(sentence, at); };
    const progress = (message) => this.#waiting.progress(message);
    const args = this.#arguments();
    this.#waiting.begin();
    this.#root.classList.add("dimmed");
    this.#link.ask("explore.full", "full", args, {
      answer: (header) => {
        this.#drawContact(header);
        this.#link.ask("explore.curve", "curve", args, {
          answer: (curve) => { this.#waiting.end(); this.#drawCurve(curve); }, error, progress});
      },
      error,
      progress,
    });
  }

  #drawLine({state, numbers, line, strip}) {
    this.#settled(state, numbers);
    this.#plots.set("stiffness line", {x: line.force_bar, y: line.stiffness_bar, low: line.low, high: line.high});
    this.#strip_(strip);
    this.#cursorTo(numbers.F);
    this.#line = line;
  }

  #drawContact(header) {
    if (header.is_coarse && this.#last && !this.#last.is_coarse && sameState(this.#last.state, header.state)) return;
    this.#last = header;
    this.#settled(header.state, header.numbers);
    this.#plots.setMap("topography", header.arrays.topography, [1, 1], header.heights);
    this.#drawField(header);
    const {force_bar: x, stiffness_bar, area} = header.curve;
    this.#plots.set("stiffness here", {x, y: stiffness_bar});
    this.#plots.set("area here", {x, y: area});
    const {waves, C_2d, law} = header.spectrum;
    this.#plots.set("spectrum", {x: waves, y: C_2d, law: law.map((value) => value ?? NaN)});
    this.#strip_(header.strip);
    this.#say(header.status);
    if (!header.is_coarse) this.#root.classList.remove("dimmed");
    fillTable("explore-topography", ["quantity", "value"], header.strip.filter(({key}) => key === "roughness").map(({symbol, value, below}) => [`rms height ${symbol}`, `${value}, ${below}`]));
    fillTable("explore-contact", ["quantity", "value"], header.strip.map(({symbol, value, below}) => [symbol, below ? `${value} (${below})` : value]));
    const every = Math.ceil(waves.length / 40);
    fillTable("explore-spectrum", ["waves in the side", "C_2d [m⁴]", "law [m⁴]"], waves.flatMap((wave, i) => i % every ? [] : [[wave.toPrecision(3), C_2d[i].toExponential(2), law[i]?.toExponential(2) ?? "-"]]));
  }

  #drawField(header) {
    const shown = this.#controls.said.shown ?? "area";
    const field = header.arrays[shown];
    this.#caption("shown", LABELS[shown]);
    if (!field) return;
    let high = 1;
    if (shown !== "area") { high = 0; for (const value of field.values) if (value > high) high = value; }
    this.#plots.colours("contact", shown === "area" ? "marks" : shown === "pressure" ? "viridis" : "cividis");
    this.#plots.setMap("contact", field, [1, 1], [0, high || 1]);
  }

  #drawCurve({curve, grid, theories, stiffness_table, area_table}) {
    const rows = (wanted, values) => {
      const kept = curve.force_bar.flatMap((x, i) => curve.converged[i] && values[i] !== null && curve.resolved[i] === wanted ? [i] : []);
      return {x: kept.map((i) => curve.force_bar[i]), y: kept.map((i) => values[i])};
    };
    for (const [name, values] of [["stiffness", curve.stiffness_bar], ["area", curve.area]]) {
      this.#plots.set(`${name} curve`, rows(true, values));
      this.#plots.set(`${name} unsure`, rows(false, values));
    }
    const known = theories.filter((each) => each.stiffness_bar);
    this.#plots.set("stiffness theories", {xs: known.map((each) => each.force_bar), ys: known.map((each) => each.stiffness_bar), name: known.map((each) => each.name)});
    this.#plots.set("area theories", {xs: theories.map((each) => each.force_bar), ys: theories.map((each) => each.area), name: theories.map((each) => each.name)});
    const failed = curve.converged.filter((each) => !each).length;
    const note = failed ? `; ${failed} loads were not solved` : "";
    this.#caption("stiffness", `marks on ${grid} points${note}`);
    this.#caption("area", [`marks on ${grid} points${note}`, ...theories.map(({name, validity}) => `${name}: ${validity}`)].join("; "));
    const line = this.#line;
    const lineRows = line ? line.force_bar.map((x, i) => [x.toPrecision(3), line.stiffness_bar[i].toPrecision(3), "1D"]) : [];
    fillTable("explore-stiffness", ["F̄", "k̄", "model"], [...stiffness_table.map((cells) => [...cells, "3D"]), ...lineRows]);
    fillTable("explore-area", ["F̄", "A/A_0"], area_table);
  }
  #line = null;

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

  #strip_(items) {
    for (const item of items) this.#strip[item.key] = item;
    const shown = STRIP.filter((key) => key in this.#strip).map((key) => this.#strip[key]);
    this.#root.querySelector(".strip").replaceChildren(...shown.map(({key, symbol, value, below, meaning}) => {
      const item = document.createElement("div");
      item.title = meaning;
      item.dataset.answer = key;
      item.tabIndex = 0;
      item.setAttribute("aria-label", `${symbol} ${value} ${below}. ${meaning}`);
      for (const [kind, text] of [["dt", symbol], ["dd", value], ["dd", below]]) {
        const part = document.createElement(kind);
        part.textContent = text;
        item.append(part);
      }
      return item;
    }));
  }

  #refuse(sentence, at) {
    clearTimeout(this.#rest);
    this.#root.classList.remove("dimmed");
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
