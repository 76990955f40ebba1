// What the figures of the paper show: curves by fractal dimension, fits, exponents, κ.
import {colour as colourOf} from "./plots.js";
import {fillTable} from "./tables.js";

const MARKERS = ["circle", "square", "diamond", "triangle", "inverted_triangle", "plus"];
const MOST_MARKS = 24;

// Curves with marks; the part where the grid decides is dashed.
export function drawCurves(plots, name, curves) {
  const sure = {xs: [], ys: [], colour: []}, unsure = {xs: [], ys: [], colour: []};
  const bands = {xs: [], ys: [], colour: []};
  const marks = {x: [], y: [], colour: [], marker: [], D_f: []};
  for (const {index, D_f, force_bar, mean, low, high, resolved} of curves) {
    const colour = colourOf(`ramp-${index}`);
    for (const [part, wanted] of [[sure, true], [unsure, false]]) {
      for (const {xs, ys} of runs(force_bar, mean, resolved, wanted)) {
        part.xs.push(xs);
        part.ys.push(ys);
        part.colour.push(colour);
      }
    }
    if (low) {
      bands.xs.push([...force_bar, ...force_bar.toReversed()]);
      bands.ys.push([...low, ...high.toReversed()]);
      bands.colour.push(colour);
    }
    const spacing = Math.max(1, Math.floor(force_bar.length / MOST_MARKS));
    force_bar.forEach((force, i) => {
      if (!resolved[i] || i % spacing) return;
      marks.x.push(force);
      marks.y.push(mean[i]);
      marks.colour.push(colour);
      marks.marker.push(MARKERS[index]);
      marks.D_f.push(D_f);
    });
  }
  plots.set(`${name} sure`, sure);
  plots.set(`${name} unsure`, unsure);
  plots.set(`${name} marks`, marks);
  if (plots.model(`${name} bands`)) plots.set(`${name} bands`, bands);
}

// Stretches of a curve that are resolved, or that are not; the latter reach to the next sure load.
function runs(force, mean, resolved, wanted) {
  const found = [];
  let current = null;
  force.forEach((x, i) => {
    if (mean[i] !== null && resolved[i] === wanted) {
      if (!current) found.push((current = {xs: [], ys: []}));
      current.xs.push(x);
      current.ys.push(mean[i]);
    } else if (current) {
      if (!wanted && mean[i] !== null) { current.xs.push(x); current.ys.push(mean[i]); }
      current = null;
    }
  });
  return found;
}

export function drawStiffness(plots, model, {curves, saturated, label, header, rows}) {
  drawCurves(plots, `stiffness ${model}`, curves);
  plots.model(`saturated ${model}`).location = saturated;
  plots.label(`published-stiffness-${model}`, null, label);
  fillTable(`published-stiffness-${model}`, header, rows);
}

// The fitted lines, the table of exponents, and the marks of Figure 5.
export function drawFits(plots, {model, laws, header, rows, note}) {
  plots.set(`stiffness ${model} fits`, {xs: laws.map(({x}) => x), ys: laws.map(({y}) => y)});
  plots.set(`exponents ${model}`, {
    x: laws.map(({D_f}) => D_f), y: laws.map(({exponent}) => exponent),
    low: laws.map(({interval}) => interval[0]), high: laws.map(({interval}) => interval[1]),
  });
  showFits({model, header, rows, note});
}

// The exponents as numbers, which need no plot.
export function showFits({model, header, rows, note}) {
  fillTable(`fit-${model}`, header, rows);
  colourVerdicts(document.querySelector(`[data-table="fit-${model}"]`));
  document.querySelector(`[data-fit-note="${model}"]`).textContent = note;
}

export function drawExponents(plots, {windows, D_f, scaling, linear}) {
  windows.forEach((each, i) => {
    plots.set(`exponents ${i}`, {x: each.D_f, y: each.exponent, low: each.low, high: each.high});
  });
  plots.set("prediction scaling", {x: D_f, y: scaling});
  plots.set("prediction linear", {x: D_f, y: linear});
  const caption = windows.map(({label}, i) => `${["solid", "dashed", "dotted"][i]} ${label}`).join(", ");
  document.querySelector('[data-caption="exponents"]').textContent =
    `marks: the windows chosen, with 95 % intervals; green: the published reduced model, ${caption}`;
}

// Figure 5 as a table: both models beside the two predictions.
export function tableOfExponents(fits, exponents) {
  if (!exponents || !fits["1D"] || !fits["3D"]) return;
  const rows = fits["1D"].laws.map(({D_f}, i) => {
    const at = exponents.D_f.findIndex((each) => Math.abs(each - D_f) < 1e-6);
    const [one, three] = ["1D", "3D"].map((model) => fits[model].rows[i]?.[1] ?? "-");
    return [D_f.toFixed(1), one, three, exponents.scaling[at].toFixed(3), exponents.linear[at].toFixed(3)];
  });
  fillTable("published-exponents", ["D_f", "α 1D", "α 3D", "1 / (4 - D_f)", "0.2567 D_f"], rows);
}

export function drawArea(plots, {curves, window, kappas, theories, header, rows, area_table}) {
  drawCurves(plots, "area", curves);
  plots.model("window area").setv({left: window[0], right: window[1]});
  for (const [name, columns] of Object.entries(kappas)) plots.set(`kappa ${name}`, columns);
  for (const {name, kappa} of theories) plots.set(`kappa ${name}`, {x: [1.9, 3.1], y: [kappa, kappa]});
  fillTable("published-area", area_table.header, area_table.rows);
  const named = theories.map(({name, kappa}) => [name, kappa.toFixed(2), "", "", ""]);
  fillTable("published-kappa", header, [...rows, ...named]);
}

// Give the cells that hold a verdict its colour.
export function colourVerdicts(place) {
  for (const cell of place.querySelectorAll("td")) {
    const [verdict] = cell.textContent.match(/confirmed|refuted|undecided/) ?? [];
    if (verdict) cell.dataset.verdict = verdict;
  }
}
