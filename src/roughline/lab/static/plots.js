// Plots of Bokeh: embedding, data and the colours of the theme.
import {element} from "./elements.js";
import {takeHands} from "./hands.js";

const documents = [], allPlots = [];
const MARKS = { // palettes of a few colours of the theme
  marks: ["paper", "ink", "plastic"], // gap, contact, contact at the hardness
  reach: ["paper", "ink", "dark-line"], // gap, contact, gap that a fluid comes to
  pull: ["paper", "ink", "pull"], // gap, contact, gap across which bodies pull each other
};
const FAINTEST = 40, DEEPEST = 1; // of the colours of a flow: those before are too near to paper or ink

// BokehJS is loaded beside the page, which asks its first questions meanwhile.
const bokeh = Promise.all(["bokeh.min.js", "bokeh-api.min.js"].map((name) => new Promise((resolve) => {
  const script = element("script", {src: `/bokeh/${name}`, async: false}); // the second needs the first
  script.addEventListener("load", resolve);
  document.head.append(script);
})));

// Embed the figures that are declared, by the elements that they belong to, less "plot-"; returns what changes them.
// They are in one document, so that they may share ranges.
export async function embedded(declared) {
  await bokeh;
  const made = new Bokeh.Document(), figures = Object.entries(declared());
  for (const [name, figure] of figures) {
    figure.name = name;
    made.add_root(figure);
  }
  documents.push(made);
  recolour(made);
  await Bokeh.embed.add_document_standalone(made, document.body, figures.map(([name]) => placeOf(name)));
  for (const root of made.roots()) takeHands(root);
  return new Plots(made);
}

function placeOf(plot) { return document.querySelector(`#plot-${CSS.escape(plot)}`); }

class Plots {
  #shown = new Map();
  #palette = {};

  constructor(made) {
    this.made = made;
    allPlots.push(this);
    for (const root of made.roots()) {
      Bokeh.index.find_one(root)?.repainted.connect(() => this.#tellDrawn(root.name));
    }
  }

  // Say what the next picture of a plot shows; when it is on the screen, its element tells so by the
  // event "drawn", and its data-shown says what was drawn last.
  // A picture that is the same as the one before is painted again for it.
  shows(plot, what) {
    this.#shown.set(plot, [...(this.#shown.get(plot) ?? []), what]);
    Bokeh.index.find_one(this.root(plot))?.schedule_paint();
  }

  #tellDrawn(plot) {
    const shown = this.#shown.get(plot);
    if (!shown?.length) return;
    this.#shown.delete(plot);
    requestAnimationFrame(() => {
      const place = placeOf(plot);
      for (const detail of shown) {
        place.dataset.shown = JSON.stringify(detail);
        place.dispatchEvent(new CustomEvent("drawn", {detail, bubbles: true}));
      }
    });
  }

  model(name) { return this.made.get_model_by_name(name); }

  root(name) { return this.made.roots().find((each) => each.name === name); }

  // Give a source its columns.
  set(name, columns) { this.model(name).data = columns; }

  // Give a map its image over both sides from a corner, and the colours of its numbers their range.
  setMap(name, {values, shape, dtype}, [width, height], [low, high], [x, y] = [0, 0]) {
    const {ndarray} = Bokeh.require("core/util/ndarray");
    this.model(`${name} colours`)?.setv({low, high});
    this.set(name, {image: [ndarray(values, {dtype, shape})], x: [x], y: [y], dw: [width], dh: [height]});
  }

  // Name the axes of a plot; one without a name keeps its own.
  label(plot, x, y) {
    const {xaxes, yaxes} = this.root(plot);
    if (x) xaxes[0].axis_label = x;
    if (y) yaxes[0].axis_label = y;
  }

  // Give a map a palette: one of Bokeh's, that of a flow, or one of few marks.
  colours(name, palette) {
    if (this.#palette[name] === `${palette} ${colour("paper")}`) return;
    this.#palette[name] = `${palette} ${colour("paper")}`;
    const wanted = MARKS[palette]?.map(colour) ?? (palette === "flux" ? ofFlux() : Bokeh.Palettes[palette]);
    this.model(`${name} colours`).setv({palette: wanted, low_color: colour("paper"), nan_color: colour("ink")});
    this.model(`${name} bar`).visible = !(palette in MARKS) && palette !== "flux";
    this.model(`${name} flux bar`)?.setv({visible: palette === "flux"}); // its scale is logarithmic
  }

  // Give maps that were drawn before the palettes of the theme.
  recolourMaps() {
    for (const [name, before] of Object.entries(this.#palette)) this.colours(name, before.split(" ")[0]);
  }

  // Show a rectangle in maps that share their ranges, with equal scales, whatever their size.
  frame(names, [width, height]) {
    const plots = names.map((name) => this.root(name));
    const fit = () => {
      const {width: across, height: up} = Bokeh.index.find_one(plots[0])?.frame?.bbox ?? {};
      if (!across || !up) return;
      const scale = Math.max(width / across, height / up);
      for (const [range, middle, length] of [["x_range", width / 2, across], ["y_range", height / 2, up]]) {
        const [start, end] = [middle - (scale * length) / 2, middle + (scale * length) / 2];
        plots[0][range].setv({start, end, reset_start: start, reset_end: end});
      }
    };
    this.observer?.disconnect();
    this.observer = new ResizeObserver(() => setTimeout(fit, 100));
    this.observer.observe(placeOf(names[0]));
    fit();
  }

  // Show a range of values on an axis, which is widened by a little.
  span(name, axis, values, atLeast = [Infinity, -Infinity]) {
    const known = [...values, ...atLeast].filter((value) => Number.isFinite(value) && value > 0);
    if (!known.length) return;
    const [low, high] = [Math.min(...known), Math.max(...known)];
    this.range(name, axis, low / 1.2, high * 1.2);
  }

  range(name, axis, start, end) {
    this.root(name)[`${axis}_range`].setv({start, end, reset_start: start, reset_end: end});
  }

  // Call when a cursor was moved by hand.
  onMove(name, moved) {
    this.model(name).properties.location.change.connect(() => moved(this.model(name).location));
  }
}

// Draw all plots in the colours of the theme.
export function recolourAll() {
  known.clear();
  documents.forEach(recolour);
  allPlots.forEach((plots) => plots.recolourMaps());
}

// Points of a curve in columns: those that are known, and wanted.
export function points(x, y, isWanted = () => true) {
  const kept = x.flatMap((_, i) => (y[i] !== null && isWanted(i) ? [i] : []));
  return {x: kept.map((i) => x[i]), y: kept.map((i) => y[i])};
}

const known = new Map(); // colours: to ask for one makes the browser style the page again

// A colour of the theme by its name in the style of the page.
export function colour(name) {
  if (!known.has(name)) known.set(name, getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
  return known.get(name);
}

// Colours that stand out from the paper the more, the more flows.
function ofFlux() {
  const {Viridis256, YlGnBu9, interp_palette} = Bokeh.Palettes;
  if (document.documentElement.dataset.theme === "dark") return Viridis256.slice(FAINTEST);
  return interp_palette(YlGnBu9.slice(DEEPEST).reverse(), Viridis256.length);
}

function recolour(made) {
  const text = colour("text"), line = colour("line"), paper = colour("paper"), grid = colour("grid");
  const labels = {axis_label_text_color: text, major_label_text_color: text, axis_line_color: line,
    major_tick_line_color: line, minor_tick_line_color: line, axis_label_text_font_style: "normal"};
  const looks = {
    Figure: {background_fill_color: paper, border_fill_color: paper, border_line_color: paper, outline_line_color: line},
    LinearAxis: labels,
    LogAxis: labels,
    CategoricalAxis: labels,
    Grid: {grid_line_color: grid},
    Legend: {label_text_color: text, title_text_color: text, background_fill_color: paper, background_fill_alpha: 0.85,
      border_line_color: null, label_text_font_size: "11px", padding: 4},
    ColorBar: {major_label_text_color: text, title_text_color: text, background_fill_color: null,
      title_text_font_style: "normal"},
    Title: {text_color: text},
  };
  for (const model of made.all_models) {
    if (looks[model.type]) model.setv(looks[model.type]);
    for (const {colours} of model.tags.filter((tag) => tag.colours)) {
      model.setv(Object.fromEntries(Object.entries(colours).map(([key, name]) => [key, colour(name)])));
    }
  }
}
