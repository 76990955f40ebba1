// My surface: a file of an instrument, prepared, pressed, and answered for.
import {Controls} from "./controls.js";
import {Answers} from "./measured-answers.js";
import {Source} from "./measured-file.js";
import {Part} from "./measured-part.js";
import {Pictures, fillList} from "./measured-pictures.js";
import {embedded, fillTable} from "./plots.js";
import {Waiting} from "./waiting.js";

const VERSION = "1";
const DEFAULTS = {first: "steel", second: "copper", loads: "2 MPa"};
const OF_FILE = ["unit", "channel", "size"]; // asked anew with each file
const OF_READING = [...OF_FILE, "fill", "most_missing"];
const OF_PREPARATION = ["trend", "outliers", "crop", "low_pass", "resample"];
const OF_BODIES = ["bodies", "first", "second", "E", "loads", "frequency", "elastic", "hardness", "joint_area"];

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
  #isAwaited = false; // a file that came before the pictures were there

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    this.#controls = new Controls(this.#root, (key) => this.#changed(key));
    for (const name of ["file", "preparation"]) {
      this.#waiting[name] = new Waiting(this.find(`[data-waiting="${name}"]`), () => {
        link.stop(`measured ${name}`);
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

  async open({view, theme, ...said}) {
    this.#take({...DEFAULTS, ...said});
    this.#askBodies();
    if (said.example) this.look();
    this.#pictures = new Pictures(this, await embedded("measured"));
    this.#answers.pictures = this.#pictures;
    this.#pictures.onBox((crop) => this.set("crop", crop));
    if (this.#isAwaited) this.look();
  }

  shown() { this.#write(); }

  // A new session has none of the files of the old one.
  reconnected() {
    this.#answers.forget();
    if (this.#controls.said.example) { this.look(); return; }
    const {file, ...kept} = this.#controls.said;
    if (!file) return;
    this.#take(kept);
    this.#forgetFile();
    this.#part.check();
    this.refuse("The connection was lost, and the file went with it: choose it again.", "file");
  }

  // All that is set, as the server reads it.
  get state() { return {v: VERSION, ...this.#controls.said}; }
  // The same of the one map that is shown.
  get stateOfMap() { return this.#part.shown ? {...this.state, file: this.#part.shown} : this.state; }
  get files() { return (this.#controls.said.file ?? "").split(",").filter(Boolean); }
  get yields() { return this.#yields; }
  #yields = false;
  get body() { return this.#prepared?.body ?? null; }
  get name() { return this.#read?.name ?? ""; }
  get isFilled() { return (this.#prepared?.missing ?? 0) > 0; }

  // Take a file that has come, or an example.
  takeSource(source) {
    const {file, example, ...kept} = this.#controls.said;
    const isOther = !(source.file ?? "").split(",").some((each) => this.files.includes(each));
    if (isOther) for (const key of [...OF_FILE, "crop"]) delete kept[key];
    this.#take({...kept, ...source});
    this.#forgetFile();
    this.#part.check();
  }

  set(key, text) {
    this.#take({...this.#controls.said, [key]: text});
    this.#changed(key);
  }

  refuse(sentence, at = "") {
    const folded = sentence && at && this.find(`[data-error="${CSS.escape(at)}"]`)?.closest("details");
    if (folded) folded.open = true;
    if (!this.#controls.refuse(at, sentence)) this.#controls.refuse("", sentence);
  }

  #take(said) {
    this.#controls.take(said);
    for (const key of [...OF_READING, ...OF_PREPARATION, ...OF_BODIES]) {
      const field = this.find(`input[data-text="${key}"]`);
      if (field && !(key in said)) field.value = "";
    }
    const byModulus = said.bodies === "modulus";
    this.find('[data-bodies="materials"]').hidden = byModulus;
    this.find('[data-bodies="modulus"]').hidden = !byModulus;
    for (const box of this.findAll("[data-theory]")) {
      box.checked = (said.theories ?? "").split(",").includes(box.dataset.theory);
    }
  }

  #changed(key) {
    this.refuse("", "");
    this.#write();
    if (key === "bodies") this.#take(this.#controls.said);
    if (OF_READING.includes(key)) this.#part.check();
    else if (OF_PREPARATION.includes(key)) {
      if (this.#part.shown) this.#part.check();
      else this.#prepare();
    }
    if (OF_BODIES.includes(key)) this.#askBodies();
    this.#answers.changed();
  }

  #write() {
    const {file, ...said} = this.#controls.said;
    const told = Object.entries(said).filter(([key, text]) => text !== "" && text !== DEFAULTS[key]);
    this.#address.write("measured", told.length ? {v: VERSION, ...Object.fromEntries(told)} : {});
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
    this.#wait("file");
    if (!this.#pictures) { this.#isAwaited = true; return; } // it is read when it can be drawn
    this.#link.ask("measured.look", "measured file", {state: this.stateOfMap}, {
      answer: (read) => {
        this.#end("file");
        this.#read = read;
        this.#write();
        this.refuse("", "file");
        this.#showAsked(read);
        for (const name of ["file", "map"]) this.showResult(name, true);
        this.find("[data-name]").textContent = read.name;
        fillList(this, "obstacles", read.obstacles);
        fillList(this, "remarks", read.remarks);
        fillTable("measured-roughness", ["", ""], read.table);
        this.#pictures.drawFile(read);
        this.#prepare();
      },
      error: (sentence, at) => {
        this.#end("file");
        if (!this.#read) { this.#forgetFile(); this.#part.showTable(); }
        this.refuse(sentence, at || "file");
      },
    });
  }

  // Channel, unit and size are asked where the file leaves them open.
  #showAsked({asks, channel}) {
    const select = this.find("#measured-channel");
    select.replaceChildren(...asks.channels.map((text) => {
      const option = document.createElement("option");
      option.value = text.split(" ", 1)[0];
      option.textContent = text;
      option.disabled = text.endsWith("(no heights)");
      option.selected = (this.#controls.said.channel ?? "") === option.value;
      return option;
    }));
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
    if (!isAsked) { this.#link.stop("measured preparation"); this.#end("preparation"); this.#showPrepared(this.#read); return; }
    this.#wait("preparation");
    this.#link.ask("measured.prepare", "measured preparation", {state: this.stateOfMap}, {
      answer: (prepared) => { this.#end("preparation"); this.#showPrepared(prepared); },
      error: (sentence, at) => { this.#end("preparation"); this.refuse(sentence, at || "preparation"); },
    });
  }

  #showPrepared(prepared) {
    this.#prepared = prepared;
    for (const key of ["preparation", ...OF_PREPARATION]) this.refuse("", key);
    this.showResult("preparation", prepared.body !== null);
    if (prepared.body) {
      this.#pictures.drawPrepared(this.#read, prepared, this.#controls.said.crop ?? "");
      this.find("[data-prepared-numbers]").open = prepared !== this.#read;
      fillList(this, "prepared-remarks", prepared === this.#read ? [] : prepared.remarks);
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
    this.#link.ask("measured.bodies", "measured bodies", {state: this.state, sides: this.body?.sides ?? null}, {
      answer: ({rows, loads, notes, yields}) => {
        this.#yields = yields;
        for (const key of ["", ...OF_BODIES]) this.refuse("", key);
        fillTable("measured-bodies", ["", ""], rows);
        fillList(this, "loads", loads);
        fillList(this, "bodies-notes", notes);
      },
      error: (sentence, at) => this.refuse(sentence, at),
    });
  }

  #wait(name) {
    this.#waiting[name].begin();
    this.find(`#measured-step-${name}`).classList.add("dimmed");
  }

  #end(name) { this.#waiting[name].end(); this.#undim(name); }
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
    for (const box of this.findAll("[data-theory]")) {
      box.addEventListener("change", () => {
        const chosen = this.findAll("[data-theory]:checked").map((each) => each.dataset.theory);
        this.set("theories", chosen.join(","));
      });
    }
  }
}
