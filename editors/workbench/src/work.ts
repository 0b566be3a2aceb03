// What a tab of the page holds: a program, or the sketch of a contour.
import type { Trouble } from "./protocol";

export interface Work {
  readonly name: string;
  readonly isChanged: boolean;
  readonly isEmpty: boolean;
  /** The mark of its file; empty where it has none. */
  readonly base: string;
  readonly text: string;
  /** Ends of names of its files, for one without a name. */
  readonly ending: string;
  /** Its file is this now. */
  wasSaved(name: string, base: string): void;
  /** Why it cannot be saved, in one sentence; empty where it can. */
  refusal?(): Promise<string>;
  save(options: { name?: string; over?: string }, isKnown: (why: Trouble) => boolean): Promise<{ saved: string; base: string } | null>;
  /** Ask for all of it again, after the Desk was away. */
  again(): Promise<unknown>;
  close(): Promise<unknown>;
}
