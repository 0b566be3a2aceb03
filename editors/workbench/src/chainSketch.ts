// The sketch of a contour: what the drawing gives, every change with its undo, and what Python says of it.
import { decimal, type Option } from "./dom";
import { type Frame, orTrouble, type Transport, Trouble } from "./protocol";
import type { Saved, Work } from "./work";

const PAUSE = 60; // ms in which keys are gathered
const REST = 300; // ms without a key after which ranges are asked for
const MOST_PAST = 500;
const INCH = 25.4; // mm

export const KINDS = [["line", "Line"], ["arc", "Arc"]] as const;
export const TURNS = [["", "Sense not given"], ["cw", "Clockwise"], ["ccw", "Counter-clockwise"]] as const;
export const CORNERS = [["", "none"], ["rounding", "Rounding"], ["chamfer", "Chamfer"]] as const;
export const PARTS = [["turned", "Turned part: Z and X"], ["milled", "Milled part: X and Y"]] as const;
export const UNITS: readonly Option[] = [["mm", "mm"], ["inch", "inch"]];
export const AXES = { turned: ["Z", "X"], milled: ["X", "Y"] } as const;

export type Kind = "line" | "arc";
export type Values = Record<string, string>;
type Point = [number, number];

// A sketch as its file has it, with texts for numbers: what is being typed is not trimmed, and empty where it was erased.
export interface ChainElement {
  kind: Kind; turn?: string; tangent?: boolean;
  corner?: Values; // its size, by its shape
  guess?: Values; facts?: string[];
  [word: string]: string | boolean | Values | string[] | undefined;
}

export interface Chain {
  sketch: 1; part: "turned" | "milled"; unit: string; closed: boolean;
  start: Values; pole: Values; facts: string[];
  element: ChainElement[];
}

export type Piece = { kind: string; start: Point; end: Point; center?: Point; radius?: number; turn?: string };
export type ChainEntry = { number: number; field: string; meaning: string; example: string; ranges: { low: string; high: string }[] };

export interface ChainView {
  is_finished: boolean;
  text: string; json: string; // of its file
  elements: { name: string; number: number; state: string; told: string; off_mm: number | null; segment: Piece | null }[];
  said: string; // its state in one line
  entries: ChainEntry[];
  findings: { code: string; severity: string; message: string; help: string; fields: [number, string][]; fixes: { title: string; elements: Record<string, ChainElement> }[] }[];
  solutions: { name: string; segments: Piece[]; is_chosen: boolean; guess: { number: number; place: Values } }[];
  remarks: string[];
  picture: { svg: string; frame: Frame } | null;
}

const OWN = new Set(["kind", "turn", "tangent", "corner", "guess", "facts"]);

export const kept = (values: Values, names: readonly string[]): Values => Object.fromEntries(Object.entries(values).filter(([name]) => names.includes(name)));

// Of a line or arc, no other words than these.
export function keepWords(element: ChainElement, words: object): void {
  for (const name of Object.keys(element)) if (!OWN.has(name) && !(name in words)) delete element[name];
}

// Of a place, what an axis has of it as it is written: X of a turned part is a diameter.
const scaleOf = (chain: Chain, axis: number): number => (chain.part === "turned" && axis === 1 ? 2 : 1) / (chain.unit === "inch" ? INCH : 1);

export function guessAt(chain: Chain, place: Point): Values {
  return Object.fromEntries(AXES[chain.part].map((name, axis) => [name, (place[axis]! * scaleOf(chain, axis)).toFixed(chain.unit === "inch" ? 3 : 2)]));
}

// The places of all guesses, in mm.
export function guessesOf(chain: Chain): Point[] {
  return chain.element.flatMap(({ guess = {} }) => {
    const place = AXES[chain.part].map((name, axis) => Number(decimal(guess[name] ?? "") || NaN) / scaleOf(chain, axis));
    return place.every(Number.isFinite) ? [place as Point] : [];
  });
}

export function newChain(part: Chain["part"]): Chain {
  return { sketch: 1, part, unit: "mm", closed: false, start: Object.fromEntries(AXES[part].map((axis) => [axis, "0"])), pole: {}, facts: [], element: [] };
}

// A file need not have all of it.
export const chainOf = (plain: Partial<Chain>): Chain => ({ ...newChain(plain.part ?? "turned"), ...plain });

// Without what is empty: so it is asked about, and saved.
export const plainOf = (chain: Chain): object => ({ start: {}, element: [], ...(pruned(chain) as Partial<Chain>) });

function pruned(value: unknown): unknown {
  if (typeof value === "string") return value.trim();
  if (typeof value !== "object" || value === null) return value;
  const all = Object.entries(value).map(([name, each]) => [name, pruned(each)] as const);
  const filled = all.filter(([, each]) => each !== "" && each !== undefined && !(typeof each === "object" && each && !Object.keys(each).length));
  return Array.isArray(value) ? filled.map(([, each]) => each) : Object.fromEntries(filled);
}

export class Sketch implements Work {
  readonly noun = "contour";
  readonly ending = "toml";
  number = 1;
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
  private answered: Chain | null = null; // about which something is told last
  private isAsking = false; // whether more will be told about it
  private timer = 0;

  constructor(
    private readonly transport: Transport,
    public chain: Chain,
    public name: string,
    public base: string,
    private readonly shown: (sketch: Sketch, why: Trouble | null) => void,
  ) {
    this.saved = base ? this.state : "";
    void this.ask();
  }

  private get state() { return JSON.stringify(plainOf(this.chain)); }
  get isChanged() { return this.state !== this.saved; }
  get isEmpty() { return !this.chain.element.length; }
  get text() { return this.textFor(this.name); }
  get isOlder() { return this.answered !== this.chain; }
  get isWaiting() { return this.isOlder || this.isAsking; }
  get canUndo() { return this.past.length > 0; }
  get canRedo() { return this.future.length > 0; }

  undo = () => this.step(this.past, this.future);
  redo = () => this.step(this.future, this.past);
  again = () => this.ask();
  close = () => Promise.resolve();

  private textFor(name: string): string {
    const seen = this.seen === this.chain ? this.view : null;
    return (/\.json$/i.test(name) ? seen?.json : seen?.text) ?? JSON.stringify(plainOf(this.chain), null, 1);
  }

  // One change; those with the same mark, one after another, are one.
  change(mark: string, by: (chain: Chain) => void): void {
    const now = structuredClone(this.chain);
    by(now);
    if (JSON.stringify(now) === JSON.stringify(this.chain)) return;
    if (!mark || mark !== this.mark) this.past = [...this.past.slice(-MOST_PAST), this.chain];
    this.mark = mark;
    this.future = [];
    if (now.element.length !== this.chain.element.length) this.measured = [];
    this.become(now);
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
    const number = (this.asked += 1);
    await this.askedFor(number, false);
    if (number === this.asked && !this.trouble) this.timer = setTimeout(() => void this.askedFor(number, true), REST);
  }

  private async askedFor(number: number, ranges: boolean): Promise<void> {
    const { chain } = this;
    const question = { do: "sketch", sketch: plainOf(chain), ranges, ...(ranges ? { window: "ranges" } : {}) };
    const fell = (why: Trouble) => {
      if (number !== this.asked) return;
      [this.answered, this.isAsking, this.isBehind] = [chain, false, true];
      // "element 2: X is ..." names the field.
      const [, at, field] = /^(?:element (\d+): )?([\w.]+) /.exec(why.message) ?? [];
      if (why.reply) [this.place, this.trouble] = [[Number(at ?? 0), field ?? ""], this.named(why.message)];
      this.shown(this, why.reply ? null : why);
    };
    const view = await orTrouble(this.transport.ask<ChainView>(question), fell);
    if (!view || number !== this.asked) return;
    [this.view, this.seen, this.answered, this.trouble, this.place, this.isBehind, this.isAsking] = [view, chain, chain, "", null, false, !ranges];
    this.shown(this, null);
  }

  // A message as it names its elements.
  named(message: string): string {
    return message.replace(/^element (\d+)/, (whole, at) => (this.chain.element[at - 1] ? `${this.chain.element[at - 1]!.kind} ${at}` : whole));
  }

  // Raises Trouble: the reason where there are none.
  words<Reply>(control: string | null): Promise<Reply> {
    return this.transport.ask<Reply>({ do: "sketch_words", sketch: plainOf(this.chain), control });
  }

  // What makes no sense cannot be read again.
  async refusal(): Promise<string> {
    await this.ask();
    return this.trouble && `Mend this first: ${this.trouble}`;
  }

  wasSaved(name: string, base: string): void {
    [this.name, this.base, this.saved] = [name, base, this.state];
  }

  async save(options: { name?: string; over?: string }): Promise<Saved> {
    const why = await this.refusal();
    if (why) throw new Trouble(`Not saved. ${why}`, {});
    return this.transport.ask({ do: "save", name: this.name, text: this.textFor(options.name ?? this.name), base: options.name ? "" : this.base, ...options });
  }
}
