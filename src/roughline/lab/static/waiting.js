// Waiting: nothing for 300 ms, then how far it is, the time left, and a cancel.
const SILENT = 300; // [ms]

export class Waiting {
  #link; #bar; #cancel; #text; #timer = null; #works = new Set();

  // cancelled(works) is told the names of what was going on, which was stopped.
  constructor(root, link, cancelled = () => {}) {
    this.#link = link;
    this.#bar = root.querySelector("progress");
    this.#bar.setAttribute("aria-label", "progress");
    this.#cancel = root.querySelector(".cancel");
    this.#text = root.querySelector("[data-left]");
    this.#cancel.addEventListener("click", () => {
      const works = [...this.#works];
      this.stop(works);
      cancelled(works);
    });
  }

  // Ask for a task, and wait for its answer.
  ask(task, slot, args, {answer, error, progress = () => {}}) {
    this.begin(slot);
    this.#link.ask(task, slot, args, {
      answer: (header) => { this.#ended(slot); answer(header); },
      error: (sentence, at) => { this.#ended(slot); error(sentence, at); },
      progress: (message) => { this.progress(message); progress(message); },
    });
  }

  // What was asked has ended, unless it was asked anew meanwhile.
  #ended(slot) { if (!this.#link.isWaiting(slot)) this.end(slot); }

  stop(works) {
    for (const work of works) { this.#link.stop(work); this.end(work); }
  }

  // Wait for a work; several may go on, and the last that ends takes the bar away.
  begin(work = "") {
    this.#works.add(work);
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#bar.removeAttribute("value");
      this.#bar.hidden = this.#cancel.hidden = false;
    }, SILENT);
  }

  progress({done, total, left}) {
    this.#bar.max = total;
    this.#bar.value = done;
    if (this.#text) this.#text.textContent = left === null ? "" : `${done} of ${total}, about ${duration(left)} left`;
  }

  end(work = "") {
    this.#works.delete(work);
    if (this.#works.size) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => { // unless another begins at once
      if (!this.#bar.hidden) this.#bar.hidden = this.#cancel.hidden = true;
      if (this.#text?.textContent) this.#text.textContent = "";
    });
  }
}

function duration(seconds) {
  return seconds < 90 ? `${Math.max(1, Math.round(seconds))} s` : `${Math.round(seconds / 60)} min`;
}
