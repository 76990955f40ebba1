// Hands on a plot. The wheel and one finger scroll the page; Ctrl or Cmd with the wheel, two fingers, the tools and
// the keys zoom, within bounds; a double click shows the whole plot again.
const WIDEST = 2, NARROWEST = 1e-3; // of the ranges, in those of the whole plot
const SCROLLS = "pan-y"; // what one finger does on a plot, in the words of CSS
const STILL = 8; // a click moves less [pixel]
const PER_STEP = 1.25; // zoom of a key and of a notch of the wheel
const NOTCH = {0: 100, 1: 3, 2: 1}; // of the wheel, in the units of its modes: pixels, lines, pages
const POINTER = ["pointerdown", "pointermove", "pointerup", "pointercancel", "pointerover", "pointerout"];
const KEYS = {"+": 1 / PER_STEP, "=": 1 / PER_STEP, "-": PER_STEP}; // factors of a zoom
const ARROWS = {ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
const MIDDLE = [0.5, 0.5];

export function takeHands(root) {
  const {element, canvas, view} = placeOf(root);
  if (!canvas) return;
  canvas.tabIndex = -1; // one stop of the tab key for each plot
  canvas.style.outline = view.el.style.outline = "none"; // that of the stop is seen
  canvas.style.touchAction = SCROLLS;
  for (const button of view.toolbar_panel?.toolbar_view.tool_button_views ?? []) button.el.style.touchAction = SCROLLS;
  for (const [range, scale] of axesOf(root)) keepBounded(range, scale);
  const isOnPlot = (event) => event.composedPath()[0] === canvas;
  for (const type of POINTER) { // the tools of Bokeh are for the mouse
    element.addEventListener(type, (event) => {
      if (event.pointerType !== "mouse" && isOnPlot(event)) event.stopPropagation();
    }, true);
  }
  element.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const notches = within(event.deltaY / NOTCH[event.deltaMode], -1, 1);
    zoom(root, PER_STEP ** notches, shareOf(view, event));
  }, {passive: false});
  element.addEventListener("dblclick", (event) => { if (isOnPlot(event)) view.reset(); });
  takeTwoFingers(root);
  element.addEventListener("keydown", (event) => {
    if (![element, canvas].includes(event.composedPath()[0])) return;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key in KEYS) zoom(root, KEYS[event.key], MIDDLE);
    else if (event.key in ARROWS) zoom(root, 1, MIDDLE, MIDDLE.map((share, i) => share + ARROWS[event.key][i]));
    else if (event.key === "0") view.reset();
    else return;
    event.preventDefault();
  });
}

// Call with a point of the plot, in the units of its axes, when it is clicked or touched.
export function onTouch(root, touched) {
  const {element, canvas, view} = placeOf(root);
  let down = null;
  element.addEventListener("pointerdown", (event) => { down = event; }, true);
  element.addEventListener("click", (event) => {
    if (event.composedPath()[0] !== canvas || !down) return;
    if (Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < STILL) touched(pointAt(view, event));
  });
}

// Call with the point under the mouse, or that was touched, and with none when the mouse leaves.
export function onPoint(root, told) {
  const {element, canvas, view} = placeOf(root);
  element.addEventListener("pointermove", (event) => {
    if (event.pointerType === "mouse") told(event.composedPath()[0] === canvas && isOnFrame(view, event) ? pointAt(view, event) : null);
  }, true);
  element.addEventListener("pointerleave", ({pointerType}) => { if (pointerType === "mouse") told(null); });
  onTouch(root, told);
}

// Let a button, once pressed, have the next drag on one of the plots draw, with one finger too: drawn(from, to, isLast)
// has points in the units of the axes; begun() is called when the button was pressed.
export function onDraw(roots, button, drawn, begun = () => {}) {
  const places = [roots].flat().map(placeOf);
  let isArmed = false, from = null;
  const arm = (wanted) => {
    [isArmed, from] = [wanted, null];
    button.setAttribute("aria-pressed", String(wanted));
    for (const {canvas} of places) {
      canvas.style.touchAction = wanted ? "none" : SCROLLS;
      canvas.style.cursor = wanted ? "crosshair" : "";
    }
  };
  const leave = () => { if (from) drawn(from, from, true); from = null; };
  button.addEventListener("click", () => { arm(!isArmed); begun(); });
  for (const {element, canvas, view} of places) {
    const take = {
      pointerdown: (event) => {
        if (!event.isPrimary) { leave(); return; }
        canvas.setPointerCapture(event.pointerId); // also beside the plot the drag goes on, and ends
        from = pointAt(view, event);
      },
      pointermove: (event) => { if (from) drawn(from, pointAt(view, event), false); },
      pointerup: (event) => {
        if (!from) return;
        drawn(from, pointAt(view, event), true);
        arm(false);
      },
      pointercancel: () => leave(),
    };
    for (const [type, act] of Object.entries(take)) {
      element.addEventListener(type, (event) => {
        if (!isArmed || event.composedPath()[0] !== canvas) return;
        event.stopPropagation();
        act(event);
      }, true);
    }
  }
}

// Let a finger that scrolls the page over a slider leave it where it is.
export function letScroll(slider) {
  let down = null; // a finger that may yet mean the page
  slider.addEventListener("pointerdown", ({pointerType, clientX}) => {
    down = pointerType === "mouse" ? null : {clientX, value: slider.value};
  });
  slider.addEventListener("pointermove", ({clientX}) => {
    if (down && Math.abs(clientX - down.clientX) > STILL) down = null;
  });
  slider.addEventListener("pointerup", () => { down = null; });
  slider.addEventListener("pointercancel", () => {
    if (down) slider.value = down.value;
    down = null;
  });
  slider.addEventListener("input", (event) => { if (down) event.stopImmediatePropagation(); });
}

function placeOf(root) {
  const view = Bokeh.index.find_one(root);
  return {element: document.querySelector(`#plot-${CSS.escape(root.name)}`), canvas: view?.canvas_view?.events_el, view};
}

function within(value, low, high) { return Math.min(Math.max(value, low), high); }

// Where an event is, in sides of the frame from its lower left corner.
function sharesOf({canvas_view, frame: {bbox}}, {clientX, clientY}) {
  const {left, top} = canvas_view.events_el.getBoundingClientRect();
  return [(clientX - left - bbox.left) / bbox.width, (bbox.bottom - (clientY - top)) / bbox.height];
}

function isOnFrame(view, event) { return sharesOf(view, event).every((share) => share >= 0 && share <= 1); }

// The same; beside the frame, at its nearest edge.
function shareOf(view, event) { return sharesOf(view, event).map((share) => within(share, 0, 1)); }

// The same in the units of the axes.
function pointAt(view, event) {
  const [right, up] = shareOf(view, event), {bbox, x_scale, y_scale} = view.frame;
  return {x: x_scale.invert(bbox.left + right * bbox.width), y: y_scale.invert(bbox.bottom - up * bbox.height)};
}

// Two fingers zoom and move what is between them.
function takeTwoFingers(root) {
  const {element, view} = placeOf(root);
  let before = null;
  const seen = ([one, other]) => {
    const middle = {clientX: (one.clientX + other.clientX) / 2, clientY: (one.clientY + other.clientY) / 2};
    return {share: shareOf(view, middle), apart: Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY)};
  };
  const taken = (event) => {
    const fingers = [...event.touches].filter(({target}) => element.contains(target)); // one may be on its legend
    if (fingers.length !== 2) { before = null; return; }
    if (event.cancelable) event.preventDefault();
    const now = seen(fingers);
    if (before && now.apart > 0) zoom(root, before.apart / now.apart, before.share, now.share);
    before = now;
  };
  for (const type of ["touchstart", "touchmove", "touchend", "touchcancel"]) {
    element.addEventListener(type, taken, {passive: false});
  }
}

// Show a part of the plot that is larger by a factor; what was at one share of the frame comes to another.
function zoom(root, factor, from, to = from) {
  axesOf(root).forEach(([range, scale], i) => {
    const [start, end] = [range.start, range.end].map(scale.to), length = end - start;
    const first = start + length * (from[i] - factor * to[i]);
    range.setv({start: scale.from(first), end: scale.from(first + factor * length)});
  });
}

const LINEAR = {to: (x) => x, from: (x) => x}, LOGARITHMIC = {to: Math.log, from: Math.exp};

// The ranges of numbers of a plot, and how their axes count.
function axesOf({x_range, y_range, x_scale, y_scale}) {
  const axes = [[x_range, x_scale], [y_range, y_scale]].filter(([range]) => range.type !== "FactorRange");
  return axes.map(([range, {type}]) => [range, type === "LogScale" ? LOGARITHMIC : LINEAR]);
}

const bounded = new WeakSet(); // plots may share a range

// Bring a range back when anything moves it too far from what it has when the whole plot is shown.
function keepBounded(range, {to, from}) {
  if (bounded.has(range)) return;
  bounded.add(range);
  const keep = () => {
    if (!range.is_valid) return;
    const whole = [range._reset_start, range._reset_end];
    const [[low, high], [start, end]] = [whole.map(to), [range.start, range.end].map(to)];
    const length = high - low, share = (at) => (at - low) / length; // some axes count downwards
    const half = within(share(end) - share(start), NARROWEST, WIDEST) / 2, beside = (WIDEST - 1) / 2;
    const middle = within((share(start) + share(end)) / 2, half - beside, 1 + beside - half);
    const may = [middle - half, middle + half];
    const isBeyond = [start, end].some((is, i) => Math.abs(share(is) - may[i]) > 1e-9);
    if (isBeyond) range.setv({start: from(low + may[0] * length), end: from(low + may[1] * length)});
  };
  range.change.connect(keep);
  keep();
}
