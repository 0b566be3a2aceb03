// Python, in a worker: it holds one contour and answers one request after another.

const SPOKEN = `
from json import dumps, loads

from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import begin

talk = None

def opened(text, start, control, is_whole):
    global talk
    try:
        talk = Conversation(begin(text, start=start or None, control=control or None))
    except ModuleNotFoundError if not is_whole else ():
        return dumps(["lacking", None])
    except ValueError as error:
        return dumps(["refused", str(error)])
    except Exception as error:
        return dumps(["refused", f"{type(error).__name__}: {error}"])
    return dumps(["opened", talk.state])

def changed(action):
    return dumps(["changed", talk.answer(loads(action))])
`;

let python = null; // a promise of Python with all that the first picture needs
let rest = null; // and of what few blocks need

const tell = (kind, value) => self.postMessage([kind, value]);

async function load() {
  tell("progress", "Loading Python");
  const sources = await (await found("sources.json")).json();
  const own = sources.archives.map(async (name) => [await (await found(name)).arrayBuffer(), name.split(".").at(-1)]);
  const base = new URL(sources.pyodide, import.meta.url).href;
  const { loadPyodide } = await import(`${base}pyodide.mjs`);
  const loaded = await loadPyodide({ indexURL: base });
  tell("progress", `Loading ${sources.packages.join(", ")}`);
  await packages(loaded, sources.packages);
  for (const [content, kind] of await Promise.all(own)) loaded.unpackArchive(content, kind);
  tell("progress", "Starting contoursolve");
  loaded.runPython(SPOKEN);
  return { loaded, later: sources.later };
}

async function found(name) {
  const answer = await fetch(new URL(name, import.meta.url));
  if (!answer.ok) throw new Error(`${answer.url} answers ${answer.status}`);
  return answer;
}

async function packages(loaded, names) {
  const done = await loaded.loadPackage(names, { messageCallback: () => {}, errorCallback: () => {} });
  const missing = names.filter((name) => !done.some((each) => each.name === name) && !(name in loaded.loadedPackages));
  if (missing.length) throw new Error(`${missing.join(", ")} did not arrive`);
}

function later() {
  return (rest ??= python.then(({ loaded, later }) => packages(loaded, later)));
}

async function answer(request) {
  python ??= load();
  const { loaded } = await python;
  const ask = (name, ...values) => JSON.parse(loaded.globals.get(name)(...values));
  if (request.do === "act") {
    await later().catch(() => (rest = null)); // few actions need it; those say so
    tell(...ask("changed", JSON.stringify(request.action)));
    return;
  }
  let found = ask("opened", request.text, request.start, request.control, false);
  if (found[0] === "lacking") {
    await later();
    found = ask("opened", request.text, request.start, request.control, true);
  }
  tell(...found);
  later().catch(() => (rest = null)); // asked for again with the next action
}

let last = Promise.resolve();
self.onmessage = ({ data }) => {
  last = last.then(() => answer(data)).catch((error) => {
    console.error(error);
    tell("failed", reason(error));
  });
};

function reason(error) {
  return (error.message || String(error)).trim().split("\n").at(-1).replace(/\.$/, "");
}
