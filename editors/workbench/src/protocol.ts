// What the page asks of the Desk (contoursolve/workbench/desk.py), and what it answers. Lines count from 1, columns and
// offsets count UTF-16 units from 0; the text has \n at the ends of lines.

export type Change = { from: number; to: number; text: string };
export type Stretch = { line: number; from: number; to: number };
export type Fix = { title: string; kind: string; effect: string }; // safe, changes-contour, placeholder

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

export type Made = { name: string; text?: string; base64?: string; message: string; details?: string; isWrong?: boolean };

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
