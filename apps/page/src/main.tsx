// The page: reads its data, keeps what is shown in the link, shows it.

import type { ComponentChildren, JSX } from "preact";
import { Component, render } from "preact";
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { About } from "./about";
import { Board } from "./board";
import { Planners, Swatch } from "./chart";
import { ComparisonPage } from "./comparison";
import type { FlightData, PageData, Sweep } from "./data";
import {
  digits,
  goalsOf,
  limitValue,
  lookOf,
  outcomeColor,
  outcomeText,
  plannerColor,
  readPage,
  readSweep,
  showTheme,
} from "./data";
import type { Shown } from "./frame";
import { Frame, usedTheme } from "./frame";
import { Overview } from "./overview";
import { watchPaper } from "./paper";
import type { Entry, Neighbours, Scene } from "./replay";
import { Replay } from "./replay";
import { Report } from "./report";
import type { Facet, View } from "./state";
import { chosenTrials, facetId, facetsOf, kUsualView, linkOfView, viewOfLink } from "./state";
import { TrialTable, useOrder } from "./trials";
import "./style.css";
import "./replay.css";
import "./paper.css";

/** The mission of a trial with all its flights that are in the page; null where its own is not. */
function sceneOfTrial(page: PageData, sweep: Sweep, trial: number): Scene | null {
  const t = sweep.t;
  const own = t.flight[trial];
  if (own < 0) return null;
  const beside: number[] = [];
  for (let i = 0; i < t.count; ++i) {
    // Axes that are no part of the map, as of sensors: only flights of the same.
    const isAlike = t.axes.every((a) => a.field.startsWith("planner") || a.of[i] === a.of[trial]);
    if (i !== trial && t.flight[i] >= 0 && t.map[i] === t.map[trial] && t.mission[i] === t.mission[trial] && isAlike)
      beside.push(i);
  }
  // Where a limit is looked for a planner flies a mission several times.
  const varied = sweep.limit && t.axes.find((a) => a.field === sweep.limit!.field);
  const label = (i: number): string =>
    sweep.planners[t.planner[i]].label + (varied ? ` at ${limitValue(sweep.limit!, varied.words[varied.of[i]])}` : "");
  const entry = (i: number): Entry => ({
    ...lookOf(t.planner[i], label(i)),
    data: page.flights[t.flight[i]],
    isMain: i === trial,
    outcome: sweep.outcomes[t.outcome[i]],
    reason: String(t.reason.words[t.reason.of[i]] ?? ""),
    cause: t.cause ? String(t.cause.words[t.cause.of[i]] ?? "") : "",
    id: t.id[i],
    key: t.key[i],
    facts: sweep.usual_metrics.map((name): [string, string] => {
      const m = sweep.metrics.findIndex((one) => one.name === name);
      return [name.replaceAll("_", " "), digits(t.metrics[m][i])];
    }),
  });
  const flight = page.flights[own];
  return {
    title: `${label(trial)}, ${sweep.maps[t.map[trial]].text}, mission ${t.mission[trial]}`,
    world: flight.world,
    start: flight.start,
    goals: goalsOf(flight),
    goalRadius: flight.goal_radius,
    entries: [trial, ...beside.sort((a, b) => t.planner[a] - t.planner[b])].map(entry),
    seen: null,
    missions: [],
  };
}

function neighboursOf(sweep: Sweep, order: Int32Array, trial: number, open: (trial: number) => void): Neighbours {
  const flown = order.filter((i) => sweep.t.flight[i] >= 0);
  const at = flown.indexOf(trial);
  // From a trial that the filters hide, the next one is their first.
  const step = (to: number): (() => void) | null => (to < 0 || to >= flown.length ? null : () => open(flown[to]));
  return {
    text: at < 0 ? `${flown.length} trials` : `${at + 1} of ${flown.length}`,
    next: step(at + 1),
    previous: step(at - 1),
  };
}

/** The one scene of a page of a flight or of a map. */
function sceneOfPage(page: PageData): Scene {
  const entry = (data: FlightData, i: number): Entry => {
    const head = data.head!;
    const twice = page.flights.some((f, k) => k < i && f.head!.planner === head.planner);
    return {
      ...lookOf(i, twice ? `${head.planner} (${head.id})` : head.planner),
      data,
      isMain: i === 0,
      outcome: head.outcome,
      reason: head.reason,
      cause: "",
      id: head.id ?? head.key,
      key: head.key,
      facts: [],
    };
  };
  const first = page.flights[0];
  const mission = page.missions?.[0];
  return {
    title: page.title,
    world: page.worlds.length ? 0 : null,
    start: first?.start ?? mission?.start ?? null,
    goals: first ? goalsOf(first) : mission ? goalsOf(mission) : [],
    goalRadius: first?.goal_radius ?? page.goal_radius ?? 0.8,
    entries: page.flights.map(entry),
    seen: page.seen ?? null,
    missions: page.missions ?? [],
  };
}

/** What the filters and the search let through, for paper. */
function wordsOf(facets: Facet[], view: View): string[] {
  const words = facets
    .filter((f) => view.filters[f.name]?.length)
    .map((f) => {
      const values = f.values.filter((_, i) => view.filters[f.name].includes(facetId(f, i)));
      return `${f.title.toLowerCase()} ${values.map(f.name === "outcome" ? outcomeText : String).join(" or ")}`;
    });
  return view.search ? [...words, `search “${view.search}”`] : words;
}

function Filters(props: {
  sweep: Sweep;
  facets: Facet[];
  view: View;
  count: number;
  change: (part: Partial<View>) => void;
}): JSX.Element {
  const { sweep, facets, view, change } = props;
  const set = (facet: Facet, values: string[]): void => {
    const filters = { ...view.filters };
    if (values.length) filters[facet.name] = values;
    else delete filters[facet.name];
    change({ filters });
  };
  const toggle = (facet: Facet, id: string): void => {
    const chosen = view.filters[facet.name] ?? [];
    set(facet, chosen.includes(id) ? chosen.filter((c) => c !== id) : [...chosen, id]);
  };
  const seen = new Set(sweep.t.outcome);
  const chosen = wordsOf(facets, view);
  const isFiltered = Object.keys(view.filters).length > 0 || view.search !== "";
  return (
    <form class="filters" aria-label="Filters" onSubmit={(e) => e.preventDefault()}>
      {facets
        .filter((f) => f.name === "planner" || f.name === "outcome")
        .map((facet) => (
          <fieldset>
            <legend>{facet.title}</legend>
            {facet.values.map((value, i) =>
              facet.name === "outcome" && !seen.has(i) ? null : (
                <button
                  type="button"
                  class="chip"
                  aria-pressed={(view.filters[facet.name] ?? []).includes(facetId(facet, i))}
                  onClick={() => toggle(facet, facetId(facet, i))}
                >
                  {facet.name === "planner" ? (
                    <Swatch shape={i} color={plannerColor(i)} />
                  ) : (
                    <Swatch color={outcomeColor(i)} />
                  )}
                  {facet.name === "outcome" ? outcomeText(value) : value}
                </button>
              ),
            )}
          </fieldset>
        ))}
      <div class="selects">
        {facets
          .filter((f) => f.name !== "planner" && f.name !== "outcome" && f.values.length > 1)
          .map((facet) => (
            <label>
              {facet.title}
              <select
                name={facet.name}
                value={view.filters[facet.name]?.[0] ?? ""}
                onChange={(e) => set(facet, e.currentTarget.value === "" ? [] : [e.currentTarget.value])}
              >
                <option value="">all</option>
                {facet.values
                  .map((value, i) => ({ value, i }))
                  .sort((a, b) =>
                    facet.name === "map"
                      ? a.i - b.i
                      : Number(a.value) - Number(b.value) || (a.value < b.value ? -1 : 1),
                  )
                  .map(({ value, i }) => (
                    <option value={facetId(facet, i)}>{value}</option>
                  ))}
              </select>
            </label>
          ))}
        <label>
          Search{" "}
          <input
            type="search"
            value={view.search}
            placeholder="id, key, planner, reason …"
            onInput={(e) => change({ search: e.currentTarget.value })}
          />
        </label>
        <span class="shown" aria-live="polite">
          {props.count} of {sweep.t.count} trials
        </span>
        <span class="on-paper">{chosen.length ? `with ${chosen.join("; ")}` : ""}</span>
        {isFiltered ? (
          <button type="button" onClick={() => change({ filters: {}, search: "" })}>
            Show all
          </button>
        ) : null}
      </div>
    </form>
  );
}

function Warnings({ sweep }: { sweep: Sweep }): JSX.Element | null {
  if (!sweep.warnings.length) return null;
  const short = (w: string): string => w.split(/: |; | \(/)[0];
  return (
    <details class="warnings">
      <summary>
        {sweep.warnings.length} {sweep.warnings.length === 1 ? "warning" : "warnings"}:{" "}
        {sweep.warnings.map(short).join("; ")}
      </summary>
      <ul>
        {sweep.warnings.map((w) => (
          <li>{w}</li>
        ))}
      </ul>
    </details>
  );
}

function SweepPage({ page, view, change }: Shown): JSX.Element {
  const at = Math.min(Math.max(Math.trunc(view.sweep), 0), page.sweeps!.length - 1);
  const sweep = useMemo(() => readSweep(page, at), [page, at]);
  const facets = useMemo(() => facetsOf(sweep), [sweep]);
  const chosen = useMemo(() => chosenTrials(sweep, facets, view), [sweep, facets, view.filters, view.search]);
  const trial = useMemo(() => (view.trial ? sweep.t.key.indexOf(view.trial) : -1), [sweep, view.trial]);
  const scene = useMemo(() => (trial < 0 ? null : sceneOfTrial(page, sweep, trial)), [page, sweep, trial]);
  const looks = useMemo(() => new Map(sweep.planners.map((p, i): [string, number] => [p.label, i])), [sweep]);
  const open = (i: number): void => change({ tab: "replay", trial: sweep.t.key[i], time: null });
  const close = (): void => change({ tab: "trials" });
  const { columns, order } = useOrder(sweep, chosen, view);
  const neighbours = useMemo(() => neighboursOf(sweep, order, trial, open), [sweep, order, trial]);
  const date = sweep.runs[0]?.date ?? "";
  const tabs: [string, string][] = [
    ["overview", "Overview"],
    ["trials", "Trials"],
    ...(page.side_by_side ? [["sweeps", "All sweeps"] as [string, string]] : []),
    ...(trial >= 0 ? [["replay", "Flight"] as [string, string]] : []),
    ["about", "About"],
  ];
  const tab = view.tab === "replay" && trial < 0 ? "trials" : view.tab;
  const sweeps =
    page.sweeps!.length > 1 ? (
      <label class="sweeps">
        Sweep{" "}
        <select
          value={String(at)}
          onChange={(e) => change({ ...kUsualView, theme: view.theme, sweep: Number(e.currentTarget.value) })}
        >
          {page.sweeps!.map((s, i) => (
            <option value={String(i)}>
              {s.name}
              {s.revision > 1 ? `@${s.revision}` : ""}
            </option>
          ))}
        </select>
      </label>
    ) : null;
  return (
    <Frame
      page={page}
      view={{ ...view, tab }}
      change={change}
      tabs={tabs}
      title={sweep.name}
      subtitle={`${sweep.title.replace(/^Sweep [^:]*: /, "")}${date ? ` · ${date.slice(0, 10)}` : ""}`}
      sweeps={sweeps}
    >
      <Planners.Provider value={looks}>
        {tab === "overview" ? <Warnings sweep={sweep} /> : null}
        {tab === "overview" || tab === "trials" ? (
          <Filters sweep={sweep} facets={facets} view={view} count={chosen.length} change={change} />
        ) : null}
        {tab === "overview" ? <Overview sweep={sweep} chosen={chosen} view={view} change={change} open={open} /> : null}
        {tab === "trials" ? (
          <TrialTable sweep={sweep} columns={columns} order={order} view={view} change={change} open={open} />
        ) : null}
        {tab === "sweeps" && page.side_by_side ? (
          <section class="tables" aria-label="All sweeps">
            <Report table={page.side_by_side} open />
          </section>
        ) : null}
        {tab === "about" ? <About page={page} sweep={sweep} /> : null}
        {tab === "replay" ? (
          scene ? (
            <Replay
              page={page}
              view={view}
              change={change}
              scene={scene}
              theme={usedTheme(view)}
              close={close}
              neighbours={neighbours}
            />
          ) : (
            <NoFlight sweep={sweep} trial={trial} page={page} close={close} />
          )
        ) : null}
      </Planners.Provider>
    </Frame>
  );
}

function NoFlight(props: { sweep: Sweep; trial: number; page: PageData; close: () => void }): JSX.Element {
  const { sweep, trial, page, close } = props;
  return (
    <section class="empty">
      <button onClick={close}>← Trials</button>
      <h2>The flight of trial {sweep.t.id[trial]} is not in this page</h2>
      <p>
        {page.flights_left_out ? "It did not fit: --page-size makes the page larger. " : "It has no stored path. "}To
        fly it again into its own page:
      </p>
      <pre>avoidbench replay DATABASE {sweep.t.key[trial]} --page flight.html</pre>
    </section>
  );
}

function OnePage({ page, view, change }: Shown): JSX.Element {
  const scene = useMemo(() => sceneOfPage(page), [page]);
  const [mission, setMission] = useState(0);
  const shown = useMemo(() => {
    const m = scene.missions[mission];
    return m ? { ...scene, start: m.start, goals: goalsOf(m) } : scene;
  }, [scene, mission]);
  const tab = view.tab === "about" ? "about" : "replay";
  const head = page.flights[0]?.head;
  const world = page.worlds[0];
  const subtitle = head
    ? `${outcomeText(head.outcome)}${head.end_s === null ? "" : ` at ${digits(head.end_s, 4)} s`}`
    : world
      ? `${world.instances} instances, ${world.triangles} triangles`
      : "";
  return (
    <Frame
      page={page}
      view={{ ...view, tab }}
      change={change}
      title={page.title}
      subtitle={subtitle}
      tabs={[
        ["replay", page.kind === "map" ? "Map" : "Flight"],
        ["about", "About"],
      ]}
    >
      {tab === "about" ? (
        <About page={page} sweep={null} />
      ) : (
        <>
          {scene.missions.length > 1 ? (
            <label class="missions">
              Mission{" "}
              <select value={String(mission)} onChange={(e) => setMission(Number(e.currentTarget.value))}>
                {scene.missions.map((m, i) => (
                  <option value={String(i)}>{m.index}</option>
                ))}
              </select>
            </label>
          ) : null}
          <Replay page={page} view={view} change={change} scene={shown} theme={usedTheme(view)} close={null} />
        </>
      )}
    </Frame>
  );
}

/** Of a run that has no trial yet. */
function WaitingPage({ page, view, change }: Shown): JSX.Element {
  return (
    <Frame page={page} view={view} change={change} title={page.title} subtitle="" tabs={[]}>
      <p class="empty">
        {page.run?.state === "running" ? "The first trials are being flown." : "No trial has been flown."}
      </p>
    </Frame>
  );
}

function BoardPage({ page, view, change }: Shown): JSX.Element {
  const tab = view.tab === "about" ? "about" : "board";
  return (
    <Frame
      page={page}
      view={{ ...view, tab }}
      change={change}
      title="Board"
      subtitle={page.title}
      tabs={[
        ["board", "Board"],
        ["about", "About"],
      ]}
    >
      {tab === "about" ? <About page={page} sweep={null} /> : page.boards!.map((board) => <Board board={board} />)}
    </Frame>
  );
}

function App({ page }: { page: PageData }): JSX.Element {
  const [view, setView] = useState<View>(() => viewOfLink(location.hash));
  useEffect(() => {
    const read = (): void => setView(viewOfLink(location.hash));
    window.addEventListener("hashchange", read);
    return () => window.removeEventListener("hashchange", read);
  }, []);
  const change = (part: Partial<View>): void =>
    setView((before) => {
      const next = { ...before, ...part };
      const link = `#${linkOfView(next)}`;
      // A new part of the page is a step back in the history; a filter or a moment is not.
      if (next.tab !== before.tab || next.trial !== before.trial) history.pushState(null, "", link);
      else history.replaceState(null, "", link);
      return next;
    });
  useLayoutEffect(() => showTheme(usedTheme(view)), [view.theme]);
  const shown = useRef(view);
  shown.current = view;
  useEffect(() => watchPaper(() => usedTheme(shown.current)), []);
  const tab = useRef(view.tab);
  useEffect(() => {
    // Not at first: a page that was loaded again stands where it was.
    if (tab.current !== view.tab) window.scrollTo(0, 0);
    tab.current = view.tab;
  }, [view.tab]);
  const Sweeps = page.sweeps?.length ? SweepPage : WaitingPage;
  const Page = { sweep: Sweeps, board: BoardPage, comparison: ComparisonPage, flight: OnePage, map: OnePage }[
    page.kind
  ];
  return <Page page={page} view={view} change={change} />;
}

/** Says what went wrong in place of an empty page. */
class Guard extends Component<{ children: ComponentChildren }, { problem: string }> {
  override state = { problem: "" };
  static override getDerivedStateFromError(error: unknown): { problem: string } {
    return { problem: error instanceof Error ? error.message : String(error) };
  }
  override render(): ComponentChildren {
    return this.state.problem ? (
      <p class="failure" role="alert">
        This page could not be shown: {this.state.problem}
      </p>
    ) : (
      this.props.children
    );
  }
}

const root = document.getElementById("app")!;
root.textContent = "";
try {
  showTheme(usedTheme(viewOfLink(location.hash)));
  const page = readPage();
  render(
    <Guard>
      <App page={page} />
    </Guard>,
    root,
  );
} catch (error) {
  root.textContent = `This page could not be shown: ${error instanceof Error ? error.message : String(error)}`;
}
