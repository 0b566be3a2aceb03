// What the page asks of the Desk (contoursolve/workbench/desk.py), and what it answers. Lines count from 1, columns and
// offsets count UTF-16 units from 0; the text has \n at the ends of lines.

export type Change = { from: number; to: number; text: string };
export type Stretch = { line: number; from: number; to: number };
// Its kind is safe, changes-contour or placeholder; a fix that chooses one of several solutions has its letter.
export type Fix = { title: string; kind: string; effect: string; solution?: string };

export interface Finding extends Stretch {
  code: string;
  severity: "error" | "warning" | "info";
  message: string; notes: string[]; help: string; source: string; alarm: string;
  labels: (Stretch & { text: string })[];
  fixes: Fix[];
}

// `told` is its status as the drawing names it.
export type ContourRow = { line: number; last: number; status: string; told: string; title: string };

// `may_be_target` of a program that is converted; its machines are lathe and mill.
export type ControlName = { name: string; title: string; may_be_target?: boolean; machines?: string[] };

export interface View {
  id: string; name: string; seq: number;
  base: string; encoding: string; has_order_mark: boolean; line_end: string; has_changes: boolean;
  control: ControlName | null; control_from: string; trouble_control: string; unit: string;
  lines: number; examined: number; counts: object;
  text?: string; // here and below: what changed
  findings?: Finding[]; more_findings?: number;
  contours?: ContourRow[];
}

export interface Hello {
  controls: ControlName[];
  folder: string | null; may_write: boolean;
  examples: { title: string; control: string }[];
  style?: string;
  drawing_words?: Record<string, Record<"line" | "arc", Record<string, string>>>;
  open?: string;
}

// A place in the plane of a drawing, mm; X of a turned part as a radius.
export type Spot = [number, number];
export type Frame = { width: number; height: number; scale: number; origin: Spot; box?: [number, number, number, number] }; // px for each mm
// A move of the tool. An arc turns by `sweep` radians about its centre, counter-clockwise positive.
export type Move = { line: number; kind: "rapid" | "feed"; start: Spot; end: Spot; center?: Spot; sweep?: number };
// A way that a contour with several may take.
export type Way = { letter: string; line: number; pieces: Omit<Move, "line" | "kind">[] };
export type Drawn = { svg: string; frame: Frame | null; axes: string[]; isDiameter: boolean[]; unit: string; moves: Move[]; left_out: number; ways: Way[] };

export type Made = { name: string; title?: string; svg?: string; text?: string; base64?: string; message: string; details?: string; isWrong?: boolean; not_converted?: { line: number; text: string; reason: string }[] };

// Where words stand: line, and columns.
export type Words = Record<string, [number, number, number]>;

export type Looked = { state: Record<string, unknown> | null; line: number | null; last: number | null; words?: Words };

// What a Transport gives back where it cannot: one sentence for the reader.
export class Trouble extends Error {
  constructor(
    message: string,
    readonly reply: Record<string, unknown> | null = null, // null where nobody answered
  ) {
    super(message);
  }
}

// What is answered; null where it fails, and then `told` hears why.
export async function orTrouble<Reply>(answer: Promise<Reply>, told: (why: Trouble) => void): Promise<Reply | null> {
  try {
    return await answer;
  } catch (error) {
    if (!(error instanceof Trouble)) throw error;
    told(error);
    return null;
  }
}

// The way to a Desk: the server of this page, or Python in a worker of the browser.
export interface Transport {
  ask<Reply>(request: Record<string, unknown>): Promise<Reply>;
}
