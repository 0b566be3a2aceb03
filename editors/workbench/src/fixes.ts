// The fixes of a finding as buttons: the words first, then what comes of it.
import { button, make } from "./dom";
import type { Finding, Fix } from "./protocol";

const ARROW = " -> ";

function fixButton({ title, effect, kind, solution }: Fix, apply: () => void, light: (isLit: boolean) => void): HTMLButtonElement {
  const [words, outcome] = title.split(ARROW, 2) as [string, string?];
  const about = [outcome, effect].filter(Boolean).join(" · ");
  const made = button("", apply, { class: `fix ${kind}`, "data-solution": solution });
  made.append(...(solution ? [make("i", { text: solution }), " "] : []), make("b", { text: words }), about && " ", about && make("span", { text: about }));
  for (const name of ["pointerenter", "focus"]) made.addEventListener(name, () => light(true));
  for (const name of ["pointerleave", "blur"]) made.addEventListener(name, () => light(false));
  return made;
}

// Those that are shown at once, and the rest. All ways that choose a solution are shown: they are what there is to choose.
export function fixButtons({ fixes }: Finding, most: number, apply: (place: number) => void, light: (place: number | null) => void): [HTMLElement[], HTMLElement[]] {
  const all = fixes.map((fix, place) => fixButton(fix, () => apply(place), (isLit) => light(isLit ? place : null)));
  const shown = Math.max(most, fixes.filter((each) => each.solution).length);
  return [all.slice(0, shown), all.slice(shown)];
}
