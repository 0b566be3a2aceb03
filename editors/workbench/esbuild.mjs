// Builds the page of `contoursolve serve` into the package: the same sources give the same bytes.
// `node esbuild.mjs FOLDER` builds it elsewhere, to compare.
import { build } from "esbuild";
import { mkdir, readdir, readFile, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";

process.chdir(fileURLToPath(new URL(".", import.meta.url)));
const folder = process.argv[2] ?? "../../contoursolve/workbench/page";
const built = await build({
  entryPoints: [{ in: "src/main.ts", out: "workbench" }],
  outdir: folder,
  bundle: true,
  minify: true,
  metafile: true,
  legalComments: "none",
  charset: "utf8",
  format: "esm",
  target: ["chrome109", "firefox115", "safari16"],
});

const packages = Object.keys(built.metafile.inputs).flatMap((path) => path.match(/^node_modules\/(?:@[^/]+\/)?[^/]+/)?.[0] ?? []);
const licences = await Promise.all([...new Set(packages)].sort().map(licence));
await mkdir(folder, { recursive: true });
await writeFile(`${folder}/licences.txt`, licences.join("\n"));
await writeFile(`${folder}/index.html`, await readFile("src/index.html"));

async function licence(path) {
  const name = (await readdir(path)).find((file) => /^licen[cs]e/i.test(file));
  if (!name) throw new Error(`${path} has no licence`);
  return `${path.replace(/.*node_modules\//, "")}\n\n${(await readFile(`${path}/${name}`, "utf8")).replaceAll("\r\n", "\n").trim()}\n`;
}
