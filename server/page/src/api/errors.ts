// Errors of calls as sentences, and the problems that a refused call carries.
import { Code, ConnectError } from "@connectrpc/connect";
import { ProblemListSchema, type Problem } from "../../gen/cellcrush/v1/problem_pb";

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
