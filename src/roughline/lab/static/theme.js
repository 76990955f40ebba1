// Light or dark, before anything is drawn: as chosen here before, or as the system has it.
"use strict";
{
  let chosen = null;
  try { chosen = localStorage.getItem("roughline theme"); } catch { /* storage may be closed */ }
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = chosen ?? (dark ? "dark" : "light");
}
