// The page: its three views, the address, the theme, and the connection.
import {copy} from "./clipboard.js";
import {Link} from "./link.js";
import {recolourAll} from "./plots.js";

const VIEWS = ["explore", "measured", "published"];
const FIRST = "explore";
const opened = new Map();

const connection = document.querySelector("#connection");
const link = new Link({
  open({isAgain, resumed, isElsewhere, version}) {
    const own = document.body.dataset.version, isOfOther = version !== own;
    tell(...(isOfOther ? [`This lab is now of version ${version}, and this page of ${own}: load it again.`] : []));
    if (!isAgain) return;
    for (const view of opened.values()) view.then((each) => each.reconnected?.(resumed, isElsewhere));
  },
  closed(reason, isUnknown) {
    if (isUnknown) {
      tell("This lab was started anew. Open the address that its terminal shows in a new tab, and this page goes on. "
        + "What it shows stays until then.");
    } else {
      tell(reason ? `The lab says: ${reason}. Trying again.`
        : "The lab does not answer: it was closed, or the connection is lost. Trying again; what is shown stays.");
    }
  },
});

let failure = "", ofLine = ""; // why the page may not show all that it was told, and how the connection is

// Say how the connection is; without a word it is well.
function tell(...words) {
  ofLine = words.join("");
  const said = [failure, ofLine].filter(Boolean).join(" ");
  connection.hidden = said === "";
  if (connection.textContent !== said) connection.textContent = said; // else a screen reader would say it again
}

for (const type of ["error", "unhandledrejection"]) {
  addEventListener(type, ({error, reason}) => {
    if (!(error ?? reason)) return; // such as a size that is told a picture later
    failure = "Something failed on this page, which may show less than was answered: load it again. All that is set stays.";
    tell(ofLine);
  });
}

const REST = 300; // without a change, until the address is written; browsers stop pages that write it often [ms]
let later = null, wanted = location.search;

// The state of a view in the address of the page.
const address = {
  read() {
    const said = Object.fromEntries(new URLSearchParams(location.search));
    delete said.view;
    return said;
  },
  write(view, said) {
    if (document.querySelector(`#${view}`).hidden) return; // answered since it was left
    const now = `?${new URLSearchParams({view, ...said})}`;
    if (now === wanted) return;
    wanted = now;
    clearTimeout(later);
    later = setTimeout(writeAddress, REST);
  },
};

function writeAddress() {
  if (later === null) return;
  forgetAddress();
  history.replaceState(null, "", wanted);
}

function forgetAddress() {
  clearTimeout(later);
  later = null;
}

addEventListener("click", writeAddress, true); // a link that is copied or saved is that of what is seen

async function show(name, said) {
  forgetAddress(); // it was of the view before
  wanted = null;
  for (const dialog of document.querySelectorAll("dialog[open]")) dialog.close(); // unseen it would hold the page
  for (const view of VIEWS) {
    document.querySelector(`#${view}`).hidden = view !== name;
    const item = document.querySelector(`nav [data-view="${view}"]`);
    if (view === name) item.setAttribute("aria-current", "page");
    else item.removeAttribute("aria-current");
  }
  document.title = `roughline: ${document.querySelector(`nav [data-view="${name}"]`).textContent}`;
  if (!opened.has(name)) {
    const root = document.querySelector(`#${name}`);
    root.inert = true; // what is clicked before its buttons are listened to would be lost
    opened.set(name, import(`./${name}.js`).then(async ({default: View}) => {
      const view = new View(link, address), isOpen = view.open(said);
      root.inert = false;
      await isOpen;
      return view;
    }));
  } else {
    (await opened.get(name)).shown?.();
  }
}

document.querySelectorAll("nav a").forEach((item) => {
  item.addEventListener("click", (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    history.pushState(null, "", item.getAttribute("href"));
    show(item.dataset.view, {});
  });
});
addEventListener("popstate", () => start());

const theme = document.querySelector("#theme");
function nameTheme() {
  theme.textContent = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
}
theme.addEventListener("click", () => {
  document.documentElement.dataset.theme = theme.textContent;
  try { localStorage.setItem("roughline theme", theme.textContent); } catch { /* storage may be closed */ }
  nameTheme();
  recolourAll();
});
nameTheme();

const help = document.querySelector("#help"), helpText = document.querySelector("#help-text");
help.addEventListener("click", () => {
  helpText.hidden = !helpText.hidden;
  help.setAttribute("aria-expanded", String(!helpText.hidden));
});

// Escape takes the help away until one comes to its control anew.
addEventListener("keydown", ({key}) => {
  if (key !== "Escape") return;
  for (const control of document.querySelectorAll(".control:is(:hover, :focus-within)")) {
    control.classList.add("told");
    for (const type of ["pointerleave", "focusout"]) control.addEventListener(type, () => control.classList.remove("told"), {once: true});
  }
});

const copyLink = document.querySelector("#copy-link");
copyLink.addEventListener("click", () => copy(location.href, copyLink));

document.querySelectorAll(".drawer").forEach((drawer) => {
  const controls = document.querySelector(`#${drawer.getAttribute("aria-controls")}`);
  drawer.addEventListener("click", () => {
    const isOpen = controls.classList.toggle("open");
    drawer.setAttribute("aria-expanded", String(isOpen));
  });
});

async function start() {
  const said = address.read(), place = document.getElementById(location.hash.slice(1));
  const name = new URLSearchParams(location.search).get("view") ?? FIRST;
  const first = VIEWS.includes(name) ? name : FIRST;
  await show(first, said);
  place?.scrollIntoView();
  await opened.get(first);
  for (const view of VIEWS) import(`./${view}.js`).catch(() => {}); // it is there when the lab is not
}
start();
