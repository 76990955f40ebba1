// Maps of a surface: linked ones have frames alike, which they fill. Each has the scale of its colours above it, tells
// what is at a point, and is cut along a line that is drawn across it.
import {element} from "./elements.js";
import {draw, plot} from "./figures.js";
import {onDraw, onPoint} from "./hands.js";
import {colour, onRecolour} from "./plots.js";

const BORDERS = {left: 60, right: 40, top: 8, bottom: 46}; // for the axes and their names [px]
const LOWEST = 48; // frame of a map that is much longer than wide [px]
const HIGHEST = 0.38, AT_LEAST = 280; // frame, in heights of the window, and [px]
const FAINTEST = 40, DEEPEST = 1; // of the colours of a flow: those before are too near to paper or ink
const STOPS = 24; // of the scale's gradient
const SAMPLES = 600; // along a profile
const ROOM = 0.05; // about it, in shares of what it spans

// An empty map; its numbers are colours themselves, or get those of a palette. Rings may be drawn on it in a colour.
export function mapFigure(name, {isOfColours = false, rings = "", ranges}) {
  const borders = Object.fromEntries(Object.entries(BORDERS).map(([side, width]) => [`min_border_${side}`, width]));
  const made = plot(["x", "y"], ranges, {match_aspect: true, ...borders});
  const mapper = new Bokeh.LinearColorMapper({palette: Bokeh.Palettes.Cividis256, low: -1, high: 1, name: `${name} colours`});
  if (isOfColours) draw(made, "image_rgba", name);
  else draw(made, "image", name, {color_mapper: mapper});
  for (const grid of made.grids) grid.visible = false;
  if (rings) {
    for (const [line_width, shown] of [[5, "paper"], [2, rings]]) { // the one is seen around the other
      draw(made, "scatter", `${name} rings`, {size: 14, line_width, fill_alpha: 0, colours: {line_color: shown}});
    }
  }
  for (const [line_width, shown] of [[5, "paper"], [2.5, "here"]]) {
    draw(made, "line", `${name} cut`, {line_width, colours: {line_color: shown}});
  }
  return made;
}

// Ranges that linked maps share.
export function sharedRanges() { return [1, 2].map(() => new Bokeh.Range1d({start: 0, end: 1})); }

// An empty profile: heights of the surface and, where a contact is shown, of the body that is pressed on it.
export function profileFigure() {
  const made = plot(["along the line", "height"], [[0, 1], [0, 1]]);
  draw(made, "line", "profile body", {line_width: 1.5, legend: "the other body", colours: {line_color: "here"}});
  draw(made, "line", "profile surface", {line_width: 1.5, legend: "surface", colours: {line_color: "dark-line"}});
  return made;
}

export class Maps {
  #plots; #names; #plot; #places; #extent = ""; #sizes = [1, 1]; #layers = []; #unit = ""; #ranges = {};
  #looks = {}; // by name, how each map is coloured
  #cut = null; #profile = null;

  // Maps of these names, whose plots have `prefix` before them; a profile is shown in the plot of that name.
  constructor(plots, prefix, names, profile = "") {
    this.#plots = plots;
    this.#names = names;
    this.#plot = (name) => `${prefix}-${name}`;
    this.#places = Object.fromEntries(names.map((name) => [name, document.querySelector(`#plot-${prefix}-${name}`)]));
    for (const name of names) this.#bind(name);
    if (profile) this.#bindProfile(this.#plot(profile));
    const observer = new ResizeObserver(() => this.#fit());
    for (const {parentElement: room} of Object.values(this.#places)) observer.observe(room);
    onRecolour(() => { for (const name of names) if (this.#looks[name]) this.#colour(name); });
  }

  #bind(name) {
    const place = this.#places[name], point = element("span", {className: "point", hidden: true});
    const room = element("div", {className: "room"});
    place.before(element("div", {className: "scale"}), room);
    room.append(place);
    room.parentElement.querySelector("figcaption").append(point);
    onPoint(this.#plots.root(this.#plot(name)), (at) => {
      point.textContent = at ? this.#told(at) : "";
      point.hidden = !point.textContent;
    });
  }

  // Lay the maps out for a surface with these sides, in a unit; all of it is shown when it is another one. As in
  // instruments' software y counts from the top downwards.
  frame(sizes, unit, corner = [0, 0]) {
    this.#sizes = sizes;
    this.#unit = unit;
    const extent = `${corner} ${sizes} ${unit}`;
    if (extent === this.#extent) return;
    this.#extent = extent;
    for (const name of this.#names) {
      this.#plots.label(this.#plot(name), withUnit("x", unit), withUnit("y", unit));
      const [left, top] = corner, [width, height] = sizes;
      this.#plots.range(this.#plot(name), "x", left, left + width);
      this.#plots.range(this.#plot(name), "y", top + height, top);
    }
    this.#fit();
  }

  // Draw numbers, {values, shape, dtype}, over the sides from a corner, in the colours of `look`: palette, low and
  // high, title, unit, and whether they are logarithms.
  show(name, {values, shape, dtype}, look, sizes = this.#sizes, [x, y] = [0, 0]) {
    const place = {x: [x], y: [y], dw: [sizes[0]], dh: [sizes[1]]}, {data} = this.#plots.model(name);
    const isSame = data.image[0] && JSON.stringify([data.image[0].shape, data.x, data.y, data.dw, data.dh])
      === JSON.stringify([shape, ...Object.values(place)]) && values.every((value, i) => Object.is(value, data.image[0][i]));
    if (!isSame) {
      const {ndarray} = Bokeh.require("core/util/ndarray");
      this.#plots.set(name, {image: [ndarray(values, {dtype, shape})], ...place});
    }
    if (!look) return;
    const before = this.#looks[name];
    this.#looks[name] = look;
    if (JSON.stringify(before) !== JSON.stringify(look)) this.#colour(name);
  }

  // Take what is told of a point and drawn along a line: looks with a key and an array; `height` and `gap` make a profile.
  tell(layers) {
    this.#layers = layers;
    if (this.#cut) this.#drawProfile();
  }

  #colour(name) {
    const {palette, low, high, title = "", unit = "", is_logarithmic: isLogarithmic = false, blank = "here"} = this.#looks[name];
    const isOfTheme = Array.isArray(palette);
    const wanted = isOfTheme ? palette.map(colour) : palette === "flux" ? ofFlux() : Bokeh.Palettes[palette];
    this.#plots.model(`${name} colours`)?.setv({palette: wanted, low, high: high > low ? high : low + 1, low_color: colour("paper"),
      nan_color: colour(blank)});
    const place = scaleAbove(this.#places[name]);
    place.replaceChildren(...(isOfTheme ? [] : scaleOf(title, unit, wanted, [low, high], isLogarithmic)));
  }

  // Give all maps the size at which the sides of the surface fill the frame: as wide as their rooms, and as high as
  // these, or as a part of the window where rooms are as high as what is in them.
  #fit() {
    const [along, up] = this.#sizes, places = Object.values(this.#places).filter((each) => each.offsetParent !== null);
    if (!places.length) return;
    const rooms = places.map(({parentElement}) => parentElement), isGiven = getComputedStyle(rooms[0]).contain.includes("size");
    const across = Math.min(...rooms.map(({clientWidth}) => clientWidth)) - BORDERS.left - BORDERS.right;
    const high = isGiven ? Math.min(...rooms.map(({clientHeight}) => clientHeight)) - BORDERS.top - BORDERS.bottom
      : Math.max(AT_LEAST, HIGHEST * innerHeight);
    const scale = Math.max(Math.min(across / along, high / up), 1 / Math.max(along, up));
    for (const place of places) {
      const width = `${Math.round(scale * along) + BORDERS.left + BORDERS.right}px`;
      place.style.width = scaleAbove(place).style.width = width;
      place.style.height = `${Math.max(Math.round(scale * up), LOWEST) + BORDERS.top + BORDERS.bottom}px`;
    }
  }

  // Words for a point in the units of the axes; none beside the surface.
  #told({x, y}) {
    const [width, height] = this.#sizes;
    if (Math.min(x, y) < 0 || x >= width || y >= height || !this.#layers.length) return "";
    const unit = this.#unit.replace("/ ", "");
    const said = this.#layers.map((layer) => wordsOf(layer, at(layer, x / width, y / height)));
    return [`x ${digits(x)} ${unit}, y ${digits(y)} ${unit}`, ...said].filter(Boolean).join("; ");
  }

  #bindProfile(plot) {
    const figure = document.querySelector(`#${plot}`);
    const button = document.querySelector(`[data-profile="${plot}"]`);
    this.#profile = {plot, figure};
    onDraw(this.#names.map((name) => this.#plots.root(this.#plot(name))), button, (from, to, isLast) => {
      this.#cut = [from, to];
      this.#drawProfile(isLast);
    }, () => { // begin anew
      this.#cut = null;
      this.#drawProfile();
    });
  }

  // Draw the line, and its profile, which does not come while the line is drawn: it would move the maps.
  #drawProfile(mayCome = true) {
    if (!this.#profile) return;
    const {plot, figure} = this.#profile, [height, gap] = ["height", "gap"].map((key) => this.#layers.find((each) => each.key === key));
    const [from, to] = this.#cut ?? [], isDrawn = Boolean(from) && Boolean(height) && Math.hypot(to.x - from.x, to.y - from.y) > 0;
    if (!isDrawn || mayCome) figure.hidden = !isDrawn;
    for (const name of this.#names) {
      this.#plots.set(`${name} cut`, this.#cut ? {x: [from.x, to.x], y: [from.y, to.y]} : {x: [], y: []});
    }
    if (!isDrawn) return;
    const shares = Array.from({length: SAMPLES}, (_, i) => i / (SAMPLES - 1));
    const along = (layer) => shares.map((share) => at(layer,
      (from.x + share * (to.x - from.x)) / this.#sizes[0], (from.y + share * (to.y - from.y)) / this.#sizes[1]));
    const x = shares.map((share) => share * Math.hypot(to.x - from.x, to.y - from.y)), surface = along(height);
    const body = gap ? along(gap).map((value, i) => surface[i] + (value || 0)) : [];
    this.#plots.set("profile surface", {x, y: surface});
    this.#plots.set("profile body", {x: gap ? x : [], y: body});
    for (const [axis, values] of Object.entries({x, y: [...surface, ...body]})) this.#plots.follow(plot, axis, endsAbout(values));
    this.#plots.label(plot, withUnit("along the line", this.#unit), withUnit("height", height.unit));
  }
}

// The ends of an axis about values.
function endsAbout(values) {
  const known = values.filter(Number.isFinite), low = Math.min(...known), high = Math.max(...known);
  const room = ROOM * (high - low) || 1;
  return [low - room, high + room];
}

// A quantity with its unit, or over a scale: height [µm], height / h.
function withUnit(name, unit) {
  if (!unit) return name;
  return unit.startsWith("/") ? `${name} ${unit}` : `${name} [${unit}]`;
}

// The number of a layer at a place, in sides of the surface.
function at({array: {values, shape: [rows, columns]}}, x, y) {
  const index = (share, count) => Math.min(Math.max(Math.floor(share * count), 0), count - 1);
  return values[index(y, rows) * columns + index(x, columns)];
}

function wordsOf({title, unit, low, nothing = "", is_logarithmic: isLogarithmic = false}, value) {
  if (!Number.isFinite(value) || value === 0 || (isLogarithmic && value < low)) return nothing;
  if (isLogarithmic) return `${title} ${value > low ? "" : "below "}${digits(10 ** value)} ${unit}`;
  return `${title} ${digits(value)} ${unit.replace("/ ", "")}`;
}

function digits(value) {
  const written = value.toPrecision(3);
  return written.includes("e") ? String(Number(written)) : written;
}

// A title, the colours from the lowest number to the highest, and round numbers below them.
function scaleOf(title, unit, palette, [low, high], isLogarithmic) {
  const stops = Array.from({length: STOPS}, (_, i) => css(palette[Math.floor((i * (palette.length - 1)) / (STOPS - 1))]));
  const bar = element("i", {}, ...roundNumbers(low, high, isLogarithmic).map((value) => {
    const tick = element("span", {textContent: isLogarithmic ? String(Number((10 ** value).toPrecision(1))) : String(value).replace("-", "−")});
    tick.style.left = `${(100 * (value - low)) / (high - low)}%`;
    return tick;
  }));
  bar.style.background = `linear-gradient(to right, ${stops})`;
  return [element("span", {textContent: withUnit(title, unit)}), bar];
}

// A few round numbers between two.
function roundNumbers(low, high, isWhole) {
  if (!(high > low)) return [];
  const rough = (high - low) / 4, power = 10 ** Math.floor(Math.log10(rough));
  const step = Math.max([1, 2, 5, 10].find((factor) => factor * power >= rough) * power, isWhole ? 1 : 0);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({length: Math.floor(high / step + 1e-9) - first + 1}, (_, i) => Number(((first + i) * step).toPrecision(6)));
}

// A colour of Bokeh: a name, red, green, blue and opacity, or all four in one number.
function css(shown) {
  if (typeof shown === "string") return shown;
  return Array.isArray(shown) ? `rgb(${shown.slice(0, 3)})` : `#${shown.toString(16).padStart(8, "0").slice(0, 6)}`;
}

function scaleAbove({parentElement: room}) { return room.previousElementSibling; }

// Colours that stand out from the paper the more, the more flows.
function ofFlux() {
  const {Viridis256, YlGnBu9, interp_palette} = Bokeh.Palettes;
  if (document.documentElement.dataset.theme === "dark") return Viridis256.slice(FAINTEST);
  return interp_palette(YlGnBu9.slice(DEEPEST).reverse(), Viridis256.length);
}

// Layers to tell of: looks by their keys, with their arrays; what has no title is not told.
export function layersOf(looks, arrays) {
  return Object.entries(looks).flatMap(([key, look]) => {
    const array = arrays[key];
    return look.title && array ? [{key, ...look, array}] : [];
  });
}
