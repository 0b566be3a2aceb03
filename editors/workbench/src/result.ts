// What a command made: shown, and to be taken along.
import { button, bytesOf, copyText, download, make } from "./dom";
import type { Made } from "./protocol";

export interface ResultPanel {
  node: HTMLElement;
  show(made: Made): void;
}

const TYPES: Record<string, string> = { png: "image/png", html: "text/html", dxf: "image/vnd.dxf" };
const ends = (name: string) => name.split(".").at(-1)?.toLowerCase() ?? "";

export function resultPanel(open: (name: string, text: string) => void, save: ((made: Made) => void) | null): ResultPanel {
  const node = make("div", { class: "result" });
  return {
    node,
    show(made) {
      const kind = ends(made.name);
      const type = TYPES[kind] ?? "text/plain";
      const content = made.base64 === undefined ? (made.text ?? "") : bytesOf(made.base64);
      const { text } = made;
      const copied = make("span", { role: "status" });
      const isProgram = text !== undefined && !(kind in TYPES);
      const shown =
        kind === "png" ? make("img", { src: `data:image/png;base64,${made.base64 ?? ""}`, alt: `Drawing: ${made.message}` })
        : kind === "html" ? make("iframe", { sandbox: "", srcdoc: typeof content === "string" ? content : new TextDecoder().decode(content), title: made.name })
        : text ? make("pre", { tabindex: 0, text, role: "group", "aria-label": made.name })
        : null;
      node.replaceChildren(
        make("h2", { text: made.name || "Result" }),
        make("p", { class: "said", role: "status", text: made.message }),
        make(
          "div",
          { class: "bar" },
          isProgram && text ? button("Open as a new program", () => open(made.name, text)) : null,
          content.length && save ? button("Save into the folder", () => save(made)) : null,
          content.length ? button("Download", () => download(made.name, content, type)) : null,
          text ? button("Copy", async () => (copied.textContent = (await copyText(text)) ? "copied" : "press Ctrl+C")) : null,
          copied,
        ),
        ...(shown ? [shown] : []),
        ...(made.details ? [make("details", {}, make("summary", { text: "Details" }), make("pre", { tabindex: 0, text: made.details, role: "group", "aria-label": "Details" }))] : []),
      );
    },
  };
}
