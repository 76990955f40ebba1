import {element} from "./elements.js";

// Put a text on the clipboard; also where the browser keeps it for pages of this machine alone.
export async function copy(text, button) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const field = element("textarea", {value: text});
    button.after(field);
    field.select();
    document.execCommand("copy");
    field.remove();
    button.focus();
  }
  button.dataset.name ??= button.textContent;
  button.textContent = "copied";
  setTimeout(() => { button.textContent = button.dataset.name; }, 1500);
}
