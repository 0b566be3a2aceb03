// What a tab of the page holds: a program, or the sketch of a contour.
export type Saved = { saved: string; base: string };

export interface Work {
  readonly noun: string;
  /** Tells those without a name apart, as long as they are open. */
  number: number;
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
  refusal(): Promise<string>;
  /** Save it; raises Trouble. */
  save(options: { name?: string; over?: string }): Promise<Saved>;
  /** Ask for all of it again, after the Desk was away. */
  again(): Promise<unknown>;
  close(): Promise<unknown>;
}
