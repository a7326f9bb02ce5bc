// The page's data: what lib/results/page writes into <script id="data">, and its trials as columns.
import { deltasOf, floatsOf, Unpacked } from "./packed";

export type Vector = [number, number, number];
export type Cell = number | string | null;

export interface ReportColumn {
  name: string;
  header: string;
  unit: string;
  doc: string;
  place: string;
  decimals: number;
}
export interface ReportTable {
  name: string;
  title: string;
  columns: ReportColumn[];
  rows: { cells: Cell[]; best: number[] }[];
}
export interface Metric {
  name: string;
  unit: string;
  doc: string;
  formula: string;
  better: "less" | "more" | "neither";
  population: string;
  is_measured: boolean;
}
interface Dictionary {
  words: Cell[];
  index: string;
}
interface PackedTrials {
  count: number;
  planner: string;
  map: string;
  mission: string;
  outcome: string;
  id: string;
  key: string;
  end_s: string;
  reason: Dictionary;
  cause?: Dictionary;
  metrics: string[];
  axes: (Dictionary & { field: string })[];
}
export interface Planner {
  label: string;
  name: string;
  version: string;
  digest: string;
  parameters: unknown;
  is_privileged: boolean;
}
export interface MapEntry {
  text: string;
  traversability: number | null;
  digest: string;
}
export interface Curve {
  planner: number;
  intercept: number | null;
  slope: number | null;
}
export interface Run {
  date: string;
  program: string;
  git: string;
  compiler: string;
  command: string;
}
/** What `avoidbench limit` varies: an axis of the trials, and the rate of success that is crossed. */
export interface LimitRule {
  field: string;
  unit: string;
  low: number;
  high: number;
  success_rate: number;
}
export interface SweepData {
  name: string;
  revision: number;
  title: string;
  warnings: string[];
  conditions: string[];
  tables: ReportTable[];
  limit: LimitRule | null;
  curves: Curve[];
  planners: Planner[];
  maps: MapEntry[];
  metrics: Metric[];
  usual_metrics: string[];
  outcomes: string[];
  runs: Run[];
  trials: PackedTrials;
}
export interface Touch {
  t: number;
  obstacle: number;
}
export interface FlightHead {
  id?: number;
  /** In a comparison: of a failure, and of the metrics that are compared. */
  cause?: string;
  metrics?: [string, number | null][];
  key: string;
  planner: string;
  outcome: string;
  reason: string;
  end_s: number | null;
}
export interface FlightData {
  n: number;
  reference: boolean;
  data: string;
  touches: Touch[];
  status: [number, number][];
  sweep?: number;
  trial?: number;
  /** In a comparison. */
  pair?: number;
  side?: "base" | "new";
  /** What explain knows of a failure, by the names that it gives; no page has it so far. */
  facts?: Record<string, number | null>;
  explanation?: string;
  world: number | null;
  rig: number;
  goal_radius: number;
  start: Vector;
  goal: Vector;
  waypoints?: Vector[]; // goals to reach in order before this one
  head?: FlightHead;
}
export interface MissionData {
  index: number;
  start: Vector;
  goal: Vector;
  waypoints?: Vector[];
}
/** In the order in which they are to be reached. */
export function goalsOf(mission: { goal: Vector; waypoints?: Vector[] }): Vector[] {
  return [...(mission.waypoints ?? []), mission.goal];
}
/** How something moves: a function of time alone. Knots are [ms, mm, mm, mm, mrad]. */
export type PathData =
  | { kind: "sway"; amplitude: Vector; period: number; phase: number }
  | { kind: "route"; knots: [number, number, number, number, number][] }
  | { kind: "trefoil"; reach: number; rise: number; period: number; phase: number; heading: number };
export interface WorldData {
  prototypes: number;
  instances: number;
  kinds: string[];
  data: string;
  triangles: number;
  motions: ({ instance: number } & PathData)[];
  bounds: [Vector, Vector];
  flight_bounds: [Vector, Vector];
}
export interface MeshData {
  vertices: number;
  triangles: number;
  data: string;
}
export interface PoseData {
  position: Vector;
  q: [number, number, number, number];
}
export interface CameraData {
  pose: PoseData;
  fov_x_deg: number;
  width: number;
  height: number;
  min_m: number;
  max_m: number;
}
export interface Rig {
  body: Vector;
  cameras: CameraData[];
}
export interface SeenImage {
  kind: "depth" | "grey" | "color";
  t: number;
  camera: number;
  width: number;
  height: number;
  skip: number;
  channels: number;
  data: string;
  pose: PoseData;
}
export interface DrawingData {
  kind: "points" | "line" | "segments" | "text";
  color: number;
  label: string;
  n: number;
  data: string;
}
export interface Seen {
  images: SeenImage[];
  drawings: { t: number; drawings: DrawingData[] }[];
  log: { t: number; text: string }[];
  calls: { n: number; t: string; speed: string; acceleration: string; thrust: string; status: string; cpu_ms: string };
}
/** A result of a suite. */
export interface BoardResult {
  label: string;
  name: string;
  version: string;
  digest: string;
  is_privileged: boolean;
  settings: string;
  licence: string;
  source: string;
  tuned_on: string;
  program: string;
  failures: [string, number][];
  /** Of S(v): speed, share down to the step before. */
  curve: [number, number][];
  links: Record<"flights" | "report" | "causes" | "trials" | "planner", string | null>;
}
/** The results of one track and split. */
export interface BoardData {
  title: string;
  tables: ReportTable[];
  results: BoardResult[];
}
/** Of the run that makes a sweep's page. */
export interface RunData {
  state: "running" | "complete" | "interrupted";
  total: number;
  done: number;
  /** The total is not known. */
  is_open: boolean;
  left_s?: number | null;
  /** Since 1970, and how often the page is written. */
  written_s?: number;
  every_s?: number;
}
/** A metric of a planner over the pairs of trials, as `compare --format json` has it. */
export interface MetricChange {
  planner: string;
  metric: string;
  unit: string;
  better: "less" | "more" | "neither";
  is_measured: boolean;
  pair_count: number;
  base_mean: number | null;
  new_mean: number | null;
  change: number | null;
  change_lower: number | null;
  change_upper: number | null;
  limit: number | null;
  adjusted_p: number | null;
  verdict: "regression" | "improvement" | "small" | "unclear" | "same" | "not_gated";
}
export interface ComparisonData {
  base: string;
  new: string;
  base_sweep: string;
  new_sweep: string;
  title: string;
  warnings: string[];
  planners: { planner: string; pair_count: number; only_base_count: number; only_new_count: number }[];
  metrics: MetricChange[];
  tables: ReportTable[];
  /** Abbreviations and what they stand for. */
  notes: [string, string][];
  /** The sides that are tables of trials, which have no flights. */
  no_flights: ("base" | "new")[];
}
/** Trials that both sides of a comparison have. */
export interface PairsData {
  planners: string[];
  maps: string[];
  outcomes: string[];
  /** Planner, map, mission, outcome before and after: indices but for the mission. */
  rows: [number, number, number, number, number][];
}
export interface PageData {
  format: number;
  kind: "sweep" | "flight" | "map" | "board" | "comparison";
  title: string;
  program: { version: string; git: string; compiler: string };
  command: string;
  sweeps?: SweepData[];
  /** The planners of several sweeps in one table. */
  side_by_side?: ReportTable;
  run?: RunData;
  comparison?: ComparisonData;
  pairs?: PairsData;
  boards?: BoardData[];
  flights: FlightData[];
  flights_left_out?: number;
  worlds: WorldData[];
  meshes: MeshData[];
  rigs: Rig[];
  scene_warnings: string[];
  seen?: Seen;
  missions?: MissionData[];
  goal_radius?: number;
  digest?: string;
  world_digest?: string;
  planner_digest?: string;
}

export interface Words {
  words: Cell[];
  of: Float64Array;
}
export interface Axis extends Words {
  field: string;
}

/** The trials of a sweep, a column each. */
export interface Trials {
  count: number;
  planner: Float64Array;
  map: Float64Array;
  mission: Float64Array;
  outcome: Float64Array;
  id: Float64Array;
  key: string[];
  end_s: Float32Array;
  reason: Words;
  cause: Words | null;
  metrics: Float32Array[];
  axes: Axis[];
  /** Index into PageData.flights, -1 where the flight is not in this page. */
  flight: Int32Array;
}

export interface Sweep extends Omit<SweepData, "trials"> {
  index: number;
  t: Trials;
}

export function readPage(): PageData {
  const element = document.getElementById("data");
  if (!element?.textContent) throw new Error("this page has no data");
  const page = JSON.parse(element.textContent) as PageData;
  if (page.format !== 1) throw new Error(`this page has data of format ${String(page.format)}`);
  return page;
}

export function readSweep(page: PageData, index: number): Sweep {
  const { trials: p, ...rest } = page.sweeps![index];
  const n = p.count;
  const bytes = new Unpacked(p.key).raw(6 * n);
  const key: string[] = [];
  for (let i = 0; i < n; ++i) {
    let digits = "";
    for (let k = 0; k < 6; ++k) digits += bytes[6 * i + k].toString(16).padStart(2, "0");
    key.push(digits);
  }
  const words = (d: Dictionary): Words => ({ words: d.words, of: deltasOf(d.index, n) });
  const flight = new Int32Array(n).fill(-1);
  page.flights.forEach((f, i) => {
    if (f.sweep === index && f.trial !== undefined) flight[f.trial] = i;
  });
  const t: Trials = {
    count: n,
    planner: deltasOf(p.planner, n),
    map: deltasOf(p.map, n),
    mission: deltasOf(p.mission, n),
    outcome: deltasOf(p.outcome, n),
    id: deltasOf(p.id, n),
    key,
    end_s: floatsOf(p.end_s, n),
    reason: words(p.reason),
    cause: p.cause ? words(p.cause) : null,
    metrics: p.metrics.map((m) => floatsOf(m, n)),
    axes: p.axes.map((a) => ({ field: a.field, ...words(a) })),
    flight,
  };
  return { ...rest, index, t };
}

export const isFinished = (t: Trials, i: number): boolean => t.outcome[i] === 0;
export const outcomeText = (word: string): string => word.replaceAll("_", " ");

// Okabe and Ito (2008), for colour-blind people, as in scripts/plot/style.py. Seven, and six signs: none recurs before the 43rd planner.
const kPlannerColors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];
// The same hues, as bright as a dark ground needs them.
const kBrightColors = ["#51a5e7", "#fb8b49", "#32cea0", "#e99cc9", "#ffcc54", "#9adcff", "#f4f4f4"];
export const kDashes = ["", "6 3", "2 3", "8 3 2 3", "1 3", "10 4", "4 2 1 2", "3 5"];
/** As a variable of the style, whose value showTheme() sets: charts need not be drawn again. */
export const plannerColor = (i: number): string => `var(--planner-${i % kPlannerColors.length})`;
export type Theme = "light" | "dark";
export const plannerHex = (i: number, theme: Theme): string =>
  (theme === "dark" ? kBrightColors : kPlannerColors)[i % kPlannerColors.length];
export const currentTheme = (): Theme => (document.documentElement.dataset.theme === "dark" ? "dark" : "light");
export function showTheme(theme: Theme): void {
  const root = document.documentElement;
  root.dataset.theme = theme;
  for (const i of kPlannerColors.keys()) root.style.setProperty(`--planner-${i}`, plannerHex(i, theme));
}
// None is like a planner's on either ground, as tests/page/check_colors.py counts likeness.
const kOutcomeColors = ["#9eb97d", "#b60121", "#6b43bd", "#a2804a", "#607978", "#766237", "#8b3179", "#415855"];
export const outcomeColor = (i: number): string => kOutcomeColors[i % kOutcomeColors.length];

/** How a planner is drawn, and its name. */
export interface Look {
  label: string;
  color: string;
  shape: number;
  dash: string;
}
export const lookOf = (planner: number, label: string): Look => ({
  label,
  color: plannerColor(planner),
  shape: planner,
  dash: kDashes[planner % kDashes.length],
});

/** So many significant digits, without an exponent for usual sizes. */
export function digits(value: number | null | undefined, count = 3): string {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const text =
    Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4
      ? value.toExponential(count - 1)
      : Math.abs(value) >= 10 ** count
        ? Math.round(value).toString()
        : value.toPrecision(count);
  return text.replace("-", "−");
}

/** Metric name without its unit, in words. */
export function metricWords(name: string): string {
  return name.replace(/_(pct|ratio|mps2|mps|ms|1pm|m|s|j)$/, "").replaceAll("_", " ");
}

/** "3.5 m/s" */
export const limitValue = (rule: LimitRule, value: Cell): string =>
  `${typeof value === "number" ? digits(value, 4) : String(value)}${rule.unit ? ` ${rule.unit}` : ""}`;
export const percent = (v: number): string => `${digits(100 * v, 3)} %`;
