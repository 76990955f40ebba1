// Pictures of My surface, as the server declares them: maps, the columns of sources, axes, captions and tables.
import {onDraw} from "./hands.js";
import {Maps, layersOf} from "./maps.js";
import {fillCaption, fillTable} from "./tables.js";

export class Pictures {
  #view; #plots; #unsettled = new Map(); #extents = new Map(); #choices = new Map();
  #maps = {}; // by the names of each
  #before = null; // the map on which a piece is drawn, and the box that is shown

  constructor(view, plots) {
    this.#view = view;
    this.#plots = plots;
    const linked = [[["file"]], [["before", "after"]], [["topography", "contact"], "profile"]];
    for (const [names, profile] of linked) {
      const maps = new Maps(plots, "measured", names, profile);
      for (const name of names) this.#maps[name] = maps;
    }
    for (const select of view.findAll("[data-choice]")) select.addEventListener("change", () => this.#choose(select));
  }

  // Call with the crop, as text, when a box was drawn on the map.
  onBox(drawn) {
    const map = this.#plots.root("measured-before"), box = this.#plots.model("crop box");
    const keep = (...corners) => {
      if (!this.#before) return;
      const {map: {sizes, along}, models} = this.#before;
      const ends = corners.map((value, i) => Math.min(Math.max(value, 0), sizes[i < 2 ? 0 : 1]));
      if (!(ends[0] < ends[1] && ends[2] < ends[3])) { box.setv(models["crop box"]); return; }
      drawn(ends.map((value) => `${Number(value.toPrecision(4))} ${along}`).join(", "));
    };
    map.on_event("selectiongeometry", ({geometry: {type, x0, x1, y0, y1}}) => { if (type === "rect") keep(x0, x1, y0, y1); });
    onDraw(map, this.#view.find("[data-draw]"), (from, to, isLast) => {
      const [left, right] = [from.x, to.x].sort((a, b) => a - b), [bottom, top] = [from.y, to.y].sort((a, b) => a - b);
      if (isLast) keep(left, right, bottom, top);
      else box.setv({visible: true, left, right, bottom, top});
    });
  }

  // Draw panels; of a choice the one that is chosen, which stays chosen where there is one of that name again.
  show(panels, choices, arrays) {
    if (panels["measured-before"]) this.#before = panels["measured-before"];
    for (const [id, panel] of Object.entries(panels)) this.#draw(id, panel, arrays);
    for (const [id, options] of Object.entries(choices)) {
      const select = this.#view.find(`[data-choice="${id}"]`), names = Object.keys(options), chosen = select.value;
      select.replaceChildren(...names.map((name) => new Option(name)));
      if (names.includes(chosen)) select.value = chosen;
      this.#choices.set(select, {id, options, arrays});
      this.#choose(select);
    }
  }

  #choose(select) {
    const {id, options, arrays} = this.#choices.get(select);
    this.#draw(id, options[select.value] ?? null, arrays);
  }

  #draw(id, panel, arrays) {
    const plots = this.#plots, place = this.#view.find(`#${id}`);
    place.hidden = !panel;
    if (!panel) return;
    const {map, sources = {}, models = {}, axes = [], factors, span, caption, marks, more = "", table, extent} = panel;
    const columnOf = (column) => (typeof column === "string" ? [...arrays[column].values] : column);
    for (const [name, columns] of Object.entries(sources)) {
      plots.set(name, Object.fromEntries(Object.entries(columns).map(([key, column]) => [key, columnOf(column)])));
    }
    if (map) {
      const maps = this.#maps[map.name];
      if (map.frame) maps.frame(map.frame, map.along);
      maps.show(map.name, arrays[map.array], map.look, map.sizes, map.corner);
      if (map.layers) maps.tell(layersOf(map.layers, arrays));
    }
    for (const [name, look] of Object.entries(models)) plots.model(name).setv(look);
    if (factors) plots.root(id).x_range.factors = factors;
    if (span) plots.span(id, "y", span);
    plots.label(id, ...axes);
    const told = place.querySelector("[data-caption]");
    if (told) {
      fillCaption(told, caption ?? "", marks);
      told.append(told.hasChildNodes() && told.textContent ? more : more.replace(/^; /, ""));
    }
    if (table) fillTable(id, ...table);
    if (!map) this.#settle(id, extent);
  }

  // Lay a plot out anew: its labels may have come, or it may have been hidden before. All of it is
  // shown where its extent, as text, is another one.
  #settle(id, extent) {
    if (this.#unsettled.size === 0) requestAnimationFrame(() => {
      for (const [name, isOther] of this.#unsettled) {
        const view = Bokeh.index.find_one(this.#plots.root(name));
        view?.invalidate_layout();
        if (isOther) view?.reset();
      }
      this.#unsettled.clear();
    });
    const isOther = Boolean(extent) && this.#extents.get(id) !== extent;
    if (isOther) this.#extents.set(id, extent);
    this.#unsettled.set(id, isOther || (this.#unsettled.get(id) ?? false));
  }
}
