// Maps of a surface: linked ones have frames alike, which they fill. Each has the scale of its colours above it, tells
// what is at a point, may lie on the relief of its heights, and is cut along a line that is drawn across it or, where a
// cross follows the mouse, along that.
import {element} from "./elements.js";
import {draw, plot} from "./figures.js";
import {onDraw, onPoint} from "./hands.js";
import {colour, onRecolour} from "./plots.js";
import {fillCaption} from "./tables.js";

export const NOTHING = {image: [], x: [], y: [], dw: [], dh: []};
const BORDERS = {left: 66, right: 40, top: 8, bottom: 46}; // for the axes and their names [px]
const SHARED = 8; // below a map whose profile has the axis for both [px]
const LOWEST = 48; // frame of a map that is much longer than wide [px]
const HIGHEST = 0.38, AT_LEAST = 280; // frame, in heights of the window, and [px]
const FAINTEST = 40, DEEPEST = 1; // of the colours of a flow: those before are too near to paper or ink
const STOPS = 24; // of the scale's gradient
const SAMPLES = 600; // along a profile
const ROOM = 0.05; // about it, in shares of what it spans
const CLEAR = "#00000000", VEIL = 0.72; // where the relief is seen: all of it, or through the colours of numbers
const ON_RELIEF = {ink: "touch", plastic: "yields"}; // colours that stand out from grey
const LIGHT = [-0.5, -0.5, Math.SQRT1_2], SLOPE = 0.35; // from the upper left; rms, so that smooth surfaces show
const GREYS = { // of the relief by the theme: flat, per brightness, per height from the mean to the ends, darkest, brightest
  light: [200, 50, 60, 95, 255], dark: [66, 44, 50, 12, 125],
};

// An empty map, whose numbers get the colours of a palette. Rings may be drawn on it in a colour.
export function mapFigure(name, {hasRelief = false, rings = "", ranges}) {
  const borders = Object.fromEntries(Object.entries({...BORDERS, bottom: hasRelief ? SHARED : BORDERS.bottom}).map(([side, width]) => [`min_border_${side}`, width]));
  const made = plot(["x", "y"], ranges, {match_aspect: true, ...borders});
  const mapper = new Bokeh.LinearColorMapper({palette: Bokeh.Palettes.Cividis256, low: -1, high: 1, name: `${name} colours`});
  if (hasRelief) {
    draw(made, "image_rgba", `${name} relief`, {level: "glyph"}); // it stays while a load moves
    made.xaxes[0].visible = false;
  }
  draw(made, "image", name, {color_mapper: mapper});
  for (const grid of made.grids) grid.visible = false;
  if (rings) {
    for (const [line_width, shown] of [[4, "paper"], [1.5, rings]]) { // the one is seen around the other
      draw(made, "scatter", `${name} rings`, {size: 22, line_width, fill_alpha: 0, colours: {line_color: shown}});
    }
  }
  for (const [line_width, shown] of [[3, "paper"], [1.2, "text"]]) {
    draw(made, "line", `${name} cut`, {line_width, colours: {line_color: shown}});
  }
  return made;
}

// Ranges that linked maps share.
export function sharedRanges() { return [1, 2].map(() => new Bokeh.Range1d({start: 0, end: 1})); }

// An empty profile: the surface, the body that is pressed on it, where a contact is shown, and the gap between them.
export function profileFigure() {
  const sides = Object.fromEntries(["left", "right"].map((side) => [`min_border_${side}`, BORDERS[side]])); // below its map
  const made = plot(["along the line", "height"], [[0, 1], [0, 1]], sides);
  draw(made, "varea", "profile surface", {fill_alpha: 0.4, colours: {fill_color: "line"}});
  draw(made, "line", "profile surface", {line_width: 1, colours: {line_color: "line"}});
  draw(made, "varea", "profile gap", {fill_alpha: 0.3, colours: {fill_color: "pull"}});
  draw(made, "line", "profile body", {line_width: 1.5, colours: {line_color: "text"}});
  draw(made, "line", "profile touching", {line_width: 4, colours: {line_color: "touch"}});
  return made;
}

export class Maps {
  #plots; #names; #plot; #places; #extent = ""; #sizes = [1, 1]; #layers = []; #unit = ""; #ranges = {};
  #looks = {}; // by name, how each map is coloured
  #reliefs = {}; // by name, the heights that are lit below it
  #points = new Map(); // where the mouse is, by the elements that tell of it
  #cut = null; #profile = null; #cross = null;
  #isByHand = false; // whether the cut was drawn

  // Maps of these names, whose plots have `prefix` before them; a profile is shown in the plot of that name, and with a
  // cross all the time.
  constructor(plots, prefix, names, {profile = "", hasCross = false} = {}) {
    this.#plots = plots;
    this.#names = names;
    this.#plot = (name) => `${prefix}-${name}`;
    this.#places = Object.fromEntries(names.map((name) => [name, document.querySelector(`#plot-${prefix}-${name}`)]));
    for (const name of names) this.#bind(name);
    if (profile) this.#bindProfile(this.#plot(profile), hasCross);
    const observer = new ResizeObserver(() => this.#fit());
    for (const {parentElement: room} of Object.values(this.#places)) observer.observe(room);
    onRecolour(() => {
      for (const name of names) if (this.#reliefs[name]) this.#light(name);
      for (const name of names) if (this.#looks[name]) this.#colour(name);
    });
  }

  #bind(name) {
    const place = this.#places[name], point = element("span", {className: "point", hidden: true});
    const room = element("div", {className: "room"});
    place.before(element("div", {className: "scale"}), room);
    room.append(place);
    room.parentElement.querySelector("figcaption").append(point);
    onPoint(this.#plots.root(this.#plot(name)), (at) => {
      this.#points.set(point, at);
      this.#tellPoints();
      if (!point.hidden && this.#profile?.hasCross && !this.#isByHand) this.#crossAt(at);
    });
  }

  #tellPoints() {
    for (const [point, at] of this.#points) {
      point.textContent = at ? this.#told(at) : "";
      point.hidden = !point.textContent;
    }
  }

  // Light heights, {values, shape}, below a map; without any its paper shows.
  lay(name, height) {
    const before = this.#reliefs[name];
    if (before === height || !(before || height)) return;
    this.#reliefs[name] = height;
    this.#light(name);
    if (Boolean(before) !== Boolean(height) && this.#looks[name]) this.#colour(name);
  }

  #light(name) {
    const height = this.#reliefs[name], [dw, dh] = this.#sizes, {ndarray} = Bokeh.require("core/util/ndarray");
    this.#plots.set(`${name} relief`, !height ? NOTHING
      : {image: [ndarray(reliefOf(height, this.#sizes), {dtype: "uint32", shape: height.shape})], x: [0], y: [0], dw: [dw], dh: [dh]});
  }

  // Lay the maps out for a surface with these sides, in a unit; all of it is shown when it is another one, without lines
  // and points of the one before. As in instruments' software y counts from the top downwards.
  frame(sizes, unit, corner = [0, 0]) {
    this.#sizes = sizes;
    this.#unit = unit;
    const extent = `${corner} ${sizes} ${unit}`;
    if (extent === this.#extent) return;
    this.#extent = extent;
    [this.#cut, this.#cross, this.#isByHand] = [null, null, false];
    for (const point of this.#points.keys()) this.#points.set(point, null);
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
    const {ndarray} = Bokeh.require("core/util/ndarray");
    this.#plots.set(name, {image: [ndarray(values, {dtype, shape})], x: [x], y: [y], dw: [sizes[0]], dh: [sizes[1]]});
    if (!look) return;
    const before = this.#looks[name];
    this.#looks[name] = look;
    if (JSON.stringify(before) !== JSON.stringify(look)) this.#colour(name);
  }

  // Take what is told of a point and drawn along a line: looks with a key and an array; `height` and `gap` make a profile.
  tell(layers) {
    this.#layers = layers;
    this.#tellPoints();
    const height = layers.find(({key}) => key === "height");
    if (this.#profile?.hasCross && !this.#cross && height) this.#crossAt(this.#summit(height));
    else this.#drawProfile();
  }

  #colour(name) {
    const {palette, low, high, title = "", unit = "", is_logarithmic: isLogarithmic = false, blank = "here"} = this.#looks[name];
    const isOfTheme = Array.isArray(palette), isLit = Boolean(this.#reliefs[name]);
    const shown = (each) => (!isLit ? colour(each) : each === "paper" ? CLEAR : colour(ON_RELIEF[each] ?? each));
    const wanted = isOfTheme ? palette.map(shown) : palette === "flux" ? ofFlux() : Bokeh.Palettes[palette];
    this.#plots.model(`${name} colours`).setv({palette: wanted, low, high: high > low ? high : low + 1,
      low_color: low < 0 && !isLogarithmic ? wanted[0] : shown("paper"), // the deepest is deep; of what begins at none there is none
      nan_color: shown(blank)});
    const {glyph} = this.#plots.root(this.#plot(name)).renderers.find(({data_source}) => data_source.name === name);
    glyph.global_alpha = {value: isLit && !isOfTheme && !(low > 0) ? VEIL : 1};
    const place = scaleAbove(this.#places[name]);
    place.replaceChildren(...(isOfTheme ? [] : scaleOf(title, unit, wanted, [low, high], isLogarithmic)));
  }

  // Give all maps the size at which the sides of the surface fill the frame: as wide as their rooms, and as high as
  // these, or as a part of the window where rooms are as high as what is in them.
  #fit() {
    const [along, up] = this.#sizes, below = this.#profile?.hasCross ? SHARED : BORDERS.bottom, places = Object.values(this.#places).filter((each) => each.offsetParent !== null);
    if (!places.length) return;
    const rooms = places.map(({parentElement}) => parentElement), isGiven = getComputedStyle(rooms[0]).contain.includes("size");
    const across = Math.min(...rooms.map(({clientWidth}) => clientWidth)) - BORDERS.left - BORDERS.right;
    const high = isGiven ? Math.min(...rooms.map(({clientHeight}) => clientHeight)) - BORDERS.top - below
      : Math.max(AT_LEAST, HIGHEST * innerHeight);
    const scale = Math.max(Math.min(across / along, high / up), 1 / Math.max(along, up));
    for (const place of places) {
      const width = `${Math.round(scale * along) + BORDERS.left + BORDERS.right}px`;
      place.style.width = scaleAbove(place).style.width = width;
      place.style.height = `${Math.max(Math.round(scale * up), LOWEST) + BORDERS.top + below}px`;
      if (this.#profile?.hasCross) document.querySelector(`#plot-${this.#profile.plot}`).style.width = width;
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

  // The highest point, which touches first.
  #summit({array: {values, shape: [rows, columns]}}) {
    const first = values.reduce((best, value, i) => (value > values[best] ? i : best), 0), [width, height] = this.#sizes;
    return {x: ((first % columns + 0.5) / columns) * width, y: ((Math.floor(first / columns) + 0.5) / rows) * height};
  }

  #crossAt(at) {
    this.#cross = at;
    this.#cut = [{x: 0, y: at.y}, {x: this.#sizes[0], y: at.y}];
    this.#drawProfile();
  }

  #bindProfile(plot, hasCross) {
    const figure = document.querySelector(`#${plot}`);
    const button = document.querySelector(`[data-profile="${plot}"]`);
    this.#profile = {plot, figure, hasCross};
    for (const side of ["inner_width", "inner_height"]) { // which its caption depends on
      this.#plots.root(plot).properties[side].change.connect(() => this.#drawProfile(false));
    }
    onDraw(this.#names.map((name) => this.#plots.root(this.#plot(name))), button, (from, to, isLast) => {
      [this.#cut, this.#isByHand] = [[from, to], true];
      this.#drawProfile(isLast);
    }, () => { // begin anew
      [this.#cut, this.#isByHand] = [null, false];
      if (this.#cross) this.#crossAt(this.#cross);
      else this.#drawProfile();
    });
  }

  // Draw the line, and its profile, which does not come while the line is drawn: it would move the maps.
  #drawProfile(mayCome = true) {
    if (!this.#profile) return;
    const {plot, figure} = this.#profile, [height, gap] = ["height", "gap"].map((key) => this.#layers.find((each) => each.key === key));
    const [from, to] = this.#cut ?? [], isDrawn = Boolean(from) && Boolean(height) && Math.hypot(to.x - from.x, to.y - from.y) > 0;
    if (!isDrawn || mayCome) figure.hidden = !isDrawn;
    const {x, y} = this.#isByHand || !this.#cross ? {} : this.#cross;
    const upright = y === undefined ? [[], []] : [[NaN, x, x], [NaN, 0, this.#sizes[1]]];
    for (const name of this.#names) {
      this.#plots.set(`${name} cut`, this.#cut
        ? {x: [from.x, to.x, ...upright[0]], y: [from.y, to.y, ...upright[1]]} : {x: [], y: []});
    }
    if (!isDrawn) return;
    const shares = Array.from({length: SAMPLES}, (_, i) => i / (SAMPLES - 1));
    const along = (layer) => shares.map((share) => at(layer,
      (from.x + share * (to.x - from.x)) / this.#sizes[0], (from.y + share * (to.y - from.y)) / this.#sizes[1]));
    const path = shares.map((share) => share * Math.hypot(to.x - from.x, to.y - from.y)), surface = along(height);
    const above = gap ? along(gap) : [], body = above.map((value, i) => surface[i] + (value || 0));
    const ends = roundAbout([...surface, ...body]), both = gap ? path : [];
    this.#plots.set("profile surface", {x: path, y: surface, low: path.map(() => ends[0]), high: surface});
    this.#plots.set("profile gap", {x: both, low: gap ? surface : [], high: body});
    this.#plots.set("profile body", {x: both, y: body});
    this.#plots.set("profile touching", {x: both, y: body.map((value, i) => (above[i] > 0 ? NaN : value))});
    const isAcross = Boolean(upright[0].length), along_x = isAcross ? [0, this.#sizes[0]] : endsAbout(path);
    this.#plots.follow(plot, "x", along_x);
    this.#plots.follow(plot, "y", ends);
    this.#plots.label(plot, withUnit(isAcross ? "x" : "along the line", this.#unit), withUnit("height", height.unit));
    this.#tellProfile(plot, height.scale, (along_x[1] - along_x[0]) / (ends[1] - ends[0]), Boolean(gap));
  }

  // Say what the colours of the profile mean, and how much heights are drawn larger than lengths.
  #tellProfile(plot, scale, perHeight, hasBody) {
    const {inner_width: width, inner_height: high} = this.#plots.root(plot), times = scale && width ? (perHeight * high) / width / scale : 0;
    const meanings = hasBody ? {line: "surface", pull: "gap", touch: "touching"} : {line: "surface"};
    fillCaption(this.#profile.figure.querySelector("[data-caption]"),
      {caption: times ? `heights ${digits(times)} times as large as lengths` : "", meanings});
  }
}

// Brightness of a surface that is lit from the upper left, as red, green, blue and opacity in one number of each point.
export function reliefOf({values, shape: [rows, columns]}, [width, height]) {
  const across = new Float32Array(values.length), down = new Float32Array(values.length), shown = new Uint32Array(values.length);
  let squares = 0, low = Infinity, high = -Infinity;
  for (let i = 0, row = 0; row < rows; row++) {
    const above = (row ? -columns : 0), below = (row < rows - 1 ? columns : 0);
    for (let column = 0; column < columns; column++, i++) {
      const left = (column ? -1 : 0), right = (column < columns - 1 ? 1 : 0);
      across[i] = ((values[i + right] - values[i + left]) * columns) / ((right - left) * width);
      down[i] = ((values[i + below] - values[i + above]) * rows) / (((below - above) / columns) * height);
      squares += across[i] ** 2 + down[i] ** 2;
      low = Math.min(low, values[i]);
      high = Math.max(high, values[i]);
    }
  }
  const steep = SLOPE / Math.sqrt(squares / values.length || 1), middle = (low + high) / 2, half = (high - low) / 2 || 1;
  const [flat, perLight, perHeight, darkest, brightest] = GREYS[document.documentElement.dataset.theme];
  for (let i = 0; i < values.length; i++) {
    const [x, y] = [-steep * across[i], -steep * down[i]];
    const light = (LIGHT[0] * x + LIGHT[1] * y + LIGHT[2]) / Math.sqrt(1 + x * x + y * y) / LIGHT[2];
    const grey = flat + perLight * (light - 1) + perHeight * ((values[i] - middle) / half);
    shown[i] = 0xff000000 + 0x10101 * Math.round(Math.min(Math.max(grey, darkest), brightest));
  }
  return shown;
}

// The contact on the relief of its heights, as it is seen before plots can be drawn.
export function sketchOf(height, {values}, palette) {
  const points = reliefOf(height, [1, 1]), [rows, columns] = height.shape, made = element("canvas", {className: "sketch", width: columns, height: rows});
  const marks = palette.map((name) => (name === "paper" ? 0 : bytesOf(colour(ON_RELIEF[name] ?? name))));
  values.forEach((mark, i) => { points[i] = marks[mark] || points[i]; });
  made.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(points.buffer), columns, rows), 0, 0);
  return made;
}

// A colour such as #b93a00 as one number, whose least byte is red.
function bytesOf(shown) { return 0xff000000 + Number(`0x${shown.match(/[\da-f]{2}/gi).reverse().join("")}`); }

// The ends of an axis about values.
function endsAbout(values) {
  const known = values.filter(Number.isFinite), low = Math.min(...known), high = Math.max(...known);
  const room = ROOM * (high - low) || 1;
  return [low - room, high + room];
}

// The same, of round numbers, which stay as a load moves: so does all that need not be drawn anew.
function roundAbout(values) {
  const [low, high] = endsAbout(values), step = roundStep((high - low) / 10);
  return [Math.floor(low / step) * step, Math.ceil(high / step) * step];
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

function wordsOf({title, unit, low, array, nothing = "", is_logarithmic: isLogarithmic = false}, value) {
  if (!Number.isFinite(value) || value === 0 || (isLogarithmic && value < low)) return nothing;
  if (isLogarithmic) return `${title} ${value > low ? "" : "below "}${digits(10 ** value)} ${unit}`;
  return `${title} ${digitsAbove(array.step, value)} ${unit.replace("/ ", "")}`;
}

// Three digits, and none much finer than the steps in which a number was sent.
function digitsAbove(step, value) {
  const finest = step > 0 ? 10 ** Math.round(Math.log10(step)) : 0;
  if (Math.abs(value) >= 100 * finest) return digits(value);
  if (Math.abs(value) < finest / 2) return `below ${Number(finest.toPrecision(1))}`;
  return (Math.round(value / finest) * finest).toFixed(Math.max(0, Math.round(-Math.log10(finest))));
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
  if (isWhole && high - low < 2) { // decades alone would be one figure
    return [1, 2, 5].flatMap((factor) => Array.from({length: Math.ceil(high) - Math.floor(low) + 1},
      (_, i) => Math.floor(low) + i + Math.log10(factor))).filter((value) => value >= low && value <= high).sort((a, b) => a - b);
  }
  const step = Math.max(roundStep((high - low) / 4), isWhole ? 1 : 0);
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({length: Math.floor(high / step + 1e-9) - first + 1}, (_, i) => Number(((first + i) * step).toPrecision(6)));
}

// The next of 1, 2, 5, 10 and so on.
function roundStep(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].find((factor) => factor * power >= rough) * power;
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

// What colours mean, by their names on a relief.
export function onRelief(meanings) {
  return Object.fromEntries(Object.entries(meanings).map(([name, meaning]) => [ON_RELIEF[name] ?? name, meaning]));
}

// Layers to tell of: looks by their keys, with their arrays; what has no title is not told.
export function layersOf(looks, arrays) {
  return Object.entries(looks).flatMap(([key, look]) => {
    const array = arrays[key];
    return look.title && array ? [{key, ...look, array}] : [];
  });
}
