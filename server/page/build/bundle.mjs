// Bundles src/ into bundle/, which the daemon serves, and reports the compressed size.
import { build } from "esbuild";
import { copyFileSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const page = dirname(dirname(fileURLToPath(import.meta.url)));
const bundle = join(page, "bundle");
const kLimit = 250_000; // bytes, compressed

await build({
  entryPoints: { app: join(page, "src/main.ts") },
  outdir: bundle,
  bundle: true,
  minify: true,
  format: "esm",
  target: ["es2022"],
  legalComments: "none",
  logLevel: "warning",
});
for (const name of ["index.html", "icon.svg"]) copyFileSync(join(page, "src", name), join(bundle, name));

// Exported pages have both inline.
for (const name of ["app.js", "app.css"]) {
  if (/<\/(script|style)|<!--/i.test(readFileSync(join(bundle, name), "utf8"))) {
    throw new Error(`${name} has what would end an inline script or style`);
  }
}

let total = 0;
for (const name of readdirSync(bundle)) {
  const size = gzipSync(readFileSync(join(bundle, name))).length;
  console.log(`${name}: ${(size / 1000).toFixed(1)} kB compressed`);
  total += size;
}
console.log(`total: ${(total / 1000).toFixed(1)} kB compressed`);
if (total > kLimit) process.exit(1);
