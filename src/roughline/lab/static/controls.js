// Sliders, their text fields and choices of one view, and the texts that they stand for.
import {typeset} from "./elements.js";
import {letScroll} from "./hands.js";

const CHOICES = ':is(select, input[type="radio"], input[type="checkbox"])[data-key]';

export class Controls {
  #root; #changed; #said = {}; #defaults = {};
  #places = new Map(); // elements by selectors
  #used = {}; // texts that the server used last
  #refused = new Set(); // keys of those that it does not use
  #ofLink = ""; // why the link that was opened is not shown

  // changed(key, isFinal) is called when something is set; isFinal is false while a slider moves.
  constructor(root, changed) {
    this.#root = root;
    this.#changed = changed;
    for (const slider of root.querySelectorAll('input[type="range"]')) this.#bindSlider(slider);
    for (const text of root.querySelectorAll("input[data-text]")) {
      const key = text.dataset.text;
      this.#defaults[key] = text.value;
      text.addEventListener("change", () => { if (this.#said[key] !== text.value) this.set(key, text.value); });
    }
    for (const choice of root.querySelectorAll(CHOICES)) {
      const {key} = choice.dataset;
      choice.addEventListener("change", () => this.set(key, chosen(this.#choices(key), "checked")));
      this.#defaults[key] ??= chosen(this.#choices(key), "defaultChecked");
    }
    for (const beside of root.querySelectorAll(":scope > .controls")) keepInSight(beside);
    root.addEventListener("submit", (event) => {
      if (event.target.method !== "dialog") event.preventDefault();
    });
  }

  // Texts by key, as they were set.
  get said() { return {...this.#said}; }

  // What the server is asked with: all texts, those that count where one cannot be used, and which are red.
  get asked() { return {state: this.said, before: {...this.#used}, red: [...this.#refused]}; }

  // Texts as they stand at the controls: what was set, and else the defaults.
  get shown() { return {...this.#defaults, ...this.used}; }

  isRefused(key) { return this.#refused.has(key); }

  // Texts that count.
  get used() {
    const others = Object.entries(this.#said).filter(([key]) => !this.#refused.has(key));
    const before = Object.entries(this.#used).filter(([key]) => this.#refused.has(key));
    return Object.fromEntries([...others, ...before]);
  }

  set(key, text, isFinal = true) {
    const {[key]: _, ...others} = this.#said;
    this.#said = {...others, [key]: text}; // what was changed last is at the end
    this.#ofLink = "";
    this.#refused.delete(key);
    this.#changed(key, isFinal);
  }

  // Set a text, and show it at its control.
  put(key, text, isFinal = true) {
    this.#show(key, text);
    this.set(key, text, isFinal);
  }

  // A number as the text of a control, within the ends of its slider.
  within(key, value) {
    return said(this.#slider(key), value);
  }

  // Take texts from an address, without telling anyone; what it does not say has its default.
  take(said) {
    this.#said = {...said};
    for (const key of Object.keys(this.#used)) if (!(key in said)) delete this.#used[key];
    for (const [key, text] of Object.entries({...this.#defaults, ...said})) this.#show(key, text);
  }

  // Take an answer of the server to what it was asked: which texts it does not use and why, the numbers that it
  // used, and the lower ends of sliders that have others now. It is about `keys`, or about all controls.
  // Sentences that cannot be seen at a control stand at the head of the view.
  answered({state}, {refused, numbers = {}, lows = {}}, keys = this.#keys) {
    const isAsAsked = (key) => state[key] === this.#said[key]; // or it has changed since
    const elsewhere = [];
    for (const key of new Set([...keys, ...Object.keys(refused)])) {
      if (!(key in refused)) {
        if (key in state) this.#used[key] = state[key];
        else delete this.#used[key];
      }
      if (!isAsAsked(key)) continue;
      if (key in refused) this.#refused.add(key);
      else this.#refused.delete(key);
      if (!this.refuse(key, refused[key] ?? "")) elsewhere.push(refused[key]);
    }
    for (const [key, low] of Object.entries(lows)) {
      const slider = this.#slider(key);
      if (Number(slider.dataset.low) === low) continue;
      slider.dataset.low = low;
      span(slider);
    }
    for (const [key, value] of Object.entries(numbers)) {
      if (!(key in refused) && isAsAsked(key)) this.#showNumber(key, value);
    }
    this.refuse("", [this.#ofLink, ...elsewhere].join(" ").trim());
  }

  get #keys() {
    const places = this.#all("[data-error]").map(({dataset}) => dataset.error);
    return [...places.filter(Boolean), ...Object.keys(this.#said)];
  }

  // Say why a question is refused: at its control, or else at the head of the view. Of a link that cannot be read that is
  // said until something is set, and `begin` takes the defaults in its place.
  deny(sentence, at, begin) {
    if (at !== "v") {
      if (!this.refuse(at, sentence)) this.refuse("", sentence);
    } else if (!this.#ofLink) {
      this.#ofLink = sentence;
      begin();
    }
  }

  // Write a sentence beside a control; an empty one takes it away. Tells whether it can be seen there.
  refuse(key, sentence) {
    const [place] = this.#all(`[data-error="${CSS.escape(key)}"]`);
    if (!place) return !sentence;
    if ((place.dataset.sentence ?? "") !== sentence) {
      place.dataset.sentence = sentence;
      const parts = sentence.split(/("[^"]*")/); // what is quoted stays as it was typed
      place.replaceChildren(...parts.flatMap((part, i) => (i % 2 ? [part] : typeset(part))));
      this.#text(key)?.setAttribute("aria-invalid", String(sentence !== ""));
    }
    return sentence === "" || place.parentElement.checkVisibility();
  }

  #bindSlider(slider) {
    const {key} = slider.dataset;
    span(slider);
    this.#show(key, slider.dataset.default);
    const moved = (isFinal) => {
      const isDefault = Number(slider.value) === position(slider, Number(slider.dataset.default));
      const value = isDefault ? Math.max(slider.dataset.default, slider.dataset.low) : number(slider);
      this.#text(key).value = slider.ariaValueText = shown(value);
      this.set(key, isDefault ? slider.dataset.default : said(slider, value), isFinal);
    };
    letScroll(slider);
    let byPointer = false; // a key that is pressed again and again rests between
    slider.addEventListener("pointerdown", () => { byPointer = true; });
    slider.addEventListener("keydown", () => { byPointer = false; });
    slider.addEventListener("input", () => moved(false));
    slider.addEventListener("change", () => { if (byPointer) moved(true); });
    for (const place of [slider, ...this.#text(key).labels]) { // a double click brings the default back
      place.addEventListener("dblclick", () => this.put(key, slider.dataset.default));
    }
  }

  #show(key, text) {
    for (const choice of this.#choices(key)) {
      if (choice.matches("select")) choice.value = text;
      else choice.checked = text.split(",").includes(choice.value);
    }
    const field = this.#text(key), slider = this.#slider(key), value = Number(text);
    const isOfSlider = slider && text && [slider.dataset.default, said(slider, value)].some((each) => Number(each) === value);
    if (field) field.value = isOfSlider ? shown(value) : text;
    if (slider && text && Number.isFinite(value)) place(slider, value);
  }

  // Show a number that is used, unless what was typed says the same already.
  #showNumber(key, value) {
    const slider = this.#slider(key), field = this.#text(key);
    if (!slider && !field) { this.#show(key, String(value)); return; }
    if (slider && document.activeElement !== slider) place(slider, value);
    const typed = this.#said[key], isWithUnit = Boolean(typed) && Number.isNaN(Number(typed));
    if (document.activeElement === field || isWithUnit || (typed && Number(typed) === value)) return;
    field.value = slider ? shown(value) : String(value);
  }

  #choices(key) { return this.#all(`${CHOICES}[data-key="${CSS.escape(key)}"]`); }
  #slider(key) { return this.#all(`input[type="range"][data-key="${CSS.escape(key)}"]`)[0]; }
  #text(key) { return this.#all(`input[data-text="${CSS.escape(key)}"]`)[0]; }

  // Elements of the page, which stay: each answer asks for all of them.
  #all(selector) {
    if (!this.#places.has(selector)) this.#places.set(selector, [...this.#root.querySelectorAll(selector)]);
    return this.#places.get(selector);
  }
}

// The word that is chosen; of boxes all that are, with commas between.
function chosen(choices, which) {
  return choices.filter((each) => each[which] ?? true).map(({value}) => value).join(",");
}

// A number as the text of a slider, within its ends: three digits, no exponent where it is short.
function said({dataset: {low, high}}, value) {
  const rounded = Number(value.toPrecision(3));
  if (Math.min(value, rounded) <= low) return low;
  if (Math.max(value, rounded) >= high) return high;
  return rounded < 1e-4 ? rounded.toExponential() : String(rounded);
}

// A number as it is shown: three digits, with zeros at its end.
function shown(value) {
  if (value === 0 || value >= 999.5) return String(Math.round(value));
  return value < 1e-4 ? value.toExponential(2) : value.toPrecision(3);
}

function place(slider, value) {
  const at = String(position(slider, value)), text = shown(value); // what is the same is not written, as answers come often
  if (slider.value !== at) slider.value = at;
  if (slider.ariaValueText !== text) slider.ariaValueText = text;
}

// Steps of a slider; on a logarithmic scale as many as lie between its ends, each as near to its own step as can be.
function span(slider) {
  const {low, high, scale, step} = slider.dataset;
  const isLinear = scale === "linear";
  Object.assign(slider, isLinear ? {min: low, max: high, step} : {min: 0, max: Math.round(Math.log10(high / low) / step), step: 1});
}

function position(slider, value) {
  const {low, high, scale} = slider.dataset;
  if (scale === "linear") return value;
  const share = Math.log(value / low) / Math.log(high / low);
  return Math.round(slider.max * Math.min(Math.max(share, 0), 1));
}

function number(slider) {
  const {low, high, scale} = slider.dataset;
  return scale === "linear" ? Number(slider.value) : low * (high / low) ** (slider.value / slider.max);
}

// Let controls stay in sight while the page scrolls: by their end, if they are longer than the window.
function keepInSight(controls) {
  const fit = () => controls.style.setProperty("top", `${Math.min(0, innerHeight - controls.offsetHeight)}px`);
  new ResizeObserver(fit).observe(controls);
  addEventListener("resize", fit);
}
