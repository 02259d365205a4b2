// Buttons that save what the page shows.
import { api } from "../api/clients";
import { isExported } from "../api/exported";
import { idOf } from "../api/names";
import type { Chart } from "../charts/chart";
import type { Axis } from "../charts/curves";
import { say } from "../dom/dialog";
import { download } from "../dom/download";
import { button, h, setText } from "../dom/element";
import { attempt } from "../jobs/actions";
import { hasEnded, titleOf } from "../jobs/states";
import type { JobData } from "../job/job_data";
import type { Picture } from "../picture/picture";
import type { Player } from "../picture/player";
import { chartSvg } from "./chart_svg";
import { historyCsv } from "./history_csv";
import { picturePng } from "./picture_png";
import { canRecord, recordCrush } from "./movie";

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

export function takeAwayOfChart(chart: Chart, data: JobData, axis: () => Axis, name: string): HTMLElement {
  const file = `job-${idOf(data.name)}-${name}`;
  return h("span", { class: "take-away" },
    saveButton("SVG", "Save the curves as an SVG file", async () => {
      if (chart.shown) download(chartSvg(chart.shown, data.job ? titleOf(data.job) : ""), `${file}.svg`);
    }),
    saveButton("CSV", "Save all samples as a CSV file", async () =>
      download(historyCsv(data.samples), `job-${idOf(data.name)}-history.csv`)));
}

// The result file, collected from its chunks.
async function fetchResult(name: string, tell: (fraction: number) => void): Promise<Blob> {
  const parts: BlobPart[] = [];
  for await (const chunk of api.jobs.downloadResult({ name })) {
    parts.push(chunk.data as Uint8Array<ArrayBuffer>);
    tell((Number(chunk.offset) + chunk.data.length) / Math.max(1, Number(chunk.totalSize)));
  }
  return new Blob(parts, { type: "application/x-hdf5" });
}

// The page of an ended job as a file that opens without a daemon.
async function fetchPage(name: string, tell: (fraction: number) => void): Promise<Blob> {
  const parts: BlobPart[] = [];
  let [kept, all] = [0, 0];
  for await (const chunk of api.jobs.exportJob({ name })) {
    parts.push(chunk.data as Uint8Array<ArrayBuffer>);
    tell(chunk.fraction);
    [kept, all] = [chunk.frameCount, chunk.jobFrameCount];
  }
  if (kept < all) say(`The file has ${kept} of ${all} frames. For more: cellcrush export --max-size.`);
  return new Blob(parts, { type: "text/html" });
}

export function takeAwayOfPicture(picture: Picture, player: Player, data: JobData): HTMLElement {
  const file = `job-${idOf(data.name)}`;
  const title = (): string => (data.job ? titleOf(data.job) : "");
  const result = saveButton("HDF5", "Save the result file, with all samples and frames", async (element) => {
    const blob = await fetchResult(data.name, (fraction) => setText(element, `${Math.round(100 * fraction)} %`));
    download(blob, `${file}.h5`);
  });
  const page = saveButton("HTML", "Save this page as a file that opens without a daemon", async (element) => {
    const blob = await fetchPage(data.name, (fraction) => setText(element, `${Math.round(100 * fraction)} %`));
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
      const film = await recordCrush(picture, player, (fraction) =>
        setText(element, `${Math.round(100 * fraction)} %`));
      if (film) download(film, `${file}.webm`);
    }),
    page, result);
}
