// A question before something that cannot be undone, and short messages at the edge of the page.
import { button, h } from "./element";

/** Asks in a modal dialog; resolves to whether the user agreed. */
export function ask(question: string, detail: string, agree: string): Promise<boolean> {
  return new Promise((resolve) => {
    const close = (answer: boolean) => () => {
      dialog.close();
      resolve(answer);
    };
    const cancel = button("Keep", close(false));
    const dialog = h("dialog", { class: "question", cancel: close(false) },
      h("h2", {}, question), h("p", {}, detail),
      h("div", { class: "buttons" }, cancel, button(agree, close(true), { class: "danger" })));
    dialog.addEventListener("close", () => dialog.remove());
    document.body.append(dialog);
    dialog.showModal();
    cancel.focus();
  });
}

const kShownMs = 7000;
let messages: HTMLElement | undefined;

/** Shows a message for some seconds; screen readers announce it. */
export function say(text: string, kind: "note" | "error" = "note"): void {
  messages ??= document.body.appendChild(h("div", { class: "messages", role: "status", "aria-live": "polite" }));
  const message = h("div", { class: `message ${kind}` }, text);
  const close = button("×", () => message.remove(), { "aria-label": "Dismiss" });
  message.append(close);
  messages.append(message);
  setTimeout(() => message.remove(), kind === "error" ? 2 * kShownMs : kShownMs);
}
