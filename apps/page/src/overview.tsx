// The overview: charts of the trials that the filters let through, then the report's own tables.
import type { JSX } from "preact";
import { useMemo } from "preact/hooks";
import { Legend } from "./chart";
import type { Bar, Box, Mark } from "./charts";
import { BarChart, BoxChart, IntervalChart } from "./charts";
import type { Look, Sweep } from "./data";
import { digits, isFinished, lookOf, metricWords, outcomeColor, outcomeText, percent } from "./data";
import { Figure, ScrollTable } from "./figure";
import type { Line } from "./lines";
import { LineChart } from "./lines";
import { Contrasts, columnsOf, Limits, number, Report } from "./report";
import { Scatter } from "./scatter";
import type { View } from "./state";
import { logisticFit, quantile, successInterval } from "./stats";

interface OverviewProps {
  sweep: Sweep;
  chosen: Int32Array;
  view: View;
  change: (part: Partial<View>) => void;
  open: (trial: number) => void;
}
interface Group {
  planner: number;
  look: Look;
  trials: number[];
}
interface Props extends OverviewProps {
  groups: Group[];
}

/** The chosen trials of each planner that has any. */
function byPlanner(sweep: Sweep, chosen: Int32Array): Group[] {
  const lists: number[][] = sweep.planners.map(() => []);
  for (const i of chosen) lists[sweep.t.planner[i]].push(i);
  return lists
    .map((trials, planner) => ({ planner, look: lookOf(planner, sweep.planners[planner].label), trials }))
    .filter((p) => p.trials.length > 0);
}

/** The finite values of these trials, the least first. */
function sortedValues(values: Float32Array, trials: number[]): Float64Array {
  const sorted = new Float64Array(trials.length);
  let count = 0;
  for (const i of trials) if (Number.isFinite(values[i])) sorted[count++] = values[i];
  return sorted.subarray(0, count).sort();
}

/** [successes, trials] of each map. */
function byMap(sweep: Sweep, trials: number[]): Map<number, [number, number]> {
  const maps = new Map<number, [number, number]>();
  for (const i of trials) {
    const map = sweep.t.map[i];
    const entry = maps.get(map) ?? [0, 0];
    entry[0] += isFinished(sweep.t, i) ? 1 : 0;
    entry[1] += 1;
    maps.set(map, entry);
  }
  return maps;
}

function Success({ sweep, groups }: Props): JSX.Element {
  const rates = groups.map(({ look, trials }) => {
    const finished = trials.filter((i) => isFinished(sweep.t, i)).length;
    const interval = successInterval(byMap(sweep, trials).values());
    return { look, count: trials.length, finished, value: finished / trials.length, ...interval };
  });
  const marks: Mark[] = rates.map(({ look, value, lower, upper, ...r }) => ({
    ...look,
    value,
    lower,
    upper,
    tip: `${look.label}: ${r.finished} of ${r.count} trials reached the goal, ${percent(value)}, 95 % interval ${percent(lower)} to ${percent(upper)}`,
  }));
  return (
    <Figure
      name="success"
      title="Success by planner"
      note="Share of trials that reached the goal, with 95 % intervals."
      numbers={{
        head: ["planner", "trials", "finished", "success rate", "lower", "upper"],
        rows: rates.map((r) => [r.look.label, r.count, r.finished, r.value, r.lower, r.upper]),
      }}
    >
      <IntervalChart
        marks={marks}
        values={{ low: 0, high: 1, percent: true }}
        label={`Success by planner: ${marks.map((m) => m.tip).join("; ")}`}
      />
    </Figure>
  );
}

function Difficulty({ sweep, chosen, groups }: Props): JSX.Element | null {
  const all = chosen.length === sweep.t.count;
  const ratios = sweep.maps.map((m) => m.traversability ?? NaN);
  const known = ratios.filter(Number.isFinite);
  if (new Set(known).size < 2) return null;
  const pad = 0.03 * (Math.max(...known) - Math.min(...known));
  const [low, high] = [Math.min(...known) - pad, Math.max(...known) + pad];
  const rows: (string | number | null)[][] = [];
  const lines: Line[] = groups.map(({ planner, look, trials }) => {
    const maps = [...byMap(sweep, trials)]
      .filter(([map]) => Number.isFinite(ratios[map]))
      .sort((a, b) => ratios[a[0]] - ratios[b[0]]);
    // The report's own curve where all trials are shown.
    const given = sweep.curves.find((c) => c.planner === planner);
    const fit =
      maps.length < 5
        ? null
        : all
          ? given && given.intercept !== null && given.slope !== null
            ? { intercept: given.intercept, slope: given.slope }
            : null
          : logisticFit(maps.map(([map, [s, n]]) => [ratios[map], s, n]));
    const points: [number, number][] = [];
    if (fit)
      for (let k = 0; k <= 60; ++k) {
        const x = low + ((high - low) * k) / 60;
        points.push([x, 1 / (1 + Math.exp(-(fit.intercept + fit.slope * x)))]);
      }
    const { label } = look;
    for (const [map, [s, n]] of maps) rows.push([label, sweep.maps[map].text, ratios[map], s, n, s / n]);
    return {
      ...look,
      points,
      dots: maps.map(([map, [s, n]]) => ({
        x: ratios[map],
        y: s / n,
        size: Math.min(6, 2.2 + Math.sqrt(n) / 2),
        tip: `${label}: ${s} of ${n} on ${sweep.maps[map].text} (traversability ${digits(ratios[map])})`,
      })),
    };
  });
  return (
    <Figure
      name="difficulty"
      wide
      title="Success against difficulty"
      note="Each sign is a map; curves are logistic fits from five maps on. To the left maps are harder: 1 is free of obstacles."
      numbers={{ head: ["planner", "map", "traversability", "finished", "trials", "success rate"], rows }}
    >
      <Legend items={lines} />
      <LineChart
        lines={lines}
        x={[low, high]}
        y={[0, 1]}
        percent
        ends
        xUnit="normalised traversability"
        label="Success rates of the maps against their traversability, by planner; its numbers are in the table below"
      />
    </Figure>
  );
}

function Outcomes({ sweep, groups }: Props): JSX.Element {
  const counts = groups.map(({ trials }) => {
    const of = sweep.outcomes.map(() => 0);
    for (const i of trials) of[sweep.t.outcome[i]] += 1;
    return of;
  });
  const seen = sweep.outcomes.map((_, o) => o).filter((o) => counts.some((c) => c[o] > 0));
  const bars: Bar[] = groups.map(({ look }, k) => ({
    label: look.label,
    parts: seen.map((o) => ({ name: outcomeText(sweep.outcomes[o]), color: outcomeColor(o), count: counts[k][o] })),
  }));
  return (
    <Figure
      name="outcomes"
      title="Outcomes"
      note="How the trials ended."
      numbers={{
        head: ["planner", ...sweep.outcomes.map(outcomeText)],
        rows: groups.map(({ look }, k) => [look.label, ...counts[k]]),
      }}
    >
      <Legend items={seen.map((o) => ({ label: outcomeText(sweep.outcomes[o]), color: outcomeColor(o) }))} />
      <BarChart bars={bars} share label="Outcomes by planner; their numbers are in the table below" />
    </Figure>
  );
}

/** S(v): the share of trials with at least each goal velocity, a failure's being 0, and v90 read from it. */
function Speeds({ sweep, chosen, groups }: Props): JSX.Element | null {
  const at = sweep.metrics.findIndex((m) => m.name === "average_goal_velocity_mps");
  if (at < 0) return null;
  // Intervals are the report's own, which are of all trials.
  const told = chosen.length === sweep.t.count ? sweep.tables.find((t) => t.name === "speed") : undefined;
  const ofTable = told && columnsOf(told);
  const boundsOf = (label: string): (number | null)[] => {
    const row = told?.rows.find(({ cells }) => cells[0] === label);
    return [1, 2].map((place) => {
      const bound = row ? number(ofTable!(row.cells, "v90_mps", place)) : NaN;
      return Number.isFinite(bound) ? bound : null;
    });
  };
  const rows: (string | number | null)[][] = [];
  let fastest = 0;
  const lines: Line[] = groups.map(({ look, trials }) => {
    const speeds = Float64Array.from(trials, (i) => (isFinished(sweep.t, i) ? sweep.t.metrics[at][i] : 0)).sort();
    const count = speeds.length;
    fastest = Math.max(fastest, count ? speeds[count - 1] : 0);
    // As lib/base/statistics/reached_speed.cpp: counts are whole.
    const reached = (share: number, least: number): number | null =>
      count < least ? null : speeds[Math.floor((1 - share) * count + 1e-9)];
    const mean = speeds.reduce((sum, v) => sum + v, 0) / count;
    const [lower, upper] = boundsOf(look.label);
    rows.push([look.label, count, reached(0.9, 29), lower, upper, reached(0.5, 5), count ? mean : null]);
    const points: [number, number][] = [[0, 1]];
    speeds.forEach((v, k) => {
      // S falls behind each speed.
      if (k + 1 === count || v < speeds[k + 1]) points.push([v, (count - k - 1) / count]);
    });
    return { ...look, points };
  });
  return (
    <Figure
      name="speeds"
      wide
      title="Goal velocity that missions reach"
      note="Share of all trials that reached the goal with at least this goal velocity (shortest path over flight time). v90 is the velocity that nine of ten reach; 0 where more than one of ten failed, none for fewer than 29 trials. Its 95 % interval is that of all trials."
      numbers={{
        head: ["planner", "trials", "v90, m/s", "lower", "upper", "v50, m/s", "mean with failures as 0, m/s"],
        rows,
      }}
    >
      <Legend items={lines} />
      <LineChart
        lines={lines}
        x={[0, fastest || 1]}
        y={[0, 1]}
        percent
        step
        xUnit="m/s"
        level={0.9}
        height={230}
        label="Share of trials that reached the goal with at least a goal velocity, by planner"
      />
    </Figure>
  );
}

function Arrivals({ sweep, chosen, groups }: Props): JSX.Element {
  const longest = chosen.reduce(
    (most, i) => Math.max(most, Number.isFinite(sweep.t.end_s[i]) ? sweep.t.end_s[i] : 0),
    0,
  );
  const rows: (string | number | null)[][] = [];
  const lines: Line[] = groups.map(({ look, trials }) => {
    const times = sortedValues(
      sweep.t.end_s,
      trials.filter((i) => isFinished(sweep.t, i)),
    );
    // Steps that are finer than a screen's pixels are taken together.
    const points: [number, number][] = [[0, 0]];
    times.forEach((t, k) => {
      const isSeen = k + 1 === times.length || times[k + 1] - points[points.length - 1][0] > longest / 2000;
      if (isSeen) points.push([t, (k + 1) / trials.length]);
    });
    points.push([longest, times.length / trials.length]);
    for (const share of [0.25, 0.5, 0.75])
      rows.push([look.label, `${100 * share} %`, times[Math.ceil(share * trials.length) - 1] ?? null]);
    return { ...look, points };
  });
  return (
    <Figure
      name="arrivals"
      title="Times to the goal"
      note="Share of all trials that has arrived; a failed trial has not arrived by any time."
      numbers={{ head: ["planner", "share of trials", "has arrived by, s"], rows }}
    >
      <Legend items={lines} />
      <LineChart
        lines={lines}
        x={[0, longest || 1]}
        y={[0, 1]}
        percent
        step
        ends
        xUnit="s"
        height={230}
        label="Share of trials that has arrived over time, by planner"
      />
    </Figure>
  );
}

function MetricChart({ sweep, groups, name }: Props & { name: string }): JSX.Element | null {
  const at = sweep.metrics.findIndex((m) => m.name === name);
  if (at < 0) return null;
  const metric = sweep.metrics[at];
  const boxes: Box[] = groups.map(({ look, trials }) => {
    const sorted = sortedValues(sweep.t.metrics[at], trials);
    const mean = sorted.reduce((sum, v) => sum + v, 0) / sorted.length;
    const five = [0.05, 0.25, 0.5, 0.75, 0.95].map((share) => quantile(sorted, share));
    return {
      ...look,
      sorted,
      mean,
      five,
      tip: `${look.label}: mean ${digits(mean)}, median ${digits(five[2])}, quartiles ${digits(five[1])} to ${digits(five[3])}, 5 to 95 % ${digits(five[0])} to ${digits(five[4])}, of ${sorted.length} trials`,
    };
  });
  const all = sortedValues(
    sweep.t.metrics[at],
    groups.flatMap((g) => g.trials),
  );
  // Single far values would press all boxes together.
  const [q1, q3] = [quantile(all, 0.25), quantile(all, 0.75)];
  const reach = Math.max(3 * (q3 - q1), 1e-9);
  const filled = boxes.filter((b) => b.sorted.length > 0);
  const low = filled.length ? Math.min(Math.max(all[0], q1 - reach), ...filled.map((b) => b.five[1])) : 0;
  const high = filled.length ? Math.max(Math.min(all[all.length - 1], q3 + reach), ...filled.map((b) => b.five[3])) : 1;
  const pad = 0.04 * (high - low || 1);
  const cut = all.length > 0 && (all[0] < low || all[all.length - 1] > high);
  const notes = [
    metric.doc.replace(/\.$/, ""),
    metric.population === "finished" ? "finished trials only" : "",
    metric.better === "neither" ? "" : `${metric.better} is better`,
    metric.is_measured ? "measured on the host: differs from run to run" : "",
    cut ? "far values are beyond the chart’s ends" : "",
  ];
  return (
    <Figure
      name={`metric ${name}`}
      title={metricWords(name)}
      note={`${notes.filter(Boolean).join("; ")}.`}
      numbers={{
        head: [
          "planner",
          "trials",
          `mean${metric.unit ? `, ${metric.unit}` : ""}`,
          "5 %",
          "first quartile",
          "median",
          "third quartile",
          "95 %",
        ],
        rows: boxes.map((b) => [
          b.label,
          b.sorted.length,
          b.sorted.length ? b.mean : null,
          ...b.five.map((v) => (Number.isFinite(v) ? v : null)),
        ]),
      }}
    >
      <BoxChart
        boxes={boxes}
        values={{ low: low - pad, high: high + pad, unit: metric.unit }}
        label={`${metricWords(name)} by planner: ${boxes.map((b) => b.tip).join("; ")}`}
      />
    </Figure>
  );
}

/** Reasons that differ in their numbers only are one reason. */
const pattern = (reason: string): string => reason.replace(/[-−]?\d+(\.\d+)?/g, "#").replace(/\(#(, #)*\)/g, "(…)");

function Reasons({ sweep, chosen, groups, open }: Props): JSX.Element | null {
  const cause = sweep.t.cause;
  const reasons = new Map<string, { count: number; parts: Map<number, number>; example: number }>();
  const patterns = useMemo(() => sweep.t.reason.words.map((w) => pattern(String(w))), [sweep]);
  for (const i of chosen) {
    if (isFinished(sweep.t, i)) continue;
    const outcome = outcomeText(sweep.outcomes[sweep.t.outcome[i]]);
    const why = (cause && String(cause.words[cause.of[i]])) || patterns[sweep.t.reason.of[i]];
    const name = why ? `${outcome}: ${why}` : outcome;
    const group = reasons.get(name) ?? { count: 0, parts: new Map<number, number>(), example: i };
    group.count += 1;
    group.parts.set(sweep.t.planner[i], (group.parts.get(sweep.t.planner[i]) ?? 0) + 1);
    // An example that can be watched.
    if (sweep.t.flight[group.example] < 0 && sweep.t.flight[i] >= 0) group.example = i;
    reasons.set(name, group);
  }
  if (reasons.size === 0) return null;
  const sorted = [...reasons].sort((a, b) => b[1].count - a[1].count);
  const shown = sorted.slice(0, 12);
  return (
    <Figure
      name="reasons"
      wide
      title={cause ? "Causes of failures" : "Reasons of failures"}
      note={`${cause ? "As found by avoidbench explain, with the outcome" : "Reasons that differ only in numbers count as one"}${sorted.length > shown.length ? `; the ${shown.length} most frequent of ${sorted.length}` : ""}.`}
      numbers={{
        head: ["reason", "trials", ...groups.map(({ look }) => look.label)],
        rows: sorted.map(([name, g]) => [name, g.count, ...groups.map(({ planner }) => g.parts.get(planner) ?? 0)]),
      }}
    >
      <Legend items={groups.map(({ look: { label, color, shape } }) => ({ label, color, shape }))} />
      <BarChart
        label="Reasons of failures; their numbers are in the table below"
        bars={shown.map(([name, g]) => ({
          label: name,
          parts: groups.map(({ planner, look }) => ({
            name: look.label,
            color: look.color,
            count: g.parts.get(planner) ?? 0,
          })),
        }))}
      />
      <p class="examples">
        Watch one:{" "}
        {shown.slice(0, 6).map(([name, g], k) => (
          <>
            {k > 0 ? " · " : ""}
            <button class="link" onClick={() => open(g.example)} title={name}>
              trial {sweep.t.id[g.example]}
            </button>
          </>
        ))}
      </p>
    </Figure>
  );
}

/** Success of each planner on each map: a click shows these trials. */
function Grid({ sweep, groups, view, change }: Props): JSX.Element | null {
  const counts = groups.map(({ trials }) => byMap(sweep, trials));
  const maps = [...new Set(counts.flatMap((c) => [...c.keys()]))].sort(
    (a, b) => (sweep.maps[a].traversability ?? 9) - (sweep.maps[b].traversability ?? 9) || a - b,
  );
  if (maps.length < 2 || maps.length > 400) return null;
  const shade = (rate: number): string => `color-mix(in srgb, var(--good) ${Math.round(100 * rate)}%, var(--bad))`;
  return (
    <figure class="wide" data-figure="grid">
      <figcaption>
        <h3>Maps</h3>
        <p class="note">Finished trials on each map, hard maps first. A click shows the trials.</p>
      </figcaption>
      <ScrollTable
        class="grid"
        label="Success by map and planner"
        right={[false, true]}
        head={["map", "traversability", ...groups.map(({ look }) => look.label)]}
      >
        {maps.map((map) => (
          <tr>
            <th scope="row">{sweep.maps[map].text}</th>
            <td class="number">{digits(sweep.maps[map].traversability)}</td>
            {counts.map((c, k) => {
              const cell = c.get(map);
              if (!cell) return <td />;
              const filters = { ...view.filters, planner: [String(groups[k].planner)], map: [String(map)] };
              return (
                <td class="rate">
                  <button
                    style={{ background: shade(cell[0] / cell[1]) }}
                    onClick={() => change({ tab: "trials", filters })}
                  >
                    {cell[0]}/{cell[1]}
                  </button>
                </td>
              );
            })}
          </tr>
        ))}
      </ScrollTable>
    </figure>
  );
}

export function Overview(given: OverviewProps): JSX.Element {
  const { sweep, chosen, view, change } = given;
  const groups = useMemo(() => byPlanner(sweep, chosen), [sweep, chosen]);
  const props: Props = { ...given, groups };
  const usual = sweep.usual_metrics;
  // The same elements whatever the filters: thousands of cells that need not be compared.
  const tables = useMemo(() => sweep.tables.map((table) => <Report table={table} />), [sweep]);
  const others = useMemo(() => sweep.metrics.map((m) => m.name).filter((name) => !usual.includes(name)), [sweep]);
  // Where a limit is looked for the trials are not a sample of the range.
  const isMixed = sweep.limit !== null && !view.filters[sweep.limit.field]?.length;
  if (chosen.length === 0)
    return (
      <p class="empty">
        No trial fits these filters. <button onClick={() => change({ filters: {}, search: "" })}>Show all</button>
      </p>
    );
  return (
    <>
      <section class="charts" aria-label="Charts">
        <Limits {...props} />
        {isMixed ? null : <Speeds {...props} />}
        {isMixed ? null : <Success {...props} />}
        <Outcomes {...props} />
        {isMixed ? null : <Difficulty {...props} />}
        <Reasons {...props} />
        {isMixed ? null : <Arrivals {...props} />}
        <Contrasts {...props} />
        <Scatter {...props} />
      </section>
      {isMixed ? (
        <p class="note">
          Most trials are near the limits, at different values for each planner: rates and metrics over all of them
          would mean nothing. Choose a value of {sweep.limit!.field} to see them.
        </p>
      ) : (
        <section aria-label="Metrics">
          <h2>Metrics</h2>
          <p class="note">Boxes are quartiles with the median, lines go from 5 to 95 %, the sign is the mean.</p>
          <div class="charts small">
            {usual.map((name) => (
              <MetricChart {...props} name={name} />
            ))}
            {view.metric && others.includes(view.metric) ? <MetricChart {...props} name={view.metric} /> : null}
          </div>
          {others.length ? (
            <label class="more">
              Another metric{" "}
              <select value={view.metric} onChange={(e) => change({ metric: e.currentTarget.value })}>
                <option value="">–</option>
                {others.map((name) => (
                  <option value={name}>{name}</option>
                ))}
              </select>
            </label>
          ) : null}
        </section>
      )}
      <section class="charts" aria-label="Maps">
        <Grid {...props} />
      </section>
      <section class="tables" aria-label="Tables of the report">
        <h2>Tables of the report</h2>
        <p class="note">
          Of all {sweep.t.count} trials, regardless of the filters; <code>report --format json</code> has the same
          numbers. Hover over a number for all its digits, over a heading for its meaning.
        </p>
        {tables}
      </section>
    </>
  );
}
