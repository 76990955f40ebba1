// The answer strip: what is true now, in large figures.
export class Strip {
  #place; #order; #items = {};

  // The keys of its numbers, in their order.
  constructor(place, order) {
    this.#place = place;
    this.#order = order;
  }

  // Take numbers in words: key, symbol, value, what stands below, and what it means.
  add(items) {
    for (const item of items) this.#items[item.key] = item;
    const shown = this.#order.filter((key) => key in this.#items).map((key) => this.#items[key]);
    fillStrip(this.#place, shown);
  }
}

// Show numbers in words, and no others.
export function fillStrip(place, items) { place.replaceChildren(...items.map(number)); }

function number({key, symbol, value, below, meaning}) {
  const item = document.createElement("div");
  item.title = meaning;
  item.dataset.answer = key;
  for (const [kind, text] of [["dt", symbol], ["dd", value], ["dd", below]]) {
    const part = document.createElement(kind);
    part.append(...withSubscripts(text));
    item.append(part);
  }
  return item;
}

// A text whose letter after an underscore is set low.
function withSubscripts(text) {
  return text.split(/_(\w)/).map((part, i) => {
    if (i % 2 === 0) return part;
    const low = document.createElement("sub");
    low.textContent = part;
    return low;
  });
}
