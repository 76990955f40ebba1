// The paper: its figures from the published study, with windows and averages to choose.
import {Controls} from "./controls.js";
import {element, typeset} from "./elements.js";
import {onDraw, onTouch} from "./hands.js";
import {colour, embedded} from "./plots.js";
import {publishedFigures} from "./published-figures.js";
import {Strip} from "./strip.js";
import {fillTable} from "./tables.js";

const EDGES = {"1D": ["low_1D", "high_1D"], "3D": ["low_3D", "high_3D"]};
const STRIP = ["exponent_1D", "stated_1D", "exponent_3D", "stated_3D"];
const OF_THE_POINT = ["roll_off", "map_D_f", "map_F", "tolerance", "claims"];
const TASKS = ["fits", "point"];
const DIMENSIONS = ["2", "2.2", "2.4", "2.6", "2.8", "3"]; // of the curves, by their place in the ramp of colours
const PANEL = "published-trust-"; // with a roll-off ratio, the panel of the trust map

const mapped = (each, change) => Object.fromEntries(Object.entries(each).map(([key, value]) => [key, change(value)]));

export async function open(link, address, said) {
  const view = new Published(link, address);
  await view.open(said);
  return view;
}

class Published {
  #link; #address; #root = document.querySelector("#published"); #controls; #plots = null; #strip; #constants = null; #panels;
  #later = new Set(); #drawn = {}; #looks = {}; #state = {}; #ofLink = ""; #shown = "";

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    this.#controls = new Controls(this.#root, (key) => {
      this.#ofLink = "";
      this.#ask(OF_THE_POINT.includes(key) ? "point" : "fits");
    });
    this.#panels = [...this.#root.querySelectorAll(`[id^="${PANEL}"]`)];
    this.#strip = new Strip(this.#root.querySelector(".strip"), STRIP);
    this.#root.querySelector("#published-windows").addEventListener("click", () => {
      const kept = Object.entries(this.#controls.said).filter(([key]) => !Object.values(EDGES).flat().includes(key));
      this.#controls.take(Object.fromEntries(kept));
      this.#ask("fits");
    });
  }

  async open({view, ...texts}) {
    this.#controls.take(texts);
    TASKS.forEach((task) => this.#ask(task));
    this.#constants = await (await fetch("/lab/paper/figures.json")).json();
    this.#take(this.#constants);
    this.#showCurves();
    this.#plots = await embedded(() => publishedFigures(this.#panels.map(({id}) => id.replace(PANEL, ""))));
    for (const model of Object.keys(EDGES)) this.#bindWindow(model);
    for (const {id} of this.#panels) {
      onTouch(this.#plots.root(id), ({x, y}) => {
        const [map_F, map_D_f] = [this.#controls.within("map_F", x), this.#controls.within("map_D_f", y)];
        this.#controls.take({...this.#controls.said, roll_off: id.replace(PANEL, ""), map_F, map_D_f});
        this.#ask("point");
      });
    }
    this.#root.querySelector("[data-legend]").replaceChildren(...this.#constants.legend.map(([background, text]) =>
      element("li", {}, element("span", {className: "patch", style: `background: ${background}`}), text)));
    this.#draw(this.#drawn, this.#looks);
    new MutationObserver(() => this.#draw(this.#drawn)).observe(document.documentElement, {attributeFilter: ["data-theme"]});
  }

  shown() { this.#address.write("published", this.#state); }

  // Ask; while an answer is awaited, a newer question waits for it, so that a moving window is followed.
  #ask(task) {
    if (this.#link.isWaiting(task)) { this.#later.add(task); return; }
    const ended = () => { if (this.#later.delete(task)) this.#ask(task); };
    const asked = this.#controls.asked;
    this.#link.ask(`published.${task}`, task, asked, {
      answer: (header) => {
        const elsewhere = this.#controls.answered(asked, header);
        this.#controls.refuse("", [this.#ofLink, elsewhere].filter(Boolean).join(" "));
        this.#state = header.state;
        if (!this.#root.hidden) this.shown();
        this.#take(header);
        if (task === "fits") this.#showCurves();
        else this.#showPoint(header);
        ended();
      },
      error: (sentence, at) => { this.#refuse(sentence, at); ended(); },
    });
  }

  // Put a sentence at its control; the defaults take the place of a link that cannot be read.
  #refuse(sentence, at) {
    if (at === "v") {
      if (this.#ofLink) return;
      this.#ofLink = sentence;
      this.#controls.take({});
      TASKS.forEach((task) => this.#ask(task));
    } else if (!this.#controls.refuse(at, sentence)) this.#controls.refuse("", sentence);
  }

  // Take an answer: columns of what is drawn, looks of models, tables, words at their places, large figures.
  #take({draw = {}, look = {}, tables = {}, words = {}, strip = []}) {
    Object.assign(this.#drawn, draw);
    Object.assign(this.#looks, look);
    for (const [id, {header, rows}] of Object.entries(tables)) {
      const labelled = (cell, i) => [element("span", {className: "label"}, ...typeset(header[i])), ...typeset(cell)];
      fillTable(id, header.map(typeset), rows.map((cells) => cells.map(labelled)));
    }
    for (const [place, text] of Object.entries(words)) {
      this.#root.querySelector(`[data-words="${place}"]`).replaceChildren(...typeset(text));
    }
    this.#strip.add(strip);
    for (const place of this.#root.querySelectorAll(".fit td, .strip dd:nth-child(2)")) {
      place.dataset.verdict = place.textContent.match(/confirmed|refuted|undecided/)?.[0] ?? "";
    }
    if (this.#plots) this.#draw(draw, look);
  }

  // Show the curves for what is chosen, of the fractal dimensions that are chosen.
  #showCurves() {
    const {mean, punch, D_f} = this.#state, kept = D_f?.split(",").map((each) => DIMENSIONS.indexOf(each));
    if (!this.#constants || !kept || this.#shown === `${mean} ${punch} ${D_f}`) return;
    this.#shown = `${mean} ${punch} ${D_f}`;
    const first = (cells) => cells.filter((_, i) => i === 0 || kept.includes(i - 1));
    for (const name of [`1D ${mean}`, `3D ${mean} ${punch}`, "area"]) {
      const {draw, look, tables} = this.#constants.curves[name];
      const shown = ({ramp, ...columns}) => mapped({ramp, ...columns}, (each) => each.filter((_, i) => kept.includes(ramp[i])));
      const table = ({header, rows}) => ({header: first(header), rows: rows.map(first)});
      this.#take({look, draw: mapped(draw, shown), tables: mapped(tables, table)});
    }
  }

  // Mark the point of the trust map, and what is said of it.
  #showPoint({state, numbers, verdict}) {
    this.#root.querySelector('[data-words="point"]').dataset.verdict = verdict;
    const marks = this.#panels.map((panel) => {
      const isChosen = panel.id === PANEL + state.roll_off;
      panel.classList.toggle("chosen", isChosen);
      return [panel.id.replace(PANEL, "trust point "), isChosen ? {x: [numbers.map_F], y: [numbers.map_D_f]} : {x: [], y: []}];
    });
    this.#take({draw: Object.fromEntries(marks)});
  }

  // Fill sources, in the colours of the theme; a window that is moved by hand stays where it is.
  #draw(columns, looks = {}) {
    for (const [name, each] of Object.entries(columns)) {
      this.#plots.set(name, each.ramp ? {...each, colour: each.ramp.map((i) => colour(`ramp-${i}`))} : each);
    }
    this.#placing = true;
    for (const [name, each] of Object.entries(looks)) if (name !== this.#moving) this.#plots.model(name).setv(each);
    this.#placing = false;
  }

  #placing = false; #moving = null; #rest = null; // the window that is held by the mouse

  #bindWindow(model) {
    const box = this.#plots.model(`window ${model}`), plot = this.#plots.root(`published-stiffness-${model}`);
    const moved = () => { if (!this.#placing) this.#windowMoved(model, box.left, box.right); };
    for (const side of ["left", "right"]) box.properties[side].change.connect(moved);
    plot.on_event("selectiongeometry", ({geometry}) => {
      if (geometry.type === "rect" && geometry.x0 !== geometry.x1) this.#windowMoved(model, geometry.x0, geometry.x1);
    });
    onDraw(plot, this.#root.querySelector(`[data-draw="${model}"]`), (from, to) => {
      if (from.x !== to.x) box.setv({left: Math.min(from.x, to.x), right: Math.max(from.x, to.x)});
    });
  }

  #windowMoved(model, ...edges) {
    const name = `window ${model}`;
    this.#moving = name;
    const ends = edges.sort((a, b) => a - b).map((edge, i) => [EDGES[model][i], this.#controls.within(EDGES[model][i], edge)]);
    this.#controls.take({...this.#controls.said, ...Object.fromEntries(ends)});
    this.#ask("fits");
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => {
      this.#moving = null;
      this.#draw({}, {[name]: this.#looks[name]});
    }, 400);
  }
}
