// The trust map, the claims and the bodies of the view "The paper".
import {colourVerdicts} from "./published-curves.js";
import {element} from "./elements.js";
import {colour, embedded} from "./plots.js";
import {bodyFigures, studyFigure} from "./published-figures.js";
import {fillTable} from "./tables.js";
import {Waiting} from "./waiting.js";

const INDENTED = 1; // row of the bodies that Figure 2 shows
const ROWS = 4;

export function drawTrust(plots, {panels, legend}) {
  for (const panel of panels) {
    const {left, right, bottom, top, colour, resolved} = panel, columns = {left, right, bottom, top, colour};
    plots.set(`trust ${panel.roll_off}`, columns);
    const unsure = Object.entries(columns).map(([name, values]) => [name, values.filter((_, i) => !resolved[i])]);
    plots.set(`trust ${panel.roll_off} unsure`, Object.fromEntries(unsure));
  }
  document.querySelector("#published [data-legend]").replaceChildren(...legend.map(({colour: background, text}) => {
    const patch = element("span");
    patch.style.background = background;
    return element("li", {}, patch, text);
  }));
}

// Mark the point that is asked about, and show its panel as a table.
export function drawPoint(plots, trust, state, numbers, {sentence, verdict}) {
  const place = document.querySelector("#published [data-point]");
  place.textContent = sentence;
  place.dataset.verdict = verdict;
  for (const panel of document.querySelectorAll("#published [data-trust]")) {
    const isChosen = panel.dataset.trust === state.roll_off;
    panel.classList.toggle("chosen", isChosen);
    const [x, y] = isChosen ? [[numbers.map_F], [numbers.map_D_f]] : [[], []];
    plots?.set(`trust point ${panel.dataset.trust}`, {x, y});
  }
  const shown = trust?.panels.find(({roll_off}) => roll_off === state.roll_off);
  if (shown) fillTable("published-trust", shown.header, shown.rows);
}

// The claims with one verdict, or all of them.
export function showClaims({header, rows, verdicts, counts, note}, wanted) {
  const kept = rows.filter((_, i) => wanted === "all" || verdicts[i] === wanted);
  fillTable("claims", header, kept);
  const place = document.querySelector('[data-table="claims"]');
  for (const row of place.querySelectorAll("tbody tr")) {
    [...row.cells].forEach((cell, i) => { cell.dataset.label = header[i]; });
    colourVerdicts({querySelectorAll: () => [row.cells[header.length - 1]]});
  }
  document.querySelector("[data-claims-note]").textContent = note;
  const counted = Object.entries(counts).map(([verdict, count]) => `${count} ${verdict}`).join(", ");
  document.querySelector('[data-status="claims"]').textContent = `${kept.length} of ${rows.length} claims shown; ${counted}`;
}

// The figures of the studies, drawn when one of them comes into sight.
export function watchStudies(link) {
  const studies = document.querySelectorAll("#published .study");
  for (const study of studies) colourVerdicts(study);
  seen(studies, () => link.ask("published.studies", "studies", {}, {
    answer: ({panels}) => {
      const places = [...document.querySelectorAll("#published .study .plot")].map(({id}) => id.replace("plot-", ""));
      embedded(() => Object.fromEntries(panels.map((panel, i) => [places[i], studyFigure(panel)])));
    },
  }));
}

// Call once, when one of the elements comes into sight.
function seen(elements, act) {
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some(({isIntersecting}) => isIntersecting)) return;
    observer.disconnect();
    act();
  }, {rootMargin: "200px"});
  for (const element of elements) observer.observe(element);
}

// Figures 1 and 2, computed when they come into sight.
export class Bodies {
  #plots; #root = document.querySelector("#published-bodies"); #found = new Map(); #waiting;

  constructor(link) {
    this.#waiting = new Waiting(this.#root.querySelector(".status"), link, () => this.#stopped("stopped"));
    this.#root.querySelector("#published-press").addEventListener("click", () => this.#press());
  }

  // Embed the figures and compute as soon as they come into sight.
  watch() {
    seen([this.#root], () => {
      embedded(() => bodyFigures(ROWS)).then((plots) => { this.#plots = plots; this.#press(); });
    });
  }

  recolour() {
    const palette = ["paper", "ink"].map(colour);
    for (const row of this.#found.keys()) this.#plots.model(`contact ${row} colours`).setv({palette});
  }

  #press() {
    this.#root.querySelector("#published-press").hidden = true;
    this.#say("Four surfaces and four lines are pressed; this takes some seconds.");
    for (let row = 0; row < ROWS; row++) {
      if (this.#found.has(row)) continue;
      this.#waiting.ask("published.body", `body ${row}`, {row}, {answer: (header) => this.#draw(header), error: (sentence) => this.#stopped(sentence)});
    }
  }

  #stopped(sentence) {
    this.#say(sentence);
    this.#root.querySelector("#published-press").hidden = false;
  }

  #draw({row, D_f, level, deepest, points, contact, springs, force_bar, arrays}) {
    const plots = this.#plots;
    this.#found.set(row, {D_f, deepest, contact, springs});
    this.#waiting.progress({done: this.#found.size, total: ROWS, left: null});
    const z = Array.from(arrays.line.values), x = z.map((_, i) => i / z.length);
    plots.set(`line ${row}`, {x, z});
    for (const what of ["topography", "contact", "deflection"]) plots.setMap(`${what} ${row}`, arrays[what], [1, 1], [0, 1]);
    this.recolour();
    const all = Math.max(...[...this.#found.values()].map((each) => each.deepest));
    document.querySelector("[data-deepest]").textContent = all.toPrecision(3);
    for (const each of this.#found.keys()) plots.model(`deflection ${each} colours`).setv({low: 0, high: all});
    document.querySelector(`[data-body="${row}"]`).textContent = `contact ${contact}`;
    if (row === INDENTED) this.#drawIndented(x, z, level);
    document.querySelector('[data-caption="bodies"]').textContent = `Surfaces of ${points} points, F̄ = ${force_bar}; all deflections have one scale.`;
    fillTable("published-bodies", ["D_f", "real contact of the surface", "springs of the line in contact", "largest deflection u / h"],
      [...this.#found].sort().map(([, each]) => [each.D_f, each.contact, each.springs, each.deepest.toPrecision(3)]));
    if (this.#found.size === ROWS) { this.#say(""); this.#root.querySelector(".status").hidden = true; }
  }

  #drawIndented(x, z, level) {
    const bottom = Math.min(...z) - 1.2;
    this.#plots.set("indented", {
      x, z, level: z.map(() => level), above: z.map((height) => Math.max(height, level)),
      bar: z.map((height) => (height > level ? bottom : NaN)),
    });
    this.#plots.model("published-indented").y_range.setv({start: bottom - 0.3, end: Math.max(...z) + 2.2});
  }

  #say(text) { this.#root.querySelector("[data-status]").textContent = text; }
}
