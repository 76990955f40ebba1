// The paper: its figures from the published study, with windows and averages to choose.
import {Controls} from "./controls.js";
import {element, typeset} from "./elements.js";
import {add, draw, plot} from "./figures.js";
import {onDraw, onTouch} from "./hands.js";
import {panelsOf} from "./panels.js";
import constants from "./paper.json" with {type: "json"};
import {fillFigures, fillTable, judged, patch} from "./tables.js";

const EDGES = {"1D": ["low_1D", "high_1D"], "3D": ["low_3D", "high_3D"]};
const OF_THE_POINT = ["roll_off", "map_D_f", "map_F", "tolerance"];
const TASKS = ["fits", "point"];
const DIMENSIONS = [...document.querySelectorAll('#published [data-key="D_f"]')].map(({value}) => value);
const PANEL = "published-trust-"; // with a roll-off ratio, the panel of the trust map
const HATCH = {hatch_pattern: "right_diagonal_line", hatch_color: "#1c1c1a", hatch_alpha: 0.7, hatch_scale: 7, hatch_weight: 0.8};
const WINDOW = {movable: "x", resizable: "x", fill_alpha: 0.12, line_alpha: 0.6, level: "underlay",
  colours: {fill_color: "quiet", line_color: "quiet"}};

const mapped = (each, change) => Object.fromEntries(Object.entries(each).map(([key, value]) => [key, change(value)]));
const ofDimensions = (series, wanted) => Object.fromEntries(Object.entries(series).filter(([name]) => {
  const [dimension] = name.split(" ");
  return !DIMENSIONS.includes(dimension) || wanted.includes(dimension);
}));

export default class Published {
  #link; #address; #root = document.querySelector("#published"); #controls; #panels; #trust;
  #windows = {}; #state = {}; #shown = "";
  #turn = 0; // of the questions: controls and address follow the answer to the newest, which knows all that is set

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    this.#controls = new Controls(this.#root, (key) => {
      this.#ask(OF_THE_POINT.includes(key) ? "point" : "fits");
    });
    this.#trust = [...this.#root.querySelectorAll(`[id^="${PANEL}"]`)];
    this.#root.querySelector("#published-windows").addEventListener("click", () => {
      const kept = Object.entries(this.#controls.said).filter(([key]) => !Object.values(EDGES).flat().includes(key));
      this.#controls.take(Object.fromEntries(kept));
      this.#ask("fits");
    });
  }

  async open({view, ...texts}) {
    this.#controls.take(texts);
    TASKS.forEach((task) => this.#ask(task));
    this.#panels = panelsOf(this.#root, (made) => ({...withWindows(made), ...trustMap(this.#trust)}));
    this.#take("constants", constants);
    this.#showCurves();
    const {plots} = await this.#panels;
    for (const model of Object.keys(EDGES)) this.#bindWindow(plots, model);
    for (const {id} of this.#trust) {
      onTouch(plots.root(id), ({x, y}) => {
        const [map_F, map_D_f] = [this.#controls.within("map_F", x), this.#controls.within("map_D_f", y)];
        this.#controls.take({...this.#controls.said, roll_off: id.replace(PANEL, ""), map_F, map_D_f});
        this.#ask("point");
      });
    }
    this.#root.querySelector("[data-legend]").replaceChildren(...constants.legend.map(([background, text]) =>
      element("li", {}, patch(background, text))));
  }

  shown() { this.#address.write("published", this.#state); }

  #ask(task) {
    const asked = this.#controls.asked, turn = ++this.#turn;
    this.#link.ask(`published.${task}`, task, asked, {
      answer: (header) => {
        if (turn === this.#turn) {
          this.#controls.answered(asked, header);
          this.#state = header.state;
          this.shown();
          this.#showCurves();
        }
        this.#take(task, header);
        if (task === "point") this.#showPoint(header);
      },
      error: (sentence, at) => this.#controls.deny(sentence, at, () => {
        this.#controls.take({});
        TASKS.forEach((each) => this.#ask(each));
      }),
    });
  }

  // Take an answer: what panels and other sources show, windows, tables, words at their places, large figures.
  #take(what, {panels, sources = {}, windows = {}, tables = {}, words = {}, strip}) {
    Object.assign(this.#windows, windows);
    for (const [id, {header, rows}] of Object.entries(tables)) {
      const labelled = (cell, i) => [element("span", {className: "label"}, ...typeset(header[i])), ...typeset(cell)];
      fillTable(id, header.map(typeset), rows.map((cells) => cells.map(labelled)));
    }
    for (const [place, text] of Object.entries(words)) {
      this.#root.querySelector(`[data-words="${place}"]`).replaceChildren(...typeset(text));
    }
    if (strip) fillFigures(this.#root.querySelector(".strip"), strip);
    this.#root.querySelectorAll(".strip span").forEach(judged);
    this.#panels.then((shown) => {
      if (panels) shown.show(what, panels);
      for (const [name, columns] of Object.entries(sources)) shown.plots.set(name, columns);
      this.#place(shown.plots, windows);
    });
  }

  // Show the curves for what is chosen, of the fractal dimensions that are chosen.
  #showCurves() {
    const {mean, punch, D_f} = {...this.#controls.shown, ...this.#state}, wanted = D_f.split(",");
    const names = [`1D ${mean}`, `3D ${mean} ${punch}`], {curves} = constants;
    if (!names.every((name) => name in curves) || this.#shown === `${names} ${D_f}`) return;
    this.#shown = `${names} ${D_f}`;
    const some = (cells) => cells.filter((_, i) => i === 0 || wanted.includes(DIMENSIONS[i - 1]));
    for (const name of names) {
      const {panels, tables} = curves[name];
      this.#take(name.slice(0, 2), {
        panels: mapped(panels, ({series, ...panel}) => ({...panel, series: ofDimensions(series, wanted)})),
        tables: mapped(tables, ({header, rows}) => ({header: some(header), rows: rows.map(some)})),
      });
    }
  }

  // Mark the point of the trust map, and what is said of it.
  #showPoint({state, numbers, verdict}) {
    this.#root.querySelector('[data-words="point"]').dataset.verdict = verdict;
    const marks = this.#trust.map((panel) => {
      const isChosen = panel.id === PANEL + state.roll_off;
      panel.classList.toggle("chosen", isChosen);
      return [panel.id.replace(PANEL, "trust point "), isChosen ? {x: [numbers.map_F], y: [numbers.map_D_f]} : {x: [], y: []}];
    });
    this.#take("point", {sources: Object.fromEntries(marks)});
  }

  // Place windows; one that is moved by hand stays where it is.
  #place(plots, windows) {
    this.#placing = true;
    for (const [name, [left, right]] of Object.entries(windows)) {
      if (name !== this.#moving) plots.model(`window ${name}`).setv({left, right});
    }
    this.#placing = false;
  }

  #placing = false; #moving = null; #rest = null; // the window that is held by the mouse

  #bindWindow(plots, model) {
    const box = plots.model(`window ${model}`), plot = plots.root(`published-stiffness-${model}`);
    const move = (...edges) => this.#windowMoved(plots, model, edges);
    const moved = () => { if (!this.#placing) move(box.left, box.right); };
    for (const side of ["left", "right"]) box.properties[side].change.connect(moved);
    plot.on_event("selectiongeometry", ({geometry}) => {
      if (geometry.type === "rect" && geometry.x0 !== geometry.x1) move(geometry.x0, geometry.x1);
    });
    onDraw(plot, this.#root.querySelector(`[data-draw="${model}"]`), (from, to) => {
      if (from.x !== to.x) box.setv({left: Math.min(from.x, to.x), right: Math.max(from.x, to.x)});
    });
  }

  #windowMoved(plots, model, edges) {
    this.#moving = model;
    const ends = edges.sort((a, b) => a - b).map((edge, i) => [EDGES[model][i], this.#controls.within(EDGES[model][i], edge)]);
    this.#controls.take({...this.#controls.said, ...Object.fromEntries(ends)});
    this.#ask("fits");
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => {
      this.#moving = null;
      if (!this.#link.isWaiting("fits")) this.#place(plots, this.#windows); // else its answer does
    }, 400);
  }
}

// Put windows on figures, two of which can be drawn anew.
function withWindows(made) {
  for (const model of Object.keys(EDGES)) {
    const figure = made[`published-stiffness-${model}`];
    add(figure, "BoxAnnotation", `window ${model}`, {...WINDOW, editable: true});
    const tool = new Bokeh.BoxSelectTool({dimensions: "width", renderers: []});
    figure.add_tools(tool);
    figure.toolbar.active_drag = tool;
  }
  return made;
}

function trustMap(panels) { return Object.fromEntries(panels.map(({id}) => [id, trust(id.replace(PANEL, ""))])); }

// One panel of the trust map, with the point that is asked about.
function trust(rollOff) {
  const made = plot(["force F̄", "fractal dimension"], [[7.5e-4, 4.217], [1.95, 3.05]], {x_axis_type: "log", tools: [], toolbar_location: null});
  draw(made, "quad", `trust ${rollOff}`, {fill_color: {field: "colour"}, line_color: {field: "colour"}});
  draw(made, "quad", `trust ${rollOff} unsure`, {fill_color: null, line_color: null, ...HATCH});
  for (const [line_color, line_width] of [["#ffffff", 5], ["#000000", 2]]) { // seen on any colour
    draw(made, "scatter", `trust point ${rollOff}`, {marker: "circle", size: 15, fill_alpha: 0, line_color, line_width});
  }
  for (const grid of made.grids) grid.visible = false;
  return made;
}
