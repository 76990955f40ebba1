// Tabs: one of several panels is shown, and told of then; arrow keys go from one to the next.
export function bindTabs(root, shown) {
  const tabs = [...root.querySelectorAll('[role="tab"]')];
  const panel = (tab) => root.querySelector(`#${tab.getAttribute("aria-controls")}`);
  const choose = (chosen) => {
    for (const tab of tabs) {
      tab.setAttribute("aria-selected", String(tab === chosen));
      tab.tabIndex = tab === chosen ? 0 : -1;
      panel(tab).hidden = tab !== chosen;
    }
    shown();
  };
  for (const tab of tabs) {
    panel(tab).setAttribute("role", "tabpanel");
    panel(tab).setAttribute("aria-labelledby", tab.id);
    tab.addEventListener("click", () => choose(tab));
    tab.addEventListener("keydown", ({key}) => {
      const step = {ArrowLeft: -1, ArrowRight: 1}[key];
      if (!step) return;
      const there = tabs.filter(({hidden}) => !hidden);
      const other = there[(there.indexOf(tab) + step + there.length) % there.length];
      choose(other);
      other.focus();
    });
  }
  choose(tabs[0]);
}
