// The page of a comparison: what changed by how much, what became of every mission, and both flights of one in the same scene.
import type { JSX } from "preact";
import { useMemo } from "preact/hooks";
import { About } from "./about";
import { Legend, Swatch } from "./chart";
import type { Mark } from "./charts";
import { BarChart, IntervalChart } from "./charts";
import type { FlightData, MetricChange, PageData } from "./data";
import { digits, goalsOf, lookOf, metricWords, outcomeColor, outcomeText, percent } from "./data";
import { Figure, ScrollTable } from "./figure";
import type { Shown } from "./frame";
import { Frame, usedTheme } from "./frame";
import type { Entry, Neighbours, Scene } from "./replay";
import { Replay } from "./replay";
import { Report } from "./report";
import type { View } from "./state";

const kFates = ["lost", "won", "failed otherwise", "failed alike", "finished"] as const;
type Fate = (typeof kFates)[number];
const kFateNotes: Record<Fate, string> = {
  lost: "only the base reached the goal",
  won: "only the new results reached it",
  "failed otherwise": "both failed, in different ways",
  "failed alike": "both failed in the same way",
  finished: "both reached the goal",
};
/** Of outcomes, as none is like a planner's. */
const fateColor = (fate: Fate): string => outcomeColor([1, 2, 3, 4, 0][kFates.indexOf(fate)]);
const kMostRows = 500;

interface Pair {
  index: number;
  planner: number;
  map: string;
  mission: number;
  before: string;
  after: string;
  fate: Fate;
  base: FlightData | null;
  now: FlightData | null;
}

function fateOf(before: string, after: string): Fate {
  const [was, is] = [before, after].map((outcome) => outcome === "reached_goal");
  if (was !== is) return is ? "won" : "lost";
  if (is) return "finished";
  return before === after ? "failed alike" : "failed otherwise";
}

function pairsOf(page: PageData): Pair[] {
  const { rows, maps, outcomes } = page.pairs!;
  const pairs = rows.map(([planner, map, mission, before, after], index): Pair => {
    const [was, is] = [outcomes[before], outcomes[after]];
    const fate = fateOf(was, is);
    return { index, planner, map: maps[map], mission, before: was, after: is, fate, base: null, now: null };
  });
  for (const flight of page.flights) {
    if (flight.side === "base") pairs[flight.pair!].base = flight;
    else pairs[flight.pair!].now = flight;
  }
  return pairs;
}

// ---- What changed.

const isShare = (row: MetricChange): boolean => row.metric === "success_rate";
const signed = (value: number | null): string =>
  value === null ? "–" : `${value > 0 ? "+" : ""}${digits(value === 0 ? 0 : value)}`;
/** In the metric's unit; rates in percent, and their changes in points. */
const valueText = (row: MetricChange, value: number | null): string =>
  value === null ? "–" : isShare(row) ? percent(value) : digits(value, 4) + (row.unit ? ` ${row.unit}` : "");
function changeText(row: MetricChange): string {
  const by = isShare(row) ? 100 : 1;
  const scaled = (value: number | null): number | null => (value === null ? null : by * value);
  const unit = isShare(row) ? "points" : row.unit;
  const ends = [row.change_lower, row.change_upper].map((end) => signed(scaled(end)));
  const interval = ends.every((end) => end === "–") ? "" : ` [${ends.join(", ")}]`;
  return `${signed(scaled(row.change))}${interval}${unit ? ` ${unit}` : ""}`;
}
const kVerdicts: [MetricChange["verdict"], string][] = [
  ["regression", "worse"],
  ["improvement", "better"],
  ["unclear", "unclear: beyond the tolerance, but it may be chance"],
  ["small", "surely different, but within the tolerance"],
];
const verdictText = (row: MetricChange): string =>
  kVerdicts.find(([v]) => v === row.verdict)?.[1].split(":")[0] ?? row.verdict.replaceAll("_", " ");

function Verdicts({ rows }: { rows: MetricChange[] }): JSX.Element {
  const groups = kVerdicts
    .map(([verdict, text]) => ({ verdict, text, rows: rows.filter((row) => row.verdict === verdict) }))
    .filter((group) => group.rows.length);
  if (!groups.length) return <p class="verdicts">No planner changed in any metric by more than its tolerance.</p>;
  return (
    <dl class="verdicts" aria-label="Verdicts">
      {groups.map((group) => (
        <>
          <dt class={group.verdict}>{group.text}</dt>
          {group.rows.map((row) => (
            <dd>
              <b>{row.planner}</b> {metricWords(row.metric)}: {valueText(row, row.base_mean)} →{" "}
              {valueText(row, row.new_mean)}, {changeText(row)}
            </dd>
          ))}
        </>
      ))}
    </dl>
  );
}

/** A metric's changes, a planner each, about no change. */
function ChangeChart({ rows, looks }: { rows: MetricChange[]; looks: Map<string, number> }): JSX.Element | null {
  const first = rows[0];
  const share = isShare(first);
  const value = (v: number | null): number => v ?? NaN;
  const marks: Mark[] = rows.map((row) => ({
    ...lookOf(looks.get(row.planner) ?? 0, row.planner),
    value: value(row.change),
    // Of too few maps one end may be unknown.
    lower: value(row.change_lower ?? (row.change_upper === null ? null : row.change)),
    upper: value(row.change_upper ?? (row.change_lower === null ? null : row.change)),
    band: row.limit === null ? undefined : [-row.limit, row.limit],
    text: row.change === null ? "–" : share ? `${signed(100 * row.change)} %` : signed(row.change),
    note: row.change === null ? "no mission that both finished" : undefined,
    tip: `${row.planner}: ${valueText(row, row.base_mean)} → ${valueText(row, row.new_mean)}, ${changeText(row)}; ${verdictText(row)}; ${row.pair_count} pairs`,
  }));
  const ends = marks.flatMap((m) => [m.value, m.lower, m.upper, ...(m.band ?? [])]).filter(Number.isFinite);
  const reach = 1.05 * Math.max(...ends.map(Math.abs), 1e-9);
  const title = metricWords(first.metric);
  const isCut = rows.some((row) => (row.change_lower === null) !== (row.change_upper === null));
  const notes = [
    "New less base",
    first.better === "neither" ? "" : `${first.better} is better`,
    "grey: within the tolerance",
    isCut ? "an interval that ends at its sign: so few maps leave that end unknown" : "",
    first.is_measured ? "measured on the host" : "",
  ];
  return (
    <Figure
      name={`change ${first.metric}`}
      title={title}
      note={`${notes.filter(Boolean).join("; ")}.`}
      numbers={{
        head: ["planner", "pairs", "base", "new", "change", "lower", "upper", "p", "verdict"],
        rows: rows.map((row) => [
          row.planner,
          row.pair_count,
          row.base_mean,
          row.new_mean,
          row.change,
          row.change_lower,
          row.change_upper,
          row.adjusted_p,
          verdictText(row),
        ]),
      }}
    >
      <IntervalChart
        marks={marks}
        values={{ low: -reach, high: reach, percent: share, origin: 0, unit: share ? undefined : first.unit }}
        label={`Change of ${title} by planner: ${marks.map((m) => m.tip).join("; ")}`}
      />
    </Figure>
  );
}

function Fates({ page, pairs }: { page: PageData; pairs: Pair[] }): JSX.Element {
  const { planners } = page.pairs!;
  const counts = planners.map((_, p) =>
    kFates.map((fate) => pairs.filter((pair) => pair.planner === p && pair.fate === fate).length),
  );
  return (
    <Figure
      name="fates"
      wide
      title="Missions lost and won"
      note={`Of the missions that both sides flew. ${kFates.map((fate) => `${fate}: ${kFateNotes[fate]}`).join("; ")}.`}
      numbers={{ head: ["planner", ...kFates], rows: planners.map((planner, p) => [planner, ...counts[p]]) }}
    >
      <Legend items={kFates.map((fate) => ({ label: fate, color: fateColor(fate) }))} />
      <BarChart
        share
        label="What became of missions, by planner; their numbers are in the table below"
        bars={planners.map((planner, p) => ({
          label: planner,
          parts: kFates.map((fate, i) => ({ name: fate, color: fateColor(fate), count: counts[p][i] })),
        }))}
      />
    </Figure>
  );
}

function Summary({ page, pairs, show }: { page: PageData; pairs: Pair[]; show: () => void }): JSX.Element {
  const found = page.comparison!;
  const looks = new Map(found.planners.map((p, i): [string, number] => [p.planner, i]));
  const metrics = [...new Set(found.metrics.map((row) => row.metric))];
  const changed = pairs.filter((p) => p.before !== p.after).length;
  return (
    <>
      {found.warnings.length ? (
        <ul class="warnings">
          {found.warnings.map((w) => (
            <li>{w}</li>
          ))}
        </ul>
      ) : null}
      <Verdicts rows={found.metrics} />
      <section class="charts" aria-label="Charts">
        <Fates page={page} pairs={pairs} />
      </section>
      <p class="more">
        <button type="button" onClick={show}>
          {changed === 0
            ? "All missions"
            : `The ${changed === 1 ? "mission" : `${changed} missions`} with another outcome`}
        </button>
      </p>
      <section class="charts" aria-label="Changes of metrics">
        {metrics.map((metric) => (
          <ChangeChart rows={found.metrics.filter((row) => row.metric === metric)} looks={looks} />
        ))}
      </section>
      <section class="tables" aria-label="Tables of the comparison">
        <h2>Tables of the comparison</h2>
        {found.tables.map((table) => (
          <Report table={table} open={table.name === "metrics"} />
        ))}
        <p class="note">{found.notes.map(([sign, meaning]) => `${sign}: ${meaning}`).join("; ")}</p>
      </section>
    </>
  );
}

// ---- The missions.

function chosenPairs(page: PageData, pairs: Pair[], view: View): Pair[] {
  const fates = view.filters.fate ?? [];
  const planner = view.filters.planner?.[0];
  const words = view.search.trim().toLowerCase().split(/\s+/).filter(Boolean);
  return pairs.filter((p) => {
    if (fates.length && !fates.includes(p.fate)) return false;
    if (planner !== undefined && String(p.planner) !== planner) return false;
    const name = page.pairs!.planners[p.planner];
    const text = `${name} ${p.map} mission ${p.mission} ${outcomeText(p.before)} ${outcomeText(p.after)}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
}

function PairFilters(props: Shown & { pairs: Pair[]; count: number }): JSX.Element {
  const { page, view, change, pairs } = props;
  const set = (name: string, values: string[]): void => {
    const filters = { ...view.filters };
    if (values.length) filters[name] = values;
    else delete filters[name];
    change({ filters });
  };
  const fates = view.filters.fate ?? [];
  return (
    <form class="filters" aria-label="Filters" onSubmit={(e) => e.preventDefault()}>
      <fieldset>
        <legend>Became</legend>
        {kFates.map((fate) => {
          const count = pairs.filter((p) => p.fate === fate).length;
          const other = fates.includes(fate) ? fates.filter((f) => f !== fate) : [...fates, fate];
          return count === 0 ? null : (
            <button
              type="button"
              class="chip"
              title={kFateNotes[fate]}
              aria-pressed={fates.includes(fate)}
              onClick={() => set("fate", other)}
            >
              <Swatch color={fateColor(fate)} />
              {fate} {count}
            </button>
          );
        })}
      </fieldset>
      <div class="selects">
        {page.pairs!.planners.length > 1 ? (
          <label>
            Planner{" "}
            <select
              value={view.filters.planner?.[0] ?? ""}
              onChange={(e) => set("planner", e.currentTarget.value === "" ? [] : [e.currentTarget.value])}
            >
              <option value="">all</option>
              {page.pairs!.planners.map((planner, i) => (
                <option value={String(i)}>{planner}</option>
              ))}
            </select>
          </label>
        ) : null}
        <label>
          Search{" "}
          <input
            type="search"
            value={view.search}
            placeholder="planner, map, outcome …"
            onInput={(e) => change({ search: e.currentTarget.value })}
          />
        </label>
        <span class="shown" aria-live="polite">
          {props.count} of {pairs.length} missions
        </span>
      </div>
    </form>
  );
}

/** Why there is no path to see. */
function NoFlights({ page }: { page: PageData }): JSX.Element | null {
  const sides = page.comparison!.no_flights;
  if (!sides.length) return null;
  return (
    <p class="note no-flights">
      {sides.length === 2
        ? "There is no 3-D view: both sides are tables of trials, which have no flights. Compare the databases to see them."
        : `The ${sides[0] === "base" ? "base is" : "new results are"} a table of trials, which has no flights: only those of the other side are shown.`}
    </p>
  );
}

const hasFlight = (p: Pair): boolean => p.base !== null || p.now !== null;

function Outcome({ page, word }: { page: PageData; word: string }): JSX.Element {
  return (
    <span class="with-sign">
      <Swatch color={outcomeColor(page.pairs!.outcomes.indexOf(word))} />
      {outcomeText(word)}
    </span>
  );
}

function Missions(props: Shown & { pairs: Pair[]; chosen: Pair[]; open: (pair: Pair) => void }): JSX.Element {
  const { page, chosen, open } = props;
  const { planners } = page.pairs!;
  const head = ["planner", "base", "new", "map", "mission", "became"];
  return (
    <>
      <PairFilters {...props} count={chosen.length} />
      <NoFlights page={page} />
      <ScrollTable
        label="Missions"
        class="pairs"
        head={["flights", ...head]}
        right={[false, false, false, false, false, true]}
        table={() => ({
          head,
          rows: chosen.map((p) => [planners[p.planner], p.before, p.after, p.map, p.mission, p.fate]),
        })}
      >
        {chosen.slice(0, kMostRows).map((p) => (
          <tr data-pair={p.index}>
            <td>
              {hasFlight(p) ? (
                <button type="button" onClick={() => open(p)}>
                  Watch
                </button>
              ) : (
                "–"
              )}
            </td>
            <td>{planners[p.planner]}</td>
            <td>
              <Outcome page={page} word={p.before} />
            </td>
            <td>
              <Outcome page={page} word={p.after} />
            </td>
            <td>{p.map}</td>
            <td class="number">{p.mission}</td>
            <td>{p.fate}</td>
          </tr>
        ))}
      </ScrollTable>
      {chosen.length > kMostRows ? (
        <p class="note">
          The first {kMostRows} of {chosen.length} missions; CSV has all.
        </p>
      ) : null}
    </>
  );
}

// ---- Both flights of a mission.

function entryOf(flight: FlightData, side: "base" | "new", isMain: boolean, other: FlightData | null): Entry {
  const head = flight.head!;
  const beside = new Map(other?.head?.metrics ?? []);
  return {
    ...lookOf(side === "base" ? 0 : 1, side),
    data: flight,
    isMain,
    outcome: head.outcome,
    reason: head.reason,
    cause: head.cause ?? "",
    id: head.key.slice(0, 8),
    key: head.key,
    facts: (head.metrics ?? []).map(([name, value]): [string, string] => {
      const before = beside.get(name);
      return [name.replaceAll("_", " "), digits(value) + (before == null ? "" : ` (base ${digits(before)})`)];
    }),
  };
}

function sceneOfPair(page: PageData, pair: Pair): Scene | null {
  const main = pair.now ?? pair.base;
  if (!main) return null;
  const entries: Entry[] = [];
  if (pair.now) entries.push(entryOf(pair.now, "new", true, pair.base));
  if (pair.base) entries.push(entryOf(pair.base, "base", !pair.now, null));
  const apart = pair.base && pair.now && pair.base.world !== pair.now.world;
  return {
    title: `${page.pairs!.planners[pair.planner]}, ${pair.map}, mission ${pair.mission}: ${outcomeText(pair.before)} → ${outcomeText(pair.after)}${apart ? " (they flew on different maps; the new one is shown)" : ""}`,
    world: main.world,
    start: main.start,
    goals: goalsOf(main),
    goalRadius: main.goal_radius,
    entries,
    seen: null,
    missions: [],
  };
}

function neighboursOf(chosen: Pair[], at: Pair, open: (pair: Pair) => void): Neighbours {
  const flown = chosen.filter(hasFlight);
  const place = flown.indexOf(at);
  const step = (to: number): (() => void) | null => (flown[to] ? () => open(flown[to]) : null);
  return {
    text: place < 0 ? `${flown.length} missions` : `${place + 1} of ${flown.length}`,
    next: step(place + 1),
    previous: step(place - 1),
  };
}

export function ComparisonPage({ page, view, change }: Shown): JSX.Element {
  const found = page.comparison!;
  const pairs = useMemo(() => pairsOf(page), [page]);
  const chosen = useMemo(() => chosenPairs(page, pairs, view), [pairs, view.filters, view.search]);
  const pair = view.trial === "" ? undefined : pairs[Number(view.trial)];
  const scene = useMemo(() => (pair ? sceneOfPair(page, pair) : null), [page, pair]);
  const open = (p: Pair): void => change({ tab: "replay", trial: String(p.index), time: null });
  const tab = view.tab === "replay" && !scene ? "trials" : view.tab;
  const show = (): void => {
    const isChanged = pairs.some((p) => p.before !== p.after);
    const filters: Record<string, string[]> = isChanged ? { fate: kFates.slice(0, 3) } : {};
    change({ tab: "trials", filters });
  };
  return (
    <Frame
      page={page}
      view={{ ...view, tab }}
      change={change}
      title="Comparison"
      subtitle={found.title}
      tabs={[
        ["overview", "Summary"],
        ["trials", "Missions"],
        ...(scene ? [["replay", "Flights"] as [string, string]] : []),
        ["about", "About"],
      ]}
    >
      {tab === "overview" ? <Summary page={page} pairs={pairs} show={show} /> : null}
      {tab === "trials" ? (
        <Missions page={page} view={view} change={change} pairs={pairs} chosen={chosen} open={open} />
      ) : null}
      {tab === "about" ? <About page={page} sweep={null} /> : null}
      {tab === "replay" && scene && pair ? (
        <Replay
          page={page}
          view={view}
          change={change}
          scene={scene}
          theme={usedTheme(view)}
          close={() => change({ tab: "trials" })}
          list="Missions"
          neighbours={neighboursOf(chosen, pair, open)}
        />
      ) : null}
    </Frame>
  );
}
