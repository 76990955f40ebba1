// Numbers and words beside the plots: tables, lists, large figures, and what the colours of a map mean.
import {element} from "./elements.js";

const unread = new WeakMap(); // folds that are closed, and what fills them

// Put rows below a plot, in a fold that is closed when it is opened; a cell is a text, or pieces of one.
export function fillTable(id, header, rows) {
  const place = document.querySelector(`[data-table="${id}"]`), fold = place.closest("details");
  const row = (cells, kind, more) => element("tr", {}, ...cells.map((cell) => element(kind, more, ...[cell].flat())));
  const fill = () => place.replaceChildren(element("table", {},
    element("thead", {}, row(header, "th", {scope: "col"})),
    element("tbody", {}, ...rows.map((cells) => row(cells, "td")))));
  if (!fold || fold.open) { fill(); return; }
  if (!unread.has(fold)) fold.addEventListener("toggle", () => unread.get(fold).forEach((each) => each()));
  unread.set(fold, (unread.get(fold) ?? new Map()).set(id, fill));
}

// Fold the rows of a table behind the headlines of their groups, which are given with the number of
// rows of each; those of the first are shown.
export function foldRows(id, groups) {
  const table = document.querySelector(`[data-table="${id}"] table`);
  const rows = [...table.tBodies[0].rows], colSpan = table.tHead.rows[0].cells.length;
  table.tBodies[0].remove();
  for (const [i, [name, told, count]] of groups.entries()) {
    const button = element("button", {type: "button", className: "fold"});
    const body = element("tbody", {}, ...rows.splice(0, count));
    const show = (isShown) => {
      body.hidden = !isShown;
      button.setAttribute("aria-expanded", String(isShown));
      button.textContent = isShown ? name : `${name}: ${told}`;
    };
    button.addEventListener("click", () => show(body.hidden));
    table.append(element("tbody", {}, element("tr", {}, element("th", {colSpan, scope: "rowgroup"}, button))), body);
    show(i === 0);
  }
}

// Fill a list of sentences; without any it is not there.
export function fillList(list, sentences) {
  list.replaceChildren(...sentences.map((textContent) => element("li", {textContent})));
  list.hidden = sentences.length === 0;
}

// What was asked in words, and the answers that lead in large figures.
export function fillFigures(place, lead, figures) {
  place.querySelector("[data-lead]").textContent = lead;
  place.querySelector("dl").replaceChildren(...figures.map(({name, value, interval}) => element("div", {},
    element("dt", {textContent: name}), ...[value, interval].map((textContent) => element("dd", {textContent})))));
}

const MEANINGS = { // of the colours of marks
  ink: "in contact",
  plastic: "of this at the hardness: permanently indented",
  reach: "reached by the fluid",
  pull: "pulled across a gap",
};

// Say in a caption what a map shows, and what the colours of its marks mean.
export function fillCaption(place, caption, marks = []) {
  const patches = marks.flatMap((name) => [element("span", {className: `patch ${name}`}), MEANINGS[name]]);
  place.replaceChildren(caption, ...patches);
}
