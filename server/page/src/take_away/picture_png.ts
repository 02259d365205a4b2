import { cssColour, kShades, themeColour, wallColour, isDark } from "../picture/colours";
import type { Picture } from "../picture/picture";

const kWidth = 2400;
const kHead = 110;

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
