// The note of a job or a sweep, with a button that opens an editor in its place.
import { allowed } from "../api/caller";
import { errorText } from "../api/clients";
import { isExported } from "../api/exported";
import { button, h, labelled, setText } from "../dom/element";

export class NoteEditor {
  readonly element: HTMLElement;
  private readonly text = h("p", { class: "job-note" });
  private readonly edit = button("Add a note", () => this.open(true), { class: "quiet" });
  private readonly input = h("textarea", { rows: 3, spellcheck: "true" });
  private readonly hint = h("div", { class: "limits", role: "status" });
  private readonly form = h("form", { hidden: true, submit: (event: Event) => void this.submit(event),
                                      keydown: (event: KeyboardEvent) => this.key(event) },
    labelled("Note", this.input, this.hint),
    h("div", { class: "buttons" }, h("button", { class: "primary" }, "Save"),
      button("Discard", () => this.open(false))));
  private note = "";

  /** `save` writes a note in place of the one that was shown. */
  constructor(private readonly save: (note: string, previousNote: string) => Promise<void>) {
    this.element = h("div", { class: "note-editor" }, this.text, !isExported && this.edit, this.form);
  }

  update(note: string, owner: string): void {
    Object.assign(this.edit, { disabled: false, title: "" }, allowed(owner));
    if (note === this.note) return;
    this.note = note;
    setText(this.text, note);
    setText(this.edit, note ? "Edit the note" : "Add a note");
    if (!this.form.hidden && note !== this.input.value.trim()) {
      this.say(note ? `Meanwhile it has become “${note}”. Save replaces that.` : "Meanwhile it was removed.");
    }
  }

  private say(text: string): void {
    setText(this.hint, text);
    this.hint.parentElement!.dataset.kind = text ? "error" : "";
  }

  private open(isOpen: boolean): void {
    this.form.hidden = !isOpen;
    this.text.hidden = this.edit.hidden = isOpen;
    this.say("");
    if (isOpen) this.input.value = this.note;
    (isOpen ? this.input : this.edit).focus();
  }

  private async submit(event: Event): Promise<void> {
    event.preventDefault();
    try {
      await this.save(this.input.value.trim(), this.note);
      this.open(false);
    } catch (error) {
      this.say(errorText(error));
    }
  }

  // Other keys are the text's, not those of the page.
  private key(event: KeyboardEvent): void {
    event.stopPropagation();
    if (event.key === "Escape") this.open(false);
    else if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) this.form.requestSubmit();
  }
}
