// Clients of the daemon's services, on the origin of the page; in an exported page, of the file itself. Their
// errors as sentences, and the problems that a refused call carries.
import { Code, ConnectError, createClient, type Interceptor } from "@connectrpc/connect";
import { createConnectTransport } from "@connectrpc/connect-web";
import { Admin } from "../../gen/cellcrush/v1/admin_service_pb";
import { Cases } from "../../gen/cellcrush/v1/cases_service_pb";
import { Jobs } from "../../gen/cellcrush/v1/jobs_service_pb";
import { ProblemListSchema, type Problem } from "../../gen/cellcrush/v1/problem_pb";
import { Sweeps } from "../../gen/cellcrush/v1/sweeps_service_pb";
import { withEpoch } from "./epoch";
import { exportedTransport, isExported } from "./exported";
import { withToken } from "./token";
import { urlOf } from "../dom/base";

// The proxy of notebook servers passes on as they come only the answers to who asks so.
const asStream: Interceptor = (next) => (request) => {
  if (request.stream) request.header.set("accept", "text/event-stream");
  return next(request);
};

const transport = isExported ? exportedTransport
  : createConnectTransport({ baseUrl: urlOf(""), useBinaryFormat: true,
                             interceptors: [withToken, withEpoch, asStream] });

export const api = {
  admin: createClient(Admin, transport),
  cases: createClient(Cases, transport),
  jobs: createClient(Jobs, transport),
  sweeps: createClient(Sweeps, transport),
};

export function errorText(error: unknown): string {
  const failure = ConnectError.from(error);
  if (isAway(failure)) return "The daemon does not answer.";
  return failure.rawMessage || `The daemon refused the call (${Code[failure.code]}).`;
}

/** Whether the daemon could not be reached, so that a later try can succeed. */
export function isAway(error: unknown): boolean {
  const failure = ConnectError.from(error);
  const unreachable = failure.code === Code.Unknown && failure.cause instanceof TypeError;
  return unreachable || failure.code === Code.Unavailable;
}

/** An answer that a view can do without; the watch says if the daemon is away. */
export function ifAny<T>(answer: Promise<T>): Promise<T | undefined> {
  return answer.catch(() => undefined);
}

export function isNotFound(error: unknown): boolean {
  return ConnectError.from(error).code === Code.NotFound;
}

export function problemsOf(error: unknown): Problem[] {
  return ConnectError.from(error).findDetails(ProblemListSchema).flatMap((list) => list.problems);
}
