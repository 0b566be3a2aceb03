import { App } from "./app";
import type { Hello } from "./protocol";
import { ServerTransport, WorkerTransport } from "./transport";
import "../../../contoursolve/notebook/explorer.css";
import "./workbench.css";

const place = document.getElementById("workbench")!;
const { worker, hello } = place.dataset;

if (worker === undefined || hello === undefined) {
  const asked = matchMedia("(prefers-color-scheme: dark)");
  const follow = () => (place.dataset["theme"] = asked.matches ? "dark" : "light");
  asked.addEventListener("change", follow);
  follow();
  void new App(place, new ServerTransport(), null).begin();
} else embed(worker, JSON.parse(hello));

// In a page that has styles of its own: a shadow keeps both apart.
function embed(address: string, known: Hello): void {
  const shadow = place.attachShadow({ mode: "open" });
  const sheet = document.createElement("link");
  sheet.rel = "stylesheet";
  sheet.href = new URL("workbench.css", import.meta.url).href;
  const root = document.createElement("div");
  root.classList.add("embedded");
  shadow.append(sheet, root);

  // The explorer looks at the theme again when that of the body changes.
  const follow = () => (root.dataset["theme"] = document.body.dataset["theme"] = document.body.dataset["mdColorScheme"] === "slate" ? "dark" : "light");
  new MutationObserver(follow).observe(document.body, { attributes: true, attributeFilter: ["data-md-color-scheme"] });
  follow();

  const app: App = new App(root, new WorkerTransport(new URL(address, import.meta.url).href, (progress) => app.progress(progress)), known);
  void app.begin();
}
