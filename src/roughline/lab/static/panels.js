// Panels of curves, as the server declares them: their figures, and what answers have for them.
import {typeset} from "./elements.js";
import {LOGARITHMIC, add, draw, drawIntervals, plot} from "./figures.js";
import {embedded} from "./plots.js";
import {fillTable} from "./tables.js";

const FILLED = ["scatter", "varea"]; // glyphs that have an inside
const FOOT = 0.04; // of a logarithmic axis: how far above its end zeros stand
const ORDER = {curve: 0, line: 2}; // of rows in tables, by the answers that they came with; of others 1
const SLOPE = 0.6; // of the names of places [rad]

// Embed the panels that the page of a view has, and its other figures, which may change those of the panels.
export async function panelsOf(root, others = () => ({})) {
  const {panels} = JSON.parse(root.dataset.declared), view = root.id;
  const plots = await embedded(() => {
    const made = Object.fromEntries(panels.map((panel) => [`${view}-${panel.key}`, figureOf(panel)]));
    return {...made, ...others(made)};
  });
  return new Panels(plots, view, panels);
}

function figureOf({key, x, y, ranges, series, is_logarithmic: isLogarithmic, of_places: isOfPlaces, cursor}) {
  const made = plot([x, y], ranges, isOfPlaces ? {y_axis_type: "log"} : isLogarithmic ? LOGARITHMIC : {});
  for (const {name, legend, colour, edge, glyphs} of series) {
    for (const [kind, look] of Object.entries(glyphs)) {
      if (kind === "whisker") { drawIntervals(made, `${key} ${name}`, edge || colour, look.size); continue; }
      const fill = FILLED.includes(kind) ? {fill_color: colour} : {};
      const line = kind === "varea" ? {} : {line_color: edge || colour};
      draw(made, kind, `${key} ${name}`, {legend, ...look, colours: {...fill, ...line}});
    }
  }
  const line = {dimension: "width", location: 0, line_width: 1, colours: {line_color: "line"}};
  if (!isLogarithmic) add(made, "Span", `${key} zero`, line);
  if (cursor) {
    add(made, "Span", `${key} cursor`, {
      dimension: cursor, location: 0.1, line_width: 3, editable: true, level: "overlay", colours: {line_color: "here", hover_line_color: "mark"},
    });
  }
  if (isOfPlaces) {
    made.xgrids[0].visible = false;
  }
  return made;
}

class Panels {
  #view; #declared;
  #answers = new Map(); // what the last of each kind has for panels, those that came last at the end

  constructor(plots, view, declared) {
    this.plots = plots;
    this.#view = view;
    this.#declared = Object.fromEntries(declared.map((panel) => [panel.key, panel]));
  }

  // Show what an answer has for panels, in the place of the last of its kind; a panel is empty that has no rows.
  show(what, panels, numbers) {
    const before = this.#answers.get(what) ?? {};
    this.#answers.delete(what);
    this.#answers.set(what, panels);
    for (const [key, {series}] of Object.entries(before)) {
      for (const name of Object.keys(series)) if (!panels[key]?.series[name]) this.plots.empty(`${key} ${name}`);
      if (panels[key]) continue;
      this.#fillRows(key);
      this.#remark(key, "");
    }
    for (const [key, filled] of Object.entries(panels)) this.#fill(what, key, filled, numbers);
  }

  #fill(what, key, {series, legends, rows, caption, remarks, x, y, axes, names}, numbers) {
    const {plots} = this, plot = this.#plot(key);
    for (const [axis, range] of Object.entries({x, y})) if (range) plots.follow(plot, axis, range);
    for (const [name, columns] of Object.entries(series)) this.#mark(key, name, columns);
    for (const [name, value] of Object.entries(legends ?? {})) plots.call(`${key} ${name}`, value);
    if (y) this.#placeZeros(key);
    if (axes) plots.label(plot, ...axes);
    if (names) nameOn(plots.root(plot).xaxes[0], names);
    if (caption != null) this.#find(key, "[data-caption]").replaceChildren(...typeset(caption));
    if (remarks != null) this.#remark(key, remarks);
    if (!rows) return;
    this.#fillRows(key);
    plots.shows(plot, {what, numbers});
    if (this.#declared[key].task === what) document.querySelector(`#${plot}`).classList.remove("dimmed");
  }

  // All points that are drawn, as a table: the panel and the series of each, and the ends of what is known of its y.
  table(remarks) {
    const rows = [], columns = ["x", "y", "low", "high"];
    const heads = Object.values(this.#declared).map(({key, x, y}) => `panel ${key}: x is ${x}, y is ${y}`);
    for (const panels of this.#answers.values()) {
      for (const [key, {series, legends}] of Object.entries(panels)) {
        for (const [name, points] of Object.entries(series)) {
          const words = legends?.[name] ?? this.#declared[key].series.find((each) => each.name === name)?.legend;
          if (points.x.length) heads.push(`series ${key} ${name}: ${words}`);
          points.x.forEach((_, i) => {
            const numbers = columns.map((column) => points[column]?.[i] ?? "nan");
            rows.push([key, name.replaceAll(" ", "_"), ...numbers].join(","));
          });
        }
      }
    }
    return [`panel,series,${columns}`, ...[...remarks, ...heads].map((each) => `# ${each.replace(/\s+/g, " ")}`), ...rows, ""].join("\n");
  }

  #plot(key) { return `${this.#view}-${key}`; }
  #find(key, selector) { return document.querySelector(`#${this.#plot(key)} ${selector}`); }
  #remark(key, text) { this.#find(key, "[data-remarks]")?.replaceChildren(...typeset(text)); }

  // The table of a panel has the rows of all answers, in one order, however they came.
  #fillRows(key) {
    const all = [...this.#answers].sort(([a], [b]) => (ORDER[a] ?? 1) - (ORDER[b] ?? 1))
      .flatMap(([, panels]) => (panels[key]?.rows ? [panels[key]] : []));
    const columns = all.find((each) => each.columns)?.columns ?? this.#declared[key].columns;
    fillTable(this.#plot(key), columns, all.flatMap(({rows}) => rows));
    document.querySelector(`#${this.#plot(key)}`).classList.toggle("empty", !all.length);
  }

  // Draw points, and name them in the legend if there are any; zeros stand at the foot of a logarithmic axis.
  #mark(key, name, columns) {
    const {start, end} = this.plots.root(this.#plot(key)).y_range, {is_logarithmic: isLogarithmic} = this.#declared[key];
    const foot = start * (end / start) ** FOOT;
    const known = Object.entries(columns).map(([column, values]) => [column, values.map((value) => value ?? NaN)]);
    const drawn = Object.fromEntries(known);
    if (isLogarithmic && drawn.y) drawn.y = drawn.y.map((value) => (value === 0 ? foot : value));
    this.plots.set(`${key} ${name}`, drawn);
  }

  // Put zeros of all answers at the foot of an axis whose range has changed.
  #placeZeros(key) {
    for (const panels of this.#answers.values()) {
      for (const [name, columns] of Object.entries(panels[key]?.series ?? {})) {
        if (columns.y?.includes(0)) this.#mark(key, name, columns);
      }
    }
  }
}

// Name the places 1, 2, 3 on an axis.
function nameOn(axis, names) {
  const ticks = names.map((_, i) => i + 1);
  axis.setv({ticker: new Bokeh.FixedTicker({ticks}), major_label_overrides: new Map(ticks.map((tick) => [tick, names[tick - 1]])),
    major_label_orientation: SLOPE});
}
