// What can be taken along from Explore: code that repeats it, and files.
import {copy} from "./clipboard.js";
import {openDialog} from "./dialogs.js";
import {element} from "./elements.js";

export class TakeAlong {
  #root; #link; #asked; #waiting; #refuse;

  // asked() gives the arguments of the state, waiting tells of what runs, refuse writes sentences.
  constructor(root, link, asked, waiting, refuse) {
    this.#root = root;
    this.#link = link;
    this.#asked = asked;
    this.#waiting = waiting;
    this.#refuse = refuse;
    const find = (selector) => root.querySelector(selector);
    find("#as-python").addEventListener("click", ({currentTarget}) => this.#showCode("python", currentTarget));
    find("#as-command").addEventListener("click", ({currentTarget}) => this.#showCode("command", currentTarget));
    find("#copy-code").addEventListener("click", ({target}) => copy(find("#code pre").textContent, target));
    find("#save").addEventListener("click", () => this.#save(find("#saved").value));
  }

  #showCode(which, opener) {
    this.#link.ask("explore.code", "code", {...this.#asked(), which}, {
      answer: ({text}) => {
        this.#root.querySelector("#code pre").textContent = text;
        openDialog(this.#root.querySelector("#code"), opener);
      },
      error: (sentence, at) => this.#refuse(sentence, at),
    });
  }

  #save(name) {
    this.#waiting.ask("explore.download", "download", {...this.#asked(), name}, {
      answer: ({file}) => element("a", {href: `/results/${this.#link.session}/${file}?save=1`, download: name}).click(),
      error: (sentence, at) => this.#refuse(sentence, at),
    });
  }
}
