import { App } from "./app";
import { ServerTransport, WorkerTransport } from "./transport";
import "../../../contoursolve/notebook/explorer.css";
import "./workbench.css";

const place = document.getElementById("workbench")!;
const worker = place.dataset["worker"];

if (worker === undefined) void new App(place, new ServerTransport(), false).begin();
else {
  // In a page of others, with styles of its own: a shadow keeps both apart.
  const shadow = place.attachShadow({ mode: "open" });
  const sheet = document.createElement("link");
  sheet.rel = "stylesheet";
  sheet.href = new URL("workbench.css", import.meta.url).href;
  const root = document.createElement("div");
  shadow.append(sheet, root);
  let app: App | null = null;
  const transport = new WorkerTransport(new URL(worker, import.meta.url).href, (progress) => app?.progress(progress));
  app = new App(root, transport, true);
  void app.begin();
}
