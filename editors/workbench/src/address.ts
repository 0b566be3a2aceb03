// What the address of "Try a block" holds behind the #: a program, and its control.
import { base64Of, bytesOf } from "./dom";

const PAUSE = 300; // ms without a change until the address follows; browsers forbid to write it often
const LONGEST = 6000; // characters of a program
const KLARTEXT = /^\s*\d*\s*F?[LC]\b/im;

export type Linked = { text: string; control: string };

export class Address {
  told = ""; // what it holds, or is about to
  private timer = 0;

  read(): Linked | null {
    const hash = location.hash.slice(1);
    if (hash === this.told) return null;
    // A program is base64, without any +; a link of before, with a block and its start as they were typed, may have some.
    const found = new URLSearchParams(hash.replaceAll("+", "%2B"));
    const text = unpacked(found.get("program") ?? "") || begun(found.get("start") ?? "", found.get("block") ?? "");
    return text ? { text, control: found.get("control") ?? "" } : null;
  }

  write(text: string, control: string): void {
    const parts = new URLSearchParams({ program: packed(text), ...(control ? { control } : {}) });
    const told = text.length <= LONGEST ? parts.toString() : "";
    if (told === this.told) return;
    this.told = told;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.show(), PAUSE);
  }

  show(): void {
    history.replaceState(null, "", `#${this.told}`);
  }
}

// The block of a link of before, behind a move to its start.
const begun = (start: string, block: string): string => (block && start ? `${KLARTEXT.test(block) ? "L" : "G00"} ${start}\n${block}` : block);

// A text as it can stand in an address, whatever characters it has.
function packed(text: string): string {
  return base64Of(new TextEncoder().encode(text)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

function unpacked(text: string): string {
  try {
    return new TextDecoder().decode(bytesOf(text.replaceAll("-", "+").replaceAll("_", "/")));
  } catch {
    return ""; // a link that was cut off, or that means a place on the page
  }
}
