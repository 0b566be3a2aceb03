// What the page asks of the Desk (contoursolve/workbench/desk.py), and what it answers. Lines count from 1, columns and
// offsets count UTF-16 units from 0; the text has \n at the ends of lines.

export interface Change {
  from: number;
  to: number;
  text: string;
}

export interface Fix {
  title: string;
  kind: string; // safe, changes-contour, placeholder
  effect: string;
  lines: { line: number; text: string | null }[];
}

export interface Finding {
  code: string;
  severity: "error" | "warning" | "info";
  line: number;
  from: number;
  to: number;
  message: string;
  notes: string[];
  help: string;
  source: string;
  alarm: string;
  labels: { line: number; from: number; to: number; text: string }[];
  fixes: Fix[];
}

export interface ContourRow {
  line: number;
  last: number;
  status: string;
  told: string; // its status as the drawing names it
  title: string;
}

export interface ControlName {
  name: string;
  title: string;
  may_be_target?: boolean; // of a program that is converted
  machines?: string[]; // lathe, mill
}

export interface View {
  id: string;
  name: string;
  seq: number;
  base: string;
  encoding: string;
  has_changes: boolean;
  control: ControlName | null;
  control_from: string;
  trouble_control: string;
  unit: string;
  lines: number;
  examined: number;
  counts: { contours: number; solved: number; errors: number; warnings: number };
  text?: string;
  findings?: Finding[];
  more_findings?: number;
  contours?: ContourRow[];
}

export interface Hello {
  version: string;
  controls: ControlName[];
  folder: string | null;
  may_write: boolean;
  can_unlock: boolean;
  examples: { title: string; control: string }[];
  style?: string;
  drawing_words?: Record<string, Record<"line" | "arc", Record<string, string>>>;
  open?: string;
}

export interface Made {
  name: string;
  text?: string;
  base64?: string;
  message: string;
  details?: string;
}

// Where words stand: line, and columns.
export type Words = Record<string, [number, number, number]>;

export interface Looked {
  state: Record<string, unknown> | null;
  line: number | null;
  last: number | null;
  words?: Words;
}

// What a Transport gives back where it cannot: one sentence for the reader.
export class Trouble extends Error {
  constructor(
    message: string,
    readonly reply: Record<string, unknown> | null = null, // null where nobody answered
  ) {
    super(message);
  }
}

// The way to a Desk: the server of this page, or Python in a worker of the browser.
export interface Transport {
  ask<Reply>(request: Record<string, unknown>): Promise<Reply>;
}
