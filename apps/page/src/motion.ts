// Where things are that move, as lib/sim/world/motion.hpp has it.
import type { PathData } from "./data";

interface Way {
  offset: [number, number, number];
  /** About the upright axis through the instance's own origin. */
  turn: number;
}

function onRoute(knots: [number, number, number, number, number][], time: number): Way {
  const ms = 1000 * time;
  let after = 0;
  for (let low = 0, high = knots.length; low < high; after = low) {
    const middle = (low + high) >> 1;
    if (knots[middle][0] <= ms) low = middle + 1;
    else high = middle;
  }
  const from = knots[Math.max(0, after - 1)];
  const to = knots[Math.min(after, knots.length - 1)];
  const share = to[0] > from[0] ? (ms - from[0]) / (to[0] - from[0]) : 0;
  const at = (k: number): number => (from[k] + share * (to[k] - from[k])) / 1000;
  return { offset: [at(1), at(2), at(3)], turn: at(4) };
}

/** How an instance stands beside its place at a time. */
export function wayAt(path: PathData, time: number): Way {
  if (path.kind === "route") return onRoute(path.knots, time);
  const a = 2 * Math.PI * (time / path.period + path.phase);
  if (path.kind === "sway") {
    const [x, y, z] = path.amplitude;
    return { offset: [x * Math.sin(a), y * Math.sin(a), z * Math.sin(a)], turn: 0 };
  }
  const x = (path.reach / 3) * (Math.sin(a) + 2 * Math.sin(2 * a));
  const y = (path.reach / 3) * (Math.cos(a) - 2 * Math.cos(2 * a));
  const [c, s] = [Math.cos(path.heading), Math.sin(path.heading)];
  return { offset: [c * x - s * y, s * x + c * y, path.rise * Math.sin(3 * a)], turn: 0 };
}
