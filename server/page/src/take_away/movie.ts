// A film of the crush: plays it at the rate of the player and records the picture.
import type { Picture } from "../picture/picture";
import type { Player } from "../picture/player";

const kTypes = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];
const kWidth = 1280;
const kFramesPerSecond = 30;
const kBitsPerSecond = 8e6;

export function canRecord(): boolean {
  return typeof MediaRecorder !== "undefined" && kTypes.some((type) => MediaRecorder.isTypeSupported(type));
}

/** Records from the first to the last frame; undefined if the user stops the playing. */
export async function recordCrush(picture: Picture, player: Player, tell: (fraction: number) => void):
    Promise<Blob | undefined> {
  const canvas = document.createElement("canvas");
  const { width, height } = picture.camera;
  canvas.width = kWidth;
  canvas.height = 2 * Math.round((0.5 * kWidth * height) / width);
  const context = canvas.getContext("2d", { alpha: false })!;
  const mimeType = kTypes.find((type) => MediaRecorder.isTypeSupported(type));
  const recorder = new MediaRecorder(canvas.captureStream(kFramesPerSecond), {
    mimeType, videoBitsPerSecond: kBitsPerSecond,
  });
  const parts: Blob[] = [];
  recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
  const stopped = new Promise((resolve) => recorder.addEventListener("stop", resolve));
  player.seek(0);
  picture.paint(context, 0, 0, canvas.width, canvas.height);
  recorder.start(500);
  player.toggle();
  const reachedEnd = await playThrough(player, () => {
    picture.paint(context, 0, 0, canvas.width, canvas.height);
    tell(player.value / player.end);
  });
  recorder.stop();
  await stopped;
  return reachedEnd ? new Blob(parts, { type: "video/webm" }) : undefined;
}

function playThrough(player: Player, paint: () => void): Promise<boolean> {
  return new Promise((resolve) => {
    const step = (): void => {
      paint();
      if (player.playing) requestAnimationFrame(step);
      else setTimeout(() => resolve(player.value >= player.end), 300); // the last picture stays for a moment
    };
    requestAnimationFrame(step);
  });
}
