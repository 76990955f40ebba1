// Maps of one part in My surface: each checked, and shown one at a time.
import {element} from "./elements.js";
import {fillTable} from "./tables.js";

export class Part {
  #view; #maps = []; #shown = null;

  constructor(view) { this.#view = view; }

  // Keys of the maps that are there; without several there is no part.
  get #files() { return (this.#view.files.length > 1 ? this.#view.files : []); }

  // Key of the map that is shown, by which it is read and prepared; none without a part.
  get shown() { return this.#files.includes(this.#shown) ? this.#shown : this.#files[0] ?? null; }

  // Check each map, and go on with one that can be pressed.
  check() {
    const isPart = this.#files.length > 1;
    this.#view.showResult("part", isPart);
    for (const name of ["add-maps", "forget-file"]) this.#view.find(`[data-${name}]`).hidden = this.#view.files.length === 0;
    if (!isPart) { this.#view.waiting.stop(["measured maps"]); this.#view.look(); return; }
    this.#view.waiting.ask("measured.maps", "measured maps", {state: this.#view.state}, {
      answer: ({maps}) => {
        this.#maps = maps;
        const good = maps.filter(({refused}) => !refused);
        if (!good.some(({file}) => file === this.shown)) this.#shown = (good[0] ?? maps[0]).file;
        this.#fill(good.length);
        this.#view.look();
      },
      error: (sentence, at) => this.#view.refuse(sentence, at || "file"),
    });
  }

  #fill(good) {
    const count = this.#maps.length;
    this.#view.say("part-count", `${count} maps of one part${good < count ? `, of which ${good} can be pressed` : ""}`);
    fillTable("measured-maps", ["map", "points", "sides", "rms height", "rms slope", ""],
      this.#maps.map(({name, cells, refused}) => [name, ...(refused ? [refused, "", "", ""] : cells), ""]));
    const rows = this.#view.findAll('[data-table="measured-maps"] tbody tr');
    for (const [i, {file, name, refused}] of this.#maps.entries()) {
      const {children} = rows[i];
      const show = button(name, `show ${name}`, () => { this.#shown = file; this.#fill(good); this.#view.look(); });
      show.setAttribute("aria-pressed", String(file === this.shown));
      show.disabled = Boolean(refused);
      children[0].replaceChildren(show);
      children[5].replaceChildren(button("leave out", `leave out ${name}`, () => {
        this.#view.takeSource({file: this.#files.filter((each) => each !== file).join(",")});
      }));
      if (!refused) continue;
      Object.assign(children[1], {className: "error", colSpan: 4});
      for (const empty of [...children].slice(2, 5)) empty.remove();
    }
  }

  // Name the maps of a part that was pressed, of which one is shown alone.
  show({names, shown}) {
    this.#view.find("[data-part-map]").replaceChildren(...names.map((name, i) => new Option(name, i, false, i === shown)));
  }
}

function button(text, label, clicked) {
  const made = element("button", {type: "button", textContent: text, ariaLabel: label});
  made.addEventListener("click", clicked);
  return made;
}
