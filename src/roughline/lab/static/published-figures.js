// The figures of The paper.
import {LOGARITHMIC, add, draw, drawIntervals, name as call, plot} from "./figures.js";

const FORCE = "force F / (E* h L)";
const RANGES = {"1D": [[1e-5, 10], [1e-4, 1.6]], "3D": [[1e-3, 10], [5e-3, 1.6]]}; // of F̄ and k̄
const DIMENSIONS = ["D_f = 2", "2.2", "2.4", "2.6", "2.8", "3"], MARKERS = ["circle", "square", "diamond", "triangle", "inverted_triangle", "plus"];
const HATCH = {hatch_pattern: "right_diagonal_line", hatch_color: "#1c1c1a", hatch_alpha: 0.7, hatch_scale: 7, hatch_weight: 0.8};
const QUIET = {fill_color: "quiet", line_color: "quiet"};
const WINDOW = {movable: "x", resizable: "x", fill_alpha: 0.12, line_alpha: 0.6, level: "underlay", colours: QUIET};

// Figures 3 to 5, the area law, and the panels of the trust map, by their roll-off ratios.
export function publishedFigures(rollOffs) {
  return {
    "published-stiffness-1D": stiffness("1D"),
    "published-stiffness-3D": stiffness("3D"),
    "published-exponents": exponents(),
    "published-area": area(),
    "published-kappa": kappa(),
    ...Object.fromEntries(rollOffs.map((each) => [`published-trust-${each}`, trust(each)])),
  };
}

// Figure 3 or 4: mean curves with their standard error, the window and the fits in it.
function stiffness(model) {
  const made = plot([FORCE, "stiffness k̄"], RANGES[model], LOGARITHMIC), name = `stiffness ${model}`;
  const tool = new Bokeh.BoxSelectTool({dimensions: "width", renderers: []});
  made.add_tools(tool);
  made.toolbar.active_drag = tool;
  made.yaxes[0].name = `label ${model}`;
  add(made, "BoxAnnotation", `window ${model}`, {...WINDOW, editable: true});
  add(made, "Span", `saturated ${model}`, {dimension: "width", line_dash: [2, 4], colours: {line_color: "theory"}});
  drawDimensions(made, name);
  draw(made, "multi_line", `${name} fits`, {line_width: 1.5, line_dash: "dashed", colours: {line_color: "text"}});
  return made;
}

// Add a curve for each fractal dimension, with marks and its standard error, dashed where the grid decides.
function drawDimensions(made, name) {
  const look = {line_color: {field: "colour"}};
  draw(made, "patches", `${name} bands`, {fill_color: {field: "colour"}, fill_alpha: 0.25, line_color: null});
  draw(made, "multi_line", `${name} all`, {...look, line_dash: "dashed"});
  draw(made, "multi_line", `${name} sure`, {...look, line_width: 1.6});
  draw(made, "scatter", `${name} marks`, {marker: {field: "marker"}, size: 6, color: {field: "colour"}});
  call(made, ...DIMENSIONS.map((legend, i) => ({
    source: `${name} marks`, legend, kind: "scatter", look: {marker: MARKERS[i]}, colours: {fill_color: `ramp-${i}`, line_color: `ramp-${i}`},
  })));
}

// Figure 5: exponents of both models, and the two predictions.
function exponents() {
  const made = plot(["fractal dimension", "exponent α"], [[1.97, 3.03], [0.4, 1.02]]);
  for (const [i, line_dash] of ["solid", "dashed", "dotted"].entries()) {
    draw(made, "varea", `exponents ${i}`, {fill_alpha: 0.3, colours: {fill_color: "light-line"}});
    draw(made, "line", `exponents ${i}`, {line_dash, line_width: 1.5, colours: {line_color: "light-line"}});
  }
  for (const [name, line_dash, legend] of [["scaling", "dashed", "scaling argument"], ["linear", "dotted", "line of §7"]]) {
    draw(made, "line", `prediction ${name}`, {line_dash, line_width: 1.5, legend, colours: {line_color: "text"}});
  }
  draw(made, "scatter", "exponents 1D", {size: 8, marker: "triangle", legend: "1D, window chosen", colours: {fill_color: "here", line_color: "here"}});
  drawIntervals(made, "exponents 1D", "here", 8);
  draw(made, "scatter", "exponents 3D", {size: 8, marker: "circle", legend: "3D, window chosen", colours: {fill_color: "dark-line", line_color: "dark-line"}});
  drawIntervals(made, "exponents 3D", "dark-line", 8);
  return made;
}

// The real contact area over force.
function area() {
  const made = plot([FORCE, "real contact area A / A₀"], [[1e-3, 10], [1e-6, 1.3]], LOGARITHMIC);
  add(made, "BoxAnnotation", "window area", WINDOW);
  drawDimensions(made, "area");
  return made;
}

// κ of eq. 4 over fractal dimension, beside two theories.
function kappa() {
  const made = plot(["fractal dimension", "κ = A E* ∇h / F"], [[1.95, 3.05], [0, 4.6]]);
  for (const [legend, line_dash] of [["Bush, Gibson, Thomas", "dashed"], ["Persson", "dotted"]]) {
    draw(made, "line", `kappa ${legend}`, {line_dash, line_width: 1.5, legend, colours: {line_color: "theory"}});
  }
  draw(made, "scatter", "kappa corrected", {size: 8, marker: "circle", legend: "area corrected", colours: {fill_color: "dark-line", line_color: "dark-line"}});
  drawIntervals(made, "kappa corrected", "dark-line", 8);
  draw(made, "scatter", "kappa cells", {size: 8, marker: "triangle", fill_alpha: 0, legend: "area in cells", colours: {fill_color: "here", line_color: "here"}});
  drawIntervals(made, "kappa cells", "here", 8);
  return made;
}

// One panel of the trust map, with the point that is asked about.
function trust(rollOff) {
  const made = plot([null, null], [[7.5e-4, 4.217], [1.95, 3.05]], {x_axis_type: "log", tools: [], toolbar_location: null});
  draw(made, "quad", `trust ${rollOff}`, {fill_color: {field: "colour"}, line_color: {field: "colour"}});
  draw(made, "quad", `trust ${rollOff} unsure`, {fill_color: null, line_color: null, ...HATCH});
  for (const [line_color, line_width] of [["#ffffff", 5], ["#000000", 2]]) { // seen on any colour
    draw(made, "scatter", `trust point ${rollOff}`, {marker: "circle", size: 15, fill_alpha: 0, line_color, line_width});
  }
  for (const grid of made.grids) grid.visible = false;
  return made;
}
