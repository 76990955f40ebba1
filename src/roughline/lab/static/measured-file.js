// The file of My surface: dropped, chosen or an example, and how it comes to the server.
const SHOWN_FROM = 2e6; // size from which on the upload is shown as it goes [bytes]

export class Source {
  #link; #view; #request = null; #turn = 0;

  constructor(link, view) {
    this.#link = link;
    this.#view = view;
    const input = view.find("[data-file]"), drop = view.find("[data-drop]");
    let isMore = false; // whether what is chosen comes beside the maps that are there
    view.find("[data-choose]").addEventListener("click", () => { isMore = false; input.click(); });
    view.find("[data-add-maps]").addEventListener("click", () => { isMore = true; input.click(); });
    const chosen = () => {
      this.#bring([...input.files], isMore);
      input.value = ""; // the same file may be chosen again
    };
    input.addEventListener("change", chosen);
    setTimeout(chosen); // what was chosen before anyone listened
    for (const button of view.findAll("[data-example]")) {
      button.addEventListener("click", () => {
        this.stop();
        view.takeSource({example: button.dataset.example});
      });
    }
    view.find("[data-forget-file]").addEventListener("click", () => { this.stop(); view.deleteFiles(); });
    const root = view.find("#measured-step-file");
    const over = (isOver) => drop.classList.toggle("over", isOver);
    root.addEventListener("dragover", (event) => { event.preventDefault(); over(true); });
    root.addEventListener("dragleave", () => over(false));
    root.addEventListener("drop", (event) => {
      event.preventDefault();
      over(false);
      const {files} = event.dataTransfer;
      if (files.length) this.#bring([...files], false);
      else view.refuse("This is not a file: drop a file, or choose one.", "file");
    });
  }

  // Stop files on their way.
  stop() {
    this.#turn++;
    this.#request?.abort();
    this.#request = null;
    this.#view.waiting.end("measured file");
    this.#said("");
  }

  // Bring files one after the other; one that is refused does not keep the others away.
  async #bring(files, isMore) {
    if (!files.length) return;
    this.stop();
    this.#view.refuse("", "file");
    const before = isMore ? this.#view.files : [], most = Number(this.#view.find("[data-drop]").dataset.most);
    if (before.length + files.length > most) {
      this.#view.refuse(`${before.length + files.length} files: up to ${most} maps can be one part.`, "file");
      return;
    }
    const turn = this.#turn, came = [], refused = [];
    this.#view.waiting.begin("measured file");
    await this.#link.ready;
    for (const [i, file] of files.entries()) {
      const of = files.length > 1 ? ` (${i + 1} of ${files.length})` : "";
      const {refusal, ...brought} = await this.#sent(file, of);
      if (turn !== this.#turn) return; // stopped
      if (brought.key) came.push(brought);
      else refused.push(refusal);
    }
    this.stop();
    if (came.length) this.#view.takeSource({file: [...before, ...came.map(({key}) => key)].join(",")}, came);
    this.#view.refuse(refused.join(" "), "file");
  }

  // Send a file; gives its key, or why it was refused.
  #sent(file, of) {
    return new Promise((done) => {
      const request = this.#request = new XMLHttpRequest();
      request.open("POST", `upload?session=${encodeURIComponent(this.#link.session)}&name=${encodeURIComponent(file.name)}`);
      request.upload.addEventListener("progress", ({loaded, total}) => {
        if (total < SHOWN_FROM) return;
        this.#view.waiting.progress({done: loaded, total, left: null});
        this.#said(`bringing ${file.name}${of}: ${(loaded / 1e6).toFixed(0)} of ${(total / 1e6).toFixed(0)} MB`);
      });
      request.addEventListener("load", () => {
        if (request.status !== 200) { done({refusal: sentence(request)}); return; }
        const {file: key, digest} = JSON.parse(request.responseText);
        done({key, digest, name: file.name});
      });
      request.addEventListener("abort", () => done({refusal: ""}));
      request.addEventListener("error", () => done({
        refusal: `${file.name} did not arrive: it may be larger than this lab accepts, it cannot be read, or the connection was lost.`,
      }));
      request.send(file);
    });
  }

  #said(text) { this.#view.find("[data-said]").textContent = text; }
}

// What the server said of a file that it refused, without the number in front.
function sentence(request) {
  const said = request.responseText.replace(/^\d+: /, "").trim();
  return `${said || "The file was refused"}.`;
}
