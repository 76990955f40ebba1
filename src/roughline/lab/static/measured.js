// My surface: a file of an instrument, prepared, pressed, and answered for.
import {Controls} from "./controls.js";
import {element} from "./elements.js";
import {Answers} from "./measured-answers.js";
import {measuredFigures} from "./measured-figures.js";
import {Source} from "./measured-file.js";
import {Part} from "./measured-part.js";
import {Pictures} from "./measured-pictures.js";
import {embedded} from "./plots.js";
import {recall, remember} from "./remember.js";
import {fillList, fillTable} from "./tables.js";
import {Waiting} from "./waiting.js";

const VERSION = "1";
const DEFAULTS = {first: "steel", second: "copper", loads: "2 MPa"};
const OF_FILE = ["unit", "channel", "size"]; // asked anew with each file
const keysOf = (what) => [...document.querySelectorAll(`#measured [data-of="${what}"] [data-error]`)].map(({dataset}) => dataset.error);
const OF_READING = [...OF_FILE, ...keysOf("Reading")];
const OF_PREPARATION = keysOf("Preparation");
const OF_BODIES = keysOf("bodies");
const TASKS = ["answers", "compare", "report"];

export async function open(link, address, said) {
  const view = new Measured(link, address);
  await view.open(said);
  return view;
}

class Measured {
  #link; #address; #root = document.querySelector("#measured");
  #controls; #pictures; #source; #part; #answers; #waiting = {};
  #read = null; // what the file holds, as last read
  #prepared = null; // the same, prepared
  #refusals = {bodies: {}, file: {}, preparation: {}}; // sentences by controls, of each question that tells them
  #ofLink = ""; // why the link that was opened is not shown
  #isAwaited = false; // a file that came before the pictures were there
  #brought = new Map(); // digests and names of the files that are on the server, by their keys
  #wanted = []; // digests and names of files that have to be chosen, by a link or once more

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    this.#controls = new Controls(this.#root, (key) => this.#changed(key));
    for (const name of ["file", "preparation"]) {
      this.#waiting[name] = new Waiting(this.find(`[data-waiting="${name}"]`), link, () => {
        this.#undim(name);
        if (name !== "file") return;
        this.#isAwaited = false;
        this.#source.stop();
      });
    }
    this.#source = new Source(link, this, this.#waiting.file);
    this.#part = new Part(link, this);
    this.#answers = new Answers(link, this, this.#part);
    this.#bind();
  }

  find(selector) { return this.#root.querySelector(selector); }
  findAll(selector) { return [...this.#root.querySelectorAll(selector)]; }
  fillList(name, sentences) { fillList(this.find(`[data-list="${name}"]`), sentences); }

  async open(given) {
    const {file, of, ...said} = await this.#begun(given);
    this.#wanted = filesIn(of ?? "");
    this.#take({...DEFAULTS, ...said});
    this.#askBodies();
    if (said.example) this.look();
    this.#link.ready.then((opened) => this.#find(opened));
    this.#pictures = new Pictures(this, await embedded(measuredFigures));
    this.#answers.pictures = this.#pictures;
    this.#pictures.onBox((crop) => this.set("crop", crop));
    if (this.#isAwaited) this.look();
    this.#link.ready.then(({resumed}) => { if (resumed && this.hasSource) this.#answers.restore(); });
  }

  // What the address sets; if nothing, what was set before the page was loaded again in another view.
  async #begun({view, theme, ...said}) {
    const before = recall("set");
    if (Object.keys(said).length || !before) return said;
    return (await this.#link.ready).resumed ? before : said;
  }

  shown() { this.#write(); }

  // The connection is back. What is drawn stays, also where another session has begun without the files.
  reconnected(resumed, isElsewhere) {
    if (resumed) return;
    if (!this.files.length) { this.#answers.loseReport(); return; }
    this.#answers.lose();
    this.#wanted = this.#of;
    const {file, ...kept} = this.#controls.said;
    this.#take(kept);
    for (const name of ["file", "preparation"]) this.#stop(name);
    this.#part.stop();
    this.#answers.ready();
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
  get files() { return (this.#controls.said.file ?? "").split(",").filter(Boolean); }
  get hasSource() { return this.files.length > 0 || Boolean(this.#controls.said.example); }
  get body() { return this.hasSource ? this.#prepared?.body ?? null : null; }
  get name() { return this.#read?.name ?? ""; }

  // Digests and names of the files that all is set for, whether they are here or have to be chosen.
  get #of() { return this.files.length ? this.files.map((key) => this.#brought.get(key)) : this.#wanted; }

  // All that is set, as the address says it.
  get #set() {
    const {file, ...said} = this.#controls.said;
    const of = textOf(this.#of);
    const set = Object.entries(said).filter(([key, text]) => text !== "" || key in DEFAULTS);
    if (!of && set.every(([key, text]) => text === DEFAULTS[key])) return {};
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
    if (isOther) for (const key of [...OF_FILE, "crop"]) delete kept[key];
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

  // Say what is to be known about the file.
  note(sentence) { this.find('[data-note="file"]').textContent = sentence; }

  set(key, text) {
    this.#take({...this.#controls.said, [key]: text});
    this.#changed(key);
  }

  refuse(sentence, at = "") {
    if (sentence && at) this.#unfold(at);
    if (!this.#controls.refuse(at, sentence)) this.#controls.refuse("", sentence);
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
    const elsewhere = this.#controls.answered(asked, {refused: all}, keys);
    this.refuse([this.#ofLink, elsewhere].filter(Boolean).join(" "));
  }

  #unfold(key) {
    const folded = this.find(`[data-error="${CSS.escape(key)}"]`)?.closest("details");
    if (folded) folded.open = true;
  }

  // Begin with the defaults in the place of a link that cannot be read.
  #begin(sentence) {
    this.#ofLink = sentence;
    this.#wanted = [];
    this.note("");
    for (const name of ["file", "preparation"]) this.#stop(name);
    this.#take({...DEFAULTS});
    this.#askBodies();
  }

  #take(said) {
    this.#controls.take(said);
    const byModulus = said.bodies === "modulus";
    this.find('[data-bodies="materials"]').hidden = byModulus;
    this.find('[data-bodies="modulus"]').hidden = !byModulus;
  }

  #changed(key) {
    this.#ofLink = "";
    for (const refused of Object.values(this.#refusals)) delete refused[key];
    for (const at of ["", key, ...TASKS]) this.refuse("", at);
    this.#write();
    if (key === "bodies") this.#take(this.#controls.said);
    if (!this.hasSource) { /* what is drawn stays */ }
    else if (OF_READING.includes(key)) this.#part.check();
    else if (OF_PREPARATION.includes(key)) {
      if (this.#part.shown) this.#part.check();
      else this.#prepare();
    }
    this.#askBodies(); // which reads all that is set
    this.#answers.changed();
  }

  #write() {
    remember("set", this.#set);
    if (!this.#root.hidden) this.#address.write("measured", this.#set);
  }

  #forgetFile() {
    this.#read = this.#prepared = null;
    for (const name of ["file", "map", "preparation", "answers", "compare"]) this.showResult(name, false);
    for (const place of this.findAll("[data-asked]")) place.hidden = true;
    this.#answers.forget();
    this.#askBodies();
  }

  // Read the file, or the map of a part that is shown.
  look() {
    const {file, example} = this.#controls.said;
    if (!file && !example) return;
    this.#waiting.file.begin("measured file");
    this.#dim("file");
    if (!this.#pictures) { this.#isAwaited = true; return; } // it is read when it can be drawn
    const asked = this.#asked(this.stateOfMap);
    this.#waiting.file.ask("measured.look", "measured file", asked, {
      answer: (read) => {
        this.#undim("file");
        this.#read = read;
        this.#write();
        this.refuse("", "file");
        this.#showAsked(read);
        Object.assign(this.find("[data-example-file]"), {
          hidden: !example, href: `/results/${this.#link.session}/${read.name}?save=1`, download: read.name,
        });
        this.#settle("file", asked, read.refused, OF_READING);
        for (const name of ["file", "map"]) this.showResult(name, true);
        this.find("[data-name]").textContent = read.name;
        this.fillList("obstacles", read.obstacles);
        this.fillList("remarks", read.remarks);
        fillTable("measured-roughness", ["", ""], read.table);
        this.#pictures.drawFile(read);
        this.#prepare();
      },
      error: (sentence, at) => {
        this.#undim("file");
        if (!this.#read) { this.#forgetFile(); this.#part.showTable(); }
        this.refuse(sentence, at || "file");
      },
    });
  }

  // Channel, unit and size are asked where the file leaves them open.
  #showAsked({asks, channel}) {
    const select = this.find("#measured-channel");
    select.replaceChildren(...asks.channels.map((textContent) => element("option", {
      textContent, value: textContent.split(" ", 1)[0], disabled: textContent.endsWith("(no heights)"),
    })));
    select.value = this.#controls.said.channel ?? "";
    if (!this.#controls.said.channel) {
      const first = [...select.options].find((each) => !each.disabled && each.textContent.endsWith(` ${channel}`));
      if (first) first.selected = true;
    }
    this.find('[data-asked="channel"]').hidden = asks.channels.length === 0;
    this.find('[data-asked="unit"]').hidden = !asks.unit;
    this.find('[data-asked="size"]').hidden = !asks.size;
  }

  #prepare() {
    if (!this.#read) return;
    const isAsked = OF_PREPARATION.some((key) => this.#controls.said[key]);
    const asked = this.#asked(this.stateOfMap);
    const show = (prepared, refused) => {
      this.#undim("preparation");
      this.#settle("preparation", asked, refused, OF_PREPARATION);
      this.#showPrepared(prepared);
    };
    if (!isAsked) { this.#stop("preparation"); show(this.#read, {}); return; }
    this.#dim("preparation");
    this.#waiting.preparation.ask("measured.prepare", "measured preparation", asked, {
      answer: (prepared) => show(prepared, prepared.refused),
      error: (sentence, at) => { this.#undim("preparation"); this.refuse(sentence, at || "preparation"); },
    });
  }

  #showPrepared(prepared) {
    this.#prepared = prepared;
    this.refuse("", "preparation");
    this.showResult("preparation", prepared.body !== null);
    if (prepared.body) {
      this.#pictures.drawPrepared(this.#read, prepared, this.#controls.said.crop ?? "");
      this.find("[data-prepared-numbers]").open = prepared !== this.#read;
      this.fillList("prepared-remarks", prepared === this.#read ? [] : prepared.remarks);
      const after = new Map(prepared.table), before = new Map(this.#read.table);
      const names = [...new Set([...before.keys(), ...after.keys()])].filter((name) => name !== "file");
      fillTable("measured-prepared", ["", "before", "after"], names.map((name) => [name, before.get(name) ?? "-", after.get(name) ?? "-"]));
    }
    this.#askBodies();
    this.#answers.ready();
  }

  showResult(name, isShown) {
    this.find(`[data-result="${name}"]`).hidden = !isShown;
    const empty = this.find(`[data-empty="${name}"]`);
    if (empty) empty.hidden = isShown;
  }

  #askBodies() {
    const asked = this.#asked(this.state);
    // the file tells more of how it is read and prepared
    const keys = this.hasSource ? OF_BODIES : [...OF_READING, ...OF_PREPARATION, ...OF_BODIES];
    this.#link.ask("measured.bodies", "measured bodies", {...asked, sides: this.body?.sides ?? null}, {
      answer: ({rows, loads, notes, refused}) => {
        this.#settle("bodies", asked, refused, keys);
        fillTable("measured-bodies", ["", ""], rows);
        this.fillList("loads", loads);
        this.fillList("bodies-notes", notes);
      },
      error: (sentence, at) => { if (at === "v") this.#begin(sentence); else this.refuse(sentence, at); },
    });
  }

  // All that is set, or that is set of one map, with what counts where a text cannot be used.
  #asked(state) { return {...this.#controls.asked, state}; }

  #stop(name) {
    this.#waiting[name].stop([`measured ${name}`]);
    this.#undim(name);
  }

  #dim(name) { this.find(`#measured-step-${name}`).classList.add("dimmed"); }
  #undim(name) { this.find(`#measured-step-${name}`).classList.remove("dimmed"); }

  #bind() {
    this.find('[data-crop="all"]').addEventListener("click", () => this.set("crop", ""));
    const load = this.find("#measured-load");
    const add = () => {
      if (!load.value.trim()) return;
      this.set("loads", [this.#controls.said.loads, load.value.trim()].filter(Boolean).join("; "));
      load.value = "";
    };
    this.find("[data-add-load]").addEventListener("click", add);
    load.addEventListener("keydown", (event) => {
      if (event.key === "Enter") { event.preventDefault(); add(); }
    });
  }
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
