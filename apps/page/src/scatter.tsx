// Any metric of the trials against what was varied, a measure of their map or another metric: a sign for each trial.
import type { JSX } from "preact";
import { useMemo } from "preact/hooks";
import type { Scale } from "./chart";
import { Chart, Legend, scaleOf, signPath, XAxis, YAxis } from "./chart";
import type { Look, Sweep } from "./data";
import { digits, isFinished, metricWords, outcomeText } from "./data";
import { Figure } from "./figure";
import { columnsOf } from "./report";
import { shortest } from "./save";
import type { View } from "./state";

/** What an axis of the chart can be. */
interface Measure {
  id: string;
  text: string;
  group: "What was varied" | "The map" | "Metrics";
  unit: string;
  of: (trial: number) => number;
  /** The words of the values 0, 1, … */
  words?: string[];
}

const withUnit = (text: string, unit: string): string => `${text}${unit ? `, ${unit}` : ""}`;

function axesOf(sweep: Sweep): Measure[] {
  return sweep.t.axes.map((axis): Measure => {
    const known = axis.words.filter((w) => w !== null);
    const isNumeric = known.every((w) => typeof w === "number");
    const words = [...known].map(String).sort();
    const places = axis.words.map((w) => (w === null ? NaN : isNumeric ? Number(w) : words.indexOf(String(w))));
    const common = { id: axis.field, text: axis.field, group: "What was varied" as const, unit: "" };
    return { ...common, of: (i) => places[axis.of[i]], words: isNumeric ? undefined : words };
  });
}

/** Traversability, and what the report's table of maps has of each; it names them otherwise, so that the same traversability tells which is which. */
function mapMeasuresOf(sweep: Sweep): Measure[] {
  const ratios = sweep.maps.map((m) => m.traversability ?? NaN);
  const group = "The map" as const;
  const name = "traversability_normalized_ratio";
  const all: Measure[] = [
    { id: name, text: "normalised traversability", group, unit: "", of: (i) => ratios[sweep.t.map[i]] },
  ];
  const table = sweep.tables.find((t) => t.name === "maps");
  if (!table) return all;
  const of = columnsOf(table);
  const rows = new Map(table.rows.map(({ cells }) => [of(cells, name), cells]));
  if (rows.size !== sweep.maps.length || new Set(ratios).size !== rows.size) return all;
  const taken = [name, "map_seed", "trial_count", "finished_count", ...sweep.t.axes.map((a) => a.field)];
  for (const column of table.columns) {
    const values = ratios.map((ratio) => of(rows.get(ratio) ?? [], column.name));
    if (column.place !== "value" || taken.includes(column.name) || !values.some((v) => typeof v === "number")) continue;
    all.push({
      id: `map ${column.name}`,
      text: metricWords(column.name),
      group,
      unit: column.unit,
      of: (i) => (typeof values[sweep.t.map[i]] === "number" ? Number(values[sweep.t.map[i]]) : NaN),
    });
  }
  return all;
}

const metricsOf = (sweep: Sweep): Measure[] =>
  sweep.metrics.map((m, at) => ({
    id: m.name,
    text: metricWords(m.name),
    group: "Metrics",
    unit: m.unit,
    of: (i) => sweep.t.metrics[at][i],
  }));

interface Dot {
  trial: number;
  planner: number;
  x: number;
  y: number;
}
interface Placed extends Dot {
  px: number;
  py: number;
}

/** [least, greatest] with some room beside them. */
function endsOf(values: number[], measure: Measure): [number, number] {
  if (measure.words) return [-0.5, measure.words.length - 0.5];
  const [low, high] = values.reduce(([l, h], v) => [Math.min(l, v), Math.max(h, v)], [Infinity, -Infinity]);
  const pad = 0.04 * (high - low || Math.abs(high) || 1);
  return Number.isFinite(low) ? [low - pad, high + pad] : [0, 1];
}

/** How far trials of one value are drawn apart, px: not at all where there are many values. */
function spreadOf(dots: Dot[], width: number): number {
  const count = new Set(dots.map((d) => d.x)).size;
  return count > 12 ? 0 : Math.min(90, (0.7 * width) / Math.max(count, 2));
}

/** Where the trials are drawn: of one value beside each other, planner by planner. */
function placed(dots: Dot[], groups: { planner: number }[], x: Scale, y: Scale, most: number): Placed[] {
  const values = [...new Set(dots.map((d) => d.x))].sort((a, b) => a - b);
  const spread = most && Math.min(most, ...values.slice(1).map((v, i) => 0.7 * (x(v) - x(values[i]))));
  const order = new Map(groups.map((g, k) => [g.planner, k]));
  return dots.map((d, i) => {
    const share = (order.get(d.planner)! + 0.15 + 0.7 * ((i * 0.618) % 1)) / groups.length;
    return { ...d, px: x(d.x) + spread * (share - 0.5), py: y(d.y) };
  });
}

/** The chart, and what lies beside its values, px. */
const [kHeight, kLeft, kRight, kBelow] = [340, 52, 12, 40];

const kNear = 12;
function nearest(all: Placed[], x: number, y: number): Placed | null {
  let found: Placed | null = null;
  let least = kNear;
  for (const one of all) {
    const away = Math.hypot(one.px - x, one.py - y);
    if (away < least) [found, least] = [one, away];
  }
  return found;
}

/** The signs of a planner in two paths: thousands of elements would be slow. */
function signs(sweep: Sweep, all: Placed[], groups: { planner: number; look: Look }[]): JSX.Element[] {
  const size = all.length > 2000 ? 2 : all.length > 300 ? 3 : 4.2;
  return groups.flatMap(({ planner, look }) => {
    const path = (finished: boolean): string =>
      all
        .filter((d) => d.planner === planner && isFinished(sweep.t, d.trial) === finished)
        .map((d) => signPath(look.shape, Math.round(10 * d.px) / 10, Math.round(10 * d.py) / 10, size))
        .join("");
    return [
      <path d={path(true)} fill={look.color} fill-opacity={0.75} class="sign" />,
      <path d={path(false)} fill="none" stroke={look.color} class="hollow" />,
    ];
  });
}

function Dots(props: {
  sweep: Sweep;
  dots: Dot[];
  groups: { planner: number; look: Look }[];
  x: Measure;
  y: Measure;
  open: (trial: number) => void;
}): JSX.Element {
  const { sweep, dots, groups, x, y, open } = props;
  const ends = useMemo(
    () =>
      [x, y].map((m, k) =>
        endsOf(
          dots.map((d) => (k ? d.y : d.x)),
          m,
        ),
      ),
    [dots],
  );
  // Not made again while the pointer moves.
  const drawn = useMemo(() => {
    const drawnAt = (width: number) => {
      const spread = spreadOf(dots, width - kLeft - kRight);
      const sx = scaleOf(...ends[0], kLeft + spread / 2, width - kRight - spread / 2);
      const sy = scaleOf(...ends[1], kHeight - kBelow, 10);
      const all = placed(dots, groups, sx, sy, spread);
      return { width, x: sx, y: sy, all, signs: signs(sweep, all, groups) };
    };
    let last: ReturnType<typeof drawnAt> | null = null;
    return (width: number) => {
      if (last?.width !== width) last = drawnAt(width);
      return last;
    };
  }, [dots]);
  const textOf = (d: Placed): string =>
    `trial ${sweep.t.id[d.trial]}, ${sweep.planners[d.planner].label}, ${outcomeText(sweep.outcomes[sweep.t.outcome[d.trial]])}: ${y.text} ${digits(d.y)} ${y.unit}, ${x.text} ${x.words?.[d.x] ?? digits(d.x)} ${x.unit}. ${sweep.t.flight[d.trial] < 0 ? "Its flight is not in this page." : "Click to see it."}`;
  return (
    <Chart
      height={kHeight}
      label={`${y.text} against ${x.text}, a sign for each trial; their numbers are in the table below`}
      draw={(width, tip) => {
        const chart = drawn(width);
        const click = (e: MouseEvent): void => {
          const box = (e.currentTarget as Element).closest("svg")!.getBoundingClientRect();
          const found = nearest(chart.all, e.clientX - box.left, e.clientY - box.top);
          if (found && sweep.t.flight[found.trial] >= 0) open(found.trial);
        };
        return (
          <>
            <XAxis
              x={chart.x}
              left={kLeft}
              right={width - kRight}
              top={10}
              bottom={kHeight - kBelow}
              unit={withUnit(x.text, x.unit)}
              words={x.words}
            />
            <YAxis y={chart.y} left={kLeft} right={width - kRight} count={6} />
            {chart.signs}
            <rect
              x={0}
              y={0}
              width={width}
              height={kHeight}
              class="hit clickable"
              onClick={click}
              {...tip((px, py) => {
                const found = nearest(chart.all, px, py);
                return found && textOf(found);
              })}
            />
          </>
        );
      }}
    />
  );
}

function Pick(props: {
  text: string;
  name: string;
  of: Measure[];
  value: Measure;
  set: (id: string) => void;
}): JSX.Element {
  const groups = [...new Set(props.of.map((m) => m.group))];
  return (
    <label>
      {props.text}{" "}
      <select name={props.name} value={props.value.id} onChange={(e) => props.set(e.currentTarget.value)}>
        {groups.map((group) => (
          <optgroup label={group}>
            {props.of
              .filter((m) => m.group === group)
              .map((m) => (
                <option value={m.id}>{withUnit(m.text, m.unit)}</option>
              ))}
          </optgroup>
        ))}
      </select>
    </label>
  );
}

export function Scatter(props: {
  sweep: Sweep;
  groups: { planner: number; look: Look; trials: number[] }[];
  view: View;
  change: (part: Partial<View>) => void;
  open: (trial: number) => void;
}): JSX.Element | null {
  const { sweep, groups, view, change, open } = props;
  const metrics = useMemo(() => metricsOf(sweep), [sweep]);
  const across = useMemo(() => {
    const all = [...axesOf(sweep), ...mapMeasuresOf(sweep)];
    return [...all.filter((m) => new Set(Array.from(sweep.t.id, (_, i) => m.of(i))).size > 1), ...metrics];
  }, [sweep]);
  const y = metrics.find((m) => m.id === view.y) ?? metrics.find((m) => m.id === "min_clearance_m") ?? metrics[0];
  const x = across.find((m) => m.id === view.x) ?? across.find((m) => m.id !== "map_seed");
  const dots = useMemo(
    () =>
      groups.flatMap(({ planner, trials }) =>
        trials
          .map((trial): Dot => ({ trial, planner, x: x?.of(trial) ?? NaN, y: y?.of(trial) ?? NaN }))
          .filter((d) => Number.isFinite(d.x + d.y)),
      ),
    [groups, x, y],
  );
  if (!x || !y) return null;
  const without = groups.reduce((sum, g) => sum + g.trials.length, 0) - dots.length;
  return (
    <Figure
      name="scatter"
      wide
      title={`${y.text} against ${x.text}`}
      note={`A sign for each trial, hollow where it failed${without ? `; ${without} without these values` : ""}. A click opens the flight.`}
      numbers={() => ({
        head: ["trial", "planner", "outcome", withUnit(x.text, x.unit), withUnit(y.text, y.unit)],
        rows: dots.map((d) => [
          sweep.t.id[d.trial],
          sweep.planners[d.planner].label,
          outcomeText(sweep.outcomes[sweep.t.outcome[d.trial]]),
          x.words?.[d.x] ?? shortest(d.x),
          shortest(d.y),
        ]),
      })}
    >
      <div class="pick">
        <Pick text="Upwards" name="y" of={metrics} value={y} set={(id) => change({ y: id })} />
        <Pick text="Across" name="x" of={across} value={x} set={(id) => change({ x: id })} />
      </div>
      <Legend
        items={[
          ...groups.map(({ look: { label, color, shape } }) => ({ label, color, shape })),
          { label: "failed", color: "var(--ink)", shape: 0, hollow: true },
        ]}
      />
      <Dots sweep={sweep} dots={dots} groups={groups} x={x} y={y} open={open} />
    </Figure>
  );
}
