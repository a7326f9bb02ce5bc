// What is shown: kept in the link after #, so that a link shows the same to everyone.
import type { Sweep } from "./data";

export interface View {
  tab: string;
  sweep: number;
  /** Chosen values of each filter: planner, map, outcome by index, axis fields by word; none: all. */
  filters: Record<string, string[]>;
  search: string;
  sort: string;
  down: boolean;
  trial: string;
  time: number | null;
  camera: string;
  color: string;
  theme: string;
  metric: string;
  /** Of the scatter chart, by their ids. */
  x: string;
  y: string;
}

export const kUsualView: View = {
  tab: "overview",
  sweep: 0,
  filters: {},
  search: "",
  sort: "",
  down: false,
  trial: "",
  time: null,
  camera: "",
  color: "",
  theme: "",
  metric: "",
  x: "",
  y: "",
};

export function viewOfLink(link: string): View {
  const view: View = { ...kUsualView, filters: {} };
  const words = new URLSearchParams(link.replace(/^#/, ""));
  for (const [name, value] of words) {
    if (name === "tab")
      view.tab = ["overview", "trials", "sweeps", "replay", "about"].includes(value) ? value : "overview";
    else if (name === "sweep") view.sweep = Number(value) || 0;
    else if (name === "q") view.search = value;
    else if (name === "sort") view.sort = value;
    else if (name === "down") view.down = value === "1";
    else if (name === "trial") view.trial = value;
    else if (name === "t") view.time = Number.isFinite(Number(value)) ? Number(value) : null;
    else if (name === "camera") view.camera = value;
    else if (name === "color") view.color = value;
    else if (name === "theme") view.theme = value === "dark" || value === "light" ? value : "";
    else if (name === "metric" || name === "x" || name === "y") view[name] = value;
    else if (name.startsWith("f.")) view.filters[name.slice(2)] = value.split("|").map(decodeURIComponent);
  }
  return view;
}

export function linkOfView(view: View): string {
  const words = new URLSearchParams();
  const put = (name: string, value: string, usual = ""): void => {
    if (value !== usual) words.set(name, value);
  };
  put("tab", view.tab, "overview");
  put("sweep", String(view.sweep), "0");
  for (const [name, values] of Object.entries(view.filters)) {
    if (values.length) words.set(`f.${name}`, values.map(encodeURIComponent).join("|"));
  }
  put("q", view.search);
  put("sort", view.sort);
  put("down", view.down ? "1" : "");
  for (const name of ["metric", "x", "y"] as const) put(name, view[name]);
  put("theme", view.theme);
  put("trial", view.trial);
  if (view.trial && view.time !== null) words.set("t", view.time.toFixed(2));
  put("camera", view.camera);
  put("color", view.color);
  return words.toString();
}

/** What a filter can choose: its values, and of each trial the index of its own. */
export interface Facet {
  name: string;
  title: string;
  values: string[];
  of: Float64Array;
}

export function facetsOf(sweep: Sweep): Facet[] {
  const all: Facet[] = [
    { name: "planner", title: "Planner", values: sweep.planners.map((p) => p.label), of: sweep.t.planner },
    { name: "outcome", title: "Outcome", values: sweep.outcomes, of: sweep.t.outcome },
    { name: "map", title: "Map", values: sweep.maps.map((m) => m.text), of: sweep.t.map },
  ];
  // One value of the same name would be two: the words are told apart by their place.
  for (const axis of sweep.t.axes) {
    all.push({
      name: axis.field,
      title: axis.field,
      of: axis.of,
      values: axis.words.map((word) =>
        word === null ? "(none)" : typeof word === "number" ? String(Number(word.toPrecision(6))) : word,
      ),
    });
  }
  return all.filter((f) => f.values.length > 0);
}

export const facetId = (facet: Facet, index: number): string =>
  facet.name === "planner" || facet.name === "outcome" || facet.name === "map" ? String(index) : facet.values[index];

/** Indices of the trials that every filter and the search lets through. */
export function chosenTrials(sweep: Sweep, facets: Facet[], view: View): Int32Array {
  const n = sweep.t.count;
  const keeps: { of: Float64Array; keep: boolean[] }[] = [];
  for (const facet of facets) {
    const chosen = view.filters[facet.name];
    if (!chosen?.length) continue;
    const set = new Set(chosen);
    keeps.push({ of: facet.of, keep: facet.values.map((_, i) => set.has(facetId(facet, i))) });
  }
  const fits = searchOf(sweep, view.search);
  const chosen = new Int32Array(n);
  let count = 0;
  for (let i = 0; i < n; ++i) {
    if (keeps.every((k) => k.keep[k.of[i]]) && (!fits || fits(i))) chosen[count++] = i;
  }
  return chosen.slice(0, count);
}

/** Whether a trial has all words of the search; null where there are none. */
function searchOf(sweep: Sweep, search: string): ((trial: number) => boolean) | null {
  const words = search.trim().toLowerCase().split(/\s+/).filter(Boolean);
  if (!words.length) return null;
  const t = sweep.t;
  const low = (all: string[]): string[] => all.map((word) => word.toLowerCase());
  const planners = low(sweep.planners.map((p) => p.label));
  const maps = low(sweep.maps.map((m) => m.text));
  const outcomes = low(sweep.outcomes.map((o) => o.replaceAll("_", " ")));
  const reasons = low(t.reason.words.map(String));
  return (i) =>
    words.every(
      (word) =>
        String(t.id[i]) === word ||
        planners[t.planner[i]].includes(word) ||
        maps[t.map[i]].includes(word) ||
        outcomes[t.outcome[i]].includes(word) ||
        reasons[t.reason.of[i]].includes(word) ||
        t.key[i].startsWith(word),
    );
}
