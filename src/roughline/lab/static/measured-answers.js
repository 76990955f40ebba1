// Answers of My surface: pressing, both models, the report, and code that repeats it.
import {bindCode} from "./code.js";
import {element} from "./elements.js";
import {recall, remember} from "./remember.js";

export const TASKS = ["answers", "compare", "report"];

export class Answers {
  #link; #view; #part;
  #answered = null; // what was asked for the answers that are shown
  #asked = recall("asked") ?? {}; // what was asked or is shown, for when the page is loaded again

  constructor(link, view, part) {
    this.#link = link;
    this.#view = view;
    this.#part = part;
    const on = (selector, type, act) => view.findAll(selector).forEach((each) => each.addEventListener(type, act));
    on("[data-press]", "click", () => this.#press({}, true));
    on("[data-compare]", "click", () => this.#compare());
    on("[data-report]", "click", () => this.#report());
    on("[data-part-map]", "change", ({target}) => this.#press({...this.#seen, map: Number(target.value)}));
    bindCode(view.root, link, () => ({state: this.#seen.state}), (sentence, at) => view.refuseTask(sentence, at, "report"));
  }

  // The file can be pressed, or not.
  ready() {
    const {body} = this.#view, isSurface = body?.kind === "surface";
    for (const button of this.#view.findAll("[data-press], [data-report], [data-code]")) button.disabled = !body;
    this.#view.find("[data-compare]").disabled = !isSurface;
    this.#view.say("compare-note", !body || isSurface
      ? "The models are compared on the surface as it is in the file, without the preparation of step 2."
      : "The models are compared on a surface: a line scan shows one direction, and the full model needs both.");
    if (this.#answered === null) this.#view.say("line-answers", body ? "press to see them" : "choose a file");
    this.changed();
  }

  // Something was set: what is shown may be of what was set before.
  changed() {
    const isOther = this.#answered !== null && this.#answered.settings !== this.#view.settings;
    this.#view.find("[data-changed]").hidden = !isOther;
    this.#dim(isOther || this.#link.isWaiting("measured answers"));
    const {settings} = this.#answered ?? this.#asked.answers ?? {};
    if (this.#asked.report?.settings !== settings) this.#view.find("[data-links]").replaceChildren();
  }

  forget() {
    this.#answered = null;
    this.lose();
  }

  // What was asked is asked no more, and the session has nothing of it any longer.
  lose() {
    const works = TASKS.map((name) => `measured ${name}`);
    this.#view.waiting.stop(works);
    this.stopped(works, "");
    this.ready();
  }

  loseReport() {
    this.#note("report", null);
    this.changed();
  }

  // Some works were cancelled.
  stopped(works, text = "stopped") {
    for (const name of TASKS.filter((each) => works.includes(`measured ${each}`))) this.#note(name, null);
    this.#end(text);
  }

  // Ask again for what was shown or asked for when the page was loaded again: it is kept, or goes on.
  restore() {
    const {file, example} = this.#view.state;
    const isOfIt = ([, asked]) => asked && asked.state.file === file && asked.state.example === example;
    const {answers, compare, report} = Object.fromEntries(Object.entries(this.#asked).filter(isOfIt));
    if (answers) this.#press(answers);
    if (compare) this.#compare(compare);
    if (report?.files) this.#showLinks(report.files);
    else if (report) this.#report(report);
  }

  #note(name, asked) {
    this.#asked[name] = asked;
    remember("asked", this.#asked);
  }

  // Ask for a task with what is set now, less what is given.
  #ask(task, name, given, done) {
    const {state, settings} = this.#view, asked = {state, settings, ...given};
    this.#view.refuse("", name);
    this.#end("");
    this.#note(name, asked);
    const {settings: _, ...question} = asked;
    this.#view.waiting.ask(task, `measured ${name}`, question, {
      answer: (answer) => { done(answer, asked); this.#end(""); },
      error: (sentence, at) => { this.#note(name, null); this.#end(""); this.#view.refuseTask(sentence, at, name); },
    });
  }

  // What the answers that are shown were asked of, and without any what is set; answers of another file are forgotten.
  get #seen() {
    const {state: {file, example}} = this.#view, {state, settings} = this.#answered ?? this.#view;
    return {state: {...state, file, example}, settings};
  }

  // Press the body, or all maps of a part, of which one is shown alone; who pressed is shown the answer.
  #press(given = {}, isByHand = false, then = () => {}) {
    this.#dim(true);
    this.#ask("measured.answer", "answers", {map: 0, ...given}, (answer, asked) => {
      const view = this.#view;
      this.#answered = asked;
      view.step("answers").open = true;
      view.showResult("answers", true);
      for (const place of view.findAll("[data-of-part]")) place.hidden = !answer.part;
      if (answer.part) this.#part.show(answer.part);
      view.find("[data-slip]").hidden = !answer.tables["measured-slip"][1].length;
      view.say("line-answers", answer.words["part-lead"] ?? answer.words["answers-lead"]);
      view.show(answer, "answers");
      if (isByHand) view.step("answers").scrollIntoView({block: "start"});
      then();
    });
  }

  #compare(given = {state: this.#view.stateOfMap}) {
    this.#ask("measured.compare", "compare", given, (found) => {
      this.#view.step("answers").open = true;
      this.#view.showResult("compare", true);
      this.#view.show(found, "compare");
    });
  }

  // Write the report of the answers that are shown; without any press first.
  #report(given = this.#answered && this.#seen) {
    if (!given) { this.#press({}, true, () => this.#report()); return; }
    this.#ask("measured.report", "report", given, ({files}, asked) => {
      this.#note("report", {...asked, files});
      this.#showLinks(files);
    });
  }

  #showLinks(files) {
    const links = Object.entries(files).map(([name, place]) => {
      const address = `results/${this.#link.session}/${place}`;
      return element("li", {}, element("a", name.endsWith(".html")
        ? {href: address, textContent: `${name}, opens in a new tab`, target: "_blank", rel: "noopener"}
        : {href: `${address}?save=1`, textContent: `${name}, to save`, download: place}));
    });
    this.#view.find("[data-links]").replaceChildren(...links);
  }

  #dim(isDimmed) {
    for (const place of this.#view.findAll('[data-result="answers"]')) place.classList.toggle("dimmed", isDimmed);
  }

  #end(text) {
    this.#view.find("[data-said]").textContent = text;
    this.changed();
  }
}
