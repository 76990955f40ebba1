// Maps of one part in My surface: each checked, shown one at a time, and what they gave together.
import {element} from "./elements.js";
import {fillFigures, fillTable, foldRows} from "./tables.js";
import {Waiting} from "./waiting.js";

export class Part {
  #view; #waiting; #maps = []; #shown = null; #drawings = [];

  constructor(link, view) {
    this.#view = view;
    this.#waiting = new Waiting(view.find('[data-waiting="maps"]'), link);
    view.find("[data-part-answer]").addEventListener("change", ({target}) => this.#draw(Number(target.value)));
  }

  // Keys of the maps that are there; without several there is no part.
  get #files() { return (this.#view.files.length > 1 ? this.#view.files : []); }

  // Key of the map that is shown, by which it is read and prepared; none without a part.
  get shown() { return this.#files.includes(this.#shown) ? this.#shown : this.#files[0] ?? null; }

  // Check each map, and go on with one that can be pressed.
  check() {
    const isPart = this.#files.length > 1;
    this.#view.find("[data-part]").hidden = !isPart;
    for (const name of ["add-maps", "forget-file"]) this.#view.find(`[data-${name}]`).hidden = this.#view.files.length === 0;
    if (!isPart) { this.stop(); this.#view.look(); return; }
    this.#waiting.ask("measured.maps", "measured maps", {state: this.#view.state}, {
      answer: ({maps}) => {
        this.#maps = maps;
        const good = maps.filter(({refused}) => !refused);
        if (!good.some(({file}) => file === this.shown)) this.#shown = (good[0] ?? maps[0]).file;
        this.#fill();
        this.showTable();
        this.#view.look();
      },
      error: (sentence, at) => this.#view.refuse(sentence, at || "file"),
    });
  }

  // Stop checking the maps.
  stop() { this.#waiting.stop(["measured maps"]); }

  // Show the table of the maps, whether or not one can be read.
  showTable() { if (this.#files.length) this.#view.showResult("file", true); }

  #fill() {
    const good = this.#maps.filter(({refused}) => !refused).length;
    this.#view.find("[data-part-count]").textContent =
      `${this.#maps.length} maps of one part${good < this.#maps.length ? `, of which ${good} can be pressed` : ""}`;
    fillTable("measured-maps", ["map", "points", "sides", "rms height", "rms slope", ""],
      this.#maps.map(({name, cells, refused}) => [name, ...(refused ? [refused, "", "", ""] : cells), ""]));
    const rows = this.#view.findAll('[data-table="measured-maps"] tbody tr');
    for (const [i, {file, name, refused}] of this.#maps.entries()) {
      const {children} = rows[i];
      const show = button(name, `show ${name}`, () => { this.#shown = file; this.#fill(); this.#view.look(); });
      show.setAttribute("aria-pressed", String(file === this.shown));
      show.disabled = Boolean(refused);
      children[0].replaceChildren(show);
      children[5].replaceChildren(button("leave out", `leave out ${name}`, () => {
        this.#view.takeSource({file: this.#files.filter((each) => each !== file).join(",")});
      }));
      if (refused) {
        children[1].className = "error";
        children[1].colSpan = 4;
        for (const empty of [...children].slice(2, 5)) empty.remove();
      }
    }
  }

  // Show what the maps gave together; none of a single map.
  show(part, pictures) {
    this.#view.find("[data-part-answers]").hidden = !part;
    this.#view.find("[data-map-shown]").hidden = !part;
    if (!part) return;
    fillTable("measured-part-answers", ...(part.answers ?? [["the maps have no common answers"], []]));
    if (part.answers) foldRows("measured-part-answers", part.groups);
    fillFigures(this.#view.find('[data-figures="part"]'), part.lead, part.figures);
    fillTable("measured-part-leading", ...part.leading);
    fillTable("measured-part-maps", ...part.maps);
    this.#view.find("[data-part-star]").textContent = part.star;
    this.#view.fillList("part-remarks", part.remarks);
    fillChoice(this.#view.find("[data-part-map]"), part.names, part.shown);
    const names = part.drawings.map(({name}) => name);
    fillChoice(this.#view.find("[data-part-answer]"), names, 0);
    this.#drawings = part.drawings.map((each) => ({...each, names: part.names, load: part.load, pictures}));
    this.#view.find("#measured-part").hidden = names.length === 0;
    if (names.length) this.#draw(0);
  }

  #draw(i) { this.#drawings[i].pictures.drawPart(this.#drawings[i]); }
}

function button(text, label, clicked) {
  const made = element("button", {type: "button", textContent: text, ariaLabel: label});
  made.addEventListener("click", clicked);
  return made;
}

function fillChoice(select, texts, chosen) {
  select.replaceChildren(...texts.map((text, i) => new Option(text, i, false, i === chosen)));
}
