/** Finds a Python that has contoursolve[lsp], or says what to type. */
import { execFile } from "node:child_process";
import { access } from "node:fs/promises";
import { homedir } from "node:os";
import { join } from "node:path";
import { ConfigurationTarget, type Disposable, env, extensions, type Uri, window, workspace } from "vscode";

/** A command that starts Python, such as `py -3`. */
export interface Python {
  command: string;
  args: string[];
}

const WINDOWS = process.platform === "win32";
// The first line tells a Python that lacks the packages from one that is too old, or is none.
const PROBE = "import sys; print(sys.version_info >= (3, 11), flush=True); import contoursolve, pygls";
const PATIENCE = 30_000;

/** The Python of the setting, or else the first that has the packages; undefined, when the user has been told why. */
export async function findPython(folder: string): Promise<Python | undefined> {
  const chosen = fromSetting();
  let usable: Python | undefined;
  for await (const python of chosen ? [chosen] : candidates()) {
    const found = await probe(python, folder);
    if (found === "ready") return python;
    if (found === "lacks packages") usable ??= python;
  }
  void advise(chosen, usable);
  return undefined;
}

/** Lets the user choose a Python; the setting keeps it. */
export async function choosePython(): Promise<void> {
  const filters = WINDOWS ? { filters: { Python: ["exe"] } } : {};
  const files = await window.showOpenDialog({ title: "Choose the Python that has contoursolve[lsp]", ...filters });
  const file = files?.[0]?.fsPath;
  if (file) await workspace.getConfiguration("contoursolve").update("python", file, ConfigurationTarget.Global);
}

/** Calls back when the Python extension, if there is one, has another interpreter than the one that runs. */
export async function onInterpreterChange(
  running: () => Python | undefined,
  changed: () => void,
): Promise<Disposable | undefined> {
  return (await pythonExtension())?.onDidChangeActiveEnvironmentPath?.(async () => {
    if (!fromSetting() && (await activeInterpreter()) !== running()?.command) changed();
  });
}

function fromSetting(): Python | undefined {
  const text = workspace.getConfiguration("contoursolve").get<string>("python", "").trim();
  if (!text) return undefined;
  const folder = workspace.workspaceFolders?.[0]?.uri.fsPath ?? "";
  const path = text.replace(/^~(?=[\\/])/, homedir()).replaceAll("${workspaceFolder}", folder);
  return path === "py -3" ? { command: "py", args: ["-3"] } : { command: path, args: [] };
}

async function* candidates(): AsyncGenerator<Python> {
  // These two may run what a stranger wrote.
  if (workspace.isTrusted) {
    const active = await activeInterpreter();
    if (active) yield { command: active, args: [] };
    for (const folder of workspace.workspaceFolders ?? []) {
      const command = join(folder.uri.fsPath, ".venv", WINDOWS ? "Scripts" : "bin", WINDOWS ? "python.exe" : "python");
      if (await exists(command)) yield { command, args: [] };
    }
  }
  if (WINDOWS) yield { command: "py", args: ["-3"] };
  yield { command: "python3", args: [] };
  yield { command: "python", args: [] };
}

function probe(python: Python, folder: string): Promise<"ready" | "lacks packages" | "unusable"> {
  return new Promise((resolve) => {
    // In a folder of ours: `-c` imports from the folder in which it runs.
    const options = { cwd: folder, timeout: PATIENCE, windowsHide: true };
    try {
      execFile(python.command, [...python.args, "-c", PROBE], options, (error, stdout) => {
        if (!error) return resolve("ready");
        resolve(stdout.startsWith("True") ? "lacks packages" : "unusable");
      });
    } catch {
      resolve("unusable"); // no name of a program, such as an empty one
    }
  });
}

async function advise(chosen: Python | undefined, usable: Python | undefined): Promise<void> {
  const choose = "Choose Python...";
  if (!usable) {
    const problem = chosen
      ? `contoursolve cannot run ${chosen.command}, which the setting contoursolve.python names.`
      : "contoursolve found no Python.";
    const answer = await window.showErrorMessage(`${problem} It needs Python 3.11 or newer.`, choose);
    if (answer) await choosePython();
    return;
  }
  const command = `${spell(usable)} -m pip install "contoursolve[lsp]"`;
  const copy = "Copy";
  const next = 'Type this in a terminal, and run "contoursolve: Restart the Server"';
  const message = `This Python lacks contoursolve. ${next}: ${command}`;
  const answer = await window.showErrorMessage(message, copy, choose);
  if (answer === copy) await env.clipboard.writeText(command);
  if (answer === choose) await choosePython();
}

/** The command as the terminal of VS Code reads it: PowerShell on Windows calls what is quoted by `&`. */
export function spell(python: Python): string {
  const quoted = /[\s&()]/.test(python.command) ? `"${python.command}"` : python.command;
  return [WINDOWS && quoted !== python.command ? `& ${quoted}` : quoted, ...python.args].join(" ");
}

/** The part of the Python extension that is used here. */
interface Environments {
  getActiveEnvironmentPath(resource?: Uri): { path: string };
  resolveEnvironment(path: unknown): Promise<{ executable: { uri?: Uri } } | undefined>;
  onDidChangeActiveEnvironmentPath?(listener: () => void): Disposable;
}

async function pythonExtension(): Promise<Environments | undefined> {
  const extension = extensions.getExtension<{ environments?: Environments }>("ms-python.python");
  try {
    return (await extension?.activate())?.environments;
  } catch {
    return undefined; // Its trouble is not ours: another Python may do.
  }
}

async function activeInterpreter(): Promise<string | undefined> {
  try {
    const environments = await pythonExtension();
    const path = environments?.getActiveEnvironmentPath(workspace.workspaceFolders?.[0]?.uri);
    return path && (await environments?.resolveEnvironment(path))?.executable.uri?.fsPath;
  } catch {
    return undefined;
  }
}

async function exists(path: string): Promise<boolean> {
  return access(path).then(
    () => true,
    () => false,
  );
}
