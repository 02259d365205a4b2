// Generates gen/ from the protos: messages and services for TypeScript, and the help of the case's fields.
import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { helpOf } from "./proto_help.mjs";

// The messages whose fields the page explains.
const kExplained = ["Case", "Lattice", "Material", "Section", "Contact", "Plates", "Loading", "Numerics", "Output",
                    "Summary"];
const page = dirname(dirname(fileURLToPath(import.meta.url)));
const protos = join(page, "../../proto");
const gen = join(page, "gen");
const files = readdirSync(join(protos, "cellcrush/v1")).map((name) => `cellcrush/v1/${name}`);
const errorFiles = ["google/rpc/status.proto"];

rmSync(gen, { recursive: true, force: true });
mkdirSync(gen);
execFileSync("protoc", [
  `--proto_path=${protos}`,
  `--plugin=protoc-gen-es=${join(page, "node_modules/.bin/protoc-gen-es")}`,
  `--es_out=${gen}`,
  "--es_opt=target=ts",
  ...files,
  ...errorFiles,
]);
const descriptors = join(gen, "help.binpb");
execFileSync("protoc", [
  `--proto_path=${protos}`,
  "--include_source_info",
  `--descriptor_set_out=${descriptors}`,
  "cellcrush/v1/case.proto",
  "cellcrush/v1/sample.proto",
]);
writeFileSync(join(gen, "help.json"), JSON.stringify(helpOf(readFileSync(descriptors), kExplained), null, 1));
rmSync(descriptors);
