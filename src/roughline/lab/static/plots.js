// Plots of Bokeh: embedding, data, colours of the theme, keys, and the tables below them.
import {unpacked} from "./link.js";

const documents = [];
const PALETTES = {
  get cividis() { return Bokeh.Palettes?.Cividis256 ?? Bokeh.require("api/palettes").Cividis256; },
  get viridis() { return Bokeh.Palettes?.Viridis256 ?? Bokeh.require("api/palettes").Viridis256; },
};

// Embed the figures of a view; returns what changes them.
export async function embedded(view) {
  const response = await fetch(`/figures/${view}`);
  if (!response.ok) throw new Error(await response.text());
  const {documents: content, items} = unpacked(await response.arrayBuffer());
  const before = new Set(Bokeh.documents);
  await Bokeh.embed.embed_items(content, items);
  const made = Bokeh.documents.find((each) => !before.has(each));
  documents.push(made);
  recolour(made);
  for (const root of made.roots()) takeKeys(root);
  return new Plots(made);
}

export class Plots {
  constructor(made) { this.made = made; }

  model(name) { return this.made.get_model_by_name(name); }

  // Give a source its columns.
  set(name, columns) { this.model(name).data = columns; }

  // Give a map its image over both sides, and its colours their range.
  setMap(name, {values, shape, dtype}, [width, height], [low, high]) {
    const {ndarray} = Bokeh.require("core/util/ndarray");
    if (low !== undefined) this.model(`${name} colours`).setv({low, high});
    this.set(name, {image: [ndarray(values, {dtype, shape})], x: [0], y: [0], dw: [width], dh: [height]});
  }

  // Give a map a palette: one of Bokeh's, or "marks", paper and ink.
  colours(name, palette) {
    const mapper = this.model(`${name} colours`), bar = this.model(`${name} bar`);
    const style = getComputedStyle(document.documentElement);
    const marks = ["--paper", "--ink"].map((colour) => style.getPropertyValue(colour).trim());
    mapper.palette = palette === "marks" ? marks : PALETTES[palette];
    bar.visible = palette !== "marks";
  }

  // Call when a cursor was moved by hand.
  onMove(name, moved) {
    this.model(name).properties.location.change.connect(() => moved(this.model(name).location));
  }
}

// Put rows below a plot.
export function fillTable(id, header, rows) {
  const table = document.createElement("table");
  const row = (cells, kind) => {
    const line = document.createElement("tr");
    for (const text of cells) {
      const cell = document.createElement(kind);
      if (kind === "th") cell.scope = "col";
      cell.textContent = text;
      line.append(cell);
    }
    return line;
  };
  table.createTHead().append(row(header, "th"));
  const body = table.createTBody();
  for (const cells of rows) body.append(row(cells, "td"));
  document.querySelector(`[data-table="${id}"]`).replaceChildren(table);
}

// Draw all plots in the colours of the theme.
export function recolourAll() { documents.forEach(recolour); }

function recolour(made) {
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(`--${name}`).trim();
  const text = colour("text"), line = colour("line"), paper = colour("paper"), grid = colour("grid");
  for (const model of made._all_models?.values() ?? made.all_models ?? []) {
    switch (model.type) {
      case "Figure": case "Plot":
        model.setv({background_fill_color: paper, border_fill_color: paper, outline_line_color: line});
        break;
      case "LinearAxis": case "LogAxis": case "CategoricalAxis":
        model.setv({axis_label_text_color: text, major_label_text_color: text, axis_line_color: line,
          major_tick_line_color: line, minor_tick_line_color: line, axis_label_text_font_style: "normal"});
        break;
      case "Grid": model.setv({grid_line_color: grid}); break;
      case "Legend":
        model.setv({label_text_color: text, background_fill_color: paper, background_fill_alpha: 0.8,
          border_line_color: null, label_text_font_size: "11px", spacing: 0, padding: 4});
        break;
      case "ColorBar":
        model.setv({major_label_text_color: text, title_text_color: text, background_fill_color: null,
          title_text_font_style: "normal"});
        break;
      case "Title": model.setv({text_color: text}); break;
      default:
        for (const tag of model.tags ?? []) {
          if (tag?.colours) {
            model.setv(Object.fromEntries(Object.entries(tag.colours).map(([key, name]) => [key, colour(name)])));
          }
        }
    }
  }
}

// Zoom and move a plot by keys: +, -, arrows; 0 shows all.
function takeKeys(root) {
  const element = document.querySelector(`#plot-${CSS.escape(root.name)}`);
  if (!element) return;
  const zoom = (factor, [dx, dy] = [0, 0]) => {
    for (const [range, scale, shift] of [[root.x_range, root.x_scale, dx], [root.y_range, root.y_scale, dy]]) {
      const isLog = scale.type === "LogScale";
      const to = isLog ? Math.log : (x) => x, from = isLog ? Math.exp : (x) => x;
      const [start, end] = [to(range.start), to(range.end)];
      const middle = (start + end) / 2 + shift * (end - start), half = ((end - start) / 2) * factor;
      range.setv({start: from(middle - half), end: from(middle + half)});
    }
  };
  const moves = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]};
  element.addEventListener("keydown", (event) => {
    if (event.target !== element) return;
    if (event.key === "+" || event.key === "=") zoom(0.8);
    else if (event.key === "-") zoom(1.25);
    else if (event.key in moves) zoom(1, moves[event.key]);
    else if (event.key === "0") Bokeh.index.find_one(root)?.reset();
    else return;
    event.preventDefault();
  });
}
