// What a test asks of a page as it is seen, heard and reached by keys; `view` is the id of one view.
({
  // Texts with the contrast to what is behind them, those that Bokeh writes included.
  contrasts() {
    const context = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
    const rgba = (colour) => {
      context.clearRect(0, 0, 1, 1);
      context.fillStyle = colour;
      context.fillRect(0, 0, 1, 1);
      return [...context.getImageData(0, 0, 1, 1).data];
    };
    const light = ([r, g, b]) => {
      const [x, y, z] = [r, g, b].map((c) => ((c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
      return 0.2126 * x + 0.7152 * y + 0.0722 * z;
    };
    const contrast = (one, other) => {
      const [a, b] = [light(rgba(one)), light(rgba(other))].sort((x, y) => y - x);
      return (a + 0.05) / (b + 0.05);
    };
    const behind = (element) => {
      for (let each = element; each; each = each.parentElement) {
        const colour = getComputedStyle(each).backgroundColor;
        if (rgba(colour)[3] === 255) return colour;
      }
      return "white";
    };
    const found = [];
    const add = (text, element) => found.push([text, contrast(getComputedStyle(element).color, behind(element))]);
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walk.nextNode()) {
      const element = walk.currentNode.parentElement, text = walk.currentNode.textContent.trim();
      if (text && element.checkVisibility() && !element.closest("option")) add(text, element);
    }
    for (const element of document.querySelectorAll("input[type=text], select")) {
      if (element.checkVisibility()) add(element.value, element);
    }
    const paper = getComputedStyle(document.documentElement).getPropertyValue("--paper");
    const keys = ["axis_label_text_color", "major_label_text_color", "label_text_color", "title_text_color"];
    for (const model of Bokeh.documents.flatMap((each) => [...each.all_models])) {
      for (const key of keys) {
        if (model.attributes[key]) found.push([`${model.type} ${key}`, contrast(model.attributes[key], paper)]);
      }
    }
    return found;
  },

  // Controls without a name.
  nameless(view) {
    const all = document.querySelectorAll(
      `#${view} :is(input, select, button, summary, .plot, pre, progress), header :is(a, button)`);
    return [...all].filter((each) => {
      const labels = [...(each.labels ?? [])].map((label) => label.textContent).join("");
      const by = document.getElementById(each.getAttribute("aria-labelledby"))?.textContent ?? "";
      return !`${each.getAttribute("aria-label") ?? ""}${labels}${by}${each.textContent}`.trim();
    }).map((each) => each.outerHTML);
  },

  // Settings that nothing describes.
  undescribed(view) {
    return [...document.querySelectorAll(`#${view} .control :is(input, select)`)].filter((each) => {
      const told = each.closest("[aria-describedby]")?.getAttribute("aria-describedby") ?? "";
      const ids = told.split(" ").filter(Boolean);
      const found = ids.map((id) => document.getElementById(id)?.textContent ?? "").join("");
      return !(found || each.closest("[title]")?.title);
    }).map((each) => each.outerHTML);
  },

  // Mark where the tab key should stop, in this order; a group of radios is one stop.
  stops(view) {
    const all = document.querySelectorAll(
      `header a, header button, #${view} :is(input, select, button, summary, .plot, pre, a[href])`);
    return [...all].filter((each) => each.checkVisibility() && each.tabIndex >= 0 && !each.disabled
      && (each.type !== "radio" || each.checked)).map((each, i) => (each.dataset.stop = `${i}`));
  },

  // The stop that has the focus, and whether one sees it.
  stop() {
    const {outlineStyle, outlineWidth} = getComputedStyle(document.activeElement);
    const {left, top, right, bottom} = document.activeElement.getBoundingClientRect();
    const inside = left >= 0 && top < innerHeight && right <= innerWidth && bottom > 0;
    // a button that cancels may go while it has the focus, which the page itself has until the next key
    const passing = document.activeElement.matches("body, .scroll, .table > div, .status button") ? "passing" : null;
    return [document.activeElement.dataset.stop ?? passing, inside && outlineStyle !== "none" && parseFloat(outlineWidth) >= 2];
  },

  // Texts and plots that are wider than their place or the window.
  cut(view) {
    const all = document.querySelectorAll(
      `header *, #${view} :is(label, legend, button, select, dt, dd, p, figcaption, summary, .plot)`);
    return [...all].filter((each) => {
      if (!each.checkVisibility() || each.closest(".hidden, .skip, .scroll, .table")) return false;
      const {left, right} = each.getBoundingClientRect();
      const overflows = each.scrollWidth > each.clientWidth + 1 && getComputedStyle(each).display !== "inline";
      return overflows || left < 0 || right > innerWidth + 0.5;
    }).map((each) => each.outerHTML.slice(0, 200));
  },

  // Targets that a finger would miss; a box is touched by its label too.
  small(view) {
    const all = document.querySelectorAll(
      `header :is(a, button), #${view} :is(button, select, summary, [type=checkbox], [type=radio])`);
    return [...all].filter((each) => each.checkVisibility()
      && (each.matches("input") ? each.labels[0] : each).getBoundingClientRect().height < 24).map((each) => each.outerHTML.slice(0, 200));
  },

  // Plots that are too small to read; trust maps are alike and stand beside each other.
  tiny(view) {
    return [...document.querySelectorAll(`#${view} .plot:not([id*=trust])`)].filter((each) => each.checkVisibility()
      && (each.clientWidth < 250 || each.clientHeight < 200)).map((each) => each.id);
  },

  width() { return document.documentElement.scrollWidth; },
})
