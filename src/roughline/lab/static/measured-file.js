// The file of My surface: dropped, chosen or an example, and how it comes to the server.
const SHOWN_FROM = 2e6; // size from which on the upload is shown as it goes [bytes]

export class Source {
  #link; #view; #waiting; #request = null;

  constructor(link, view, waiting) {
    this.#link = link;
    this.#view = view;
    this.#waiting = waiting;
    const input = view.find("[data-file]"), drop = view.find("[data-drop]");
    view.find("[data-choose]").addEventListener("click", () => input.click());
    input.addEventListener("change", () => {
      if (input.files.length) this.#bring(input.files[0]);
      input.value = ""; // the same file may be chosen again
    });
    for (const button of view.findAll("[data-example]")) {
      button.addEventListener("click", () => {
        this.stop();
        view.takeSource({example: button.dataset.example});
      });
    }
    const root = view.find("#measured-step-file");
    const over = (isOver) => drop.classList.toggle("over", isOver);
    root.addEventListener("dragover", (event) => { event.preventDefault(); over(true); });
    root.addEventListener("dragleave", () => over(false));
    root.addEventListener("drop", (event) => {
      event.preventDefault();
      over(false);
      const {files} = event.dataTransfer;
      if (files.length === 1) this.#bring(files[0]);
      else view.refuse(files.length ? "Drop one file at a time." : "This is no file: drop one, or choose it.", "file");
    });
  }

  // Stop a file on its way.
  stop() {
    this.#request?.abort();
    this.#request = null;
    this.#said("");
  }

  #bring(file) {
    this.stop();
    this.#view.refuse("", "file");
    if (!this.#link.session) { this.#view.refuse("The lab is not connected: try again in a moment.", "file"); return; }
    const request = this.#request = new XMLHttpRequest();
    request.open("POST", `/upload?session=${encodeURIComponent(this.#link.session)}&name=${encodeURIComponent(file.name)}`);
    request.upload.addEventListener("progress", ({loaded, total}) => {
      if (total < SHOWN_FROM) return;
      this.#waiting.progress({done: loaded, total, left: null});
      this.#said(`bringing ${file.name}: ${(loaded / 1e6).toFixed(0)} of ${(total / 1e6).toFixed(0)} MB`);
    });
    request.addEventListener("load", () => {
      this.#done();
      if (request.status === 200) this.#view.takeSource({file: JSON.parse(request.responseText).file});
      else this.#view.refuse(sentence(request), "file");
    });
    request.addEventListener("error", () => {
      this.#done();
      this.#view.refuse(`${file.name} did not arrive: it may be larger than this lab takes, it cannot be read, or the connection was lost.`, "file");
    });
    this.#waiting.begin();
    request.send(file);
  }

  #done() {
    this.#request = null;
    this.#waiting.end();
    this.#said("");
  }

  #said(text) { this.#view.find('[data-waiting="file"] [data-said]').textContent = text; }
}

// What the server said of a file that it refused, without the number in front.
function sentence(request) {
  const said = request.responseText.replace(/^\d+: /, "").trim();
  return `${said || "The file was refused"}.`;
}
