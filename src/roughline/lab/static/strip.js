// The answer strip: numbers in large figures, with their meaning on hover and on focus.
export function fillStrip(strip, items) {
  strip.replaceChildren(...items.map(({key, symbol, value, below, meaning}) => {
    const item = document.createElement("div");
    item.title = meaning;
    item.dataset.answer = key;
    item.tabIndex = 0;
    item.setAttribute("aria-label", `${symbol} ${value} ${below}. ${meaning}`);
    for (const [kind, text] of [["dt", symbol], ["dd", value], ["dd", below]]) {
      const part = document.createElement(kind);
      part.textContent = text;
      item.append(part);
    }
    return item;
  }));
}
