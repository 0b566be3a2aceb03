/** The status bar: the control of the program in sight, and how many of its contours are solved. */
import { type Disposable, StatusBarAlignment, ThemeColor, Uri, window } from "vscode";
import { LANGUAGES, type Status } from "./protocol";

const SOURCES: Record<string, string> = {
  "project file": "The project file contoursolve.toml names it.",
  comment: "A comment in the program names it.",
  "editor setting": "The setting contoursolve.control names it.",
  program: "The words of the program tell it.",
};

export class StatusBar implements Disposable {
  private readonly item = window.createStatusBarItem("contoursolve.status", StatusBarAlignment.Right, 100);
  private readonly known = new Map<string, Status>();
  private readonly listener = window.onDidChangeActiveTextEditor(() => this.show());

  constructor() {
    this.item.name = "contoursolve";
    this.item.command = "contoursolve.chooseControl";
  }

  take(status: Status): void {
    // The server may spell an address otherwise than VS Code does.
    this.known.set(Uri.parse(status.uri).toString(), status);
    this.show();
  }

  /** The server is gone, and with it what it said. */
  clear(): void {
    this.known.clear();
    this.show();
  }

  dispose(): void {
    this.listener.dispose();
    this.item.dispose();
  }

  private show(): void {
    const document = window.activeTextEditor?.document;
    const status = document && LANGUAGES.includes(document.languageId) && this.known.get(document.uri.toString());
    if (!status) {
      this.item.hide();
      return;
    }
    const icon = status.errors ? "$(error)" : status.warnings ? "$(warning)" : "$(check)";
    const counts = status.contours ? `${status.solved} of ${status.contours} solved` : "no contours";
    this.item.text = status.control ? `${icon} ${status.control}: ${counts}` : "$(question) no control";
    this.item.tooltip = [tell(status), "Click to choose the control."].join("\n");
    this.item.backgroundColor = status.control ? undefined : new ThemeColor("statusBarItem.warningBackground");
    this.item.show();
  }
}

function tell(status: Status): string {
  if (!status.control) return status.message || "The program does not tell its control.";
  const counts = [`${status.contours} contours`, `${status.solved} solved`];
  counts.push(`${status.errors} errors`, `${status.warnings} warnings`);
  const lines = [`${status.control}: ${counts.map((count) => count.replace(/^1 (\w+)s$/, "1 $1")).join(", ")}`];
  const source = SOURCES[status.source];
  return [...lines, ...(source ? [source] : []), ...(status.message ? [status.message] : [])].join("\n");
}
