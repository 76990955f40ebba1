// The figures of Explore.
import {LOGARITHMIC, add, addFluxBar, draw, drawImage, plot} from "./figures.js";

const BAR = {width: 14, padding: 4};
const LEGEND = {glyph_width: 34, glyph_height: 14, label_height: 14, spacing: 0, margin: 4, padding: 3};
const FILLED = ["scatter", "varea"]; // glyphs that have an inside

// Both maps, and panels of curves as the server declares them.
export function exploreFigures(panels) {
  const sides = [1, 2].map(() => new Bokeh.Range1d({start: 0, end: 1}));
  return {
    "explore-topography": map("topography", sides, "height / h", true),
    "explore-contact": contact(sides),
    ...Object.fromEntries(panels.map((panel) => [`explore-${panel.key}`, curves(panel)])),
  };
}

function map(name, sides, title, isOfColours) {
  const made = plot(["x / L", "y / L"], sides, {min_border_left: 62, min_border_right: 84}); // maps side by side are alike
  const color_mapper = drawImage(made, name, {isOfColours});
  add(made, "ColorBar", `${name} bar`, {color_mapper, title, ...BAR}, "right");
  add(made, "BoxAnnotation", `${name} border`, {left: 0, right: 1, bottom: 0, top: 1, fill_alpha: 0, line_width: 1, colours: {line_color: "line"}});
  return made;
}

function contact(sides) {
  const made = map("contact", sides, "", false);
  addFluxBar(made, "contact", made.right.find(({name}) => name === "contact bar").color_mapper, BAR);
  for (const [size, line_width, colour] of [[17, 5, "paper"], [17, 2, "here"]]) { // the one is seen around the other
    draw(made, "scatter", "ring", {size, line_width, fill_alpha: 0, colours: {line_color: colour}});
  }
  return made;
}

function curves({key, x, y, ranges, series, is_logarithmic, legend: place, cursor}) {
  const made = plot([x, y], ranges, is_logarithmic ? LOGARITHMIC : {});
  for (const {name, legend, colour, edge, glyphs} of series) {
    for (const [kind, look] of Object.entries(glyphs)) {
      const fill = FILLED.includes(kind) ? {fill_color: colour} : {};
      const line = kind === "varea" ? {} : {line_color: edge || colour};
      draw(made, kind, `${key} ${name}`, {legend, ...look, colours: {...fill, ...line}});
    }
    made.legend.items.at(-1).visible = false; // until there is something
  }
  made.legend.setv({location: place, ...LEGEND});
  const line = {dimension: "width", location: 0, line_width: 1, colours: {line_color: "line"}};
  if (!is_logarithmic) add(made, "Span", `${key} zero`, line);
  if (cursor) { // the present load, which can be dragged
    add(made, "Span", `${key} cursor`, {
      dimension: cursor, location: 0.1, line_width: 3, editable: true, colours: {line_color: "here", hover_line_color: "mark"},
    });
  }
  return made;
}
