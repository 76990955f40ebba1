// How plots of Bokeh are declared: what they draw comes later, into sources of the names that are given here. Their
// colours are names of the theme, by the attributes of Bokeh that they are of, such as line_color.
const ZOOM = 0.25; // of a click on a tool, in sides of the plot
const IMAGE = {image: "image", x: "x", y: "y", dw: "dw", dh: "dh"};
const COLUMNS = { // that glyphs take
  line: {x: "x", y: "y"},
  scatter: {x: "x", y: "y"},
  varea: {x: "x", y1: "low", y2: "high"},
  quad: {left: "left", right: "right", bottom: "bottom", top: "top"},
  image: IMAGE,
  image_rgba: IMAGE,
};
const DASHES = {dashed: [6], dotted: [2, 4], dashdot: [6, 4, 2, 4]}; // as long for lines of any width
export const LOGARITHMIC = {x_axis_type: "log", y_axis_type: "log"};

// An empty plot with the labels of its axes and their ranges.
export function plot([x_axis_label, y_axis_label], [x_range, y_range], look = {}) {
  const made = new Bokeh.Plotting.Figure({
    x_axis_label, y_axis_label, x_range, y_range, lod_threshold: null, tools: tools(look.match_aspect), sizing_mode: "stretch_both", ...look,
  });
  for (const axis of made.axes) {
    axis.major_label_policy = new Bokeh.NoOverlap();
  }
  for (const [[axis], [grid], range] of [[made.xaxes, made.xgrids, made.x_range], [made.yaxes, made.ygrids, made.y_range]]) {
    if (axis.type === "LogAxis") keepDecades(axis, grid, range);
  }
  made.toolbar.setv({logo: null, autohide: true});
  return made;
}

const ROUND = [1, 2, 5], FEW = 2; // of a decade; decades, below which they alone would be too few

// Let a logarithmic axis have decades, and within few of them round numbers too.
function keepDecades(axis, grid, range) {
  const {ticker: decades, formatter: powers} = axis, ofFew = new Bokeh.BasicTickFormatter();
  ofFew.doFormat = (ticks) => ticks.map(inFewDigits);
  const choose = () => {
    const [low, high] = [range.start, range.end].map(Math.log10).sort((a, b) => a - b);
    const isFew = high - low < FEW, from = Math.floor(low);
    const ticks = isFew ? Array.from({length: Math.ceil(high) - from}, (_, i) => ROUND.map((each) => each * 10 ** (from + i))).flat() : [];
    const ticker = isFew ? new Bokeh.FixedTicker({ticks}) : decades;
    axis.setv({ticker, formatter: isFew ? ofFew : powers});
    grid.ticker = ticker;
  };
  range.change.connect(choose);
  choose();
}

function inFewDigits(tick) {
  const rounded = Number(tick.toPrecision(6));
  return rounded >= 1e5 || rounded < 1e-3 ? rounded.toExponential() : String(rounded);
}

// Tools for the mouse; the wheel is left to the page.
function tools(match_aspect = false) {
  const zooms = [new Bokeh.ZoomInTool({factor: ZOOM}), new Bokeh.ZoomOutTool({factor: ZOOM})];
  return [new Bokeh.PanTool(), new Bokeh.BoxZoomTool({match_aspect}), ...zooms, new Bokeh.ResetTool(), new Bokeh.SaveTool()];
}

// What has a name in a plot: of each glyph its source, its words, and its colours.
const legends = new WeakMap();
export function legendOf(plot) { return legends.get(plot) ?? []; }

// Let a plot draw the columns of a source, which several glyphs may share, and name it. What has the level "overlay" has a
// canvas of its own above the axes, which are not painted again when it moves.
export function draw(plot, kind, source_name, {colours = {}, legend, level = "overlay", ...look} = {}) {
  const fields = Object.fromEntries(Object.entries(COLUMNS[kind]).map(([key, field]) => [key, {field}]));
  if (look.line_dash in DASHES) look.line_dash = {value: DASHES[look.line_dash]};
  const source = plot.renderers.find(({data_source}) => data_source.name === source_name)?.data_source
    ?? new Bokeh.ColumnDataSource({name: source_name});
  const wanted = [...Object.values({...fields, ...look}).map((each) => each?.field)].filter(Boolean);
  source.data = {...source.data, ...Object.fromEntries(wanted.map((column) => [column, []]))};
  const drawn = plot[kind]({...fields, ...look, source});
  drawn.setv({level, selection_glyph: "auto", nonselection_glyph: "auto", hover_glyph: null}); // else each is drawn in Bokeh's blue
  drawn.glyph.tags = [{colours}];
  if (legend) legends.set(plot, [...legendOf(plot), {source: source.name, legend, colours}]);
  return drawn;
}

// Add what is no glyph: a span, a box, whiskers, a colour bar.
export function add(plot, kind, name, {colours = {}, ...look}, side = "center") {
  const added = new Bokeh[kind]({name, tags: [{colours}], ...look});
  plot.add_layout(added, side);
  return added;
}

// Draw intervals from "low" to "high" about the points of a source that is drawn.
export function drawIntervals(plot, name, colour, size) {
  const {data_source: source} = plot.renderers.find(({data_source}) => data_source.name === name);
  source.data = {...source.data, low: [], high: []};
  const head = () => new Bokeh.TeeHead({size: size - 1, tags: [{colours: {line_color: colour}}]});
  add(plot, "Whisker", `${name} intervals`, {
    base: {field: "x"}, lower: {field: "low"}, upper: {field: "high"}, source, level: "overlay",
    upper_head: head(), lower_head: head(), colours: {line_color: colour},
  });
}
