// One flight as arrays, and its state at a moment.
import type { FlightData } from "./data";
import { Unpacked } from "./packed";

export interface Flight {
  n: number;
  t: Float64Array;
  x: Float64Array;
  y: Float64Array;
  z: Float64Array;
  /** w x y z of each sample. */
  q: Float64Array;
  speed: Float64Array;
  /** NaN where not known. */
  clearance: Float64Array;
  /** From the vehicle to the commanded position, m; null where no command has one, NaN where one has none. */
  ahead: [Float64Array, Float64Array, Float64Array] | null;
  start_s: number;
  end_s: number;
}

const scaled = (values: Float64Array, step: number): Float64Array => values.map((v) => v * step);

export function readFlight(data: FlightData): Flight {
  const u = new Unpacked(data.data);
  const n = data.n;
  const t = scaled(u.secondDeltas(n), 0.001);
  const [x, y, z] = [0, 1, 2].map(() => scaled(u.secondDeltas(n), 0.01));
  const parts = [0, 1, 2, 3].map(() => u.deltas(n));
  const q = new Float64Array(4 * n);
  for (let i = 0; i < n; ++i) {
    const norm = Math.hypot(parts[0][i], parts[1][i], parts[2][i], parts[3][i]) || 1;
    for (let k = 0; k < 4; ++k) q[4 * i + k] = parts[k][i] / norm;
  }
  const speed = scaled(u.deltas(n), 0.01);
  const clearance = u.deltas(n).map((c) => (c < 0 ? NaN : 0.01 * c));
  let ahead: Flight["ahead"] = null;
  if (data.reference) {
    const has = u.deltas(n);
    ahead = [0, 1, 2].map(() => u.deltas(n).map((v, i) => (has[i] ? 0.01 * v : NaN))) as Flight["ahead"];
  }
  return { n, t, x, y, z, q, speed, clearance, ahead, start_s: n ? t[0] : 0, end_s: n ? t[n - 1] : 0 };
}

export interface State {
  position: [number, number, number];
  q: [number, number, number, number];
  speed: number;
  clearance: number;
  index: number;
}

/** The sample not after `time`, and how far it is to the next one, 0 to 1. */
export function placeOf(f: Flight, time: number): [number, number] {
  let low = 0;
  let high = f.n - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (f.t[middle] <= time) low = middle;
    else high = middle - 1;
  }
  if (low + 1 >= f.n) return [low, 0];
  const span = f.t[low + 1] - f.t[low];
  return [low, span > 0 ? Math.min(1, Math.max(0, (time - f.t[low]) / span)) : 0];
}

export function stateAt(f: Flight, time: number): State {
  const [i, share] = placeOf(f, time);
  const j = Math.min(i + 1, f.n - 1);
  const mix = (a: Float64Array): number => a[i] + share * (a[j] - a[i]);
  const q = [0, 1, 2, 3].map((k) => f.q[4 * i + k] + share * (f.q[4 * j + k] - f.q[4 * i + k]));
  const norm = Math.hypot(...q) || 1;
  return {
    position: [mix(f.x), mix(f.y), mix(f.z)],
    q: q.map((v) => v / norm) as State["q"],
    speed: mix(f.speed),
    clearance: Number.isNaN(f.clearance[j]) ? f.clearance[i] : mix(f.clearance),
    index: i,
  };
}
