// Bundles the extension and the script of its picture, with the licences of all that is bundled.
import { build } from "esbuild";
import { readdir, readFile, rm, writeFile } from "node:fs/promises";

const production = process.argv.includes("--production");
const shared = { bundle: true, minify: production, sourcemap: !production, metafile: true, legalComments: "none" };

await rm("dist", { recursive: true, force: true });
const [extension] = await Promise.all([
  build({
    ...shared,
    entryPoints: ["src/extension.ts"],
    outfile: "dist/extension.js",
    platform: "node",
    target: "node20",
    format: "cjs",
    external: ["vscode"],
  }),
  build({ ...shared, entryPoints: ["src/page.ts"], outfile: "dist/page.js", target: "chrome120", format: "iife" }),
]);

const inputs = Object.keys(extension.metafile.inputs).join("\n");
const packages = new Set([...inputs.matchAll(/^.*node_modules\/(?:@[^/]+\/)?[^/]+/gm)].map(String));
const licences = await Promise.all([...packages].sort().map(licence));
await writeFile("dist/licences.txt", licences.join("\n"));

async function licence(folder) {
  const name = (await readdir(folder)).find((file) => /^licen[cs]e/i.test(file));
  if (!name) throw new Error(`${folder} has no licence`);
  return `${folder.replace(/.*node_modules\//, "")}\n\n${await readFile(`${folder}/${name}`, "utf8")}\n`;
}
