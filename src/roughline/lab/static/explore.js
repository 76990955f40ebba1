// Explore: a random surface under both models, as sliders move. What can be added to the contact, and which curves
// there are, the server declares.
import {bindCode} from "./code.js";
import {Controls} from "./controls.js";
import {element} from "./elements.js";
import {onDraw} from "./hands.js";
import {settle} from "./link.js";
import {Maps, layersOf, mapFigure, onRelief, profileFigure, sharedRanges, sketchOf} from "./maps.js";
import {panelsOf} from "./panels.js";
import {pictureOf, save} from "./saving.js";
import {fillCaption, fillFigures, fillList, fillTable} from "./tables.js";
import {bindTabs} from "./tabs.js";
import {Waiting} from "./waiting.js";

const REST = 250; // without a move, until the full grid is computed [ms]
const MAP = "explore-contact", NOT_ASKED = ["white"]; // how the area is drawn, which is always there
const SKETCHED = 500; // until plots are made, if no answer has come to be sketched before [ms]
const SURFACES = 4; // whose heights are held
const LEFT = {full: "the coarse answer is shown", download: "nothing was saved"}; // what a cancel of these leaves
const LEFT_BY_OTHERS = "curves belong to the contact before";

export default class Explore {
  #link; #address; #root = document.querySelector("#explore");
  #controls; #plots; #maps; #waiting; #rest = null; #last = null; #fromCursor = false; #numbers = {F: 0.1};
  #physics; #declared; #cursors; #figures; // as the server declares them: panels, and of figures the keys, in their order
  #panels = null;

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    const {physics, panels, strip} = JSON.parse(this.#root.dataset.declared);
    this.#physics = physics;
    this.#declared = panels;
    this.#cursors = panels.filter(({cursor}) => cursor);
    this.#controls = new Controls(this.#root, (key, isFinal) => this.#changed(key, isFinal));
    this.#waiting = new Waiting(this.#find(".status"), link, (works) => this.#cancelled(works));
    bindCode(this.#root, link, () => this.#seen, (...said) => this.#refuse(...said));
    this.#find("#save").addEventListener("click", () => this.#save(this.#find("#saved").value));
    this.#figures = strip;
    this.#find("#another").addEventListener("click", () => {
      this.#controls.put("seed", String(Math.floor(Math.random() * 1e6)));
    });
    for (const key of Object.keys(physics)) {
      this.#find(`[data-tick="${key}"]`).addEventListener("change", () => this.#ticked(key));
    }
    for (const panel of this.#root.querySelectorAll(".panel:not(.wide)")) panel.classList.add("empty");
    for (const {key, task} of panels) this.#panelOf(key).dataset.task = task;
    this.#find(`#${MAP}`).dataset.task = "contact";
    bindTabs(this.#root, () => this.#placeCursors());
  }

  async open(said) {
    this.#take(said);
    this.#stale = new Set(this.#finer);
    this.#dim(["contact", ...this.#stale]);
    this.#askNow();
    await Promise.race([this.#sketched, new Promise((resolve) => { setTimeout(resolve, SKETCHED); })]);
    this.#panels = await panelsOf(this.#root, maps);
    this.#plots = this.#panels.plots;
    for (const {key, cursor, drags} of this.#cursors) {
      this.#plots.onMove(`${key} cursor`, (value) => this.#cursorMoved(drags, value));
      onDraw(this.#plots.root(`explore-${key}`), this.#find(`[data-draw="${key}"]`),
        (from, {x, y}) => { this.#plots.model(`${key} cursor`).location = cursor === "width" ? y : x; });
    }
    this.#maps = new Maps(this.#plots, "explore", ["contact"], {profile: "profile", hasCross: true});
    this.#maps.frame([1, 1], "/ L");
    for (const draw of this.#missed.splice(0)) draw();
    this.#sharpen();
  }

  shown() { if (this.#last) this.#writeAddress(this.#last.state); }

  // What is seen: the texts of the last answer, as they were typed where they counted, and the map that is chosen.
  get #seen() {
    const {state, texts, points} = this.#last ?? {state: {}, texts: this.#controls.used};
    return {state: {...state, ...texts, shown: this.#controls.said.shown ?? "area"}, points};
  }

  async #save(name) {
    if (name.endsWith(".png")) {
      const isMap = ({id}) => [MAP, "explore-profile"].includes(id);
      const panels = [...this.#root.querySelectorAll(".panel:not(.empty)")]
        .filter((each) => each.offsetParent && isMap(each) === (name === "contact.png"));
      save(name, await pictureOf(this.#plots, panels, ({dataset}) => this.#remarkOn(dataset.task)));
      return;
    }
    if (name.endsWith(".csv")) {
      const remarks = [`roughline ${document.body.dataset.version}`, `lab_link = ${location.search}`];
      for (const {key, task} of this.#declared) if (this.#remarkOn(task)) remarks.push(`panel ${key}: ${this.#remarkOn(task)}`);
      save(name, new Blob([this.#panels.table(remarks)], {type: "text/csv"}));
      return;
    }
    this.#waiting.ask("explore.download", `download ${name}`, {...this.#seen, name}, {
      answer: ({file}) => element("a", {href: `results/${this.#link.session}/${file}?save=1`, download: name}).click(),
      error: (...said) => this.#refuse(...said),
    });
  }

  #find(selector) { return this.#root.querySelector(selector); }
  #isAdded(key) { return Boolean(this.#controls.said[key]); }

  // Take the texts of an address, or none.
  #take({view, theme, H, ...texts}) {
    this.#controls.take(H === undefined ? texts : {...texts, D_f: `H = ${H}`});
    this.#showHeightOrSlope();
    for (const key of Object.keys(this.#physics)) this.#showPhysics(key);
  }

  #ticked(key) {
    const text = this.#find(`[data-text="${key}"]`)?.value || this.#find(`#explore-${key}`)?.dataset.default;
    this.#controls.set(key, this.#find(`[data-tick="${key}"]`).checked ? this.#physics[key].word || text : "");
  }

  // Show what there is with a physics alone; its first curve is opened with it, and its maps are left without it.
  #showPhysics(key) {
    const isAdded = this.#isAdded(key), {panels} = this.#physics[key];
    this.#find(`[data-tick="${key}"]`).checked = isAdded;
    for (const each of this.#root.querySelectorAll(`[data-of="${key}"]`)) each.hidden = !isAdded;
    const chosen = this.#root.querySelectorAll(`select:has([data-of="${key}"]:checked)`);
    for (const select of chosen) if (!isAdded) select.selectedIndex = 0;
    const tabs = panels.map((panel) => this.#find(`#tab-${panel}`));
    if (isAdded) tabs[0]?.click();
    else if (tabs.some((tab) => tab.ariaSelected === "true")) this.#find("[role=tab]").click();
    if (isAdded) return;
    this.#show(key, {});
    for (const panel of panels) this.#panelOf(panel).classList.remove("dimmed");
  }

  // What is to be known of curves that are saved.
  #remarkOn(task) { return this.#isOfContact(task) ? "" : LEFT_BY_OTHERS; }

  #missed = []; // answers that came before the plots were there
  #draw(action) { if (this.#plots) action(); else this.#missed.push(action); }

  #changed(key, isFinal) {
    if (key === "shown") {
      if (!this.#last) { this.#sharpen(); return; }
      this.#drawField();
      this.#writeAddress(this.#last.state);
      const {shown} = this.#controls.said;
      if (![...NOT_ASKED, ...Object.keys(this.#fields.maps)].includes(shown)) this.#sharpen(); // it was not sent
      return;
    }
    if (key === "rms") this.#showHeightOrSlope();
    if (key in this.#physics && this.#isAdded(key) === this.#find(`[data-adds="${key}"]`).hidden) { // on or off
      const {opens, maps} = this.#physics[key], {shown} = this.#controls.said;
      if (opens && this.#isAdded(key)) this.#controls.put("shown", opens);
      if (maps.includes(shown) && !this.#isAdded(key)) this.#controls.put("shown", "area");
      this.#showPhysics(key);
    }
    this.#stale = new Set([...this.#stale].filter((each) => this.#finer.includes(each)));
    for (const each of this.#finer) if (key !== "F" || this.#physics[each]?.follows === "load") this.#stale.add(each);
    for (const each of this.#stale) this.#leave(each);
    this.#dim(["contact", ...this.#stale]);
    this.#askNow();
    clearTimeout(this.#rest);
    this.#waiting.stop(["full", "curve", ...Object.keys(this.#physics)]); // also of what is added no more
    this.#rest = setTimeout(() => this.#sharpen(), isFinal ? 0 : REST);
  }

  // What is asked once the contact is known, by the panels' tasks.
  get #finer() {
    return ["curve", ...Object.keys(this.#physics).filter((key) => this.#physics[key].follows && this.#isAdded(key))];
  }
  #stale = new Set(); // of these, what belongs to another contact

  #cancelled(works) {
    this.#stopped = this.#turn;
    this.#say(`stopped: ${[...new Set(works.map((work) => LEFT[work.split(" ")[0]] ?? LEFT_BY_OTHERS))].join(", and ")}`, true);
  }

  #askNow() {
    const turn = ++this.#turn, args = this.#controls.asked;
    const held = new Map(this.#heights);
    this.#link.ask("explore.coarse", "coarse", {...args, heights: [...held.keys()]}, {
      answer: (header) => {
        this.#hold(header, held);
        if (!this.#plots) this.#sketch(header);
        this.#draw(() => this.#drawContact(header, args, turn));
      },
      error: (sentence, at) => {
        this.#tellSketched();
        if (turn === this.#turn) clearTimeout(this.#rest);
        this.#refuse(sentence, at, turn);
      },
    });
  }

  #tellSketched;
  #sketched = new Promise((resolve) => { this.#tellSketched = resolve; }); // the browser then has time to load what makes plots

  // Show an answer before there are plots, whose picture takes the place of the sketch.
  #sketch(header) {
    const {arrays: {height, area}, maps, points, numbers} = header;
    this.#show("contact", header);
    const place = this.#find(`#plot-${MAP}`);
    if (area) {
      place.querySelector(".sketch")?.remove();
      place.append(sketchOf(height, area, maps.area.palette));
      this.#find(`#${MAP}`).classList.remove("empty");
    }
    requestAnimationFrame(() => setTimeout(() => { // after this frame
      if (area) place.dispatchEvent(new CustomEvent("drawn", {detail: {what: "contact", points, numbers}, bubbles: true}));
      place.addEventListener("drawn", () => place.querySelector(".sketch")?.remove(), {once: true});
      this.#tellSketched();
    }));
  }

  #heights = new Map(); // those that came last, of a coarse and of a fine grid, by the keys of their surfaces

  // Keep the heights of an answer, or take those that were held when it was asked for, and are not sent again.
  #hold({heights, arrays}, held) {
    if (!arrays.gap) return; // the load was not solved
    arrays.height ??= held.get(heights);
    this.#heights.delete(heights);
    this.#heights.set(heights, arrays.height);
    if (this.#heights.size > SURFACES) this.#heights.delete(this.#heights.keys().next().value);
    settle(arrays);
  }

  #sharpen() {
    if (!this.#plots) return;
    const turn = this.#turn, args = this.#controls.asked, held = new Map(this.#heights);
    const error = (sentence, at) => {
      if (turn === this.#turn) this.#waiting.stop(["full", ...this.#finer]);
      this.#refuse(sentence, at, turn);
    };
    const ask = (task, slot, asked, answer, progress) => this.#waiting.ask(`explore.${task}`, slot, asked, {
      answer: (header) => {
        answer(header);
        if (header.is_coarse && !asked.refines) ask(task, slot, {...asked, refines: true}, answer, progress);
      },
      error,
      progress,
    });
    ask("full", "full", {...args, heights: [...held.keys()]}, (header) => {
      this.#hold(header, held);
      this.#drawContact(header, args, turn);
      for (const each of this.#stale) {
        if (each !== "curve" && !header.state[each]) { this.#dim([each], false); continue; } // it is refused
        const task = each === "curve" ? "curve" : "further";
        const tell = (message) => this.#tellProgress(each, message);
        ask(task, each, {...args, of: each}, (found) => this.#drawCurves(each, found), tell);
      }
    });
  }

  #drawContact(header, asked, turn) {
    const {line, state, numbers: own} = header;
    if (line) this.#show("line", {...line, state, numbers: own});
    this.#settled(header, asked, turn);
    if (header.is_coarse && this.#last && !this.#last.is_coarse && (turn <= this.#last.turn || sameState(this.#last.state, state))) {
      this.#compare(); // with the lines, which it has brought
      return;
    }
    const counted = Object.entries(asked.state).filter(([key]) => !(key in header.refused));
    this.#last = {...header, turn, texts: Object.fromEntries(counted)};
    const {strip, points: n, numbers} = header;
    this.#plots.shows(MAP, {what: "contact", points: n, numbers});
    this.#show("contact", header);
    this.#drawField();
    this.#tell(header.facts);
    this.#compare();
    this.#fillTables(strip);
    const wasStopped = header.is_coarse && turn === this.#stopped; // and says so already
    if (!wasStopped) this.#say(header.status, !header.is_coarse);
    const {classList} = this.#find(`#${MAP}`);
    classList.remove("dimmed");
    classList.toggle("empty", !header.maps.area);
    this.#find("#save").disabled = false;
  }

  #drawCurves(what, header) {
    if (!header.is_coarse) this.#stale.delete(what);
    this.#show(what, header);
    if (this.#last && Object.keys(header.maps).length) this.#drawField();
  }

  // Say above the numbers what is known against them.
  #tell(facts) {
    const list = this.#find("[data-facts]"), said = facts.join("; ");
    if ((list.dataset.said ?? "") === said) return; // else a screen reader would say it again
    list.dataset.said = said;
    fillList(list, facts);
  }

  // Say in words how the surface stands beside lines, once both are of the same state.
  #compare() {
    const line = this.#answers.get("line"), place = this.#find("[data-compared]");
    if (!line || !this.#last || !sameState(line.state, this.#last.state)) return;
    if (!(this.#last.stiffness_bar_3d > 0)) { place.textContent = place.dataset.said = ""; return; } // the load was not solved
    const {numbers: {D_f, F}, stiffness_bar_3d: stiffness, scatter} = this.#last, ratio = stiffness / line.stiffness_bar_1d - 1;
    const size = `${Math.round(100 * Math.abs(ratio))} % ${ratio < 0 ? "softer" : "stiffer"} than`;
    const words = `This surface is ${Math.round(100 * ratio) ? size : "as stiff as"} lines with its waves${line.strip[0].below && `, ${line.strip[0].below}`}`;
    const trust = `?${new URLSearchParams({view: "published", v: "1", map_D_f: D_f, map_F: F})}#trust-title`;
    if (place.dataset.said === `${words} ${scatter} ${trust}`) return;
    place.dataset.said = `${words} ${scatter} ${trust}`;
    place.replaceChildren(words, ...(scatter === null ? ["."] : [`; single surfaces scatter by ${Math.round(100 * scatter)} % `,
      element("a", {href: trust, textContent: "(trust map)"}), "."]));
  }

  #fillTables(strip) {
    fillTable(MAP, ["quantity", "value", "with unit, interval", "meaning"],
      strip.map(({symbol, value, below, meaning}) => [symbol, value, below, meaning]));
  }

  #answers = new Map(); // the last of each kind: of the line, the contact, the curves, and of what is added

  // Show what an answer has for the panels and the strip, in the place of the last of its kind.
  #show(what, header) {
    this.#answers.delete(what);
    this.#answers.set(what, header); // those that came last are at the end
    fillFigures(this.#find(".strip"), this.#shownFigures);
    this.#panels?.show(what, header.panels ?? {}, header.numbers);
  }

  get #shownFigures() {
    const known = Object.fromEntries([...this.#answers].flatMap(([what, {strip = []}]) =>
      strip.map((each) => [each.key, {...each, isBefore: !this.#isOfContact(what)}])));
    return this.#figures.flatMap((key) => known[key] ?? []);
  }

  // Take away what belongs to another load from the panels that others fill.
  #leave(what) {
    const header = this.#answers.get(what), {panels = [], follows} = this.#physics[what] ?? {};
    if (!header?.panels || follows !== "load") return;
    const own = Object.entries(header.panels).filter(([key]) => panels.includes(key));
    this.#show(what, {...header, panels: Object.fromEntries(own)});
  }

  #drawField() {
    const {shown: wanted} = this.#controls.said, {maps, arrays} = this.#fields, shown = wanted in maps ? wanted : "area";
    if (!(shown in maps)) { // and the map before is not seen
      fillCaption(this.#find('[data-caption="shown"]'), {caption: "the load was not solved", meanings: {}});
      return;
    }
    const {rings} = maps[shown];
    const isLit = wanted !== "white", {caption, meanings} = maps[shown];
    fillCaption(this.#find('[data-caption="shown"]'), {caption, meanings: isLit ? onRelief(meanings) : meanings});
    this.#maps.lay("contact", isLit ? arrays.height : null);
    this.#maps.show("contact", arrays[shown], maps[shown]);
    this.#plots.set("contact rings", {x: rings.map(([x]) => x), y: rings.map(([, y]) => y)});
    this.#maps.tell(layersOf(maps, arrays));
  }

  // Maps of the contact, and of what is added and known of it.
  get #fields() {
    const all = [...this.#answers].filter(([what, {maps}]) => maps && this.#isOfContact(what)).map(([, header]) => header);
    const together = (name) => Object.assign({}, ...all.map((each) => each[name]));
    return {maps: together("maps"), arrays: together("arrays")};
  }

  // Whether the last answer of a kind is about the contact that is shown.
  #isOfContact(what) {
    const {state} = this.#answers.get(what) ?? {}, isOfSurface = what === "curve" || this.#physics[what]?.follows === "surface";
    return !state || !this.#last || sameState(state, this.#last.state, isOfSurface ? ["F"] : []);
  }

  // Dim panels whose tasks have no answer to what is asked now.
  #dim(tasks, isDimmed = true) {
    const panels = tasks.flatMap((task) => [...this.#root.querySelectorAll(`[data-task="${task}"]`)]);
    for (const {classList} of panels) classList.toggle("dimmed", isDimmed);
  }

  #tellProgress(task, {done, total}) {
    const places = this.#root.querySelectorAll(`[data-task="${task}"] [data-progress]`);
    for (const place of places) place.textContent = `, ${done} of ${total}`;
  }

  #stopped = null; // turn whose finer answer was cancelled
  #turn = 0; // of the questions: controls and cursor follow the answer to the newest alone

  #settled(header, asked, turn) {
    if (turn !== this.#turn) return;
    this.#controls.answered(asked, header);
    this.#numbers = header.numbers;
    this.#placeCursors();
    this.#writeAddress(header.state);
  }

  #writeAddress(state) {
    this.#address.write("explore", {...state, ...(this.#controls.said.shown ? {shown: this.#controls.said.shown} : {})});
  }

  // Place the cursors of loads; those of hidden panels, which Bokeh would lay out each time, when they are shown.
  #placeCursors() {
    if (!this.#plots) return;
    this.#fromCursor = true;
    for (const {key, drags} of this.#cursors) if (!this.#panelOf(key).hidden) this.#plots.model(`${key} cursor`).location = this.#numbers[drags] ?? 0;
    this.#fromCursor = false;
  }

  #cursorMoved(key, value) {
    if (this.#fromCursor) return;
    this.#controls.put(key, this.#controls.within(key, value), false);
  }

  #refuse(sentence, at, turn = this.#turn) {
    if (turn !== this.#turn) return;
    this.#controls.deny(sentence, at, () => {
      this.#take({});
      this.#askNow();
      this.#sharpen();
    });
  }

  // Write the status; at rest it is spoken too, with the numbers.
  #say(text, atRest) {
    this.#find("[data-status]").textContent = text;
    if (atRest) this.#find("[data-spoken]").textContent = `${text}; ${this.#shownFigures.filter(({isBefore}) => !isBefore).map(({symbol, value}) => `${symbol} ${value}`).join(", ")}`;
  }

  #panelOf(key) { return this.#find(`#explore-${key}`); }

  #showHeightOrSlope() {
    const bySlope = this.#controls.said.rms === "slope";
    this.#find('[data-control="h"]').hidden = bySlope;
    this.#find('[data-control="slope"]').hidden = !bySlope;
  }
}

// The picture with its profile.
function maps() {
  return {[MAP]: mapFigure("contact", {hasRelief: true, rings: "mark", ranges: sharedRanges()}), "explore-profile": profileFigure()};
}

// Whether two are states of one contact, whichever map is shown of it.
function sameState(first, second, others = []) {
  const texts = (state) => JSON.stringify(Object.entries(state).filter(([key]) => !["shown", ...others].includes(key)));
  return texts(first) === texts(second);
}
