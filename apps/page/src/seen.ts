// What a planner was shown: images as pictures, depth as points in the world.
import type { CameraData, SeenImage } from "./data";
import { Unpacked } from "./packed";

function pixelsOf(image: SeenImage): Uint8Array {
  return new Unpacked(image.data).raw(image.width * image.height * image.channels);
}

/** Metres of a byte as lib/results/page/flight_page.cpp rounds them: NaN invalid, infinity no return. */
function depthOfByte(byte: number, near: number, far: number): number {
  if (byte === 0) return NaN;
  if (byte === 255) return Infinity;
  return near * (far / near) ** ((byte - 1) / 253);
}

const nearest = (camera: CameraData): number => Math.max(camera.min_m, 0.05);

/** Turbo (Mikhailov 2019): 0 blue to 1 red. */
function turbo(x: number): [number, number, number] {
  const sum = (c: number[]): number =>
    Math.min(
      1,
      Math.max(
        0,
        c.reduce((s, v, i) => s + v * x ** i, 0),
      ),
    );
  return [
    sum([0.13572138, 4.6153926, -42.66032258, 132.13108234, -152.94239396, 59.28637943]),
    sum([0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604]),
    sum([0.1066733, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973]),
  ];
}

export function paint(image: SeenImage, camera: CameraData, canvas: HTMLCanvasElement): void {
  canvas.width = image.width;
  canvas.height = image.height;
  const context = canvas.getContext("2d");
  if (!context) return;
  const pixels = pixelsOf(image);
  const out = context.createImageData(image.width, image.height);
  for (let i = 0; i < image.width * image.height; ++i) {
    let rgb: number[];
    if (image.kind === "depth") {
      const depth = depthOfByte(pixels[i], nearest(camera), camera.max_m);
      rgb = Number.isNaN(depth)
        ? [110, 110, 110]
        : depth === Infinity
          ? [0, 0, 0]
          : turbo(1 - (depth - camera.min_m) / (camera.max_m - camera.min_m)).map((v) => 255 * v);
    } else if (image.channels === 3) {
      rgb = [pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]];
    } else {
      rgb = [pixels[i], pixels[i], pixels[i]];
    }
    out.data.set([rgb[0], rgb[1], rgb[2], 255], 4 * i);
  }
  context.putImageData(out, 0, 0);
}

/** The points of a depth image in the world, from where the planner takes its camera to be. */
export function pointsOf(image: SeenImage, camera: CameraData): { points: Float32Array; colors: Float32Array } {
  const pixels = pixelsOf(image);
  const focal = camera.width / 2 / Math.tan((camera.fov_x_deg * Math.PI) / 360);
  const [w, x, y, z] = image.pose.q;
  const points: number[] = [];
  const colors: number[] = [];
  for (let row = 0; row < image.height; ++row) {
    for (let column = 0; column < image.width; ++column) {
      const depth = depthOfByte(pixels[row * image.width + column], nearest(camera), camera.max_m);
      if (!Number.isFinite(depth)) continue;
      const half = Math.floor(image.skip / 2);
      const v = [
        ((column * image.skip + half - (camera.width - 1) / 2) / focal) * depth,
        ((row * image.skip + half - (camera.height - 1) / 2) / focal) * depth,
        depth,
      ];
      // v + 2 q × (q × v + w v)
      const t = [y * v[2] - z * v[1] + w * v[0], z * v[0] - x * v[2] + w * v[1], x * v[1] - y * v[0] + w * v[2]];
      const moved = [
        v[0] + 2 * (y * t[2] - z * t[1]),
        v[1] + 2 * (z * t[0] - x * t[2]),
        v[2] + 2 * (x * t[1] - y * t[0]),
      ];
      points.push(
        moved[0] + image.pose.position[0],
        moved[1] + image.pose.position[1],
        moved[2] + image.pose.position[2],
      );
      colors.push(...turbo(1 - (depth - camera.min_m) / (camera.max_m - camera.min_m)));
    }
  }
  return { points: Float32Array.from(points), colors: Float32Array.from(colors) };
}

/** The last one not after `time`, -1 where all are later. */
export function latest(all: { t: number }[], time: number): number {
  let found = -1;
  for (let i = 0; i < all.length && all[i].t <= time + 1e-6; ++i) found = i;
  return found;
}
