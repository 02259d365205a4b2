// Generates gen/ from the protos: messages and services for TypeScript, and the help of the case's fields.
import { execFileSync } from "node:child_process";
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { fromBinary } from "@bufbuild/protobuf";
import { FileDescriptorSetSchema } from "@bufbuild/protobuf/wkt";

// The page explains the fields of all messages of the first file, and of one of the second.
const kExplained = ["cellcrush/v1/case.proto", "cellcrush/v1/sample.proto"];
const kExplainedSample = "Summary";
const page = dirname(dirname(fileURLToPath(import.meta.url)));
const protos = join(page, "../../proto");
const gen = join(page, "gen");
const files = readdirSync(join(protos, "cellcrush/v1")).map((name) => `cellcrush/v1/${name}`);
const errorFiles = ["google/rpc/status.proto"];

const kMessages = 4, kNestedMessages = 3, kFields = 2, kNestedEnums = 4, kValues = 2; // numbers in descriptor.proto

// Comment of every declaration, keyed by its path in the file.
function commentsOf(file) {
  const comments = new Map();
  for (const location of file.sourceCodeInfo.location) {
    const text = location.leadingComments.trim().replace(/\s+/g, " ");
    if (text) comments.set(location.path.join("."), text);
  }
  return comments;
}

function addMessage(help, comments, message, path, name) {
  const fields = {};
  message.field.forEach((field, i) => {
    fields[field.name] = comments.get(`${path}.${kFields}.${i}`) ?? "";
  });
  help.messages[name] = fields;
  message.nestedType.forEach((nested, i) =>
    addMessage(help, comments, nested, `${path}.${kNestedMessages}.${i}`, `${name}.${nested.name}`));
  message.enumType.forEach((type, i) => {
    const values = {};
    type.value.forEach((value, j) => {
      values[value.name] = comments.get(`${path}.${kNestedEnums}.${i}.${kValues}.${j}`) ?? "";
    });
    help.enums[`${name}.${type.name}`] = values;
  });
}

// The comments of the protos as data, from the bytes of a FileDescriptorSet with source info: for each message its
// fields, for each enum its values.
function helpOf(bytes) {
  const help = { messages: {}, enums: {} };
  for (const file of fromBinary(FileDescriptorSetSchema, bytes).file) {
    const comments = commentsOf(file);
    file.messageType.forEach((message, i) => {
      if (file.name === kExplained[1] && message.name !== kExplainedSample) return;
      addMessage(help, comments, message, `${kMessages}.${i}`, message.name);
    });
  }
  return help;
}

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
  ...kExplained,
]);
writeFileSync(join(gen, "help.json"), JSON.stringify(helpOf(readFileSync(descriptors)), null, 1));
rmSync(descriptors);
