// My surface: a file of an instrument, prepared, pressed, and answered for.
import {Controls} from "./controls.js";
import {element, typeset} from "./elements.js";
import {Answers, TASKS} from "./measured-answers.js";
import {Source} from "./measured-file.js";
import {Part} from "./measured-part.js";
import {picturesOf} from "./measured-pictures.js";
import {recall, remember} from "./remember.js";
import {fillBars, fillFigures, fillGroups, fillList, fillTable} from "./tables.js";
import {Waiting} from "./waiting.js";

const VERSION = "1";
const keysOf = (what) => [...document.querySelectorAll(`#measured ${what} [data-error]`)].map(({dataset}) => dataset.error);
const OF_FILE = keysOf("[data-of-file]"); // asked anew with each file
const OF_READING = keysOf('[data-of="Reading"]');
const OF_PREPARATION = keysOf('[data-of="Preparation"]');
const OF_BODIES = keysOf('[data-of="bodies"]');
const TEXTS = [...document.querySelectorAll("#measured input[data-text]")];
const BEGINS = Object.fromEntries(TEXTS.filter((each) => each.defaultValue).map((each) => [each.dataset.text, each.defaultValue]));

export default class Measured {
  #link; #address; root = document.querySelector("#measured");
  #controls; #source; #part; #answers;
  #read = null; // what the file holds, as last read
  #body = null; // the same, prepared, as far as it can be pressed
  #refusals = {bodies: {}, file: {}, preparation: {}}; // sentences by controls, of each question that tells them
  #brought = new Map(); // digests and names of the files that are on the server, by their keys
  #wanted = []; // digests and names of files that have to be chosen, by a link or once more

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    this.#controls = new Controls(this.root, (key) => this.#changed(key));
    this.waiting = new Waiting(this.find("[data-waiting]"), link, (works) => {
      this.#undim();
      if (works.includes("measured file")) this.#source.stop();
      this.#answers.stopped(works);
    });
    this.pictures = picturesOf(this, this.root);
    this.#source = new Source(link, this);
    this.#part = new Part(this);
    this.#answers = new Answers(link, this, this.#part);
    this.find('[data-crop="all"]').addEventListener("click", () => this.set("crop", ""));
    for (const name of recall("steps") ?? []) this.step(name).open = true;
    for (const step of this.findAll(".step")) {
      step.addEventListener("toggle", () => {
        remember("steps", this.findAll(".step[open]").map(({id}) => id.replace("measured-step-", "")));
        if (step.open && step === this.step("preparation")) this.#prepare();
      });
    }
  }

  find(selector) { return this.root.querySelector(selector); }
  findAll(selector) { return [...this.root.querySelectorAll(selector)]; }
  step(name) { return this.find(`#measured-step-${name}`); }

  async open(given) {
    const {file, of, ...said} = await this.#begun(given);
    this.#wanted = filesIn(of ?? "");
    this.#take({...BEGINS, ...said});
    this.#askBodies();
    if (said.example) this.look();
    this.#link.ready.then((opened) => {
      this.#find(opened);
      if (opened.resumed && this.hasSource) this.#answers.restore();
    });
    (await this.pictures).onBox((crop) => this.set("crop", crop));
  }

  // What the address sets; if nothing, what was set before the page was loaded again in another view.
  async #begun({view, theme, ...said}) {
    const before = recall("set");
    if (Object.keys(said).length || !before) return said;
    return (await this.#link.ready).resumed ? before : said;
  }

  shown() { this.#write(); }

  // Show what an answer of the server tells: words, tables, lists, figures and remarks by their places, and pictures.
  show(answer, step = "") {
    const {words = {}, tables = {}, lists = {}, figures = {}, bars = {}, remarks} = answer;
    for (const [name, text] of Object.entries(words)) this.say(name, text);
    for (const [id, [header, rows, groups, quiet]] of Object.entries(tables)) fillTable(id, header, rows, groups, quiet);
    for (const [name, sentences] of Object.entries(lists)) fillList(this.find(`[data-list="${name}"]`), sentences);
    for (const [name, each] of Object.entries(figures)) {
      fillFigures(this.find(`[data-figures="${name}"] dl`), each.map((figure) => ({symbol: figure.name, value: figure.value, below: figure.interval})));
    }
    for (const [name, each] of Object.entries(bars)) fillBars(this.find(`[data-bars="${name}"]`), each);
    if (remarks) fillGroups(this.find("[data-remarks]"), remarks);
    if (step) this.pictures.then((pictures) => pictures.show(step, answer));
  }

  say(name, text) {
    for (const place of this.findAll(`[data-words="${name}"]`)) {
      place.hidden = text === "";
      place.replaceChildren(...typeset(text));
    }
  }

  // Say what is to be known about the file.
  note(sentence) { this.find('[data-note="file"]').textContent = sentence; }

  showResult(name, isShown) {
    for (const place of this.findAll(`[data-result="${name}"]`)) place.hidden = !isShown;
  }

  // The connection is back. What is drawn stays, also where another session has begun without the files.
  reconnected(resumed, isElsewhere) {
    if (resumed) return;
    if (!this.files.length) { this.#answers.loseReport(); return; }
    this.#wanted = this.#of;
    const {file, ...kept} = this.#controls.said;
    this.#take(kept);
    this.#stop();
    this.#answers.lose();
    this.note(isElsewhere
      ? `${named(this.#wanted)}: now with the other tab of this page. Go on there, or choose ${them(this.#wanted)} here again.`
      : `${named(this.#wanted)} went with the old session: choose ${them(this.#wanted)} again. All that is set is kept.`);
  }

  // Find the files that the address names among those that are still on the server, or ask for them.
  #find({files}) {
    if (!this.#wanted.length || this.files.length) return;
    const left = Object.entries(files);
    const keys = this.#wanted.map(({digest}) => {
      const i = left.findIndex(([, each]) => each.digest === digest);
      return i < 0 ? null : left.splice(i, 1)[0][0];
    });
    if (keys.includes(null)) {
      this.note(`This link is of ${named(this.#wanted)}: choose ${them(this.#wanted)}. All else is set as the link says.`);
      return;
    }
    for (const [i, key] of keys.entries()) this.#brought.set(key, this.#wanted[i]);
    this.#wanted = [];
    this.#take({...this.#controls.said, file: keys.join(",")});
    this.#part.check();
  }

  // All that is set, as the server reads it.
  get state() { return {v: VERSION, ...this.#controls.said}; }
  // The same of the one map that is shown.
  get stateOfMap() { return this.#part.shown ? {...this.state, file: this.#part.shown} : this.state; }
  // What is asked, with what counts where a text cannot be used.
  get asked() { return {...this.#controls.asked, state: this.state}; }
  get files() { return (this.#controls.said.file ?? "").split(",").filter(Boolean); }
  get hasSource() { return this.files.length > 0 || Boolean(this.#controls.said.example); }
  get body() { return this.hasSource ? this.#body : null; }

  // Digests and names of the files that all is set for, whether they are here or have to be chosen.
  get #of() { return this.files.length ? this.files.map((key) => this.#brought.get(key)) : this.#wanted; }

  // All that is set, as the address says it: without what is not asked.
  get #set() {
    const {file, ...said} = this.#controls.said;
    const of = textOf(this.#of);
    const isAsked = (key) => !this.find(`[data-bodies][hidden] [data-text="${CSS.escape(key)}"]`);
    const set = Object.entries(said).filter(([key, text]) => (text !== "" || key in BEGINS) && isAsked(key));
    if (!of && set.every(([key, text]) => text === BEGINS[key])) return {};
    return {v: VERSION, ...Object.fromEntries(set.sort()), ...(of ? {of} : {})};
  }
  get settings() { return JSON.stringify(this.#set); }

  // Take files that have come, of which some may have been here before, or an example, or nothing.
  takeSource(source, came = []) {
    for (const {key, ...each} of came) this.#brought.set(key, each);
    const {file, example, ...kept} = this.#controls.said;
    const before = this.#of, wanted = this.#wanted;
    const now = (source.file ?? "").split(",").filter(Boolean).map((key) => this.#brought.get(key));
    const isOther = !now.some(({digest}) => before.some((each) => each.digest === digest));
    if (isOther) for (const key of OF_FILE) delete kept[key];
    this.#wanted = [];
    this.#take({...kept, ...source});
    this.note(isOther && now.length && wanted.length
      ? `This is not ${named(wanted)}: unit, channel, size and crop are asked anew; all else stays as it was set.` : "");
    if (!now.length || digests(now) !== digests(wanted)) this.#forgetFile(); // else what is drawn is of the same
    this.#part.check();
    this.#write();
  }

  // Delete the files, and what was made of them.
  deleteFiles() {
    this.#brought.clear();
    this.takeSource({});
    this.note(this.#link.forgetFiles() ? "The file and all that was made of it are deleted."
      : "The file and all that was made of it are deleted as soon as the lab answers again.");
  }

  set(key, text) { this.#controls.put(key, text); }

  // Write a sentence where it belongs, and unfold it; begin anew in the place of a link that cannot be read.
  refuse(sentence, at = "") {
    if (sentence && at) this.#unfold(at);
    this.#controls.deny(sentence, at, () => {
      this.#wanted = [];
      this.note("");
      this.#stop();
      this.#take({...BEGINS});
      this.#askBodies();
    });
  }

  // Say why something was not done: at its button, and at the control that it is about, which may say so already.
  refuseTask(sentence, at, task) {
    this.refuse(sentence, task);
    if (at && at !== task && !this.#controls.isRefused(at)) this.refuse(sentence, at);
  }

  // Take from an answer which texts are not used and why; it knows whether `keys` are.
  #settle(question, asked, refused, keys) {
    const known = Object.entries(refused).filter(([key]) => asked.state[key] === this.#controls.said[key]);
    this.#refusals[question] = Object.fromEntries(known);
    const all = Object.assign({}, ...Object.values(this.#refusals));
    for (const key of Object.keys(all)) if (!this.#controls.isRefused(key)) this.#unfold(key);
    this.#controls.answered(asked, {refused: all}, keys);
  }

  #unfold(key) {
    let folded = this.find(`[data-error="${CSS.escape(key)}"]`);
    while ((folded = folded?.parentElement.closest("details"))) folded.open = true;
  }

  #take(said) {
    this.#controls.take(said);
    for (const place of this.findAll("[data-bodies]")) place.hidden = place.dataset.bodies !== (said.bodies ?? "materials");
    this.root.classList.toggle("has-file", this.hasSource);
    this.#answers?.ready();
  }

  #changed(key) {
    for (const refused of Object.values(this.#refusals)) delete refused[key];
    for (const at of ["", key, ...TASKS]) this.refuse("", at);
    if (key === "bodies") this.#take(this.#controls.said);
    this.#write();
    const isPrepared = OF_PREPARATION.includes(key);
    if (!this.hasSource) { /* what is drawn stays */ }
    else if (OF_READING.includes(key) || (isPrepared && this.#part.shown)) this.#part.check();
    else if (isPrepared) this.#prepare();
    this.#askBodies(); // which reads all that is set
    this.#answers.changed();
  }

  #write() {
    remember("set", this.#set);
    this.#address.write("measured", this.#set);
  }

  #forgetFile() {
    this.#stop();
    this.#read = this.#body = null;
    for (const name of ["file", "preparation", "answers", "compare"]) this.showResult(name, false);
    for (const place of this.findAll("[data-asked], [data-asks]")) place.hidden = true;
    const idle = this.hasSource ? ["answers"] : ["preparation", "bodies", "answers"]; // what was opened for a file on its way stays
    for (const name of idle) this.step(name).open = false;
    this.say("line-file", "");
    this.#answers.forget();
    this.#askBodies();
  }

  // Read the file, or the map of a part that is shown.
  look() {
    if (!this.hasSource) return;
    const asked = {...this.asked, state: this.stateOfMap};
    this.step("file").classList.add("dimmed");
    this.waiting.ask("measured.look", "measured file", asked, {
      answer: (read) => {
        this.#undim();
        if (!this.#read) this.step("bodies").open = true;
        this.#read = read;
        this.#write();
        this.refuse("", "file");
        this.#showAsked(read);
        Object.assign(this.find("[data-example-file]"), {
          hidden: !this.#controls.said.example, href: `results/${this.#link.session}/${read.name}?save=1`, download: read.name,
        });
        this.#settle("file", asked, read.refused, OF_READING);
        this.showResult("file", true);
        this.say("line-file", read.name);
        this.show(read, "file");
        this.#prepare();
      },
      error: (sentence, at) => {
        this.#undim();
        if (!this.#read) this.#forgetFile();
        this.refuse(sentence, at || "file");
      },
    });
  }

  // Channel, unit and size are asked where the file leaves them open.
  #showAsked({asks, channel, body}) {
    const select = this.find("#measured-channel"), {said} = this.#controls;
    select.replaceChildren(...asks.channels.map((textContent) => element("option", {
      textContent, value: textContent.split(" ", 1)[0], disabled: textContent.endsWith("(no heights)"),
    })));
    const first = [...select.options].find((each) => !each.disabled && each.textContent.endsWith(` ${channel}`));
    select.value = said.channel || (first ?? select.options[0])?.value || "";
    const isAsked = {channel: asks.channels.length > 0, unit: asks.unit, size: asks.size};
    for (const [key, isShown] of Object.entries(isAsked)) this.find(`[data-asked="${key}"]`).hidden = !isShown;
    this.find("[data-asks]").hidden = !Object.values(isAsked).some(Boolean);
    if (!body && (!asks.unit || said.unit) && (!asks.size || said.size)) this.step("preparation").open = true; // too much is missing
  }

  // Prepare what was read, if anything is set for that, or is to be seen.
  #prepare() {
    if (!this.#read) return;
    const isSet = OF_PREPARATION.some((key) => this.#controls.said[key]), step = this.step("preparation");
    const asked = {...this.asked, state: this.stateOfMap};
    const take = (body, refused) => {
      this.#settle("preparation", asked, refused, OF_PREPARATION);
      this.refuse("", "preparation");
      this.#body = body;
      this.#askBodies();
      this.#answers.ready();
    };
    if (!isSet) take(this.#read.body, {});
    if (!isSet && !step.open) { this.waiting.stop(["measured preparation"]); this.showResult("preparation", false); return; }
    step.classList.add("dimmed");
    this.waiting.ask("measured.prepare", "measured preparation", asked, {
      answer: (prepared) => {
        this.#undim();
        this.showResult("preparation", prepared.body !== null);
        this.show(prepared, "preparation");
        take(prepared.body, prepared.refused);
      },
      error: (sentence, at) => { this.#undim(); this.refuse(sentence, at || "preparation"); },
    });
  }

  #askBodies() {
    const asked = {...this.asked, sides: this.body?.sides ?? null};
    // the file tells more of how it is read and prepared
    const keys = this.hasSource ? OF_BODIES : [...OF_READING, ...OF_PREPARATION, ...OF_BODIES];
    this.#link.ask("measured.bodies", "measured bodies", asked, {
      answer: (found) => {
        this.#settle("bodies", asked, found.refused, keys);
        this.#offerElastic(found.mended_if_elastic);
        this.show(found);
      },
      error: (sentence, at) => this.refuse(sentence, at),
    });
  }

  // Where a text is refused that elastic bodies would have, offer to take them so.
  #offerElastic(keys) {
    for (const key of keys.filter((each) => this.#controls.isRefused(each))) {
      const place = this.find(`[data-error="${CSS.escape(key)}"]`);
      if (place.querySelector("button")) continue;
      const button = element("button", {type: "button", className: "small", textContent: "take them as elastic"});
      button.addEventListener("click", () => this.set("elastic", "yes"));
      place.append(" ", button);
    }
  }

  #stop() {
    this.waiting.stop(["measured file", "measured preparation", "measured maps"]);
    this.#undim();
  }

  #undim() { for (const step of this.findAll(".step.dimmed")) step.classList.remove("dimmed"); }
}

const LONGEST = 600; // that names of files may be together in an address

// Files as an address says them: the digest of each and its name, with slashes between, which no name has.
function textOf(files) {
  const most = Math.floor(LONGEST / files.length);
  const short = (name) => (name.length > most ? `${name.slice(0, most - 21)}…${name.slice(-20)}` : name);
  return files.map(({digest, name}) => `${digest}/${short(name)}`).join("/");
}

function filesIn(text) {
  const files = [];
  for (const [, digest, name] of text.matchAll(/([0-9a-f]{12})\/([^/]+)(?:\/|$)/g)) files.push({digest, name});
  return files;
}

function digests(files) { return files.map(({digest}) => digest).sort().join(); }
function named(files) { return files.map(({name}) => name).join("; "); }
function them(files) { return files.length > 1 ? "these files" : "that file"; }
