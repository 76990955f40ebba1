// Sliders, their text fields and choices of one view, and the texts that they stand for.
import {letScroll} from "./hands.js";

const STEPS = 1000; // of a slider on a logarithmic scale

export class Controls {
  #root; #changed; #said = {}; #defaults = {};

  // changed(key, isFinal) is called when something is set; isFinal is false while a slider moves.
  constructor(root, changed) {
    this.#root = root;
    this.#changed = changed;
    for (const slider of root.querySelectorAll('input[type="range"]')) this.#bindSlider(slider);
    for (const text of root.querySelectorAll("input[data-text]")) {
      text.addEventListener("change", () => this.#typed(text.dataset.text, text.value));
      text.addEventListener("keydown", (event) => {
        if (event.key === "Enter") { event.preventDefault(); this.#typed(text.dataset.text, text.value); }
      });
    }
    for (const choice of root.querySelectorAll('select[data-key], input[type="radio"][data-key]')) {
      choice.addEventListener("change", () => {
        if (choice.type !== "radio" || choice.checked) this.set(choice.dataset.key, choice.value, true);
      });
    }
    root.addEventListener("submit", (event) => {
      if (event.target.method !== "dialog") event.preventDefault();
    });
    for (const choice of root.querySelectorAll('select[data-key], input[type="radio"][data-key]')) {
      if (choice.type !== "radio" || choice.defaultChecked) this.#defaults[choice.dataset.key] = choice.value;
    }
    for (const text of root.querySelectorAll("input[data-text]")) this.#defaults[text.dataset.text] = text.value;
  }

  // Texts by key: what the server reads.
  get said() { return {...this.#said}; }

  set(key, text, isFinal = true) {
    this.#said[key] = text;
    this.refuse(key, "");
    this.#changed(key, isFinal);
  }

  // Take texts from an address, without telling anyone; what it does not say has its default.
  take(said) {
    this.#said = {...said};
    for (const [key, text] of Object.entries({...this.#defaults, ...said})) this.#show(key, text);
  }

  // Show where numbers stand after the server has read their texts.
  showNumbers(numbers) {
    for (const [key, value] of Object.entries(numbers)) {
      const slider = this.#slider(key);
      if (slider && document.activeElement !== slider) place(slider, value);
      const text = this.#text(key);
      const hasUnit = Number.isNaN(Number(this.#said[key] ?? value)); // stays as it was typed
      if (text && document.activeElement !== text && !hasUnit) text.value = said(value);
    }
  }

  // Write a sentence beside a control; an empty one takes it away. Tells whether it can be seen there.
  refuse(key, sentence) {
    const place = this.#root.querySelector(`[data-error="${CSS.escape(key)}"]`);
    if (!place) return false;
    if (place.textContent === sentence) return true;
    place.textContent = sentence;
    this.#text(key)?.setAttribute("aria-invalid", String(sentence !== ""));
    return sentence === "" || place.parentElement.checkVisibility();
  }

  // Take all sentences away: all that is set was used.
  accept() {
    for (const {dataset} of this.#root.querySelectorAll("[data-error]")) this.refuse(dataset.error, "");
  }

  #bindSlider(slider) {
    const {low, high, scale, step, key} = slider.dataset;
    const whole = scale === "whole", linear = scale === "linear" || whole;
    Object.assign(slider, linear ? {min: low, max: high, step} : {min: 0, max: STEPS, step: STEPS * step / Math.log10(high / low)});
    place(slider, Number(slider.dataset.default));
    this.#text(key).value = said(Number(slider.dataset.default));
    const moved = (isFinal) => {
      const text = said(number(slider));
      this.#text(key).value = text;
      slider.setAttribute("aria-valuetext", text);
      this.set(key, text, isFinal);
    };
    letScroll(slider);
    let byPointer = false; // a key that is pressed again and again rests between
    slider.addEventListener("pointerdown", () => { byPointer = true; });
    slider.addEventListener("keydown", () => { byPointer = false; });
    slider.addEventListener("input", () => moved(false));
    slider.addEventListener("change", () => { if (byPointer) moved(true); });
  }

  #typed(key, text) {
    if (this.#said[key] !== text) this.set(key, text, true);
  }

  #show(key, text) {
    for (const radio of this.#root.querySelectorAll(`input[type="radio"][data-key="${CSS.escape(key)}"]`)) {
      radio.checked = radio.value === text;
    }
    const select = this.#root.querySelector(`select[data-key="${CSS.escape(key)}"]`);
    if (select) select.value = text;
    const field = this.#text(key);
    if (field) field.value = text;
    const slider = this.#slider(key);
    if (slider && text && Number.isFinite(Number(text))) place(slider, Number(text));
  }

  #slider(key) { return this.#root.querySelector(`input[type="range"][data-key="${CSS.escape(key)}"]`); }
  #text(key) { return this.#root.querySelector(`input[data-text="${CSS.escape(key)}"]`); }
}

// A number as it is typed: four digits, no exponent where it is short.
export function said(value) {
  const rounded = Number(value.toPrecision(4));
  return rounded !== 0 && Math.abs(rounded) < 1e-4 ? rounded.toExponential() : String(rounded);
}

function place(slider, value) {
  slider.value = position(slider, value);
  slider.setAttribute("aria-valuetext", said(value));
}

function position(slider, value) {
  const {low, high, scale} = slider.dataset;
  return scale === "logarithmic" ? (STEPS * Math.log(value / low)) / Math.log(high / low) : value;
}

function number(slider) {
  const {low, high, scale} = slider.dataset;
  return scale === "logarithmic" ? low * (high / low) ** (slider.value / STEPS) : Number(slider.value);
}
