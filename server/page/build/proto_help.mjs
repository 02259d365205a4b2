// The comments of the protos as data: for each message its fields with help and default, for each enum its values.
import { fromBinary } from "@bufbuild/protobuf";
import { FileDescriptorSetSchema } from "@bufbuild/protobuf/wkt";

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

/** Help from the bytes of a FileDescriptorSet with source info, for the messages of the given names. */
export function helpOf(bytes, names) {
  const help = { messages: {}, enums: {} };
  for (const file of fromBinary(FileDescriptorSetSchema, bytes).file) {
    const comments = commentsOf(file);
    file.messageType.forEach((message, i) => {
      if (names.includes(message.name)) addMessage(help, comments, message, `${kMessages}.${i}`, message.name);
    });
  }
  return help;
}
