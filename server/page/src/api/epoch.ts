// The server whose jobs the tab shows. Every answer has the epoch of the server's data, and every call of the tab names
// the first that came. A daemon that comes back at this address with other data has another one: it refuses the calls,
// since the jobs that the tab shows are not its own.
import { ConnectError, type Interceptor } from "@connectrpc/connect";
import { Listeners } from "../dom/calls";

const kHeader = "cellcrush-epoch";
let seen = "";
let isOther = false;

/** Told once, at the first answer of another server. */
export const otherServer = new Listeners<void>();

/** Names the server in a call. */
export function nameServer(headers: Headers): Headers {
  if (seen) headers.set(kHeader, seen);
  return headers;
}

/** Looks which server has answered. */
export function noteServer(headers: Headers): void {
  const epoch = headers.get(kHeader) ?? "";
  seen ||= epoch;
  if (isOther || !epoch || epoch === seen) return;
  isOther = true;
  otherServer.tell();
}

export const withEpoch: Interceptor = (next) => async (request) => {
  nameServer(request.header);
  try {
    const response = await next(request);
    noteServer(response.header);
    return response;
  } catch (error) {
    noteServer(ConnectError.from(error).metadata);
    throw error;
  }
};
