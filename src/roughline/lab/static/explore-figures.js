// The figures of Explore.
import {LOGARITHMIC, add, draw, plot} from "./figures.js";
import {mapFigure, profileFigure, sharedRanges} from "./maps.js";

const FILLED = ["scatter", "varea"]; // glyphs that have an inside

// Both maps with their profile, and panels of curves as the server declares them.
export function exploreFigures(panels) {
  const ranges = sharedRanges();
  return {
    "explore-topography": mapFigure("topography", {isOfColours: true, ranges}),
    "explore-contact": mapFigure("contact", {rings: "here", ranges}),
    "explore-profile": profileFigure(),
    ...Object.fromEntries(panels.map((panel) => [`explore-${panel.key}`, curves(panel)])),
  };
}

function curves({key, x, y, ranges, series, is_logarithmic, cursor}) {
  const made = plot([x, y], ranges, is_logarithmic ? LOGARITHMIC : {});
  for (const {name, legend, colour, edge, glyphs} of series) {
    for (const [kind, look] of Object.entries(glyphs)) {
      const fill = FILLED.includes(kind) ? {fill_color: colour} : {};
      const line = kind === "varea" ? {} : {line_color: edge || colour};
      draw(made, kind, `${key} ${name}`, {legend, ...look, colours: {...fill, ...line}});
    }
  }
  const line = {dimension: "width", location: 0, line_width: 1, colours: {line_color: "line"}};
  if (!is_logarithmic) add(made, "Span", `${key} zero`, line);
  if (cursor) { // the present load, which can be dragged
    add(made, "Span", `${key} cursor`, {
      dimension: cursor, location: 0.1, line_width: 3, editable: true, colours: {line_color: "here", hover_line_color: "mark"},
    });
  }
  return made;
}
