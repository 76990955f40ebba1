// The figures of The paper.
import {LOGARITHMIC, add, draw, drawImage, drawIntervals, plot} from "./figures.js";

const FORCE = "force F / (E* h L)";
const RANGES = {"1D": [[1e-5, 10], [1e-4, 1.6]], "3D": [[1e-3, 10], [5e-3, 1.6]]}; // of F̄ and k̄
const DASHES = ["solid", "dashed", "dotted"];
const MARKERS = ["circle", "square", "triangle", "diamond", "inverted_triangle", "plus"]; // of studies
const HATCH = {hatch_pattern: "right_diagonal_line", hatch_color: "#1c1c1a", hatch_alpha: 0.7, hatch_scale: 7, hatch_weight: 0.8};
const WINDOW = {movable: "x", resizable: "x", fill_alpha: 0.12, line_alpha: 0.6, level: "underlay", colours: {fill_color: "quiet", line_color: "quiet"}};

// Figures 3 to 5, the area law, and the panels of the trust map, by their roll-off ratios.
export function publishedFigures(rollOffs) {
  const ranges = [[7.5e-4, 4.217], [1.95, 3.05]].map(([start, end]) => new Bokeh.Range1d({start, end}));
  return {
    "published-stiffness-1D": stiffness("1D"),
    "published-stiffness-3D": stiffness("3D"),
    "published-exponents": exponents(),
    "published-area": area(),
    "published-kappa": kappa(),
    ...Object.fromEntries(rollOffs.map((each) => [`published-trust-${each}`, trust(each, ranges)])),
  };
}

// Figure 3 or 4: mean curves with their standard error, the window and the fits in it.
function stiffness(model) {
  const made = plot([FORCE, "stiffness k̄"], RANGES[model], LOGARITHMIC), name = `stiffness ${model}`;
  const tool = new Bokeh.BoxSelectTool({dimensions: "width", renderers: []});
  made.add_tools(tool);
  made.toolbar.active_drag = tool;
  add(made, "BoxAnnotation", `window ${model}`, {...WINDOW, editable: true});
  add(made, "Span", `saturated ${model}`, {dimension: "width", line_dash: [2, 4], line_width: 1.2, colours: {line_color: "theory"}});
  draw(made, "patches", `${name} bands`, {fill_color: {field: "colour"}, fill_alpha: 0.25, line_color: null});
  drawDimensions(made, name);
  draw(made, "multi_line", `${name} fits`, {line_width: 1.5, line_dash: "dashed", colours: {line_color: "text"}});
  return made;
}

// Add a curve for each fractal dimension, with marks, dashed where the grid decides.
function drawDimensions(made, name) {
  for (const [what, line_width, line_dash] of [["sure", 1.6, "solid"], ["unsure", 1, "dashed"]]) {
    draw(made, "multi_line", `${name} ${what}`, {line_color: {field: "colour"}, line_width, line_dash});
  }
  draw(made, "scatter", `${name} marks`, {marker: {field: "marker"}, size: 6, color: {field: "colour"}, legend_field: "D_f"});
  made.legend.setv({location: "bottom_right", title: "D_f"});
}

// Figure 5: exponents of both models, and the two predictions.
function exponents() {
  const made = plot(["fractal dimension D_f", "exponent α"], [[1.97, 3.03], [0.4, 1.02]]);
  for (const [i, line_dash] of DASHES.entries()) {
    draw(made, "varea", `exponents ${i}`, {fill_alpha: 0.3, colours: {fill_color: "light-line"}});
    draw(made, "line", `exponents ${i}`, {line_dash, line_width: 1.5, colours: {line_color: "light-line"}});
  }
  for (const [name, line_dash, legend] of [["scaling", "dashed", "1 / (4 - D_f)"], ["linear", "dotted", "0.2567 D_f"]]) {
    draw(made, "line", `prediction ${name}`, {line_dash, line_width: 1.5, legend, colours: {line_color: "text"}});
  }
  drawIntervals(made, "exponents 1D", "here", {marker: "triangle", legend: "1D, the window chosen"});
  drawIntervals(made, "exponents 3D", "dark-line", {marker: "circle", legend: "3D, the window chosen"});
  made.legend.location = "top_left";
  return made;
}

// The real contact area over force.
function area() {
  const made = plot([FORCE, "real contact area A / A_0"], [[1e-3, 10], [1e-6, 1.3]], LOGARITHMIC);
  add(made, "BoxAnnotation", "window area", WINDOW);
  drawDimensions(made, "area");
  return made;
}

// κ of eq. 4 over fractal dimension, beside two theories.
function kappa() {
  const made = plot(["fractal dimension D_f", "κ = A E* ∇h / F"], [[1.95, 3.05], [0, 6]]);
  for (const [legend, line_dash] of [["Bush, Gibson, Thomas", "dashed"], ["Persson", "dotted"]]) {
    draw(made, "line", `kappa ${legend}`, {line_dash, line_width: 1.5, legend, colours: {line_color: "theory"}});
  }
  drawIntervals(made, "kappa corrected", "dark-line", {marker: "circle", legend: "area corrected"});
  drawIntervals(made, "kappa cells", "here", {marker: "triangle", fill_alpha: 0, legend: "area in cells"});
  made.legend.location = "top_left";
  return made;
}

// One panel of the trust map, with the point that is asked about.
function trust(rollOff, ranges) {
  const made = plot(["F̄", "D_f"], ranges, {x_axis_type: "log", tools: [], toolbar_location: null, title: `q_r/q_0 = ${rollOff}`});
  draw(made, "quad", `trust ${rollOff}`, {fill_color: {field: "colour"}, line_color: {field: "colour"}});
  draw(made, "quad", `trust ${rollOff} unsure`, {fill_color: null, line_color: null, ...HATCH});
  for (const [line_color, line_width] of [["#ffffff", 5], ["#000000", 2]]) { // seen on any colour
    draw(made, "scatter", `trust point ${rollOff}`, {marker: "circle", size: 15, fill_alpha: 0, line_color, line_width});
  }
  for (const grid of made.grids) grid.visible = false;
  return made;
}

// Figure 1, a row for each fractal dimension, and Figure 2.
export function bodyFigures(rows) {
  const plots = {};
  for (let row = 0; row < rows; row++) {
    plots[`published-line-${row}`] = roughLine(row);
    for (const what of ["topography", "contact", "deflection"]) plots[`published-${what}-${row}`] = bodyMap(`${what} ${row}`, what === "topography");
  }
  return {...plots, "published-indented": indented()};
}

function roughLine(row) {
  const made = plot(["x / L", "height z / h"], [[0, 1], [-4.5, 4.5]], {toolbar_location: null});
  draw(made, "line", `line ${row}`, {columns: {y: "z"}, line_width: 0.7, colours: {line_color: "text"}});
  return made;
}

function bodyMap(name, isOfColours) {
  const made = plot(["x / L", "y / L"], [[0, 1], [0, 1]], {toolbar_location: null});
  drawImage(made, name, {isOfColours, low: 0});
  for (const axis of made.axes) axis.ticker.desired_num_ticks = 3;
  return made;
}

function indented() {
  const made = plot(["x / L", "height z / h"], [[0, 1]]);
  draw(made, "varea", "indented", {columns: {y1: "level", y2: "above"}, legend: "F / E* = shaded area", colours: {fill_color: "light-line"}});
  for (const [y, line_width, line_dash, colour, legend] of [
    ["z", 1, "solid", "quiet", "rough line"],
    ["level", 1, "dashed", "text", "level z = z_max - d"],
    ["bar", 5, "solid", "text", "springs in contact"],
  ]) draw(made, "line", "indented", {columns: {y}, line_width, line_dash, legend, colours: {line_color: colour}});
  made.legend.location = "top_left";
  return made;
}

// A panel of a study, drawn with its data.
export function studyFigure({x_label, y_label, x_range, y_range, is_log, curves}) {
  const made = plot([x_label, y_label], [x_range, y_range], is_log ? {x_axis_type: "log"} : {});
  for (const [i, curve] of curves.entries()) drawCurve(made, `curve ${i}`, curve);
  const {legend} = made;
  legend.setv({ncols: 2, spacing: 12, location: "center", glyph_height: 12, label_height: 12}); // three columns are wider than a phone
  made.center = made.center.filter((each) => each !== legend);
  made.add_layout(legend, "below"); // inside it would lie on the curves
  return made;
}

// A curve with its band, or marks with their intervals.
function drawCurve(made, name, {name: legend, colour: index, marks, dash: line_dash, x, y, low, high}) {
  const colour = index < 0 ? "text" : `ramp-${index}`, hasEnds = low.length > 0;
  const look = {legend: legend || undefined, colours: {fill_color: colour, line_color: colour}};
  const marker = MARKERS.at(index % MARKERS.length);
  if (marks && hasEnds) drawIntervals(made, name, colour, {marker, size: 7, legend: look.legend});
  else if (marks) draw(made, "scatter", name, {marker, size: 7, ...look});
  else {
    if (hasEnds) draw(made, "varea", name, {fill_alpha: 0.2, colours: {fill_color: colour}});
    draw(made, "line", name, {line_dash, line_width: 1.5, ...look, colours: {line_color: colour}});
  }
  made.renderers.at(-1).data_source.data = hasEnds ? {x, y, low, high} : {x, y};
}
