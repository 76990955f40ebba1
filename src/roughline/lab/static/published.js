// The paper: its figures from the published study, with windows and averages to choose.
import {Controls} from "./controls.js";
import {onDraw, onTouch} from "./hands.js";
import {embedded} from "./plots.js";
import {publishedFigures} from "./published-figures.js";
import {drawArea, drawExponents, drawFits, drawStiffness, showFits, tableOfExponents} from "./published-curves.js";
import {Bodies, drawPoint, drawTrust, showClaims, watchStudies} from "./published-maps.js";
import {Strip} from "./strip.js";
import {Waiting} from "./waiting.js";

const MODELS = ["1D", "3D"];
const EDGES = {"1D": ["low_1D", "high_1D"], "3D": ["low_3D", "high_3D"]};
const STRIP = ["exponent_1D", "stated_1D", "exponent_3D", "stated_3D"];
const LATEST = 2000; // that the plots, which keep the page busy, wait for the first numbers [ms]
const OF_THE_POINT = ["roll_off", "map_D_f", "map_F", "tolerance"];

export async function open(link, address, said) {
  const view = new Published(link, address);
  await view.open(said);
  return view;
}

class Published {
  #link; #address; #root = document.querySelector("#published"); #controls; #plots; #bodies; #strip; #waiting;
  #got = {fits: {}}; #later = new Set(); #state = {}; #placing = false; #opening = true;

  constructor(link, address) {
    this.#link = link;
    this.#address = address;
    this.#controls = new Controls(this.#root, (key) => this.#changed(key));
    this.#bodies = new Bodies(link);
    this.#strip = new Strip(this.#root.querySelector(".strip"), STRIP);
    this.#waiting = new Waiting(this.#root.querySelector('[aria-labelledby="claims-title"] .status'), link, () => this.#status("stopped"));
    this.#bindButtons();
  }

  #firstNumbers; #numbers = new Promise((resolve) => { this.#firstNumbers = resolve; });

  async open(said) {
    const {view, ...texts} = said;
    this.#controls.take(texts);
    this.#askAll();
    await Promise.race([this.#numbers, new Promise((resolve) => setTimeout(resolve, LATEST))]);
    const rollOffs = [...this.#root.querySelectorAll("[data-trust]")].map((each) => each.dataset.trust);
    this.#plots = await embedded(() => publishedFigures(rollOffs));
    for (const model of MODELS) this.#bindWindow(model);
    this.#bindMaps();
    this.#drawAll();
    this.#bodies.watch();
    watchStudies(this.#link);
    new MutationObserver(() => { this.#drawAll(); this.#bodies.recolour(); })
      .observe(document.documentElement, {attributeFilter: ["data-theme"]});
    this.#opening = false;
    this.#askClaims();
  }

  shown() { this.#address.write("published", this.#state); }

  #askAll() {
    for (const model of MODELS) this.#askFits(model);
    this.#askPoint();
    for (const name of Object.keys(this.#drawn)) this.#askFor(name);
    if (!this.#opening) this.#askClaims(); // else it waits, as it takes all of a core
  }

  #askFits(model) {
    this.#ask("fits", `fits ${model}`, {model}, (header) => {
      this.#got.fits[model] = header;
      this.#root.querySelector(`[data-fit-error="${model}"]`).textContent =
        EDGES[model].map((key) => header.refused[key]).filter(Boolean).join(" ");
      this.#showStrip();
      if (Object.keys(this.#got.fits).length === MODELS.length) this.#firstNumbers();
      if (this.#plots) this.#drawFits(model);
      else showFits(header);
      tableOfExponents(this.#got.fits, this.#got.exponents);
    });
  }

  #askFor(name) {
    this.#ask(name, name, {}, (header) => {
      this.#got[name] = header;
      this.#draw(name);
    });
  }

  #askPoint() {
    this.#ask("point", "point", {}, (header) => {
      this.#got.point = header;
      this.#drawPoint();
    });
  }

  #askClaims() {
    this.#status("The claims are judged by resampling all realisations; this takes some seconds.");
    this.#waiting.begin("claims");
    this.#ask("claims", "claims", {}, (header) => {
      this.#waiting.end("claims");
      this.#got.claims = header;
      this.#showClaims();
    }, (sentence) => { this.#waiting.end("claims"); this.#status(sentence); });
  }

  // Ask; while an answer is awaited, a newer question waits for it, so that a moving window is followed.
  #ask(task, slot, more, answer, failed) {
    if (this.#link.isWaiting(slot)) {
      this.#later.add(slot);
      this.#again.set(slot, () => this.#ask(task, slot, more, answer, failed));
      return;
    }
    const ended = () => { if (this.#later.delete(slot)) this.#again.get(slot)(); };
    const asked = this.#controls.asked;
    this.#link.ask(`published.${task}`, slot, {...asked, ...more}, {
      answer: (header) => {
        if (header.refused) this.#settled(header, asked);
        answer(header);
        ended();
      },
      error: (sentence, at) => { failed?.(sentence); this.#refuse(sentence, at); ended(); },
    });
  }
  #again = new Map();

  #changed(key) {
    this.#ofLink = "";
    const model = MODELS.find((each) => EDGES[each].includes(key));
    if (model) this.#askFits(model);
    else if (OF_THE_POINT.includes(key)) this.#askPoint();
    else if (key === "claims") this.#showClaims();
    else {
      this.#askFor("curves");
      for (const each of MODELS) this.#askFits(each);
      if (key === "D_f") this.#askFor("area");
    }
  }

  #settled(header, asked) {
    const elsewhere = this.#controls.answered(asked, header);
    this.#controls.refuse("", [this.#ofLink, elsewhere].filter(Boolean).join(" "));
    this.#state = {...header.state, claims: this.#claims};
    if (!this.#root.hidden) this.#address.write("published", this.#state);
  }

  get #claims() { return this.#controls.used.claims ?? "all"; }

  #ofLink = ""; // why the link that was opened is not shown

  // Put a sentence at its control; the defaults take the place of a link that cannot be read.
  #refuse(sentence, at) {
    if (at === "v") {
      if (this.#ofLink) return;
      this.#ofLink = sentence;
      this.#controls.take({});
      this.#askAll();
    } else if (!this.#controls.refuse(at, sentence)) this.#controls.refuse("", sentence);
  }

  // What is drawn of answers.
  #drawn = {
    curves: (plots, {models}) => { for (const model of MODELS) drawStiffness(plots, model, models[model]); },
    exponents: (plots, header) => { drawExponents(plots, header); tableOfExponents(this.#got.fits, header); },
    area: drawArea,
    trust: (plots, header) => { drawTrust(plots, header); this.#drawPoint(); },
  };

  #draw(name) { if (this.#plots && this.#got[name]) this.#drawn[name](this.#plots, this.#got[name]); }

  #drawAll() {
    for (const name of Object.keys(this.#drawn)) this.#draw(name);
    for (const model of MODELS) if (this.#got.fits[model]) this.#drawFits(model);
  }

  #drawFits(model) {
    const fits = this.#got.fits[model], [left, right] = fits.window;
    drawFits(this.#plots, fits);
    if (this.#moving === model) return;
    this.#placing = true;
    this.#plots.model(`window ${model}`).setv({left, right});
    this.#placing = false;
  }

  #drawPoint() {
    const {point, trust} = this.#got;
    if (point) drawPoint(this.#plots, trust, point.state, point.numbers, point);
  }

  #showClaims() {
    const wanted = this.#claims;
    if (this.#got.claims) showClaims(this.#got.claims, wanted);
    if (Object.keys(this.#state).length) {
      this.#state = {...this.#state, claims: wanted};
      if (!this.#root.hidden) this.#address.write("published", this.#state);
    }
  }

  #showStrip() {
    this.#strip.add(MODELS.flatMap((model) => this.#got.fits[model]?.strip ?? []));
    for (const item of this.#root.querySelectorAll('.strip [data-answer^="stated"]')) {
      item.dataset.verdict = item.querySelector("dd").textContent;
    }
  }

  #status(text) { this.#root.querySelector('[data-status="claims"]').textContent = text; }

  #moving = null; #rest = null; // the model whose window is held by the mouse

  #bindWindow(model) {
    const box = this.#plots.model(`window ${model}`), plot = this.#plots.model(`published-stiffness-${model}`);
    const moved = () => { if (!this.#placing) this.#windowMoved(model, box.left, box.right); };
    for (const side of ["left", "right"]) box.properties[side].change.connect(moved);
    plot.on_event("selectiongeometry", ({geometry}) => {
      if (geometry.type === "rect" && geometry.x0 !== geometry.x1) this.#windowMoved(model, geometry.x0, geometry.x1);
    });
    onDraw(plot, this.#root.querySelector(`[data-draw="${model}"]`), (from, to) => {
      if (from.x === to.x) return;
      box.setv({left: Math.min(from.x, to.x), right: Math.max(from.x, to.x)});
    });
  }

  #windowMoved(model, left, right) {
    this.#moving = model;
    const [first, last] = EDGES[model];
    this.#controls.take({
      ...this.#controls.said,
      [first]: this.#controls.within(first, Math.min(left, right)),
      [last]: this.#controls.within(last, Math.max(left, right)),
    });
    this.#changed(first);
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => {
      this.#moving = null;
      if (this.#got.fits[model]) this.#drawFits(model);
    }, 400);
  }

  #bindMaps() {
    for (const panel of this.#root.querySelectorAll("[data-trust]")) {
      onTouch(this.#plots.root(`published-trust-${panel.dataset.trust}`), ({x, y}) => {
        const [map_F, map_D_f] = [this.#controls.within("map_F", x), this.#controls.within("map_D_f", y)];
        this.#controls.take({...this.#controls.said, roll_off: panel.dataset.trust, map_F, map_D_f});
        this.#changed("map_F");
      });
    }
  }

  #bindButtons() {
    this.#root.querySelector("#published-windows").addEventListener("click", () => {
      const kept = Object.entries(this.#controls.said).filter(([key]) => !Object.values(EDGES).flat().includes(key));
      this.#controls.take(Object.fromEntries(kept));
      for (const model of MODELS) this.#askFits(model);
    });
  }
}
