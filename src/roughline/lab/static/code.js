// Code that repeats what is shown, in the dialog of a view.
import {copy} from "./clipboard.js";

// asked() gives what the task is asked with, and refuse(sentence, at) writes why there is no code.
export function bindCode(root, link, asked, refuse) {
  const dialog = root.querySelector("[data-code-dialog]"), code = dialog.querySelector("pre");
  dialog.querySelector("[data-copy]").addEventListener("click", ({target}) => copy(code.textContent, target));
  for (const button of root.querySelectorAll("[data-code]")) {
    button.addEventListener("click", () => link.ask(`${root.id}.code`, `${root.id} code`, {...asked(), which: button.dataset.code}, {
      answer: ({text}) => {
        if (root.hidden) return; // a dialog that nobody sees would hold the page
        code.textContent = text;
        dialog.showModal();
      },
      error: refuse,
    }));
  }
}
