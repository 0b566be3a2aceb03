/** Finds the program that serves: that of the extension's own folder, or a Python that has contoursolve[lsp]. */
import { execFile } from "node:child_process";
import { access } from "node:fs/promises";
import { homedir } from "node:os";
import { join } from "node:path";
import { ConfigurationTarget, type Disposable, env, extensions, type Uri, window, workspace } from "vscode";

/** A command that starts the server, or a Python that may have it, such as `py -3`; and what names it. */
export interface Command {
  command: string;
  args: string[];
  source: string;
}

const WINDOWS = process.platform === "win32";
// The first line tells a Python that lacks the packages from one that is too old, or is none.
const PROBE = "import sys; print(sys.version_info >= (3, 11), flush=True); import contoursolve, pygls";
const PATIENCE = 30_000;
const BUNDLED = "the extension's own folder";

/** The server with the Python of the setting, or else the one of the extension's folder, or else with the first Python
 * that has the packages; undefined, when the user has been told why. */
export async function findServer(folder: string): Promise<Command | undefined> {
  const chosen = fromSetting();
  const bundled = join(folder, "server", WINDOWS ? "contoursolve.exe" : "contoursolve");
  if (!chosen && (await exists(bundled))) return { command: bundled, args: ["lsp"], source: BUNDLED };
  const python = await findPython(chosen, folder);
  // -P: a file of the user's folder must not stand in for a Python package.
  return python && { ...python, args: [...python.args, "-P", "-m", "contoursolve", "lsp"] };
}

async function findPython(chosen: Command | undefined, folder: string): Promise<Command | undefined> {
  let usable: Command | undefined;
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
  running: () => Command | undefined,
  changed: () => void,
): Promise<Disposable | undefined> {
  return (await pythonExtension())?.onDidChangeActiveEnvironmentPath?.(async () => {
    const isFree = !fromSetting() && running()?.source !== BUNDLED;
    if (isFree && (await activeInterpreter()) !== running()?.command) changed();
  });
}

function fromSetting(): Command | undefined {
  const text = workspace.getConfiguration("contoursolve").get<string>("python", "").trim();
  if (!text) return undefined;
  const folder = workspace.workspaceFolders?.[0]?.uri.fsPath ?? "";
  const path = text.replace(/^~(?=[\\/])/, homedir()).replaceAll("${workspaceFolder}", folder);
  const source = "the setting contoursolve.python";
  return path === "py -3" ? { command: "py", args: ["-3"], source } : { command: path, args: [], source };
}

async function* candidates(): AsyncGenerator<Command> {
  // These two may run what a stranger wrote.
  if (workspace.isTrusted) {
    const active = await activeInterpreter();
    if (active) yield { command: active, args: [], source: "the Python extension" };
    for (const folder of workspace.workspaceFolders ?? []) {
      const command = join(folder.uri.fsPath, ".venv", WINDOWS ? "Scripts" : "bin", WINDOWS ? "python.exe" : "python");
      if (await exists(command)) yield { command, args: [], source: "the environment of the folder" };
    }
  }
  if (WINDOWS) yield { command: "py", args: ["-3"], source: "the launcher of Python" };
  for (const command of ["python3", "python"]) yield { command, args: [], source: "the PATH" };
}

function probe(python: Command, folder: string): Promise<"ready" | "lacks packages" | "unusable"> {
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

async function advise(chosen: Command | undefined, usable: Command | undefined): Promise<void> {
  const choose = "Choose Python...";
  if (!usable) {
    const problem = chosen
      ? `contoursolve cannot run ${chosen.command}, which the setting contoursolve.python names.`
      : "contoursolve found no Python.";
    const help = `Install Python 3.11 or newer, and type in a terminal: ${WINDOWS ? "py -3" : "python3"} -m pip install "contoursolve[lsp]"`;
    const answer = await window.showErrorMessage(`${problem} ${help}`, choose);
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
export function spell({ command, args }: Command): string {
  const quoted = /[\s&()]/.test(command) ? `"${command}"` : command;
  return [WINDOWS && quoted !== command ? `& ${quoted}` : quoted, ...args].join(" ");
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
