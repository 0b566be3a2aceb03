/** The picture beside the program: it follows the cursor and edits, and its words and those of the program are one. */
import { randomBytes } from "node:crypto";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import {
  CancellationTokenSource,
  type Disposable,
  OverviewRulerLane,
  Range,
  Selection,
  type TextEditor,
  TextEditorRevealType,
  ThemeColor,
  Uri,
  ViewColumn,
  type WebviewPanel,
  window,
  workspace,
} from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { isResult } from "./commands";
import { LANGUAGES, type Picture, type Word } from "./protocol";

/** What the page says. */
export type FromPage = { type: "ready" } | { type: "point"; key: string | null } | { type: "go"; key: string };

type Drawing = Pick<Picture, "svg" | "words" | "findings">;

/** What the page is told. */
export type ToPage =
  | { type: "picture"; picture: Drawing; marked: string | null }
  | { type: "none"; message: string }
  | { type: "mark"; key: string | null };

export const VIEW = "contoursolve.picture";
/** Milliseconds of rest before a picture is asked for: holding an arrow key asks once. */
const REST = 120;
const AIM = "Put the cursor into a contour block.";

export class PictureView implements Disposable {
  private panel: WebviewPanel | undefined;
  private editor: TextEditor | undefined;
  private shown: Picture | undefined;
  private last: ToPage = { type: "none", message: AIM };
  private timer: NodeJS.Timeout | undefined;
  private pending: CancellationTokenSource | undefined;
  private readonly parts: Disposable[];
  private readonly highlight = window.createTextEditorDecorationType({
    backgroundColor: new ThemeColor("editor.wordHighlightStrongBackground"),
    border: "1px solid",
    borderColor: new ThemeColor("focusBorder"),
    overviewRulerColor: new ThemeColor("editorOverviewRuler.wordHighlightStrongForeground"),
    overviewRulerLane: OverviewRulerLane.Center,
  });

  constructor(
    private readonly folder: string,
    private readonly client: () => LanguageClient | undefined,
  ) {
    this.parts = [
      this.highlight,
      window.onDidChangeTextEditorSelection(({ textEditor }) => this.follow(textEditor)),
      window.onDidChangeActiveTextEditor((editor) => editor && this.follow(editor)),
      workspace.onDidChangeTextDocument(({ document }) => {
        if (document === this.editor?.document) this.follow(this.editor);
      }),
      window.registerWebviewPanelSerializer(VIEW, { deserializeWebviewPanel: async (panel) => this.fill(panel) }),
    ];
  }

  /** Opens the picture beside the editor, or brings it into sight. */
  open(editor: TextEditor): void {
    if (this.panel) this.panel.reveal(undefined, true);
    else {
      const place = { viewColumn: ViewColumn.Beside, preserveFocus: true };
      this.fill(window.createWebviewPanel(VIEW, "Contour", place, { enableFindWidget: true }));
    }
    this.follow(editor);
  }

  /** Asks again: the server has come or gone. */
  refresh(): void {
    this.shown = undefined;
    if (this.editor) this.follow(this.editor);
  }

  /** Asks again where the server has read the same text anew: its settings have changed. */
  examined(uri: string): void {
    const document = this.editor?.document;
    if (document?.uri.toString() !== Uri.parse(uri).toString()) return;
    if (!this.shown || this.shown.version === document.version) this.refresh();
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.pending?.cancel();
    this.panel?.dispose();
    for (const part of this.parts) part.dispose();
  }

  private fill(panel: WebviewPanel): void {
    this.panel = panel;
    panel.webview.options = { enableScripts: true, localResourceRoots: [] };
    panel.webview.onDidReceiveMessage((message: FromPage) => this.hear(message));
    panel.onDidDispose(() => {
      this.panel = this.shown = undefined;
      this.point(null);
    });
    panel.webview.html = this.page();
    const editor = window.activeTextEditor ?? window.visibleTextEditors[0];
    if (editor) this.follow(editor);
  }

  private follow(editor: TextEditor): void {
    if (!this.panel || !LANGUAGES.includes(editor.document.languageId) || isResult(editor.document)) return;
    this.editor = editor;
    if (this.isShown()) {
      // The same contour: another word of it.
      clearTimeout(this.timer);
      this.pending?.cancel();
      this.tell({ type: "mark", key: this.wordAtCursor() });
      return;
    }
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(editor), REST);
  }

  private isShown(): boolean {
    const { shown, editor } = this;
    return (
      !!shown &&
      !!editor &&
      shown.version === editor.document.version &&
      shown.uri === editor.document.uri.toString() &&
      rangeOf(shown).contains(editor.selection.active)
    );
  }

  private async ask(editor: TextEditor): Promise<void> {
    const client = this.client();
    this.pending?.cancel();
    if (!client?.isRunning()) return this.show(undefined, "The server of contoursolve does not run.");
    const { document } = editor;
    const version = document.version;
    const source = new CancellationTokenSource();
    this.pending = source;
    const place = client.code2ProtocolConverter.asTextDocumentPositionParams(document, editor.selection.active);
    let picture: Picture | null;
    try {
      picture = await client.sendRequest<Picture | null>("contoursolve/picture", place, source.token);
    } catch (error) {
      if (!source.token.isCancellationRequested) this.show(undefined, String(error));
      return;
    }
    // An edit or another place has overtaken the answer.
    if (source.token.isCancellationRequested || document.version !== version) return;
    if (picture && picture.version !== version) return;
    const line = editor.selection.active.line + 1;
    // The server may spell an address otherwise than VS Code does.
    if (picture) picture.uri = document.uri.toString();
    this.show(picture ?? undefined, `Line ${line} is no part of a contour. ${AIM}`);
  }

  private show(picture: Picture | undefined, otherwise: string): void {
    this.shown = picture;
    this.point(null);
    this.last = picture
      ? { type: "picture", picture: slim(picture), marked: this.wordAtCursor() }
      : { type: "none", message: otherwise };
    this.tell(this.last);
  }

  private tell(message: ToPage): void {
    if (message.type === "mark" && this.last.type === "picture") this.last = { ...this.last, marked: message.key };
    void this.panel?.webview.postMessage(message);
  }

  private hear(message: FromPage): void {
    if (message.type === "ready") this.tell(this.last);
    else if (message.type === "point") this.point(message.key);
    else void this.go(message.key);
  }

  private wordAtCursor(): string | null {
    const cursor = this.editor?.selection.active;
    return this.shown?.words.find((word) => cursor && rangeOf(word).contains(cursor))?.key ?? null;
  }

  /** Highlights a word of the program, or none. */
  private point(key: string | null): void {
    this.editor?.setDecorations(this.highlight, this.words(key).map(rangeOf));
  }

  private async go(key: string): Promise<void> {
    const [word] = this.words(key);
    if (!word || !this.editor) return;
    const range = rangeOf(word);
    const editor = await window.showTextDocument(this.editor.document, { viewColumn: this.editor.viewColumn ?? 1 });
    editor.selection = new Selection(range.start, range.start);
    editor.revealRange(range, TextEditorRevealType.InCenterIfOutsideViewport);
  }

  /** The words of a key, where the picture and the program are of one version. */
  private words(key: string | null): Word[] {
    if (!this.shown || this.shown.version !== this.editor?.document.version) return [];
    return this.shown.words.filter((word) => word.key === key);
  }

  /** The page asks nobody for anything: its script and its styles stand in its text. */
  private page(): string {
    const nonce = randomBytes(16).toString("base64");
    const policy = `default-src 'none'; script-src 'nonce-${nonce}'; style-src 'nonce-${nonce}'`;
    return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>Contour</title>
<style nonce="${nonce}">${this.read("media/picture.css")}</style>
</head>
<body>
<main><figure></figure><section aria-live="polite"></section></main>
<script nonce="${nonce}">${this.read("dist/page.js")}</script>
</body>
</html>`;
  }

  private read(file: string): string {
    return readFileSync(join(this.folder, file), "utf8");
  }
}

function slim({ svg, words, findings }: Picture): Drawing {
  return { svg, words, findings };
}

function rangeOf({ range: { start, end } }: { range: Word["range"] }): Range {
  return new Range(start.line, start.character, end.line, end.character);
}
