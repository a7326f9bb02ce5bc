// The plots under a replay: one time axis, a line at the shown moment; a click goes there.
import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { useWidth } from "./charts";
import { kDashes } from "./data";

export interface Series {
  label: string;
  color: string;
  t: ArrayLike<number>;
  v: ArrayLike<number>;
  isMain: boolean;
  dash?: number;
}

function ink(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim() || "#888";
}

export function Plot(props: {
  title: string;
  unit: string;
  series: Series[];
  time: number;
  end: number;
  seek: (t: number) => void;
  theme: string;
  bands?: [number, number][];
}): JSX.Element {
  const [ref, width] = useWidth();
  const plot = useRef<uPlot | null>(null);
  const now = useRef(props.time);
  now.current = props.time;
  const seek = useRef(props.seek);
  seek.current = props.seek;
  useEffect(() => {
    if (width === 0 || !ref.current) return;
    // uPlot wants one list of times for all: those of all series, with null where a series has no value.
    const tables = props.series.map(
      (s) => [Array.from(s.t), Array.from(s.v, (v) => (Number.isFinite(v) ? v : null))] as uPlot.AlignedData,
    );
    const data = tables.length
      ? uPlot.join(
          tables,
          tables.map((t) => t.map(() => 2)),
        )
      : ([[0], []] as unknown as uPlot.AlignedData);
    const axis = {
      stroke: ink("--soft"),
      grid: { stroke: ink("--line"), width: 1 },
      ticks: { show: false },
      font: "11px system-ui, sans-serif",
    };
    const options: uPlot.Options = {
      width,
      height: 112,
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { show: false } },
      scales: {
        x: { time: false, range: [0, Math.max(props.end, 0.1)] },
        y: { range: (_, low, high) => [Math.min(0, low ?? 0), Math.max(high ?? 1, 0.1) * 1.05] },
      },
      axes: [
        { ...axis, size: 22 },
        { ...axis, size: 42 },
      ],
      series: [
        {},
        ...props.series.map(
          (s): uPlot.Series => ({
            label: s.label,
            stroke: s.color,
            width: s.isMain ? 2.2 : 1.2,
            dash: s.isMain ? [] : kDashes[(s.dash ?? 0) % kDashes.length].split(" ").filter(Boolean).map(Number),
            points: { show: false },
            spanGaps: true,
          }),
        ),
      ],
      hooks: {
        drawAxes: [
          (u) => {
            for (const [from, to] of props.bands ?? []) {
              u.ctx.fillStyle = ink("--band");
              const x = u.valToPos(from, "x", true);
              u.ctx.fillRect(x, u.bbox.top, Math.max(2, u.valToPos(to, "x", true) - x), u.bbox.height);
            }
          },
        ],
        draw: [
          (u) => {
            const x = Math.round(u.valToPos(now.current, "x", true));
            u.ctx.fillStyle = ink("--ink");
            u.ctx.fillRect(x, u.bbox.top, 1.5, u.bbox.height);
          },
        ],
        ready: [
          (u) => {
            u.over.addEventListener("pointerdown", (e) => {
              const go = (event: PointerEvent): void =>
                seek.current(u.posToVal(event.clientX - u.over.getBoundingClientRect().left, "x"));
              go(e);
              const stop = (): void => {
                window.removeEventListener("pointermove", go);
                window.removeEventListener("pointerup", stop);
              };
              window.addEventListener("pointermove", go);
              window.addEventListener("pointerup", stop);
            });
          },
        ],
      },
    };
    const made = new uPlot(options, data, ref.current);
    plot.current = made;
    return () => {
      made.destroy();
      plot.current = null;
    };
  }, [width, props.series, props.end, props.theme]);
  useEffect(() => {
    plot.current?.redraw(false, false);
  }, [props.time]);
  return (
    <div class="plot">
      <h3>
        {props.title} <span class="unit">{props.unit}</span>
      </h3>
      <div ref={ref} role="img" aria-label={`${props.title} over time`} />
    </div>
  );
}
