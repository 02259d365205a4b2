// The token that a daemon with --tokens asks for. It stays in the tab, or in the browser if the user wants that.
import { Code, ConnectError, type Interceptor } from "@connectrpc/connect";
import { nameServer, noteServer } from "./epoch";
import { base } from "../dom/base";
import { h, labelled, setText } from "../dom/element";

const kKey = `cellcrush-token${base}`; // another path of the site may be another daemon
let isAsking = false;

// None where the browser keeps nothing, as for a page in a frame of another site.
function storedToken(): string {
  try {
    return sessionStorage.getItem(kKey) ?? localStorage.getItem(kKey) ?? "";
  } catch {
    return "";
  }
}

export const hasToken = (): boolean => storedToken() !== "";

export function forgetToken(): void {
  sessionStorage.removeItem(kKey);
  localStorage.removeItem(kKey);
  location.reload();
}

// Asks once, and loads the page again with the token.
function askForToken(reason: string): void {
  if (isAsking) return;
  isAsking = true;
  const token = h("input", { type: "password", autocomplete: "off", required: true });
  const keep = h("input", { type: "checkbox" });
  const why = h("p", {}, reason);
  const submit = (event: Event): void => {
    event.preventDefault();
    try {
      sessionStorage.removeItem(kKey);
      localStorage.removeItem(kKey);
      (keep.checked ? localStorage : sessionStorage).setItem(kKey, token.value.trim());
      location.reload();
    } catch {
      setText(why, "The browser keeps no token for this page, as in a frame. Open the page in a tab of its own.");
    }
  };
  const dialog = h("dialog", { class: "token", cancel: (event: Event) => event.preventDefault() },
    h("h2", {}, "This daemon asks who you are"), why,
    h("form", { submit }, labelled("Token", token),
      h("label", { class: "keep" }, keep, " keep it in this browser"),
      h("div", { class: "buttons" }, h("button", { type: "submit", class: "primary" }, "Continue"))));
  document.body.append(dialog);
  dialog.showModal();
}

function checkRefusal(error: unknown): void {
  const failure = ConnectError.from(error);
  if (failure.code !== Code.Unauthenticated) return;
  askForToken(hasToken() ? failure.rawMessage
    : "Run `cellcrush open` on the daemon's machine for a link that lets this browser in, or enter a token from the " +
      "daemon's administrator.");
}

async function* watchRefusals<T>(messages: AsyncIterable<T>): AsyncIterable<T> {
  try {
    yield* messages;
  } catch (error) {
    checkRefusal(error);
    throw error;
  }
}

/** What a GET of the daemon answers, with the token. Throws its error. */
export async function get(path: string): Promise<Response> {
  const token = storedToken();
  const headers = nameServer(new Headers(token ? { authorization: `Bearer ${token}` } : {}));
  const response = await fetch(path, { headers });
  noteServer(response.headers);
  if (!response.ok) throw new Error(await response.text());
  return response;
}

/** Adds the token to every call, and asks for one where the daemon refuses the call without it. */
export const withToken: Interceptor = (next) => async (request) => {
  const token = storedToken();
  if (token) request.header.set("authorization", `Bearer ${token}`);
  try {
    const response = await next(request);
    return response.stream ? { ...response, message: watchRefusals(response.message) } : response;
  } catch (error) {
    checkRefusal(error);
    throw error;
  }
};
