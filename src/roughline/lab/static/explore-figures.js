// The figures of Explore.
import {LOGARITHMIC, add, draw, plot} from "./figures.js";
import {mapFigure, profileFigure, sharedRanges} from "./maps.js";

const FORCE = "force F / (E* h L)", FORCES = [1e-4, 10];
const DASHES = ["dashed", "dotted", "dashdot"]; // of theories
const MARKS = [ // of the full model: source, name, colour, and how they look
  ["curve", "3D", "dark-line", {marker: "circle", size: 7}],
  ["unsure", "3D, fewer than ten cells touch", "dark-line", {marker: "circle", size: 7, fill_alpha: 0}],
  ["unloading", "3D, on unloading", "mark", {marker: "triangle", size: 7, fill_alpha: 0}],
  ["back", "3D, way back", "here", {marker: "square", size: 5}],
  ["here", "3D, this load", "here", {marker: "circle", size: 13}],
];

export function exploreFigures() {
  const ranges = sharedRanges();
  return {
    "explore-topography": mapFigure("topography", {isOfColours: true, ranges}),
    "explore-contact": mapFigure("contact", {rings: "here", ranges}),
    "explore-profile": profileFigure(),
    "explore-stiffness": stiffness(),
    "explore-area": area(),
    "explore-aperture": aperture(),
    "explore-cycle": cycle(),
    "explore-spectrum": spectrum(),
  };
}

function stiffness() {
  const made = plot([FORCE, "stiffness k̄"], [FORCES, [1e-3, 1.6]], LOGARITHMIC);
  const legend = "1D, mean and range of single lines";
  draw(made, "varea", "stiffness line", {fill_alpha: 0.25, legend, colours: {fill_color: "light-line"}});
  draw(made, "line", "stiffness line", {line_width: 2.5, legend, colours: {line_color: "light-line"}});
  drawLoads(made, "stiffness");
  return made;
}

function area() {
  const made = plot([FORCE, "real contact area A / A₀"], [FORCES, [1e-4, 1.3]], LOGARITHMIC);
  drawLoads(made, "area");
  return made;
}

// Loads and theories that are sealed, which have no place on a logarithmic axis, stand at its foot.
function aperture() {
  const made = plot([FORCE, "hydraulic aperture uₕ / h"], [FORCES, [1e-2, 10]], LOGARITHMIC);
  const look = {marker: "x", size: 9, line_width: 2};
  drawLoads(made, "aperture");
  draw(made, "scatter", "aperture theory sealed", {...look, colours: {line_color: "theory"}});
  draw(made, "scatter", "aperture sealed", {...look, legend: "sealed: nothing comes through", colours: {line_color: "dark-line"}});
  return made;
}

// Both ways of bodies that stick, on scales that have pulls.
function cycle() {
  const made = plot(["depth d / h", FORCE], [[-1, 1], [-1, 1]]);
  add(made, "Span", "cycle zero", {dimension: "width", location: 0, line_width: 1, colours: {line_color: "line"}});
  for (const [way, legend, colour, marker] of [["there", "there", "dark-line", "circle"], ["back", "back", "here", "square"]]) {
    draw(made, "line", `cycle ${way}`, {line_width: 2, legend, colours: {line_color: colour}});
    draw(made, "scatter", `cycle ${way}`, {size: 4, marker, legend, colours: {fill_color: colour, line_color: colour}});
  }
  draw(made, "scatter", "cycle here", {size: 13, line_width: 1.5, legend: "this load on both ways", colours: {fill_color: "mark", line_color: "paper"}});
  draw(made, "scatter", "cycle pull-off", {marker: "inverted_triangle", size: 13, line_width: 1.5, legend: "pull-off", colours: {fill_color: "pull", line_color: "text"}});
  addCursor(made, "cycle", "width");
  return made;
}

function spectrum() {
  const made = plot(["waves along the side, q L / 2π", "C_2d [m⁴]"], [[0.8, 300], [1e-20, 1e-10]], LOGARITHMIC);
  draw(made, "scatter", "spectrum", {size: 4, colours: {fill_color: "mark", line_color: "mark"}});
  draw(made, "line", "spectrum", {columns: {y: "law"}, line_width: 2, colours: {line_color: "here"}});
  return made;
}

// Add theories, the loads of the full model, the present one, and the cursor that sets it.
function drawLoads(made, name) {
  for (const [i, line_dash] of DASHES.entries()) {
    draw(made, "line", `${name} theory ${i}`, {line_dash, line_width: 2, colours: {line_color: "theory"}});
  }
  for (const [what, legend, colour, look] of MARKS) {
    if (what === "back") draw(made, "line", `${name} back`, {line_width: 2, legend, colours: {line_color: colour}});
    draw(made, "scatter", `${name} ${what}`, {line_width: 1.5, legend, ...look, colours: {fill_color: colour, line_color: colour}});
  }
  addCursor(made, name, "height");
}

// Add the line of the present load, which can be dragged.
function addCursor(made, name, dimension) {
  add(made, "Span", `${name} cursor`, {
    dimension, location: 0.1, line_width: 3, editable: true, colours: {line_color: "here", hover_line_color: "mark"},
  });
}
