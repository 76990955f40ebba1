// Make an element of its properties and of what is in it.
export function element(kind, properties = {}, ...inside) {
  const made = Object.assign(document.createElement(kind), properties);
  made.append(...inside);
  return made;
}

const NAMES = {
  ...{eta: "η", kappa: "κ", mu: "μ", nu: "ν", omega: "ω", phi: "φ", pi: "π", rho: "ρ", sigma: "σ"},
  m_dot: "ṁ",
};
const NAMED = new RegExp(String.raw`(?<![\p{L}\d_])(m_dot(?![\p{L}\d])|(?:${Object.keys(NAMES).slice(0, -1).join("|")})(?=_))`, "gu");
const SYMBOLS = [ // k_i and E*_l, but no names of files; powers; numbers such as 1e-05
  String.raw`(?<![\p{L}\d.])\p{L}\p{M}?\*?_(?!star)[\p{L}\d]{1,5}(?![\p{L}\d_]|\.\p{L})`,
  String.raw`\^\([^()]*\)`,
  String.raw`\^-?[\wα-ω]+(?:\.\d+)?`,
  String.raw`(?<=(?<![\p{L}\d_.-])\d+(?:\.\d+)?)e[+-]?\d+(?![\p{L}\d])`,
];
const SYMBOL = new RegExp(`(${SYMBOLS.join("|")})`, "u");

// A text in pieces: what follows the underscore of a symbol is set low, and powers high.
export function typeset(text) {
  const parts = text.replace(NAMED, (name) => NAMES[name]).split(SYMBOL);
  return parts.flatMap((part, i) => {
    if (i % 2 === 0) return part ? [part] : [];
    const [base, low] = part.split("_");
    if (low) return [base, element("sub", {textContent: low})];
    if (part[1] === "(") return [element("sup", {textContent: part.slice(2, -1)})];
    const textContent = part.slice(1).replace(/^\+?(-?)0*(?=\d)/, "$1").replace("-", "−");
    return [...(part[0] === "e" ? ["·10"] : []), element("sup", {textContent})];
  });
}
