// Why jobs wait: the order of the queue, and the shortages that hold it.
import type { Queue_Entry, Queue_Hold } from "../../gen/cellcrush/v1/admin_service_pb";
import { api, ifAny } from "../api/clients";
import { Later } from "../dom/calls";
import { h, replaceChildren } from "../dom/element";
import { clock } from "../dom/format";
import { elsewhere } from "./states";

const kCalmMs = 400; // after a change of states, before the queue is asked for
const kAgainMs = 20_000; // while jobs wait, as the estimates change

export class QueuePanel {
  readonly element = h("div", { class: "holds", "aria-live": "polite" });
  entries = new Map<string, Queue_Entry>();
  waitingCount = 0;
  private readonly next = new Later(() => void this.fetch(), kCalmMs);
  private isDestroyed = false;

  constructor(private readonly changed: () => void) {}

  /** Asks for the queue soon; several calls in a row make one request. */
  refresh(): void {
    this.next.afresh();
  }

  private async fetch(): Promise<void> {
    const queue = await ifAny(api.admin.getQueue({})); // if none, the next change of a state asks again
    if (!queue || this.isDestroyed) return;
    this.entries = new Map(queue.entries.map((entry) => [entry.job, entry]));
    this.waitingCount = queue.entries.length + queue.moreCount;
    this.showHolds(queue.holds);
    this.changed();
    if (queue.entries.length > 0 || queue.holds.length > 0) this.next.soon(kAgainMs);
  }

  private showHolds(holds: Queue_Hold[]): void {
    replaceChildren(this.element, ...holds.map((hold) =>
      h("div", { class: "banner warning" }, h("strong", {}, noJobStarts(hold)), `${hold.reason} ${hold.remedy}`,
        hold.since ? h("span", { class: "faint" }, ` Since ${clock(hold.since)}.`) : null)));
  }

  destroy(): void {
    this.isDestroyed = true;
    this.next.stop();
  }
}

function noJobStarts(hold: Queue_Hold): string {
  const executor = elsewhere(hold.executor);
  return executor ? `No job starts on ${executor}. ` : "No job starts. ";
}
