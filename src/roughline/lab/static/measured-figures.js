// The figures of My surface.
import {LOGARITHMIC, add, draw, plot} from "./figures.js";
import {mapFigure, profileFigure, sharedRanges} from "./maps.js";

const LOADS = [ // source, name, colour, and how they look
  ["loads", "loads", "dark-line", {size: 6}],
  ["unsure", "the grid decides", "dark-line", {size: 6, fill_alpha: 0}],
  ["asked", "as asked", "here", {size: 13, fill_alpha: 0, line_width: 2}],
];
const both = (colour) => ({fill_color: colour, line_color: colour});

export function measuredFigures() {
  const [prepared, contact] = [sharedRanges(), sharedRanges()], before = mapFigure("before", {ranges: prepared});
  takeBoxes(before);
  return {
    "measured-file": mapFigure("file", {rings: "here", ranges: sharedRanges()}),
    "measured-file-line": fileLine(),
    "measured-spectrum": spectrum(),
    "measured-before": before,
    "measured-after": mapFigure("after", {ranges: prepared}),
    "measured-prepared-line": preparedLine(),
    "measured-topography": mapFigure("topography", {ranges: contact}),
    "measured-contact": mapFigure("contact", {rings: "theory", ranges: contact}),
    "measured-profile": profileFigure(),
    "measured-stiffness": stiffness(),
    "measured-area": curve("area", "real contact area A / A_0"),
    "measured-models": models(),
    "measured-part": part(),
  };
}

// Let a piece be drawn on a map.
function takeBoxes(made) {
  const tool = new Bokeh.BoxSelectTool({description: "draw the piece to keep"});
  made.add_tools(tool);
  made.toolbar.active_drag = tool;
  add(made, "BoxAnnotation", "crop box", {
    left: 0, right: 0, top: 0, bottom: 0, fill_alpha: 0, line_width: 3, visible: false, colours: {line_color: "here"},
  });
}

function fileLine() {
  const made = plot(["x", "height"]);
  draw(made, "line", "file line heights", {line_width: 1.2, colours: {line_color: "dark-line"}});
  for (const [what, marker, size] of [["spikes", "circle", 11], ["missing", "x", 8]]) {
    draw(made, "scatter", `file line ${what}`, {marker, size, fill_alpha: 0, line_width: 2, colours: {line_color: "here"}});
  }
  return made;
}

function preparedLine() {
  const made = plot(["x", "height"]);
  for (const [legend, colour] of [["before", "theory"], ["after", "dark-line"]]) {
    draw(made, "line", `prepared line ${legend}`, {line_width: 1.2, legend, colours: {line_color: colour}});
  }
  return made;
}

function spectrum() {
  const made = plot(["wavenumber q = 2π/λ [1/m]", "spectrum C [m⁴]"], [], LOGARITHMIC);
  draw(made, "scatter", "spectrum", {size: 3.5, legend: "this surface", colours: both("dark-line")});
  draw(made, "line", "spectrum law", {line_width: 2.5, legend: "nearest self-affine law", colours: {line_color: "here"}});
  return made;
}

// Stiffness over force, that on unloading beside it.
function stiffness() {
  const made = curve("stiffness", "stiffness k");
  draw(made, "line", "stiffness unloading", {line_dash: "dashed", line_width: 1.5, legend: "on unloading", colours: {line_color: "mark"}});
  return made;
}

// A quantity over force with its interval; open marks where the grid decides.
function curve(name, label) {
  const made = plot(["force F [N]", label], [], LOGARITHMIC);
  draw(made, "varea", `${name} interval`, {fill_alpha: 0.25, legend: "interval", colours: {fill_color: "dark-line"}});
  draw(made, "multi_line", `${name} theories`, {line_dash: "dashed", line_width: 1.5, colours: {line_color: "theory"}});
  draw(made, "line", `${name} line`, {line_width: 1, colours: {line_color: "theory"}});
  for (const [what, legend, colour, look] of LOADS) draw(made, "scatter", `${name} ${what}`, {legend, ...look, colours: both(colour)});
  return made;
}

function models() {
  const made = plot(["force F / (E* h L)", "raw stiffness k / (E* L)"], [], LOGARITHMIC);
  for (const [name, legend, colour] of [
    ["full", "full model, this surface", "dark-line"],
    ["reduced", "reduced model, mean of lines", "light-line"],
  ]) {
    draw(made, "varea", `models ${name}`, {fill_alpha: 0.25, colours: {fill_color: colour}});
    draw(made, "line", `models ${name}`, {line_width: 2, legend, colours: {line_color: colour}});
    draw(made, "scatter", `models ${name}`, {size: 6, legend, colours: both(colour)});
  }
  return made;
}

// An answer of each map with its interval; their mean, and the interval of the part.
function part() {
  const made = plot(["", ""], [new Bokeh.FactorRange(), [0.1, 10]], {y_axis_type: "log"});
  add(made, "BoxAnnotation", "part interval", {fill_alpha: 0.2, line_alpha: 0, level: "underlay", colours: {fill_color: "here"}});
  add(made, "Span", "part mean", {dimension: "width", line_width: 2, colours: {line_color: "here"}});
  draw(made, "segment", "part", {columns: {x0: "map", y0: "low", x1: "map", y1: "high"}, colours: {line_color: "dark-line"}});
  draw(made, "scatter", "part", {columns: {x: "map"}, size: 8, colours: both("dark-line")});
  const [x] = made.xaxes, [y] = made.yaxes;
  const decades = Array.from({length: 13}, (_, i) => 10 ** (i - 6));
  const ticker = new Bokeh.FixedTicker({ticks: decades.flatMap((decade) => [decade, 2 * decade, 5 * decade])}); // Bokeh's own miss decades
  x.major_label_orientation = 0.6;
  y.setv({ticker, formatter: new Bokeh.BasicTickFormatter()});
  made.xgrids[0].visible = false;
  made.ygrids[0].ticker = ticker;
  return made;
}
