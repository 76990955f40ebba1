// Dialogs: closed by their button, by Escape and by a click or a touch beside them; the focus goes back.
export function openDialog(dialog, opener) {
  if (dialog.open) return;
  const isBeside = ({clientX, clientY}) => {
    const {left, right, top, bottom} = dialog.getBoundingClientRect();
    return clientX < left || clientX > right || clientY < top || clientY > bottom;
  };
  const listening = new AbortController(), {signal} = listening;
  let began = false; // beside it: a text that is selected may end there
  dialog.addEventListener("pointerdown", (event) => { began = isBeside(event); }, {signal});
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog && began && isBeside(event)) dialog.close();
  }, {signal});
  dialog.addEventListener("close", () => { listening.abort(); opener.focus(); }, {signal});
  dialog.showModal();
}
