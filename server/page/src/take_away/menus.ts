// Buttons that save what the page shows.
import { api } from "../api/clients";
import { isExported } from "../api/exported";
import { idOf } from "../dom/format";
import type { Chart } from "../charts/chart";
import { say } from "../dom/dialog";
import { button, h, setText } from "../dom/element";
import { attempt } from "../jobs/actions";
import { hasEnded, titleOf } from "../jobs/states";
import type { JobData } from "../job/job_data";
import type { Picture } from "../picture/picture";
import type { Player } from "../picture/player";
import { chartSvg } from "./chart_svg";
import { canRecord, picturePng, recordCrush } from "./picture_files";
import { kSampleColumns } from "../charts/sample_chart";
import type { Sample } from "../../gen/cellcrush/v1/sample_pb";

/** Saves a blob as a file of the user. */
export function download(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

// Here and not by a GET of history.csv, because an exported page has no daemon; a test compares both.
export function historyCsv(samples: Sample[]): Blob {
  const rows = samples.map((sample) => kSampleColumns.map(({ value }) => value(sample) ?? ""));
  const lines = [kSampleColumns.map(({ name }) => name), ...rows].map((row) => `${row.join(",")}\n`);
  return new Blob(lines, { type: "text/csv" });
}

export function saveButton(label: string, what: string,
                           save: (button: HTMLButtonElement) => Promise<void>): HTMLElement {
  const element = button(label, () => void attempt(async () => {
    element.disabled = true;
    try {
      await save(element);
    } finally {
      element.disabled = false;
      setText(element, label);
    }
  }), { title: what, "aria-label": what });
  return element;
}

export function addSaving(chart: Chart, data: JobData, name: string): void {
  chart.addTools(
    saveChartButton(chart, () => (data.job ? titleOf(data.job) : ""), `job-${idOf(data.name)}-${name}`),
    saveButton("CSV", "Save all samples as a CSV file", async () =>
      download(historyCsv(data.samples), `job-${idOf(data.name)}-history.csv`)));
}

// A file, collected from its chunks.
async function collect<T extends { data: Uint8Array }>(chunks: AsyncIterable<T>, type: string,
                                                       see: (chunk: T) => void): Promise<Blob> {
  const parts: BlobPart[] = [];
  for await (const chunk of chunks) {
    parts.push(chunk.data as Uint8Array<ArrayBuffer>);
    see(chunk);
  }
  return new Blob(parts, { type });
}

/** A button that saves what a chart shows. */
export function saveChartButton(chart: Chart, title: () => string, file: string): HTMLElement {
  return saveButton("SVG", "Save the chart as an SVG file", async () => {
    if (chart.data) download(chartSvg(chart.data, title()), `${file}.svg`);
  });
}

export function takeAwayOfPicture(picture: Picture, player: Player, data: JobData): HTMLElement {
  const file = `job-${idOf(data.name)}`;
  const title = (): string => (data.job ? titleOf(data.job) : "");
  const tell = (element: HTMLElement, fraction: number): void => setText(element, `${Math.round(100 * fraction)} %`);
  const result = saveButton("HDF5", "Save the result file, with all samples and frames", async (element) => {
    download(await collect(api.jobs.downloadResult({ name: data.name }), "application/x-hdf5", (chunk) =>
      tell(element, (Number(chunk.offset) + chunk.data.length) / Math.max(1, Number(chunk.totalSize)))), `${file}.h5`);
  });
  const page = saveButton("HTML", "Save this page as a file that opens without a daemon", async (element) => {
    let [kept, all] = [0, 0];
    const blob = await collect(api.jobs.exportJob({ name: data.name }), "text/html", (chunk) => {
      tell(element, chunk.fraction);
      [kept, all] = [chunk.frameCount, chunk.jobFrameCount];
    });
    if (kept < all) say(`The file has ${kept} of ${all} frames. For more: cellcrush export --max-size.`);
    download(blob, `${file}.html`);
  });
  data.jobChanges.add(() => {
    result.hidden = isExported || !data.job?.summary;
    page.hidden = isExported || !data.job || !hasEnded(data.job);
  });
  return h("span", { class: "take-away" },
    saveButton("PNG", "Save this picture as a PNG file", async () =>
      download(await picturePng(picture, title(), `strain ${player.value.toFixed(3)}`), `${file}.png`)),
    canRecord() && saveButton("WebM", "Record the crush as a WebM film, at the rate of play", async (element) => {
      const film = await recordCrush(picture, player, (fraction) => tell(element, fraction));
      if (film) download(film, `${file}.webm`);
    }),
    page, result);
}
