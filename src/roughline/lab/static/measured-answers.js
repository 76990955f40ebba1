// Answers of My surface: pressing, both models, the report, and code that repeats it.
import {copy} from "./clipboard.js";
import {openDialog} from "./dialogs.js";
import {element} from "./elements.js";
import {recall, remember} from "./remember.js";
import {fillFigures, fillTable, foldRows} from "./tables.js";
import {Waiting} from "./waiting.js";

const TASKS = ["answers", "compare", "report"];
const VERDICTS = {confirmed: "good", refuted: "error", undecided: "doubt"};

export class Answers {
  #link; #view; #part; #waiting = {}; #contact = null; #arrays = {};
  #answered = null; // what was asked for the answers that are shown
  #asked = recall("asked") ?? {}; // what was asked or is shown, for when the page is loaded again
  pictures = null;

  constructor(link, view, part) {
    this.#link = link;
    this.#view = view;
    this.#part = part;
    for (const name of TASKS) {
      this.#waiting[name] = new Waiting(view.find(`[data-waiting="${name}"]`), link, () => {
        this.#end(name, "stopped");
        this.#note(name, null);
      });
    }
    view.find("[data-press]").addEventListener("click", () => this.#press());
    view.find("[data-compare]").addEventListener("click", () => this.#compare());
    view.find("[data-report]").addEventListener("click", () => this.#report());
    for (const button of view.findAll("[data-code]")) button.addEventListener("click", () => this.#code(button));
    view.find("[data-shown]").addEventListener("change", () => this.#drawField());
    view.find("[data-part-map]").addEventListener("change", ({target}) => this.#press({...this.#seen, map: Number(target.value)}));
    view.find("[data-copy]").addEventListener("click", ({target}) => copy(view.find("[data-code-dialog] pre").textContent, target));
  }

  // The file can be pressed, or not.
  ready() {
    const {body} = this.#view;
    const isSurface = body?.kind === "surface";
    for (const name of ["press", "report"]) this.#view.find(`[data-${name}]`).disabled = !body;
    for (const button of this.#view.findAll("[data-code]")) button.disabled = !body;
    this.#view.find("[data-compare]").disabled = !isSurface;
    this.#view.find("[data-compare-note]").textContent = !body || isSurface
      ? "Where the reduced model may be trusted on the surface as it is in the file, without the preparation of step 2."
      : "The models are compared on a surface: a line scan shows one direction, and the full model needs both.";
    this.changed();
  }

  // Something was set: what is shown may be of what was set before.
  changed() {
    const isOther = this.#answered !== null && this.#answered.settings !== this.#view.settings;
    this.#view.find("[data-changed]").hidden = !isOther;
    this.#view.find('[data-result="answers"]').classList.toggle("dimmed", isOther || this.#link.isWaiting("measured answers"));
    const {settings} = this.#answered ?? this.#asked.answers ?? {};
    if (this.#asked.report?.settings !== settings) this.#view.find("[data-links]").replaceChildren();
  }

  forget() {
    this.lose();
    this.#answered = null;
    this.#view.find('[data-empty="answers"]').hidden = false;
    this.ready();
  }

  // What was asked is asked no more, and the session has nothing of it any longer.
  lose() {
    for (const name of TASKS) {
      this.#waiting[name].stop([`measured ${name}`]);
      this.#end(name, "");
      this.#note(name, null);
    }
    this.changed();
  }

  loseReport() {
    this.#note("report", null);
    this.changed();
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

  #ask(task, name, asked, done) {
    this.#view.refuse("", name);
    this.#say(name, "");
    this.#note(name, asked);
    const {settings, ...question} = asked;
    this.#waiting[name].ask(task, `measured ${name}`, question, {
      answer: (answer) => { this.#end(name, ""); done(answer); },
      error: (sentence, at) => { this.#end(name, ""); this.#note(name, null); this.#view.refuseTask(sentence, at, name); },
    });
  }

  // A question of what is set now, less what is given.
  #now(given = {}) {
    const {state, settings} = this.#view;
    return {state, settings, ...given};
  }

  // What the answers that are shown were asked of, and without any what is set; answers of another file are forgotten.
  get #seen() {
    const {state: {file, example}} = this.#view, {state, settings} = this.#answered ?? this.#view;
    return {state: {...state, file, example}, settings};
  }

  // Press the body, or all maps of a part, of which one is shown alone.
  #press(given = {}, then = () => {}) {
    this.#view.find('[data-result="answers"]').classList.add("dimmed");
    const asked = this.#now({map: 0, ...given});
    this.#ask("measured.answer", "answers", asked, (answer) => { this.#show(answer, asked); then(); });
  }

  #show(answer, asked) {
    const view = this.#view;
    this.#answered = asked;
    view.find('[data-empty="answers"]').hidden = true;
    view.find('[data-result="answers"]').hidden = false;
    this.changed();
    this.#part.show(answer.part ?? null, this.pictures);
    view.find("[data-modulus]").textContent = answer.modulus;
    fillTable("measured-answers", ...(answer.answers ?? answer.curve));
    for (const cell of view.findAll('[data-table="measured-answers"] td:first-child')) {
      cell.parentElement.classList.toggle("elastic", cell.textContent === answer.if_elastic);
    }
    if (answer.answers) foldRows("measured-answers", answer.groups);
    fillFigures(view.find('[data-figures="answers"]'), answer.lead, answer.figures);
    view.find("[data-star]").textContent = answer.star;
    view.fillList("answer-remarks", [...(answer.part ? [] : answer.remarks), ...answer.theories]); // the part has all
    fillTable("measured-formulas", ...(answer.formulas ?? [["no answers follow from a contact modulus alone"], []]));
    view.find("[data-slip]").hidden = !answer.slip;
    if (answer.slip) fillTable("measured-slip", ["displacement", "tangential force"], answer.slip.rows);
    this.#contact = answer.contact;
    this.#arrays = answer.arrays;
    this.pictures.drawContact(answer.contact, answer.arrays);
    this.pictures.drawCurve(answer.plot, answer.curve);
  }

  get #shown() { return this.#view.find("[data-shown]").value; }
  #drawField() { if (this.#contact) this.pictures.drawField(this.#contact, this.#arrays, this.#shown); }

  #compare(given = {state: this.#view.stateOfMap}) {
    this.#ask("measured.compare", "compare", this.#now(given), (found) => {
      const view = this.#view;
      view.find('[data-empty="answers"]').hidden = true;
      view.find('[data-result="compare"]').hidden = false;
      view.find("[data-what]").textContent = found.what;
      view.find("[data-verdict]").textContent = `${found.verdict[0].toUpperCase()}${found.verdict.slice(1)}.`;
      view.find("[data-compare-star]").textContent = found.star;
      view.fillList("compare-notes", found.notes);
      this.pictures.drawModels(found);
      for (const cell of view.findAll('[data-table="measured-models"] td')) {
        if (cell.textContent in VERDICTS) cell.className = VERDICTS[cell.textContent];
      }
    });
  }

  // Write the report of the answers that are shown; without any press first.
  #report(asked = this.#answered && this.#seen) {
    if (!asked) { this.#press({}, () => this.#report()); return; }
    this.#ask("measured.report", "report", asked, ({files}) => {
      this.#note("report", {...asked, files});
      this.#showLinks(files);
    });
  }

  #showLinks(files) {
    const links = Object.entries(files).map(([name, place]) => {
      const address = `/results/${this.#link.session}/${place}`;
      return element("li", {}, element("a", name.endsWith(".html")
        ? {href: address, textContent: `${name}, opens in a new tab`, target: "_blank", rel: "noopener"}
        : {href: `${address}?save=1`, textContent: `${name}, to save`, download: place}));
    });
    this.#view.find("[data-links]").replaceChildren(...links);
  }

  #code(button) {
    this.#link.ask("measured.code", "measured code", {state: this.#seen.state, which: button.dataset.code}, {
      answer: ({text}) => {
        this.#view.find("[data-code-dialog] pre").textContent = text;
        openDialog(this.#view.find("[data-code-dialog]"), button);
      },
      error: (sentence, at) => this.#view.refuseTask(sentence, at, "report"),
    });
  }

  #end(name, text) {
    this.#say(name, text);
    if (name === "answers") this.changed();
  }

  #say(name, text) { this.#view.find(`[data-waiting="${name}"] [data-said]`).textContent = text; }
}
