// Numbers and words beside the plots: tables, lists, large figures, and what the colours of a map mean.
import {element, typeset} from "./elements.js";

const REST = 500; // without other rows, until a table in a fold that is closed is filled, as sliders move [ms]
const later = new Map(); // what will fill them

// Put rows below a plot; a cell is a text, or pieces of one. They stand behind the headlines of their groups, which are
// given with the number of rows of each; those of the first are shown. Rows that begin with `quiet` are beside those
// above them.
export function fillTable(id, header, rows, groups = null, quiet = null) {
  const place = document.querySelector(`[data-table="${id}"]`), fold = place.closest("details:not(.step)");
  const fill = () => place.replaceChildren(tableOf(header, rows, groups, quiet));
  clearTimeout(later.get(id));
  if (fold) fold.ontoggle = () => { if (fold.open) fill(); };
  if (!fold || fold.open || !place.children.length) fill();
  else later.set(id, setTimeout(fill, REST));
}

function tableOf(header, rows, groups, quiet) {
  const pieces = (cell) => (Array.isArray(cell) ? cell : typeset(cell));
  const row = (cells, kind, more) => element("tr", {className: quiet !== null && cells[0] === quiet ? "quiet" : ""},
    ...cells.map((cell) => judged(element(kind, more, ...pieces(cell)))));
  const table = element("table", {}, element("thead", {}, row(header, "th", {scope: "col"})));
  const body = (some) => element("tbody", {}, ...some.map((cells) => row(cells, "td", {})));
  if (!groups) table.append(body(rows));
  let first = 0;
  for (const [i, [name, told, count]] of (groups ?? []).entries()) {
    const button = element("button", {type: "button", className: "fold"}), inside = body(rows.slice(first, first + count));
    first += count;
    const show = (isShown) => {
      inside.hidden = !isShown;
      button.setAttribute("aria-expanded", String(isShown));
      button.replaceChildren(...typeset(isShown ? name : `${name}: ${told}`));
    };
    button.addEventListener("click", () => show(inside.hidden));
    table.append(element("tbody", {}, element("tr", {}, element("th", {colSpan: header.length, scope: "rowgroup"}, button))), inside);
    show(i === 0);
  }
  return table;
}

// Mark an element with the verdict that its text has, or with none.
export function judged(place) {
  place.dataset.verdict = place.textContent.match(/confirmed|refuted|undecided/)?.[0] ?? "";
  return place;
}

// Fill a list of sentences; without any it is not there.
export function fillList(list, sentences) {
  list.replaceChildren(...sentences.map((each) => element("li", {}, ...typeset(each))));
  list.hidden = sentences.length === 0;
}

// Fold lists of sentences behind what they are about.
export function fillGroups(place, groups) {
  const filled = Object.entries(groups).filter(([, sentences]) => sentences.length);
  place.replaceChildren(...filled.map(([about, sentences]) => {
    const list = element("ul", {className: "remarks"});
    fillList(list, sentences);
    return element("details", {}, element("summary", {textContent: `${about} (${sentences.length})`}), list);
  }));
}

// The answers that lead, in large figures, each with what stands below; those that are the same stay as they are.
export function fillFigures(place, figures) {
  while (place.children.length > figures.length) place.lastElementChild.remove();
  for (const [i, {key = "", symbol, value, below, meaning: title = "", isBefore = false}] of figures.entries()) {
    if (!place.children[i]) place.append(element("div", {}, element("dt"), element("dd", {}, element("span"), element("small"))));
    const item = place.children[i];
    if (item.title !== title) item.title = title;
    item.classList.toggle("before", isBefore);
    if (item.dataset.answer !== key) item.dataset.answer = key;
    for (const [part, said] of Object.entries({dt: symbol, span: value, small: below})) {
      const piece = item.querySelector(part);
      if (piece.dataset.said === said) continue;
      piece.dataset.said = said;
      piece.replaceChildren(...typeset(said));
    }
  }
}

// Why answers are not known better: below the whole interval of each a bar for each cause, all on one axis; a fold that is
// open stays so.
export function fillBars(place, bars) {
  place.hidden = !bars;
  if (!bars) return;
  const [cause, ends, remedy] = bars.header;
  const svg = (kind, height, parts) => element(kind, {className: "axis", innerHTML: `<svg height="${height}" aria-hidden="true">${parts.join("")}</svg>`});
  const ticks = Object.entries(bars.ticks).map(([label, at]) =>
    `<text x="${at}%" y="12" text-anchor="${{0: "start", 100: "end"}[at] ?? "middle"}">${label}</text>`);
  const line = `<line x1="0" x2="100%" y1="7" y2="7"/><line class="value" x1="${bars.value}%" x2="${bars.value}%" y1="0" y2="14"/>`;
  const bar = ({name, ends, remedy, left, width}, i) => element("tr", {},
    element("td", {textContent: name}),
    svg("td", 14, [line, width === null ? "" : `<rect class="${i ? "" : "whole"}" x="${left}%" width="${width}%" y="3" height="8"/>`]),
    element("td", {className: "ends", textContent: ends}), element("td", {className: "remedy", textContent: remedy}));
  const head = (text) => element("th", {scope: "col", textContent: text});
  place.replaceChildren(
    element("summary", {textContent: bars.title}),
    element("p", {className: "quiet"}, ...typeset(`${bars.about} The axis is logarithmic.`)),
    element("table", {}, element("thead", {}, element("tr", {}, head(cause), svg("th", 16, ticks), head(ends), head(remedy))),
      ...bars.groups.map((group) => element("tbody", {},
        element("tr", {}, element("th", {colSpan: 4, scope: "rowgroup"}, ...typeset(group.names))), ...group.bars.map(bar)))));
}

// Say in a caption what a map shows, and what colours of the theme mean in it.
export function fillCaption(place, {caption, meanings}) {
  const said = JSON.stringify([caption, meanings]); // what is the same is not written: it comes with each picture
  if (place.dataset.said === said) return;
  place.dataset.said = said;
  place.replaceChildren(caption, ...Object.entries(meanings).map(([name, meaning]) => patch(`var(--${name})`, meaning)));
}

// A colour and its meaning, which stay together.
export function patch(shown, meaning) { return element("span", {className: "patch", style: `--shown: ${shown}`, textContent: meaning}); }
