// The page of the server: its executors with the jobs that they compute, its queue, and the shortages that hold it.
import type { Capabilities, Queue } from "../../gen/cellcrush/v1/admin_service_pb";
import { Job_State, type Job } from "../../gen/cellcrush/v1/job_pb";
import { api, errorText } from "../api/clients";
import { watch } from "../api/watch";
import { Later } from "../dom/calls";
import { h, replaceChildren, setBanner, type Child } from "../dom/element";
import { clock, count, duration, idOf, number, pathOf, plural } from "../dom/format";
import { progressBar } from "../jobs/progress_bar";
import { elsewhere, titleOf } from "../jobs/states";
import type { View } from "../router";

const kCalmMs = 500;
const kAgainMs = 5000;
const kListed = 100;

const row = (name: string, ...text: Child[]): HTMLElement => h("div", {}, h("dt", {}, name), h("dd", {}, ...text));
const link = (name: string, text: string): HTMLElement => h("a", { href: pathOf(name) }, text);
const whereText = (executor: string): string => elsewhere(executor) || "this machine";

function table(head: string[], rows: Child[][]): HTMLElement {
  return h("div", { class: "table-scroll" }, h("table", { class: "rows" },
    h("thead", {}, h("tr", {}, ...head.map((text) => h("th", { scope: "col" }, text)))),
    h("tbody", {}, ...rows.map((cells) => h("tr", {}, ...cells.map((cell) => h("td", {}, cell)))))));
}

export class ServerPage implements View {
  readonly title = "Server";
  private readonly problem = h("div", { class: "banner error", hidden: true });
  private readonly about = h("section", { class: "card" });
  private readonly resources = h("section", { class: "card" });
  private readonly running = h("section", { class: "server-part" });
  private readonly queue = h("section", { class: "server-part" });
  readonly element = h("div", { class: "page server-page" }, h("h1", {}, this.title), this.problem,
    h("div", { class: "server-grid" }, this.about, this.resources), this.running, this.queue);
  private readonly refreshing = new Later(() => void this.load(), kCalmMs);
  private readonly abort = new AbortController();
  private readonly stops = [watch.jobs.add(() => this.refreshing.soon()),
                            watch.freshStarts.add(() => this.refreshing.soon())];

  constructor() {
    void this.load();
  }

  private async load(): Promise<void> {
    const { signal } = this.abort;
    try {
      const [capabilities, queue, { jobs }] = await Promise.all([
        api.admin.getCapabilities({}, { signal }), api.admin.getQueue({}, { signal }),
        api.jobs.listJobs({ filter: `state = ${Job_State[Job_State.RUNNING]}`, pageSize: 1000 }, { signal })]);
      setBanner(this.problem, "");
      this.show(capabilities, queue, jobs);
    } catch (error) {
      if (signal.aborted) return;
      setBanner(this.problem, errorText(error));
    }
    this.refreshing.soon(kAgainMs);
  }

  private show(capabilities: Capabilities, queue: Queue, running: Job[]): void {
    const { version, draining, executors, defaultExecutor } = capabilities;
    const waiting = queue.entries.length + queue.moreCount;
    replaceChildren(this.about, h("h2", {}, "Workers"), h("dl", { class: "facts" },
      ...executors.map(({ name, jobLimit }) => {
        const busy = running.filter(({ executor }) => executor === name).length;
        const meter = h("progress", { max: jobLimit, "aria-label": `jobs on ${whereText(name)}` });
        meter.value = busy;
        return row(whereText(name), `${busy} of ${plural(jobLimit, "job")} `, meter,
                   executors.length > 1 && name === defaultExecutor && h("span", { class: "faint" }, " default"));
      }),
      row("version", version), row("accepts jobs", draining ? "no, draining" : "yes")));
    replaceChildren(this.resources, h("h2", {}, "Disk and memory"), ...(queue.holds.length ? queue.holds.map((hold) =>
      h("div", { class: "banner warning" }, h("strong", {}, `${hold.cause.replaceAll("_", " ")}. `),
        `${hold.reason} ${hold.remedy}`, hold.since && h("span", { class: "faint" }, ` Since ${clock(hold.since)}.`)))
      : [h("p", {}, "No shortage holds up the queue.")]));
    replaceChildren(this.running, h("h2", {}, `Running: ${running.length}`), running.length > 0 &&
      table(["Job", "Progress", "Time left", "Steps per second", "Plateau so far", "Where", "Process", "Owner"],
        running.slice(0, kListed).map((job) => [
          link(job.name, `${idOf(job.name)}: ${titleOf(job)}`), progressBar(job), duration(job.progress?.secondsLeft),
          job.progress && count(Math.round(job.progress.stepsPerSecond)),
          job.progress?.plateauSoFarMpa !== undefined && `${number(job.progress.plateauSoFarMpa)} MPa`,
          job.place || whereText(job.executor), job.workerPid ? String(job.workerPid) : "–", job.owner])));
    replaceChildren(this.queue, h("h2", {}, `Waiting: ${count(waiting)}`), waiting > 0 &&
      table(["Job", "Starts", "Why it waits", "Priority", "Where"], queue.entries.slice(0, kListed).map((entry) => [
        link(entry.job, `job ${idOf(entry.job)}`),
        entry.secondsUntilStart > 0 ? `in ${duration(entry.secondsUntilStart)}` : "–",
        h("span", { class: "reason" }, entry.reason), String(entry.priority), whereText(entry.executor)])),
      waiting > kListed && h("p", { class: "faint" }, `the first ${kListed}`));
  }

  destroy(): void {
    this.abort.abort();
    this.refreshing.stop();
    for (const stop of this.stops) stop();
  }
}
