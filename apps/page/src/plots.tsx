// Speed, clearance and commands of a flight over time.
import type { JSX } from "preact";
import { useMemo } from "preact/hooks";
import type { Seen } from "./data";
import type { Line } from "./lines";
import { TimeChart } from "./lines";
import { deltasOf, floatsOf } from "./packed";
import type { Entry, Scene } from "./replay";
import type { Track } from "./viewer";

function lineOf(of: Entry, t: ArrayLike<number>, v: ArrayLike<number>): Line {
  const points = Array.from(v, (value, i): [number, number] => [t[i], value]).filter((p) => Number.isFinite(p[1]));
  const { label, color, shape, dash, isMain } = of;
  return { label, color, shape, dash: isMain ? "" : dash, width: isMain ? 2.2 : 1.2, points };
}

/** Charts over time below a replay. */
export function Plots(props: {
  scene: Scene;
  tracks: Track[];
  hidden: Set<string>;
  time: number;
  end: number;
  seek: (t: number) => void;
}): JSX.Element {
  const { scene, tracks, hidden } = props;
  const shown = tracks.filter((t) => !hidden.has(t.label)).sort((a, b) => Number(a.isMain) - Number(b.isMain));
  const name = shown.map((t) => t.label).join("\n");
  const of = (value: (t: Track) => ArrayLike<number>): Line[] =>
    shown.map((t) => lineOf(scene.entries[tracks.indexOf(t)], t.flight.t, value(t)));
  const speed = useMemo(() => of((t) => t.flight.speed), [name, tracks]);
  const clearance = useMemo(() => of((t) => t.flight.clearance), [name, tracks]);
  const main = tracks.find((t) => t.isMain)!;
  const entry = scene.entries.find((e) => e.isMain)!;
  const commands = useMemo((): { title: string; unit: string; lines: Line[] }[] => {
    const calls = scene.seen?.calls;
    if (calls?.n) {
      const t = floatsOf(calls.t, calls.n);
      const wanted: [string, string, string][] = [
        ["Commanded speed", "m/s", calls.speed],
        ["Commanded acceleration", "m/s²", calls.acceleration],
        ["Commanded thrust over mass", "m/s²", calls.thrust],
        ["CPU time of a call", "ms", calls.cpu_ms],
      ];
      return wanted
        .map(([title, unit, text]) => ({
          title,
          unit,
          lines: [lineOf(entry, t, floatsOf(text, calls.n))],
        }))
        .filter((p) => p.lines[0].points.length > 0);
    }
    const ahead = of((t) => {
      const a = t.flight.ahead;
      return a ? t.flight.t.map((_, i) => Math.hypot(a[0][i], a[1][i], a[2][i])) : [];
    }).filter((line) => line.points.length > 0);
    return ahead.length ? [{ title: "Commanded position ahead of the vehicle", unit: "m", lines: ahead }] : [];
  }, [name, tracks, scene]);
  // When the planner had no plan.
  const spans = useMemo((): [number, number][] => {
    const changes: [number, number][] = scene.seen?.calls.n ? statusChanges(scene.seen) : entry.data.status;
    return changes.flatMap(([from, status], i) =>
      status === 0 ? [] : [[from, changes[i + 1]?.[0] ?? main.flight.end_s] as [number, number]],
    );
  }, [scene]);
  const common = { name: `trial ${entry.id}`, time: props.time, end: props.end, seek: props.seek };
  return (
    <div class="plots">
      <TimeChart title="Speed" unit="m/s" lines={speed} {...common} />
      <TimeChart title="Clearance" unit="m" lines={clearance} {...common} />
      {commands.map((c) => (
        <TimeChart {...c} spans={spans} {...common} />
      ))}
      <p class="note">
        {spans.length ? "Shaded: the planner answered without a command. " : ""}Clearance is to the nearest surface, 5 m
        at most{scene.seen ? "" : "; between two samples, the smallest value is shown"}.
      </p>
    </div>
  );
}

function statusChanges(seen: Seen): [number, number][] {
  const t = floatsOf(seen.calls.t, seen.calls.n);
  const status = deltasOf(seen.calls.status, seen.calls.n);
  const changes: [number, number][] = [];
  status.forEach((s, i) => {
    if (s !== (changes.length ? changes[changes.length - 1][1] : 0)) changes.push([t[i], s]);
  });
  return changes;
}
