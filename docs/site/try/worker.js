// Python, in a worker: it holds the Desk of the workbench and answers one question after another.

const SPOKEN = `
import sys
from json import dumps, loads

from contoursolve.workbench import Desk

desk = Desk()
lacking = []

class Missing:
    @staticmethod
    def find_spec(name, path=None, target=None):
        if path is None and name in later:
            lacking.append(name)

sys.meta_path.append(Missing)

def answered(request):
    lacking.clear()
    reply = dumps(desk.answer(loads(request)))
    return "" if lacking else reply
`;

let python = null; // a promise of Python with all that the first picture needs
let rest = null; // and of what few programs need

const tell = (...told) => self.postMessage(told);

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
  loaded.globals.set("later", loaded.toPy(sources.later));
  loaded.runPython(SPOKEN);
  tell("progress", "");
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

async function answer({ number, request }) {
  python ??= load();
  const { loaded } = await python;
  const ask = () => loaded.globals.get("answered")(request);
  // What opens a program may be asked twice; what changes one waits until all is there, if it can be had.
  const isQuick = ["hello", "open"].includes(JSON.parse(request).do);
  if (!isQuick) await later().catch(() => (rest = null));
  let reply = ask();
  if (!reply) {
    await later();
    reply = ask();
  }
  tell("reply", reply, number);
  if (isQuick) later().catch(() => (rest = null)); // asked for again with the next question
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
