/** What the server `contoursolve lsp` says and hears beyond the standard protocol. */
import type { Range } from "vscode-languageclient";
import type { LanguageClient } from "vscode-languageclient/node";

/** What the server reads. */
export const LANGUAGES = ["gcode", "sinumerik", "klartext"];

export interface Status {
  uri: string;
  control: string | null;
  source: string;
  contours: number;
  solved: number;
  errors: number;
  warnings: number;
  /** Why no control is known. */
  message: string;
}

export interface Word {
  key: string;
  text: string;
  range: Range;
}

export interface Picture {
  uri: string;
  version: number;
  title: string;
  description: string;
  svg: string;
  range: Range;
  words: Word[];
  findings: string[];
}

export interface Control {
  name: string;
  title: string;
}

export interface Written {
  text: string | null;
  message: string;
}

export interface Report {
  html: string | null;
  message: string;
}

export interface Notebook {
  notebook: string | null;
  message: string;
}

/** What the server answers to a command of its own. */
export function ask<Answer>(client: LanguageClient, command: string, ...args: unknown[]): Promise<Answer> {
  return client.sendRequest<Answer>("workspace/executeCommand", { command, arguments: args });
}
