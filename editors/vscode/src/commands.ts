/** What the commands do. No command changes the user's file: each result is a new document. */
import { basename, parse } from "node:path";
import { TextEncoder } from "node:util";
import {
  commands,
  extensions,
  languages,
  NotebookCellData,
  NotebookCellKind,
  NotebookData,
  Position,
  type QuickPickItem,
  type TextDocument,
  Uri,
  ViewColumn,
  type WebviewPanel,
  window,
  workspace,
  WorkspaceEdit,
} from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { ask, type Control, type Notebook, type Report, type Written } from "./protocol";

/** Documents that hold what the server wrote. It does not read them: they may be for another control. */
const results = new Set<string>();

export function isResult({ uri }: { uri: Uri }): boolean {
  return results.has(uri.toString());
}

export async function expand(client: LanguageClient, document: TextDocument): Promise<void> {
  const written = await ask<Written>(client, "contoursolve.expand", document.uri.toString());
  await showWritten(document, written, "plain", `in plain ${document.languageId === "klartext" ? "Klartext" : "G-code"}`);
}

export async function convert(client: LanguageClient, document: TextDocument): Promise<void> {
  const control = await pickControl(client, "Convert the program for which control?");
  if (!control) return;
  const written = await ask<Written>(client, "contoursolve.convert", document.uri.toString(), control);
  await showWritten(document, written, control, `for ${control}`);
}

/** What the server says, as a sentence beside others. */
function sentence(text: string): string {
  return text && text.charAt(0).toUpperCase() + text.slice(1) + (/[.!?]$/.test(text) ? "" : ".");
}

async function showWritten(document: TextDocument, written: Written, mark: string, what: string): Promise<void> {
  if (written.text === null) {
    void window.showErrorMessage(sentence(written.message) || "contoursolve wrote no program.");
    return;
  }
  const made = await newDocument(document, written.text, mark);
  await window.showTextDocument(made, { viewColumn: ViewColumn.Beside, preview: false });
  const compare = "Compare";
  const name = basename(document.fileName);
  const news = `This is a new document: the program ${what}. ${name} is as it was.`;
  const answer = await window.showInformationMessage([news, sentence(written.message)].filter(Boolean).join(" "), compare);
  if (answer) await commands.executeCommand("vscode.diff", document.uri, made.uri, `${name} and the program ${what}`);
}

/** The ending of files, by the language of what is written into them. */
const ENDINGS: Record<string, string> = { gcode: ".nc", sinumerik: ".mpf", klartext: ".h" };

/** The language of a control's programs. */
function languageOf(control: string): string {
  return control === "heidenhain" ? "klartext" : control.startsWith("siemens") ? "sinumerik" : "gcode";
}

/** A document without a file, whose name says what it holds. */
async function newDocument(document: TextDocument, text: string, mark: string): Promise<TextDocument> {
  const { name, ext } = parse(document.fileName);
  const own = mark === "plain" ? document.languageId : languageOf(mark);
  const ending = mark === "plain" || own === document.languageId ? ext : ENDINGS[own];
  const taken = new Set(workspace.textDocuments.map((open) => open.uri.toString()));
  let uri: Uri;
  let number = 1;
  do {
    uri = Uri.from({ scheme: "untitled", path: `${name}-${mark}${number > 1 ? `-${number}` : ""}${ending}` });
    number += 1;
  } while (taken.has(uri.toString()));
  results.add(uri.toString());
  // .h belongs to C.
  const made = await languages.setTextDocumentLanguage(await workspace.openTextDocument(uri), own);
  const edit = new WorkspaceEdit();
  edit.insert(uri, new Position(0, 0), text);
  await workspace.applyEdit(edit);
  return made;
}

export async function explore(client: LanguageClient, document: TextDocument, line: number): Promise<void> {
  const answer = await ask<Notebook>(client, "contoursolve.explore", document.uri.toString(), line);
  if (answer.notebook === null) {
    void window.showErrorMessage(sentence(answer.message) || `Line ${line + 1} is no part of a contour.`);
    return;
  }
  const made = await workspace.openNotebookDocument("jupyter-notebook", notebookData(answer.notebook));
  await window.showNotebookDocument(made, { viewColumn: ViewColumn.Beside });
  if (!extensions.getExtension("ms-toolsai.jupyter")) {
    void window.showInformationMessage("To run the notebook, install the extension Jupyter.");
  }
}

interface Ipynb {
  cells: { cell_type: string; source: string | string[] }[];
  metadata: Record<string, unknown>;
  nbformat: number;
  nbformat_minor: number;
}

function notebookData(text: string): NotebookData {
  const { cells, ...rest } = JSON.parse(text) as Ipynb;
  const data = new NotebookData(
    cells.map(({ cell_type, source }) => {
      const isCode = cell_type === "code";
      const lines = Array.isArray(source) ? source.join("") : source;
      return new NotebookCellData(
        isCode ? NotebookCellKind.Code : NotebookCellKind.Markup,
        lines,
        isCode ? "python" : "markdown",
      );
    }),
  );
  data.metadata = rest;
  return data;
}

let reportPanel: WebviewPanel | undefined;

export async function report(client: LanguageClient, document: TextDocument): Promise<void> {
  const { html, message } = await ask<Report>(client, "contoursolve.report", document.uri.toString());
  if (html === null) {
    void window.showErrorMessage(sentence(message) || "contoursolve wrote no report.");
    return;
  }
  const name = basename(document.fileName);
  if (!reportPanel) {
    const place = { viewColumn: ViewColumn.Beside, preserveFocus: true };
    reportPanel = window.createWebviewPanel("contoursolve.report", "Report", place, {
      enableFindWidget: true,
      localResourceRoots: [],
    });
    reportPanel.onDidDispose(() => (reportPanel = undefined));
  }
  reportPanel.title = `Report: ${name}`;
  // The page brings its own styles, and may load nothing.
  const policy = `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:">`;
  reportPanel.webview.html = html.replace(/<head[^>]*>/i, (head) => head + policy);
  reportPanel.reveal(undefined, true);
  const save = "Save the Page...";
  const news = ["This is the report. Save it to print or send it.", sentence(message)].filter(Boolean).join(" ");
  if ((await window.showInformationMessage(news, save)) !== save) return;
  const beside = document.uri.scheme === "file" ? { defaultUri: Uri.file(document.fileName.replace(/(\.\w+)?$/, ".html")) } : {};
  const target = await window.showSaveDialog({ ...beside, filters: { "Web page": ["html"] } });
  if (target) await workspace.fs.writeFile(target, new TextEncoder().encode(html));
}

/** The control of the setting becomes the one that the user picks. */
export async function chooseControl(client: LanguageClient): Promise<void> {
  const control = await pickControl(client, "Your programs are for which control?", "Tell it from the program");
  if (control === undefined) return;
  const inFolder = workspace.workspaceFolders !== undefined;
  // A folder has programs for one machine; without a folder the setting is the user's.
  await workspace.getConfiguration("contoursolve").update("control", control, !inFolder);
  const whose = inFolder ? "The programs of this folder are" : "Your programs are";
  const others = "A project file, or a comment in a program, still counts more.";
  const news = control ? `${whose} for ${control} now.` : "Each program tells its control now.";
  void window.showInformationMessage(`${news} ${others}`);
}

async function pickControl(client: LanguageClient, title: string, none?: string): Promise<string | undefined> {
  const controls = await ask<Control[]>(client, "contoursolve.controls");
  const items: (QuickPickItem & { control: string })[] = controls.map(({ name, title }) => ({
    label: name,
    description: title,
    control: name,
  }));
  if (none) items.unshift({ label: none, control: "" });
  return (await window.showQuickPick(items, { title, matchOnDescription: true }))?.control;
}
