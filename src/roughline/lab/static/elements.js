// Make an element of its properties and of what is in it.
export function element(kind, properties = {}, ...inside) {
  const made = Object.assign(document.createElement(kind), properties);
  made.append(...inside);
  return made;
}

const SYMBOL = /(_[A-Za-z0-9]+|\^-?[\wα-ω]+(?:\.\d+)?|(?<=\d)e-?\d+)/;

// A text in pieces: what follows an underscore is set low, and powers high.
export function typeset(text) {
  return text.split(SYMBOL).filter(Boolean).flatMap((part) => {
    if (!SYMBOL.test(part)) return part;
    if (part[0] === "_") return element("sub", {textContent: part.slice(1)});
    const textContent = part.slice(1).replace(/^-0*/, "−");
    return [part[0] === "e" ? "·10" : "", element("sup", {textContent})];
  });
}
