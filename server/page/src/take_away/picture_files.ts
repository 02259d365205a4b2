// Files of the picture: a film of the crush, played at the rate of the player, and a PNG.
import type { Picture } from "../picture/picture";
import type { Player } from "../picture/player";
import { cssColour, kShades, themeColour, wallColour } from "../picture/colours";
import { isDark } from "../dom/preferences";

const kTypes = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];
const kFilmWidth = 1280;
const kFramesPerSecond = 30;
const kBitsPerSecond = 8e6;
const kWidth = 2400; // of the PNG
const kHead = 110;

export function canRecord(): boolean {
  return typeof MediaRecorder !== "undefined" && kTypes.some((type) => MediaRecorder.isTypeSupported(type));
}

/** Records from the first to the last frame; undefined if the user stops the playing. */
export async function recordCrush(picture: Picture, player: Player, tell: (fraction: number) => void):
    Promise<Blob | undefined> {
  const canvas = document.createElement("canvas");
  const { width, height } = picture.camera;
  canvas.width = kFilmWidth;
  canvas.height = 2 * Math.round((0.5 * kFilmWidth * height) / width);
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

/** The picture with a title, the strain and the colour map above it. */
export function picturePng(picture: Picture, title: string, place: string): Promise<Blob> {
  const height = Math.round((kWidth * picture.camera.height) / picture.camera.width);
  const canvas = document.createElement("canvas");
  canvas.width = kWidth;
  canvas.height = height + kHead;
  const context = canvas.getContext("2d")!;
  context.fillStyle = themeColour("canvas");
  context.fillRect(0, 0, kWidth, canvas.height);
  picture.paint(context, 0, kHead, kWidth, height);
  const font = themeColour("font");
  context.fillStyle = themeColour("ink");
  context.font = `600 40px ${font}`;
  context.fillText(title, 36, 52, 0.62 * kWidth);
  context.fillStyle = themeColour("ink-2");
  context.font = `32px ${font}`;
  context.fillText(place, 36, 96);
  const right = kWidth - 70;
  for (let i = 0; i < kShades; ++i) {
    context.fillStyle = cssColour(wallColour(i / (kShades - 1), isDark()));
    context.fillRect(right - 400 + (400 * i) / kShades, 40, 400 / kShades + 1, 26);
  }
  context.fillStyle = themeColour("ink-2");
  context.textAlign = "right";
  context.fillText("plastic fraction  0", right - 414, 64);
  context.fillText("1", right + 34, 64);
  return new Promise((resolve, reject) => canvas.toBlob((blob) =>
    blob ? resolve(blob) : reject(new Error("The browser could not make the picture."))));
}
