// Runs the files of test/ or bench/ in Node, each bundled with the sources that it imports.
//   node build/in_node.mjs test|bench
import { build } from "esbuild";
import { spawnSync } from "node:child_process";
import { readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const page = dirname(dirname(fileURLToPath(import.meta.url)));
const folder = process.argv[2];
const names = readdirSync(join(page, folder)).filter((name) => name.endsWith(`.${folder}.mjs`));
await build({
  entryPoints: names.map((name) => join(page, folder, name)),
  outdir: join(page, "node-build", folder),
  outExtension: { ".js": ".mjs" },
  bundle: true,
  format: "esm",
  platform: "node",
  logLevel: "warning",
});
const files = names.map((name) => join(page, "node-build", folder, name));
const options = folder === "test" ? ["--test"] : [];
process.exit(spawnSync(process.execPath, [...options, ...files], { stdio: "inherit" }).status ?? 1);
