// The sketch of a contour: what the drawing gives, every change with its undo, and what Python says of it.
import { type Transport, Trouble } from "./protocol";
import type { Work } from "./work";

const PAUSE = 60; // ms in which keys are gathered
const REST = 300; // ms without a key after which ranges are asked for
const MOST_PAST = 500;

export type Values = Record<string, string>;

export interface ChainElement {
  kind: "line" | "arc";
  turn: string; // cw, ccw, or empty where the drawing does not say it
  tangent: boolean;
  words: Values;
  corner: string; // rounding, chamfer, or empty
  size: string; // of the corner
  guess: Values;
  facts: string;
}

export interface Chain {
  part: "turned" | "milled";
  unit: string;
  closed: boolean;
  start: Values;
  pole: Values;
  facts: string;
  elements: ChainElement[];
}

export interface Piece {
  kind: string;
  start: [number, number];
  end: [number, number];
  center?: [number, number];
  radius?: number;
  turn?: string;
}

export interface Frame {
  width: number;
  height: number;
  scale: number; // px for each mm
  origin: [number, number];
}

export interface ChainEntry {
  number: number;
  field: string;
  meaning: string;
  example: string;
  ranges: { low: string; high: string }[];
  is_complete: boolean;
}

export interface ChainView {
  status: string;
  is_finished: boolean;
  text: string; // of its file, as TOML and as JSON
  json: string;
  elements: { name: string; number: number; state: string; told: string; off_mm: number | null; segment: Piece | null }[];
  missing: string;
  said: string; // its state in one line
  entries: ChainEntry[];
  findings: { code: string; severity: string; message: string; help: string; fields: [number, string][]; fixes: { title: string; elements: Record<string, Plain> }[] }[];
  solutions: { name: string; segments: Piece[]; is_chosen: boolean; guess: { number: number; place: Values } }[];
  remarks: string[];
  picture: { svg: string; frame: Frame } | null;
}

export type Plain = Record<string, unknown>;

export const AXES = { turned: ["Z", "X"], milled: ["X", "Y"] } as const;

const OWN = new Set(["kind", "turn", "tangent", "corner", "guess", "facts"]);
const filled = (values: Values): Values => Object.fromEntries(Object.entries(values).flatMap(([name, value]) => (value.trim() ? [[name, value.trim()]] : [])));
const listed = (facts: string): string[] => facts.split("\n").map((each) => each.trim()).filter(Boolean);
const texts = (table: unknown): Values => Object.fromEntries(Object.entries((table ?? {}) as Plain).map(([name, value]) => [name, String(value)]));
const joined = (facts: unknown): string => ((facts ?? []) as string[]).join("\n");

export function newElement(kind: "line" | "arc"): ChainElement {
  return { kind, turn: "", tangent: false, words: {}, corner: "", size: "", guess: {}, facts: "" };
}

export function newChain(part: "turned" | "milled"): Chain {
  return { part, unit: "mm", closed: false, start: Object.fromEntries(AXES[part].map((axis) => [axis, "0"])), pole: {}, facts: "", elements: [] };
}

export function elementOf(plain: Plain): ChainElement {
  const [corner] = Object.entries((plain["corner"] ?? {}) as Plain);
  return {
    kind: plain["kind"] === "arc" ? "arc" : "line",
    turn: String(plain["turn"] ?? ""),
    tangent: plain["tangent"] === true,
    words: texts(Object.fromEntries(Object.entries(plain).filter(([name]) => !OWN.has(name)))),
    corner: corner?.[0] ?? "",
    size: corner ? String(corner[1]) : "",
    guess: texts(plain["guess"]),
    facts: joined(plain["facts"]),
  };
}

export function chainOf(plain: Plain): Chain {
  return {
    part: plain["part"] === "milled" ? "milled" : "turned",
    unit: String(plain["unit"] ?? "mm"),
    closed: plain["closed"] === true,
    start: texts(plain["start"]),
    pole: texts(plain["pole"]),
    facts: joined(plain["facts"]),
    elements: ((plain["element"] ?? []) as Plain[]).map(elementOf),
  };
}

// As the file has it; numbers stay as they were typed.
export function plainOf(chain: Chain): Plain {
  return {
    sketch: 1,
    part: chain.part,
    unit: chain.unit,
    closed: chain.closed,
    start: filled(chain.start),
    pole: filled(chain.pole),
    facts: listed(chain.facts),
    element: chain.elements.map((each) => ({
      kind: each.kind,
      ...(each.kind === "arc" && each.turn ? { turn: each.turn } : {}),
      ...(each.tangent ? { tangent: true } : {}),
      ...filled(each.words),
      ...(each.corner && each.size.trim() ? { corner: { [each.corner]: each.size.trim() } } : {}),
      ...(Object.keys(filled(each.guess)).length ? { guess: filled(each.guess) } : {}),
      ...(listed(each.facts).length ? { facts: listed(each.facts) } : {}),
    })),
  };
}

export class Sketch implements Work {
  readonly ending = "toml";
  view: ChainView | null = null;
  trouble = ""; // about what was typed
  place: [number, string] | null = null; // of the field that makes it
  isBehind = false; // whether the view is that of an earlier chain, for of this one nothing is known
  measured: Values[] = []; // what a drawing of CAD has of each element, as long as they are those
  private past: Chain[] = [];
  private future: Chain[] = [];
  private mark = ""; // of the field that is being typed in: all of it is one change
  private saved: string;
  private asked = 0;
  private seen: Chain | null = null; // of which the view tells
  private timer = 0;

  constructor(
    private readonly transport: Transport,
    public chain: Chain,
    public name: string,
    public base: string,
    private readonly shown: (sketch: Sketch, why: Trouble | null) => void,
  ) {
    this.saved = base ? JSON.stringify(chain) : "";
    void this.ask();
  }

  get isChanged(): boolean {
    return JSON.stringify(this.chain) !== this.saved;
  }

  get isEmpty(): boolean {
    return !this.chain.elements.length;
  }

  get text(): string {
    return this.textFor(this.name);
  }

  private textFor(name: string): string {
    const seen = this.seen === this.chain ? this.view : null;
    return (/\.json$/i.test(name) ? seen?.json : seen?.text) ?? JSON.stringify(plainOf(this.chain), null, 1);
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  // One change; those with the same mark, one after another, are one.
  change(mark: string, by: (chain: Chain) => void): void {
    const now = structuredClone(this.chain);
    by(now);
    if (JSON.stringify(now) === JSON.stringify(this.chain)) return;
    if (!mark || mark !== this.mark) this.past = [...this.past.slice(-MOST_PAST), this.chain];
    this.mark = mark;
    this.future = [];
    if (now.elements.length !== this.chain.elements.length) this.measured = [];
    this.become(now);
  }

  undo(): void {
    this.step(this.past, this.future);
  }

  redo(): void {
    this.step(this.future, this.past);
  }

  private step(from: Chain[], to: Chain[]): void {
    const found = from.pop();
    if (!found) return;
    to.push(this.chain);
    this.mark = "";
    this.become(found);
  }

  private become(chain: Chain): void {
    this.chain = chain;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(), PAUSE);
    this.shown(this, null);
  }

  // What is known of it, and when its user rests, ranges and fixes, too. Of several answers under way, the last counts.
  async ask(): Promise<void> {
    clearTimeout(this.timer);
    this.asked += 1;
    const number = this.asked;
    await this.askedFor(number, false);
    if (number === this.asked && !this.trouble) this.timer = setTimeout(() => void this.askedFor(number, true), REST);
  }

  private async askedFor(number: number, ranges: boolean): Promise<void> {
    const { chain } = this;
    try {
      const view = await this.transport.ask<ChainView>({ do: "sketch", sketch: plainOf(chain), ranges, ...(ranges ? { window: "ranges" } : {}) });
      if (number !== this.asked) return;
      [this.view, this.seen, this.trouble, this.place, this.isBehind] = [view, chain, "", null, false];
      this.shown(this, null);
    } catch (error) {
      if (!(error instanceof Trouble)) throw error;
      if (number !== this.asked) return;
      this.isBehind = true;
      if (error.reply) {
        // "element 2: X is ..." names the field.
        const [, number, field] = /^(?:element (\d+): )?([\w.]+) /.exec(error.message) ?? [];
        this.place = [Number(number ?? 0), field ?? ""];
        this.trouble = this.named(error.message);
      }
      this.shown(this, error.reply ? null : error);
    }
  }

  private named(message: string): string {
    return message.replace(/^element (\d+)/, (whole, at) => (this.chain.elements[at - 1] ? `${this.chain.elements[at - 1]!.kind} ${at}` : whole));
  }

  // Where there are none, the reason.
  async words<Reply>(control: string | null): Promise<Reply | null> {
    try {
      return await this.transport.ask<Reply>({ do: "sketch_words", sketch: plainOf(this.chain), control });
    } catch (error) {
      if (!(error instanceof Trouble)) throw error;
      if (error.reply) return { reason: this.named(error.message), candidates: [], rows: [] } as Reply;
      this.shown(this, error);
      return null;
    }
  }

  // What makes no sense cannot be read again.
  async refusal(): Promise<string> {
    await this.ask();
    return this.trouble && `Mend this first: ${this.trouble}`;
  }

  wasSaved(name: string, base: string): void {
    [this.name, this.base] = [name, base];
    this.saved = JSON.stringify(this.chain);
  }

  async save(options: { name?: string; over?: string }, isKnown: (why: Trouble) => boolean): Promise<{ saved: string; base: string } | null> {
    const why = await this.refusal();
    if (why) {
      this.shown(this, new Trouble(`Not saved. ${why}`, {}));
      return null;
    }
    try {
      return await this.transport.ask({ do: "save", name: this.name, text: this.textFor(options.name ?? this.name), base: options.name ? "" : this.base, ...options });
    } catch (error) {
      if (!(error instanceof Trouble)) throw error;
      if (!isKnown(error)) this.shown(this, error);
      return null;
    }
  }

  again(): Promise<void> {
    return this.ask();
  }

  async close(): Promise<void> {}
}
