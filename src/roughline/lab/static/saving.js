// What is drawn is saved as it is drawn: the pictures of plots, with their words above them, and the points of curves.
import {element} from "./elements.js";

const GAP = 16, LINE = 20, KEY = 14; // between pictures, of words, and of the key of a curve [px]

// Have the browser save a file.
export function save(name, content) {
  const address = URL.createObjectURL(content);
  element("a", {href: address, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

// The plots in panels, side by side, as PNG, each with what is remarked on its panel.
export async function pictureOf(plots, panels, remarkOn) {
  const style = getComputedStyle(document.body), pictures = panels.map((panel) => {
    const {canvas} = Bokeh.index.find_one(plots.root(panel.id)).export("png", true);
    return {canvas, words: wordsOf(panel, remarkOn(panel)), width: panel.querySelector(".plot").clientWidth};
  });
  const scale = pictures[0].canvas.width / pictures[0].width, lines = Math.max(...pictures.map(({words}) => words.length));
  const made = element("canvas", {
    width: pictures.reduce((sum, {canvas}) => sum + canvas.width + GAP * scale, GAP * scale),
    height: Math.max(...pictures.map(({canvas}) => canvas.height)) + (lines * LINE + 2 * GAP) * scale,
  });
  const pen = made.getContext("2d");
  pen.fillStyle = getComputedStyle(panels[0]).backgroundColor;
  pen.fillRect(0, 0, made.width, made.height);
  pen.font = `${KEY * scale}px ${style.fontFamily}`;
  let left = GAP * scale;
  for (const {canvas, words} of pictures) {
    words.forEach(({text, colour}, line) => {
      const base = (GAP + (line + 0.7) * LINE) * scale;
      pen.fillStyle = colour ?? style.color;
      if (colour) pen.fillRect(left, base - 0.35 * KEY * scale, KEY * scale, 3 * scale);
      pen.fillStyle = style.color;
      pen.fillText(text, left + (colour ? 1.5 * KEY * scale : 0), base, canvas.width);
    });
    pen.drawImage(canvas, left, (GAP + lines * LINE) * scale);
    left += canvas.width + GAP * scale;
  }
  return new Promise((resolve) => { made.toBlob(resolve, "image/png"); });
}

// Lines above a picture: what it is of, the scale of its colours, and what colours and curves are, with their colours.
function wordsOf(panel, remark) {
  const found = (selector) => [...panel.querySelectorAll(`:scope > ${selector}`)];
  const told = (each) => each.selectedOptions?.[0].text ?? (each.querySelector(".patch") ? each.firstChild.textContent : each.innerText).trim();
  const keys = found("figcaption .patch").map((patch) =>
    ({text: patch.textContent, colour: getComputedStyle(patch, "::before").backgroundColor}));
  const names = [...panel.querySelectorAll(".names li:not([hidden])")].map((item) =>
    ({text: item.innerText.trim(), colour: getComputedStyle(item).borderLeftColor}));
  const head = [found("figcaption :is(.title, select, small)").map(told).filter(Boolean).join("; "), found(".scale").map(told).join("").replace(/\s+/g, " ")];
  return [...[...head, remark].filter(Boolean).map((text) => ({text})), ...keys, ...names];
}
