/** Starts the server `contoursolve lsp`, and gives its answers a place in VS Code. */
import {
  commands,
  type ExtensionContext,
  type LogOutputChannel,
  Selection,
  type TextDocument,
  type TextEditor,
  Uri,
  window,
  workspace,
} from "vscode";
import { LanguageClient, type LanguageClientOptions, RevealOutputChannelOn, type ServerOptions } from "vscode-languageclient/node";
import { chooseControl, convert, expand, explore, isResult, report } from "./commands";
import { PictureView } from "./picture";
import { LANGUAGES, type Status } from "./protocol";
import { choosePython, type Command, findServer, onInterpreterChange, spell } from "./python";
import { StatusBar } from "./status";

let client: LanguageClient | undefined;
let running: Command | undefined;
/** One start or stop at a time. */
let turn: Promise<void> = Promise.resolve();

export async function activate(context: ExtensionContext): Promise<void> {
  const output = window.createOutputChannel("contoursolve", { log: true });
  const status = new StatusBar();
  const folder = context.extensionUri.fsPath;
  const picture = new PictureView(folder, () => client);
  const restart = () => (turn = turn.catch(() => undefined).then(stop).then(() => start(folder, output, status, picture)));
  const register = (name: string, run: (...args: never[]) => unknown) =>
    context.subscriptions.push(commands.registerCommand(`contoursolve.${name}`, run));

  context.subscriptions.push(output, status, picture, { dispose: () => void stop() });
  register("restartServer", restart);
  register("showOutput", () => output.show());
  register("choosePython", choosePython);
  register("drawBeside", async (uri?: string, line?: number) => picture.open(await editorOf(uri, line)));
  register("exploreContour", async (uri?: string, line?: number) => {
    const editor = await editorOf(uri);
    await withServer((client) => explore(client, editor.document, line ?? editor.selection.active.line));
  });
  register("expandProgram", async (uri?: string) => {
    const document = await documentOf(uri);
    await withServer((client) => expand(client, document));
  });
  register("convertProgram", async (uri?: string) => {
    const document = await documentOf(uri);
    await withServer((client) => convert(client, document));
  });
  register("showReport", async (uri?: string) => {
    const document = await documentOf(uri);
    await withServer((client) => report(client, document));
  });
  register("chooseControl", () => withServer(chooseControl));

  // The Python extension may take its time; contour blocks need not wait for it.
  void onInterpreterChange(() => running, restart).then((listener) => listener && context.subscriptions.push(listener));
  context.subscriptions.push(
    workspace.onDidGrantWorkspaceTrust(restart),
    workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("contoursolve.python")) void restart();
    }),
  );
  await restart();
}

export async function deactivate(): Promise<void> {
  await turn.then(stop);
}

async function start(folder: string, output: LogOutputChannel, status: StatusBar, picture: PictureView): Promise<void> {
  running = await findServer(folder);
  if (!running) {
    output.error("No server is found.");
    return;
  }
  output.info(`The server, from ${running.source}: ${spell(running)}`);
  const server: ServerOptions = { command: running.command, args: running.args };
  const { control, settings, inlayHints, codeLenses, pictures } = workspace.getConfiguration("contoursolve");
  const options: LanguageClientOptions = {
    documentSelector: LANGUAGES.flatMap((language) => ["file", "untitled"].map((scheme) => ({ language, scheme }))),
    outputChannel: output,
    revealOutputChannelOn: RevealOutputChannelOn.Never,
    initializationOptions: { control, settings, inlayHints, codeLenses, pictures, clientCommands: true },
    synchronize: { configurationSection: "contoursolve" },
    middleware: {
      didOpen: (document, next) => (isResult(document) ? Promise.resolve() : next(document)),
      didChange: (event, next) => (isResult(event.document) ? Promise.resolve() : next(event)),
      window: { showDocument: (params, token, next) => showPage(params.uri) ?? next(params, token) },
    },
  };
  const made = new LanguageClient("contoursolve", "contoursolve", server, options);
  made.onNotification("contoursolve/status", (news: Status) => {
    status.take(news);
    picture.examined(news.uri);
  });
  made.onDidChangeState(() => {
    if (!made.isRunning()) status.clear();
    picture.refresh();
  });
  try {
    await made.start();
    client = made;
    picture.refresh();
  } catch (error) {
    output.error(String(error));
    const show = "Show the Output";
    const message = "The server of contoursolve did not start. The output says why.";
    void window.showErrorMessage(message, show).then((answer) => answer && output.show());
  }
}

async function stop(): Promise<void> {
  const old = client;
  client = undefined;
  try {
    await old?.dispose();
  } catch {
    // A server that has failed cannot be asked to stop.
  }
}

/** Pages about rules are Markdown: they are for reading. */
function showPage(address: string): Promise<{ success: boolean }> | undefined {
  const uri = Uri.parse(address);
  if (uri.scheme !== "file" || !uri.path.endsWith(".md")) return undefined;
  return Promise.resolve(commands.executeCommand("markdown.showPreviewToSide", uri)).then(() => ({ success: true }));
}

async function withServer(run: (client: LanguageClient) => Promise<void>): Promise<void> {
  await turn.catch(() => undefined);
  if (!client?.isRunning()) {
    const restart = "Restart the Server";
    const answer = await window.showErrorMessage("The server of contoursolve does not run.", restart);
    if (answer) await commands.executeCommand("contoursolve.restartServer");
    return;
  }
  try {
    await run(client);
  } catch (error) {
    void window.showErrorMessage(`contoursolve: ${error instanceof Error ? error.message : String(error)}`);
  }
}

async function documentOf(uri?: string | Uri): Promise<TextDocument> {
  return (await editorOf(uri)).document;
}

/** The editor of an address, or of what is in sight; with the cursor on a line, if one is given. */
async function editorOf(uri?: string | Uri, line?: number): Promise<TextEditor> {
  const active = window.activeTextEditor;
  const address = typeof uri === "string" ? Uri.parse(uri) : (uri ?? active?.document.uri);
  if (!address) throw new Error("Open a program first.");
  if (isResult({ uri: address })) throw new Error("Save this document first. contoursolve reads it when it has a file.");
  const seen = window.visibleTextEditors.find((editor) => editor.document.uri.toString() === address.toString());
  if (seen && seen === active && line === undefined) return seen;
  const editor = await window.showTextDocument(address, seen?.viewColumn ? { viewColumn: seen.viewColumn } : {});
  // The button in the title gives something else.
  if (typeof line === "number") {
    const { start } = editor.document.lineAt(line).range;
    if (editor.selection.active.line !== line) editor.selection = new Selection(start, start);
  }
  return editor;
}
