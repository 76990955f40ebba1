// A browser keeps its cookie back when a file or a page of another site leads here: who is logged in goes on.
document.documentElement.hidden = true;
addEventListener("DOMContentLoaded", async () => {
  const isIn = await fetch("/here").then(({ok}) => ok, () => false);
  if (isIn) return location.replace(document.querySelector('[name="next"]').value);
  document.documentElement.hidden = false;
  document.querySelector("[autofocus]").focus();
});
