// The answers of the daemon in an exported page (Jobs.ExportJob): each is a message in a script element of the file.
import { fromBinary, type DescMessage, type MessageShape } from "@bufbuild/protobuf";
import { Code, ConnectError, type Transport } from "@connectrpc/connect";
import { unzlibSync } from "fflate";

/** Whether this page is a file with its data, without a daemon. */
export const isExported = document.querySelector("script[data-call]") !== null;

/** Version of the daemon that exported the page. */
export function exportedBy(): string {
  return document.querySelector<HTMLMetaElement>("meta[name=generator]")?.content.split("+")[0] ?? "";
}

function blocksOf(call: string): Element[] {
  const blocks = [...document.querySelectorAll(`script[data-call=${call}]`)];
  if (blocks.length === 0) throw new ConnectError(`The file has no answer to ${call}.`, Code.Unimplemented);
  return blocks;
}

function bytesOf(block: Element): Uint8Array {
  const text = atob(block.textContent ?? "");
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return block.hasAttribute("data-zlib") ? unzlibSync(bytes) : bytes;
}

/** Answers the calls of the page from the file. The pages of a list are numbered by their tokens. */
export const exportedTransport: Transport = {
  async unary(method, _signal, _timeout, _header, input) {
    const { pageToken } = input as { pageToken?: string };
    const block = blocksOf(method.name)[Number(pageToken || 0)];
    return { stream: false, service: method.parent, method, header: new Headers(), trailer: new Headers(),
             message: fromBinary(method.output, bytesOf(block)) };
  },
  async stream(method) {
    return { stream: true, service: method.parent, method, header: new Headers(), trailer: new Headers(),
             message: messages(blocksOf(method.name), method.output) };
  },
};

async function* messages<T extends DescMessage>(blocks: Element[], type: T): AsyncIterable<MessageShape<T>> {
  for (const block of blocks) yield fromBinary(type, bytesOf(block));
}
