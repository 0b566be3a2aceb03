// Packs the extension: a folder with what it needs and nothing else, and of that contoursolve.vsix.
//
// REPOSITORY says where the project lies, as for hatch_build.py: https://HOST/OWNER/NAME, laid out as on GitHub. Without
// it the package has no addresses, and its page no pictures. SERVER names a folder with the program contoursolve, which
// is packed as well, and TARGET the platform that it is for, such as win32-x64.
import { execFileSync } from "node:child_process";
import { cp, mkdir, readFile, rm, writeFile } from "node:fs/promises";
import { dirname, resolve } from "node:path";

const { REPOSITORY = "", SERVER, TARGET } = process.env;
const STAGE = "build";
const PARTS = ["dist/extension.js", "dist/page.js", "dist/licences.txt", "languages", "media/icon.png", "media/picture.css"];
const OF_BUILD = ["private", "scripts", "devDependencies"];

await rm(STAGE, { recursive: true, force: true });
for (const part of [...PARTS, "syntaxes"]) {
  await mkdir(dirname(`${STAGE}/${part}`), { recursive: true });
  await cp(part, `${STAGE}/${part}`, { recursive: true });
}
await cp("../../LICENSE", `${STAGE}/LICENSE`);
if (SERVER) await cp(SERVER, `${STAGE}/server`, { recursive: true, verbatimSymlinks: true });

const manifest = JSON.parse(await readFile("package.json", "utf8"));
const [, version] = /^__version__ = "(.+)"$/m.exec(await readFile("../../contoursolve/__init__.py", "utf8"));
const address = REPOSITORY.replace(/\/+$/, "");
const fields = address && {
  repository: { type: "git", url: `${address}.git`, directory: "editors/vscode" },
  homepage: `${address}/blob/v${version}/docs/editors.md`,
  bugs: { url: `${address}/issues` },
  qna: `${address}/issues`,
};
for (const name of OF_BUILD) delete manifest[name];
await writeFile(`${STAGE}/package.json`, JSON.stringify({ ...manifest, version, ...fields, files: ["**"] }, null, 2));

const page = await readFile("README.md", "utf8");
const folder = (kind) => `${address}/${kind}/v${version}/editors/vscode`;
const links = address
  ? [`--baseContentUrl=${folder("blob")}`, `--baseImagesUrl=${folder("raw")}`]
  : ["--no-rewrite-relative-links", "--allow-missing-repository"];
await writeFile(`${STAGE}/README.md`, address ? page : page.replace(/^!\[.*\n\n?/gm, ""));

const target = TARGET ? [`--target=${TARGET}`] : [];
const vsce = resolve("node_modules/@vscode/vsce/vsce");
const options = ["--no-dependencies", "--out", resolve("contoursolve.vsix"), ...target, ...links];
execFileSync(process.execPath, [vsce, "package", ...options], { cwd: STAGE, stdio: "inherit" });
