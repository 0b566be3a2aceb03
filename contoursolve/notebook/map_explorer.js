
// The map and the explorer below it, for `MapExplorer`.

function renderMap({ model, el }) {
  const page = document.createElement("div");
  const root = document.createElement("div");
  root.className = "contoursolve map";
  // JupyterLab keeps Enter and the arrow keys to itself elsewhere.
  root.dataset.lmSuppressShortcuts = "true";
  const figure = document.createElement("figure");
  const paper = document.createElement("div");
  paper.className = "paper";
  const drawn = picture(model.get("drawing"));
  if (drawn) paper.append(drawn);
  figure.append(paper);
  root.append(figure);
  const below = document.createElement("div");
  page.append(root, below);
  el.replaceChildren(page);
  const theme = () => (page.dataset.theme = isDark(el) ? "dark" : "light");
  const observer = new MutationObserver(theme);
  for (const element of [document.documentElement, document.body]) {
    observer.observe(element, { attributes: true, attributeFilter: ["class", "style", "data-theme", "data-jp-theme-light", "data-jp-theme-name", "data-vscode-theme-kind"] });
  }
  theme();
  requestAnimationFrame(theme);

  let number = 0; // of the last question
  let isBusy = false;
  let next = null; // the only question that still matters when the one under way is answered
  let leave = null; // what takes the explorer away
  function ask(values, isOpen) {
    next = { values, is_open: isOpen || Boolean(next?.is_open) };
    if (isBusy) return;
    isBusy = true;
    number += 1;
    model.set("place", { ...next, number });
    next = null;
    model.save_changes();
  }
  const told = showMap(root, model.get("frames"), {
    look: (values) => ask(values, false),
    open: (values) => ask(values, true),
  });
  function answered() {
    const seen = model.get("seen");
    isBusy = false;
    if (seen.values) told(seen.values, seen.text, seen.path);
    if (seen.is_open) {
      leave ??= render({ model, el: below });
      below.scrollIntoView({ block: "nearest" });
    }
    if (next) ask(next.values, next.is_open);
  }
  model.on("change:seen", answered);
  return () => {
    observer.disconnect();
    model.off("change:seen", answered);
    leave?.();
  };
}

export default { render: renderMap };
