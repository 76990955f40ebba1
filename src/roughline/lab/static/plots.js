// Plots of Bokeh: embedding, data and the colours of the theme.
import {element, typeset} from "./elements.js";
import {legendOf} from "./figures.js";
import {takeHands} from "./hands.js";

const TYPE = "12px"; // of all words in pictures
const BESIDE = 6, STEP = 8, MOST = 40; // of names from curves and edges, and of curves that names should not cover [px]; at most
const CROWDED = 10, WORSE = 1000; // another end there, and to cover another name, in steps of a curve that are covered
const documents = [], recoloured = [];
let bokeh = null; // once it is asked for

// Load BokehJS, whose megabyte keeps the browser and the server busy for a while.
function loaded() {
  bokeh ??= Promise.all(["bokeh.min.js", "bokeh-api.min.js"].map((name) => new Promise((resolve, reject) => {
    const script = element("script", {src: `bokeh/${name}`, async: false}); // the second needs the first
    script.addEventListener("load", resolve);
    script.addEventListener("error", () => reject(new Error(`${name} did not come`)));
    document.head.append(script);
  }))).then(spareStyles);
  return bokeh;
}

// Embed the figures that are declared, by the elements that they belong to, less "plot-"; returns what changes them.
// They are in one document, so that they may share ranges.
export async function embedded(declared) {
  await loaded();
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

// With each picture Bokeh writes the places of all that it draws into the style of the page and asks that for colours,
// hundreds of times a second while a slider moves, and each time the browser styles the page anew. A place that is the
// same is not written, that of a glyph is not asked for, the page has no such colours, and all type is of one size. It
// also keeps four copies of each glyph, for what is selected, passed, muted or too much, which nothing is here; looks for
// points outside the frame, which clips them; and measures all axes, which no glyph moves.
function spareStyles() {
  const {InlineStyleSheet} = Bokeh.require("core/dom"), {VisualProperties} = Bokeh.require("core/visuals/visual");
  const {GlyphRendererView} = Bokeh.require("models/renderers/glyph_renderer"), {build_view} = Bokeh.require("core/build_views");
  const {PlotView} = Bokeh.require("models/plots/plot_canvas"), {DataRendererView} = Bokeh.require("models/renderers/data_renderer");
  InlineStyleSheet.prototype._update = function (css) { if (this.css !== css) this.el.textContent = css; };
  VisualProperties.prototype._get_css_value = () => "";
  Object.defineProperty(PlotView.prototype, "base_font_size", {value: parseFloat(TYPE)});
  Object.defineProperty(GlyphRendererView.prototype, "needs_clip", {value: true}); // which overlays else have not
  Object.assign(GlyphRendererView.prototype, {
    update_position() {},
    async lazy_initialize() {
      await DataRendererView.prototype.lazy_initialize.call(this);
      this.cds_view = await build_view(this.model.view, {parent: this});
      this.glyph = await this.build_glyph_view(this.model.glyph);
      this.selection_glyph = this.nonselection_glyph = this.muted_glyph = this.decimated_glyph = this.glyph;
      await this.set_data();
    },
    async set_data() {
      const {glyph, model: {data_source: source, view: {indices}}} = this;
      this.all_indices = indices;
      await glyph.set_data(source, indices);
      glyph.set_visuals(source, indices);
      glyph.after_visuals();
    },
    _paint(ctx) {
      this.glyph.map_data();
      this.glyph.paint(ctx, this.all_indices.ones());
    },
  });
  const fit = PlotView.prototype._invalidate_layout_if_needed;
  PlotView.prototype._invalidate_layout_if_needed = function () {
    const isAxis = (view) => !(view instanceof GlyphRendererView) && view.model.level !== "overlay";
    if (this._needs_layout || this._invalidate_all || [...this._invalidated_painters].some(isAxis)) fit.call(this);
  };
}

function placeOf(plot) { return document.querySelector(`#plot-${CSS.escape(plot)}`); }

class Plots {
  #shown = new Map();
  #named = new Map(); // names of curves by the sources of these
  #counts = {}; // points in a source
  #models = new Map(); // by their names, for which Bokeh looks through all
  #views = new Map(); // of plots by their names, for the same reason

  constructor(made) {
    this.made = made;
    for (const root of made.roots()) {
      this.#addNames(root);
      const view = Bokeh.index.find_one(root);
      this.#views.set(root.name, view);
      view?.repainted.connect(() => {
        if (legendOf(root).length) this.#placeNames(root);
        this.#tellDrawn(root.name);
      });
    }
  }

  // Say what the next picture of a plot shows; when it is on the screen, its element tells so by the
  // event "drawn", and its data-shown says what was drawn last.
  // A picture that is the same as the one before is painted again for it.
  shows(plot, what) {
    this.#shown.set(plot, [...(this.#shown.get(plot) ?? []), what]);
    this.#views.get(plot)?.schedule_paint();
  }

  #tellDrawn(plot) {
    const shown = this.#shown.get(plot);
    if (!shown?.length) return;
    this.#shown.delete(plot);
    setTimeout(() => { // after this frame
      const place = placeOf(plot);
      for (const detail of shown) {
        place.dataset.shown = JSON.stringify(detail);
        place.dispatchEvent(new CustomEvent("drawn", {detail, bubbles: true}));
      }
    });
  }

  model(name) {
    if (!this.#models.has(name)) this.#models.set(name, this.made.get_model_by_name(name));
    return this.#models.get(name);
  }

  root(name) { return this.made.roots().find((each) => each.name === name); }

  // Give a source its columns, unless it has them; what there is has its name.
  set(name, columns) {
    const source = this.model(name), [first] = Object.values(columns);
    if (isSame(source.data, columns)) return;
    for (const column of Object.keys(source.data)) if (!(column in columns)) delete source.data[column]; // the shortest counts
    Object.assign(source.data, columns); // a new table would have Bokeh look for models in it
    source.change.emit();
    this.#counts[name] = first.length;
    for (const {item, names} of this.#named.get(name) ?? []) {
      const isThere = names.some((each) => this.#counts[each]);
      if (item.hidden === isThere) item.hidden = !isThere;
    }
  }

  // Take all points from a source.
  empty(name) { this.set(name, Object.fromEntries(Object.keys(this.model(name).data).map((column) => [column, []]))); }

  // Call a source by other words.
  call(name, words) { for (const {item} of this.#named.get(name) ?? []) item.lastChild.replaceChildren(...typeset(words)); }

  // Name the curves of a plot at their ends.
  #addNames(root) {
    const places = new Map();
    for (const {legend, ...glyph} of legendOf(root)) places.set(legend, [...(places.get(legend) ?? []), glyph]);
    if (!places.size) return;
    const items = [...places].map(([words, glyphs]) => {
      const item = element("li", {hidden: true}, element("span", {}, ...typeset(words)));
      const names = glyphs.map(({source}) => source), {line_color, fill_color} = Object.assign({}, ...glyphs.map(({colours}) => colours));
      item.style.borderColor = `var(--${line_color ?? fill_color})`;
      item.dataset.sources = names.join(";");
      for (const name of names) this.#named.set(name, [...(this.#named.get(name) ?? []), {item, names}]);
      return item;
    });
    placeOf(root.name).append(element("ul", {className: "names"}, ...items));
  }

  // Put the names of a plot to ends of what they name: where these are apart, and a name covers least.
  #placeNames(root) {
    const {frame: {bbox, x_scale, y_scale}} = this.#views.get(root.name), taken = [];
    const named = [...placeOf(root.name).querySelectorAll(".names li:not([hidden])")].map((item) => {
      const lines = item.dataset.sources.split(";").map((name) => this.#lineOf(name, x_scale, y_scale)).filter(({points}) => points.length);
      return {item, lines, lasts: lines.map(({points}) => points.at(-1)), firsts: lines.map(({points}) => points[0])};
    });
    const steps = named.flatMap(({lines}) => lines.flatMap((line) => line.steps));
    for (const {item, lasts, firsts} of named.sort((one, other) => (one.lasts[0]?.[1] ?? 0) - (other.lasts[0]?.[1] ?? 0))) {
      const {width, high} = sizeOf(item), rest = named.filter((each) => each.item !== item);
      const about = ([x, y], beside) => {
        const isNear = ([left, top]) => Math.abs(left - x) < width && Math.abs(top - y) < high;
        const cost = CROWDED * rest.filter((each) => [...each.lasts, ...each.firsts].some(isNear)).length;
        return [[beside, y - high / 2], [x - width / 2, y - BESIDE - high], [x - width / 2, y + BESIDE]].map((place) => ({place, cost}));
      };
      const costs = ({place, cost}) => {
        const left = within(place[0], bbox.left + BESIDE, bbox.right - width - BESIDE), right = left + width;
        const top = within(place[1], bbox.top + BESIDE, bbox.bottom - high - BESIDE), bottom = top + high;
        const covered = steps.filter(([x, y]) => x > left - BESIDE && x < right && y > top && y < bottom);
        const others = taken.filter((each) => left < each.right && right > each.left && top < each.bottom && bottom > each.top);
        return {left, right, top, bottom, cost: cost + covered.length + WORSE * others.length};
      };
      const {cost: _, ...best} = [
        ...lasts.flatMap((end) => about(end, end[0] + 2 * BESIDE)), ...firsts.flatMap((end) => about(end, end[0] - 2 * BESIDE - width)),
        ...taken.map(({left, bottom}) => ({place: [left, bottom], cost: WORSE / 2})), {place: [bbox.right, bbox.top], cost: WORSE / 2},
      ].map(costs).reduce((best, each) => (each.cost < best.cost ? each : best));
      taken.push(best);
      const place = `translate(${Math.round(best.left)}px, ${Math.round(best.top)}px)`;
      if (item.style.transform !== place) item.style.transform = place;
    }
  }

  // Where the points of a source are on the screen, and what lies between them, which stays until one or the other changes.
  #lineOf(name, x_scale, y_scale) {
    const {data} = this.model(name), of = [data.x, data.y ?? data.low, ...[x_scale, y_scale].flatMap(({source_range: {start, end}, target_range}) =>
      [start, end, target_range.start, target_range.end])];
    const known = this.#lines.get(name);
    if (known && of.every((each, i) => each === known.of[i])) return known;
    const points = pointsOf(data).map(([x, y]) => [x_scale.compute(x), y_scale.compute(y)]), line = {of, points, steps: stepsOf(points)};
    this.#lines.set(name, line);
    return line;
  }
  #lines = new Map();

  // Name the axes of a plot; one without a name keeps its own.
  label(plot, x, y) {
    const {xaxes, yaxes} = this.root(plot);
    if (x) xaxes[0].axis_label = x;
    if (y) yaxes[0].axis_label = y;
  }

  // Show a range of an axis, all of which it is from now on.
  range(name, axis, start, end) {
    this.root(name)[`${axis}_range`].setv({start, end, reset_start: start, reset_end: end});
  }

  // Show another range of an axis; where it is what it was, a part that is shown alone stays.
  follow(name, axis, [start, end]) {
    const {reset_start, reset_end} = this.root(name)[`${axis}_range`];
    if (start !== reset_start || end !== reset_end) this.range(name, axis, start, end);
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
  recoloured.forEach((told) => told());
}

// Call when the theme was changed.
export function onRecolour(told) { recoloured.push(told); }

// Whether two are made of the same numbers; arrays of maps have shapes too.
function isSame(one, other) {
  if (Object.is(one, other)) return true;
  if (![one, other].every((each) => each && typeof each === "object") || String(one.shape) !== String(other.shape)) return false;
  if (one.length >= 0) return one.length === other.length && one.every((each, i) => isSame(each, other[i]));
  return Object.keys(one).length === Object.keys(other).length && Object.keys(one).every((key) => isSame(one[key], other[key]));
}

const sizes = new WeakMap(); // of names; to ask for one makes the browser lay out the page

function sizeOf(item) {
  const {textContent: text} = item;
  if (sizes.get(item)?.text !== text) sizes.set(item, {text, width: item.offsetWidth, high: item.offsetHeight});
  return sizes.get(item);
}

// The points of a source that are known: of marks and lines x and y, of bands their middle.
function pointsOf({x = [], y, low, high}) {
  const up = y ?? (low ?? []).map((each, i) => (each + high[i]) / 2);
  return Array.from(x, (each, i) => [each, up[i]]).filter((point) => point.every(Number.isFinite));
}

// A line in steps of a few pixels.
function stepsOf(line) {
  return line.flatMap(([x, y], i) => {
    const [left, up] = line[i - 1] ?? [x, y], count = Math.min(Math.ceil(Math.hypot(x - left, y - up) / STEP), MOST) || 1;
    return Array.from({length: count}, (_, k) => [x - (k / count) * (x - left), y - (k / count) * (y - up)]);
  });
}

function within(value, low, high) { return Math.max(Math.min(value, high), low); }

const known = new Map(); // colours: to ask for one makes the browser style the page again

// A colour of the theme by its name in the style of the page.
export function colour(name) {
  if (!known.has(name)) known.set(name, getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
  return known.get(name);
}

function recolour(made) {
  const text = colour("text"), line = colour("line"), paper = colour("paper"), grid = colour("grid");
  const labels = {axis_label_text_color: text, major_label_text_color: text, axis_line_color: line,
    major_tick_line_color: line, minor_tick_line_color: line, axis_label_text_font_style: "normal",
    axis_label_text_font_size: TYPE, major_label_text_font_size: TYPE};
  const looks = {
    Figure: {background_fill_color: paper, border_fill_color: paper, border_line_color: paper, outline_line_color: line},
    LinearAxis: labels,
    LogAxis: labels,
    CategoricalAxis: labels,
    Grid: {grid_line_color: grid},
    Title: {text_color: text},
  };
  for (const model of made.all_models) {
    if (looks[model.type]) model.setv(looks[model.type]);
    for (const {colours} of model.tags.filter((tag) => tag.colours)) {
      model.setv(Object.fromEntries(Object.entries(colours).map(([key, name]) => [key, colour(name)])));
    }
  }
}
