// Pictures of My surface: maps beside each other, and panels of curves.
import {add} from "./figures.js";
import {onDraw} from "./hands.js";
import {Maps, NOTHING, layersOf, mapFigure, profileFigure, sharedRanges} from "./maps.js";
import {panelsOf} from "./panels.js";
import {fillCaption, fillTable} from "./tables.js";

const BESIDE = {file: ["file"], preparation: ["before", "after"], answers: ["topography", "contact"]}; // maps, by their steps
const RINGS = {file: "here", contact: "theory"};

// Embed all pictures of the view.
export async function picturesOf(view, root) {
  const maps = () => Object.fromEntries(Object.values(BESIDE).flatMap(mapsOf));
  return new Pictures(view, await panelsOf(root, () => ({...maps(), "measured-profile": profileFigure()})));
}

function mapsOf(names) {
  const ranges = sharedRanges();
  return names.map((name) => {
    const made = mapFigure(name, {rings: RINGS[name], ranges});
    if (name === "before") takeBoxes(made);
    return [`measured-${name}`, made];
  });
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

class Pictures {
  #view; #plots; #panels; #maps;
  #before = null; // the map on which a piece is drawn, and the box about what is kept
  #kept = {visible: false};

  constructor(view, panels) {
    this.#view = view;
    this.#panels = panels;
    this.#plots = panels.plots;
    this.#maps = Object.fromEntries(Object.entries(BESIDE).map(([step, names]) => [
      step, new Maps(panels.plots, "measured", names, step === "answers" ? {profile: "profile"} : {})]));
    for (const {classList} of view.findAll(".panel:not(.wide)")) classList.add("empty");
  }

  // Call with the crop, as text, when a box was drawn on the map.
  onBox(drawn) {
    const map = this.#plots.root("measured-before"), box = this.#plots.model("crop box");
    const keep = (...corners) => {
      if (!this.#before) return;
      const {sizes, along} = this.#before;
      const ends = corners.map((value, i) => Math.min(Math.max(value, 0), sizes[i < 2 ? 0 : 1]));
      if (!(ends[0] < ends[1] && ends[2] < ends[3])) { box.setv(this.#kept); return; }
      drawn(ends.map((value) => `${Number(value.toPrecision(4))} ${along}`).join(", "));
    };
    map.on_event("selectiongeometry", ({geometry: {type, x0, x1, y0, y1}}) => { if (type === "rect") keep(...rising(x0, x1), ...rising(y0, y1)); });
    onDraw(map, this.#view.find("[data-draw]"), (from, to, isLast) => {
      const [left, right] = rising(from.x, to.x), [top, bottom] = rising(from.y, to.y);
      if (isLast) keep(left, right, top, bottom);
      else box.setv({visible: true, left, right, top, bottom});
    });
  }

  // Show what the answer of a step, or of the comparison, has for maps and panels.
  show(step, {panels, maps, choices = {}, arrays, crop}) {
    this.#panels.show(step, panels);
    if (choices.part) this.#offer("part", choices.part, (part) => this.#panels.show("part", {part}));
    if (!(step in BESIDE)) return;
    const {height, after, ...others} = maps, [first] = BESIDE[step];
    for (const name of BESIDE[step]) this.#view.find(`#measured-${name}`).classList.toggle("empty", !height);
    if (!height) return;
    this.#maps[step].frame(height.sizes, height.along);
    this.#maps[step].tell(layersOf({height, ...others}, arrays));
    this.#draw(step, first, height, arrays.height);
    if (after) this.#draw(step, "after", after, arrays.after);
    if (after) this.#keep(height, after, crop !== null);
    if (step !== "answers") return;
    this.#offer("contact", others, (look, chosen) => this.#draw(step, "contact", look, arrays[chosen]));
  }

  #keep(before, {corner: [left, top], sizes: [width, height]}, visible) {
    this.#before = before;
    this.#kept = {visible, left, right: left + width, top, bottom: top + height};
    this.#plots.model("crop box").setv(this.#kept);
  }

  // Let one of several pictures be chosen; what is chosen stays chosen where there is one of that name again.
  #offer(name, options, show) {
    const select = this.#view.find(`[data-choice="measured-${name}"]`), names = Object.keys(options), chosen = select.value;
    select.replaceChildren(...names.map((each) => new Option(each)));
    if (names.includes(chosen)) select.value = chosen;
    select.onchange = () => show(options[select.value], select.value);
    select.onchange();
  }

  #draw(step, name, look, array) {
    const told = this.#view.find(`[data-caption="measured-${name}"]`);
    if (!look) {
      this.#plots.set(name, NOTHING);
      fillCaption(told, {caption: "the load was not solved", meanings: {}});
      return;
    }
    const {rings, sizes, corner, table} = look;
    this.#maps[step].show(name, array, look, sizes, corner);
    const [x, y] = [0, 1].map((axis) => rings.map((ring) => corner[axis] + ring[axis] * sizes[axis]));
    if (name in RINGS) this.#plots.set(`${name} rings`, {x, y});
    fillCaption(told, look);
    fillTable(`measured-${name}`, ...table);
  }
}

function rising(...ends) { return ends.sort((one, other) => one - other); }
