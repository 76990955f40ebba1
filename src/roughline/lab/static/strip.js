// The answer strip: what is true now, in large figures.
import {element, typeset} from "./elements.js";

export class Strip {
  #place; #order; #items = new Map();

  // The keys of its numbers, in their order.
  constructor(place, order) {
    this.#place = place;
    this.#order = order;
  }

  // Take numbers in words: key, symbol, value, what stands below, and what it means; those of some keys go.
  add(items, gone = []) {
    for (const key of gone) this.#items.delete(key);
    for (const item of items) {
      if (!this.#items.has(item.key)) this.#items.set(item.key, {place: empty(item.key)});
      write(this.#items.get(item.key), item);
    }
    const wanted = this.#order.filter((key) => this.#items.has(key)).map((key) => this.#items.get(key).place);
    if (wanted.length !== this.#place.children.length || wanted[0] !== this.#place.children[0]) this.#place.replaceChildren(...wanted);
  }

  // Its numbers in one line, for who hears the page.
  get spoken() {
    return [...this.#items.values()].map(({said}) => `${said.symbol} ${said.value}`).join(", ");
  }
}

function empty(key) {
  const item = element("div", {}, element("dt"), element("dd"), element("dd"));
  item.dataset.answer = key;
  return item;
}

function write(item, {symbol, value, below, meaning}) {
  const {place, said} = item;
  item.said = {symbol, value, below, meaning};
  if (meaning !== said?.meaning) place.title = meaning;
  [symbol, value, below].forEach((text, i) => {
    if (said && text === [said.symbol, said.value, said.below][i]) return;
    place.children[i].replaceChildren(...typeset(text));
  });
}
