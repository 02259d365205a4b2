// What the caller may do. The page asks once; an older daemon does not say, and refuses what it does not allow.
import type { WhoAmIResponse } from "../../gen/cellcrush/v1/admin_service_pb";
import { api, ifAny } from "./clients";

let caller: WhoAmIResponse | undefined;

export async function learnCaller(): Promise<void> {
  caller = await ifAny(api.admin.whoAmI({}));
}

/** Why the caller may not create anything, or not change what the owner has; empty if it may. */
export function whyNot(owner?: string): string {
  if (!caller || caller.scope === "admin") return "";
  const { name, scope } = caller;
  if (scope === "read") return `${name} has the scope “read” and changes nothing.`;
  return owner === undefined || owner === name ? ""
    : `This belongs to ${owner || "nobody"}; ${name} has the scope “${scope}” and changes only its own.`;
}

/** Attributes of a button for it. */
export function allowed(owner?: string): { disabled?: boolean; title?: string } {
  const why = whyNot(owner);
  return why ? { disabled: true, title: why } : {};
}
