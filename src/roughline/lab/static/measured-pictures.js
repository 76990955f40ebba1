// Pictures of My surface: heights, spectrum, contact and curves, and their tables.
import {onDraw} from "./hands.js";
import {points} from "./plots.js";
import {fillCaption, fillTable} from "./tables.js";

const FIELDS = {
  area: ["marks", ""],
  pressure: ["Viridis256", "pressure"],
  gap: ["Cividis256", "gap"],
  displacement: ["Cividis256", "deflection of the half-space"],
};

export class Pictures {
  #view; #plots; #before = null; #unsettled = new Map(); #extents = new Map();

  constructor(view, plots) {
    this.#view = view;
    this.#plots = plots;
  }

  // Call with the crop, as text, when a box was drawn on the map.
  onBox(drawn) {
    const map = this.#plots.root("measured-before");
    const keep = (...corners) => {
      if (!this.#before) return;
      const {sizes, along} = this.#before;
      const within = (value, side) => Math.min(Math.max(value, 0), side);
      const ends = corners.map((value, i) => within(value, sizes[i < 2 ? 0 : 1]));
      if (!(ends[0] < ends[1] && ends[2] < ends[3])) { this.#showBox(...this.#box); return; }
      drawn(ends.map((value) => `${Number(value.toPrecision(4))} ${along}`).join(", "));
    };
    map.on_event("selectiongeometry", ({geometry: {type, x0, x1, y0, y1}}) => { if (type === "rect") keep(x0, x1, y0, y1); });
    onDraw(map, this.#view.find("[data-draw]"), (from, to, isLast) => {
      const [left, right] = [from.x, to.x].sort((a, b) => a - b), [bottom, top] = [from.y, to.y].sort((a, b) => a - b);
      if (isLast) keep(left, right, bottom, top);
      else this.#plots.model("crop box").setv({visible: true, left, right, bottom, top});
    });
  }

  drawFile({file, spectrum, arrays}) {
    const share = file.is_map ? "orange: missing points; rings: spikes" : "crosses: missing points; rings: spikes";
    const spikes = file.spikes ? `${file.spikes.count} spikes` : "spikes are looked for once unit and size are known";
    this.#toggle("measured-file", file.is_map);
    this.#toggle("measured-file-line", !file.is_map);
    if (file.is_map) {
      this.#map("file", arrays["file heights"], file, file.range, file.up);
      this.#plots.set("file spikes", {x: file.spikes?.x ?? [], y: file.spikes?.y ?? []});
    } else {
      this.#plots.set("file line heights", {x: [...arrays["file x"].values], y: [...arrays["file heights"].values]});
      this.#plots.set("file line spikes", {x: file.spikes?.x ?? [], y: file.spikes?.y ?? []});
      this.#plots.set("file line missing", {x: file.missing, y: file.missing.map(() => file.range[0])});
      this.#settle("measured-file-line", `${file.sizes} ${file.along}`);
      this.#plots.label("measured-file-line", `x [${file.along}]`, `height [${file.up}]`);
    }
    this.#caption(file.is_map ? "file" : "file-line", `${share}; ${spikes}`);
    fillTable(file.is_map ? "measured-file" : "measured-file-line", ["heights", ""], file.rows);
    this.#drawSpectrum(spectrum);
  }

  #drawSpectrum(spectrum) {
    this.#toggle("measured-spectrum", spectrum !== null);
    if (!spectrum) return;
    this.#plots.set("spectrum", {x: spectrum.q, y: spectrum.power});
    this.#plots.set("spectrum law", {x: spectrum.law?.q ?? [], y: spectrum.law?.power ?? []});
    this.#plots.label("measured-spectrum", null, spectrum.label);
    this.#caption("spectrum", spectrum.title);
    fillTable("measured-spectrum", ["q [1/m]", spectrum.label], spectrum.rows);
  }

  // Before and after, with the same colours.
  drawPrepared(read, prepared, crop) {
    const after = prepared.body, before = read.body ?? after;
    const source = read.body ? read : prepared;
    this.#before = before;
    for (const name of ["before", "after"]) this.#toggle(`measured-${name}`, after.is_map);
    this.#toggle("measured-prepared-line", !after.is_map);
    const corner = corners(crop, before);
    const scale = after.metres / before.metres; // from the unit of one to that of the other
    if (!after.is_map) {
      this.#plots.set("prepared line before", {x: [...source.arrays["body x"].values], y: [...source.arrays["body heights"].values]});
      const factor = heightFactor(after.up, before.up);
      this.#plots.set("prepared line after", {
        x: [...prepared.arrays["body x"].values].map((x) => x * scale + corner.x),
        y: [...prepared.arrays["body heights"].values].map((y) => y * factor),
      });
      this.#settle("measured-prepared-line", `${before.sizes} ${before.along}`);
      this.#plots.label("measured-prepared-line", `x [${before.along}]`, `height [${before.up}]`);
      fillTable("measured-prepared-line", ["heights", "before", "after"], before.rows.map(([name, value], i) => [name, value, after.rows[i]?.[1] ?? "-"]));
      return;
    }
    const factor = heightFactor(after.up, before.up);
    const most = after.most.map((height) => height * factor);
    const range = [Math.min(before.most[0], most[0]), Math.max(before.most[1], most[1])];
    this.#map("before", source.arrays["body heights"], before, range, before.up);
    this.#map("after", scaled(prepared.arrays["body heights"], factor), {
      sizes: after.sizes.map((size) => size * scale), along: before.along, ...corner,
    }, range, before.up);
    this.#showBox(crop, corner, after.sizes.map((size) => size * scale));
    this.#caption("before", read.body ? "about the mean, as read; draw a box to keep a piece" : "the file as it stands cannot be pressed");
    this.#caption("after", `${after.points.join(" x ")} points`);
    fillTable("measured-before", ["heights", ""], before.rows);
    fillTable("measured-after", ["heights", ""], after.rows);
  }

  drawContact(contact, arrays) {
    for (const name of ["topography", "contact"]) this.#toggle(`measured-${name}`, contact !== null);
    if (!contact) return;
    this.#map("topography", arrays["body heights"], contact, contact.range, contact.up);
    this.#caption("topography", "heights about their mean");
    fillTable("measured-topography", ["heights", ""], contact.rows);
    const select = this.#view.find("[data-shown]");
    select.querySelector('[value="flux"]').hidden = !contact.fields.flux;
    if (!(select.value in contact.fields)) select.value = "area";
    this.drawField(contact, arrays, select.value);
  }

  drawField(contact, arrays, shown) {
    const field = contact.fields[shown];
    if (!field) { this.#caption("contact", "the load was not solved"); return; }
    const [palette, meaning] = FIELDS[shown] ?? [field.palette, field.caption], rings = field.ring ?? contact.spots;
    this.#plots.set("contact spikes", rings);
    this.#plots.colours("contact", palette);
    this.#map("contact", arrays[shown], contact, field.range, field.unit);
    const caption = this.#view.find('[data-caption="contact"]');
    const marks = field.marks ?? (shown === "area" ? ["ink", ...(contact.yields ? ["plastic"] : [])] : []);
    fillCaption(caption, meaning, marks);
    caption.append(`; ${contact.load}${rings === contact.spots && rings.x.length ? "; rings: the few points that touch" : ""}`);
    const rows = Object.entries(contact.fields).filter(([, {unit}]) => unit)
      .map(([name, {unit, range}]) => [`largest ${name}`, `${range[1].toPrecision(4)} ${unit}`]);
    fillTable("measured-contact", ["quantity", "value"], [["contact", contact.load], ...rows]);
  }

  drawCurve(plot, table) {
    for (const id of ["measured-stiffness", "measured-area"]) this.#settle(id, `${plot.force} ${plot.stiffness}`);
    this.#quantity("stiffness", plot, plot.stiffness, plot.stiffness_interval, `stiffness k [${plot.stiffness_unit}]`);
    this.#toggle("measured-area", plot.area !== null);
    if (plot.area) this.#quantity("area", plot, plot.area, plot.area_interval, "real contact area A / A_0");
    this.#plots.set("stiffness unloading", plot.unloading ? {x: plot.force, y: plot.unloading} : {x: [], y: []});
    this.#plots.model("stiffness unloading label").visible = plot.unloading !== null;
    for (const id of ["measured-stiffness", "measured-area"]) fillTable(id, ...table);
  }

  // One answer of each map of a part, their mean, and the interval of the part.
  drawPart({names, load, name, unit, values, low, high, mean, interval}) {
    const maps = names.map((text, i) => `${i + 1} ${text.length > 18 ? `${text.slice(0, 17)}…` : text}`);
    this.#plots.root("measured-part").x_range.factors = maps;
    this.#plots.set("part", {map: maps, y: values, low, high});
    this.#plots.model("part mean").setv({location: mean ?? 0, visible: mean !== null});
    this.#plots.model("part interval").setv({bottom: interval[0] ?? 0, top: interval[1] ?? 0, visible: interval[0] !== null});
    this.#plots.span("measured-part", "y", [...values, ...low, ...high, mean, ...interval]);
    this.#plots.label("measured-part", null, unit ? `${name} [${unit}]` : name);
    this.#caption("part", `at ${load}; marks: each map and its interval; band: that of the mean, for the part`);
    this.#settle("measured-part", `${maps} ${name}`);
    const cell = (value) => (Number.isFinite(value) ? `${value.toPrecision(3)} ${unit}` : "-");
    fillTable("measured-part", ["map", "value", "from", "to"],
      [...names.map((text, i) => [text, cell(values[i]), cell(low[i]), cell(high[i])]), ["mean", cell(mean), ...interval.map(cell)]]);
  }

  #quantity(name, plot, values, interval, label) {
    const where = (wanted) => points(plot.force, values, wanted);
    this.#plots.set(`${name} line`, where(() => true));
    this.#plots.set(`${name} loads`, where((i) => plot.resolved[i]));
    this.#plots.set(`${name} unsure`, where((i) => !plot.resolved[i]));
    this.#plots.set(`${name} asked`, where((i) => plot.asked[i]));
    const [low, high] = (interval ?? [[], []]).map((ends, _, [lows, highs]) => points(plot.force, ends, (i) => lows[i] > 0 && highs[i] !== null));
    this.#plots.set(`${name} interval`, {x: low.x, low: low.y, high: high.y});
    const known = plot.theories.filter((each) => each[name]);
    this.#plots.set(`${name} theories`, {xs: known.map((each) => each.force), ys: known.map((each) => each[name]), name: known.map((each) => each.name)});
    this.#plots.label(`measured-${name}`, `force F${plot.is_of_joint ? " on the joint" : ""} [${plot.force_unit}]`, label);
    this.#caption(name, known.length ? `dashed: ${known.map((each) => each.name).join(", ")}` : "");
  }

  drawModels({force_bar: x, full, reduced, table}) {
    this.#settle("measured-models", `${x} ${full}`);
    this.#plots.set("models full", {x, y: full, low: full, high: full});
    this.#plots.set("models reduced", {x, y: reduced.mean, low: reduced.low, high: reduced.high});
    fillTable("measured-models", ...table);
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
    const isOther = extent !== undefined && this.#extents.get(id) !== extent;
    if (isOther) this.#extents.set(id, extent);
    this.#unsettled.set(id, isOther || (this.#unsettled.get(id) ?? false));
  }

  #map(name, array, {sizes, along, x = 0, y = 0}, [low, high], unit) {
    this.#plots.setMap(name, array, sizes, [low, high > low ? high : low + 1], [x, y]);
    this.#plots.label(`measured-${name}`, `x [${along}]`, `y [${along}]`);
    this.#plots.model(`${name} bar`).title = unit ? `[${unit}]` : "";
    this.#settle(`measured-${name}`, name === "after" ? undefined : `${sizes} ${along}`);
  }

  #box = []; // that is shown

  #showBox(crop, {x, y}, [width, height]) {
    this.#box = [crop, {x, y}, [width, height]];
    this.#plots.model("crop box").setv({visible: crop !== "", left: x, right: x + width, bottom: y, top: y + height});
  }

  #toggle(id, isShown) {
    this.#view.find(`#${id}`).hidden = !isShown;
    if (isShown) this.#settle(id);
  }
  #caption(name, text) { this.#view.find(`[data-caption="${name}"]`).textContent = text; }
}

const POWERS = {a: -18, f: -15, p: -12, n: -9, "µ": -6, u: -6, m: -3, k: 3, M: 6, G: 9};

// Where a cropped piece begins, in the unit of the map.
function corners(crop, {metres}) {
  if (!crop) return {x: 0, y: 0};
  const ends = crop.split(",").map((text) => {
    const [, number, unit] = /^\s*([-+.\deE]*\d)\s*(\S*)\s*$/.exec(text) ?? [];
    return (Number(number) * metresIn(unit ?? "m")) / metres || 0;
  });
  return {x: ends[0] ?? 0, y: ends[2] ?? 0};
}

function scaled(array, factor) {
  return factor === 1 ? array : {...array, values: array.values.map((value) => value * factor)};
}

function metresIn(unit) { return unit.length > 1 ? 10 ** (POWERS[unit[0]] ?? 0) : 1; }
function heightFactor(from, to) { return metresIn(from) / metresIn(to); }

