/** The script of the picture's page. It shows what it is told, and tells where the reader points. */
import type { FromPage, ToPage } from "./picture";

declare function acquireVsCodeApi(): { postMessage(message: FromPage): void };

const editor = acquireVsCodeApi();
const figure = document.querySelector("figure")!;
const notes = document.querySelector("section")!;

window.addEventListener("message", ({ data }: MessageEvent<ToPage>) => {
  if (data.type === "mark") return mark(data.key);
  if (data.type === "none") {
    figure.replaceChildren();
    notes.replaceChildren(paragraph("hint", data.message));
    return;
  }
  const { svg, words, findings } = data.picture;
  figure.replaceChildren(...draw(svg));
  // A finding begins with how serious it is.
  notes.replaceChildren(...findings.map((text) => paragraph(`finding ${text.split(":", 1)[0]}`, text)));
  if (!findings.length) notes.replaceChildren(paragraph("hint", "No findings."));
  const texts = new Map(words.map((word) => [word.key, word.text]));
  for (const part of parts()) prepare(part, texts.get(part.dataset.word!));
  mark(data.marked);
});

/** The picture; its style sheet is adopted, since the page allows none that stands in its text. */
function draw(svg: string): Node[] {
  const root = new DOMParser().parseFromString(svg, "image/svg+xml").documentElement;
  const sheets = [...root.querySelectorAll("style")].map((style) => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(style.textContent ?? "");
    style.remove();
    return sheet;
  });
  document.adoptedStyleSheets = sheets;
  root.setAttribute("height", "auto");
  root.setAttribute("width", "100%");
  return [document.importNode(root, true)];
}

function parts(): SVGElement[] {
  return [...figure.querySelectorAll<SVGElement>("[data-word]")];
}

function prepare(part: SVGElement, text: string | undefined): void {
  const key = part.dataset.word!;
  const same = parts().filter((other) => other.dataset.word === key);
  const stop = same.find((other) => other.localName === "text") ?? same[0];
  if (stop === part) part.setAttribute("tabindex", "0"); // One stop of the Tab key for each word.
  part.setAttribute("role", "button");
  part.setAttribute("aria-label", text ?? key);
  const point = (at: string | null) => {
    mark(at, "pointed");
    editor.postMessage({ type: "point", key: at });
  };
  part.addEventListener("pointerenter", () => point(key));
  part.addEventListener("pointerleave", () => point(null));
  part.addEventListener("focus", () => point(key));
  part.addEventListener("blur", () => point(null));
  part.addEventListener("click", () => editor.postMessage({ type: "go", key }));
  part.addEventListener("keydown", (event) => {
    if (event.key === "Enter" || event.key === " ") editor.postMessage({ type: "go", key });
  });
}

function mark(key: string | null, kind = "marked"): void {
  for (const part of parts()) part.classList.toggle(kind, part.dataset.word === key);
}

function paragraph(kind: string, text: string): HTMLParagraphElement {
  const made = document.createElement("p");
  made.className = kind;
  made.textContent = text;
  return made;
}

editor.postMessage({ type: "ready" });
