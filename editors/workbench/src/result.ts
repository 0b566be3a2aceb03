// What a command made: shown, and to be taken along.
import { placeList } from "./drawing";
import { button, bytesOf, make, picture, scroller, takeAlong } from "./dom";
import type { Made } from "./protocol";

const TYPES: Record<string, string> = { png: "image/png", html: "text/html", dxf: "image/vnd.dxf" };

// `go` leads to a line of the program that something was made of.
export function resultPanel(open: (name: string, text: string) => void, save: ((made: Made) => void) | null, go: (line: number) => void) {
  const older = make("p", { class: "wrong", role: "status", hidden: true, text: "Of the program before the last change. Do it again for the program as it is." });
  const node = make("div", { class: "result" });
  const left = (made: Made): HTMLElement | string => {
    if (!made.not_converted?.length) return "";
    const list = placeList("Not converted", go);
    list.show(made.not_converted.map(({ line, text, reason }) => ({ line, text: `${text}: ${reason}`, kind: "unsolved" })));
    return make("section", {}, make("h3", { text: "Not converted: each stands in its place as a comment" }), list.node);
  };
  const show = (made: Made): void => {
    const { name, title, svg, text, base64, details, isWrong } = made;
    const kind = name.split(".").at(-1)?.toLowerCase() ?? "";
    const content = base64 === undefined ? (text ?? "") : bytesOf(base64);
    const html = () => (typeof content === "string" ? content : new TextDecoder().decode(content));
    const shown =
      kind === "png" ? make("img", { src: `data:image/png;base64,${base64 ?? ""}`, alt: `Drawing: ${made.message}` })
      : kind === "html" ? make("iframe", { sandbox: "", srcdoc: html(), title: name })
      : text ? scroller("pre", name || (title ?? ""), { text })
      : "";
    node.replaceChildren(
      make("h2", { text: title || name || (isWrong ? "Nothing was made" : "Result") }),
      older,
      make("p", { class: isWrong ? "said wrong" : "said", role: "status", text: made.message }),
      left(made),
      svg ? scroller("div", `Picture: ${title}`, { class: "canvas contoursolve" }, ...picture(svg)) : "",
      takeAlong(
        name || "differences.txt",
        content,
        TYPES[kind] ?? "text/plain",
        text,
        text && name && !(kind in TYPES) ? button("Open as a new program", () => open(name, text)) : null,
        content.length && name && save ? button("Save into the folder", () => save(made)) : null,
      ),
      shown,
      details ? make("details", {}, make("summary", { text: "Details" }), scroller("pre", "Details", { text: details })) : "",
    );
  };
  return { node, show, mark: (isOlder: boolean): void => void (older.hidden = !isOlder) };
}
