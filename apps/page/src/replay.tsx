// A mission in 3-D with all its flights, plots below and one time slider.
import type { JSX } from "preact";
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { Swatch } from "./chart";
import type { FlightData, Look, MissionData, PageData, Seen, Theme, Vector } from "./data";
import { digits, outcomeText, plannerHex } from "./data";
import { readFlight, stateAt } from "./flight";
import { usePaper } from "./paper";
import { Plots } from "./plots";
import { latest, paint, pointsOf } from "./seen";
import { Slider, ticksOf } from "./slider";
import type { View } from "./state";
import type { CameraMode, PathColor, Track } from "./viewer";
import { kScaleColors, Viewer } from "./viewer";

export interface Entry extends Look {
  data: FlightData;
  isMain: boolean;
  outcome: string;
  reason: string;
  cause: string;
  id: number | string;
  key: string;
  facts: [string, string][];
}
export interface Scene {
  title: string;
  world: number | null;
  start: Vector | null;
  goals: Vector[];
  goalRadius: number;
  entries: Entry[];
  seen: Seen | null;
  missions: MissionData[];
}
/** The trials before and after this one that have a flight, as the table sorts and filters them. */
export interface Neighbours {
  text: string;
  /** One step on or back; null where there is none. */
  next: (() => void) | null;
  previous: (() => void) | null;
}

/** A failed flight begins so long before its end. */
const kBeforeEnd_s = 3;
function beginningOf(scene: Scene, tracks: Track[]): number {
  const failed = scene.entries.some((e) => e.isMain && e.outcome !== "reached_goal");
  const end = tracks.find((t) => t.isMain)?.flight.end_s ?? 0;
  return failed ? Math.max(0, end - kBeforeEnd_s) : 0;
}

const kModes: [CameraMode, string][] = [
  ["orbit", "Free"],
  ["follow", "Follow"],
  ["top", "Top"],
];
const kColors: [PathColor, string][] = [
  ["planner", "Planner"],
  ["speed", "Speed"],
  ["clearance", "Clearance"],
];
const kKeys: [string, string][] = [
  ["space", "play or stop"],
  ["← →", "a tenth of a second; with shift a second"],
  ["Home End", "begin, end"],
  ["n p", "next and previous trial"],
  ["1 2 3", "free camera, follow, top"],
  ["c", "colours of the paths"],
  [", .", "slower, faster"],
  ["Esc", "back to the trials"],
];

function boxOf(tracks: Track[], page: PageData, scene: Scene): [Vector, Vector] {
  const low: Vector = [Infinity, Infinity, Infinity];
  const high: Vector = [-Infinity, -Infinity, -Infinity];
  const take = (p: number[]): void => {
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k], p[k]);
      high[k] = Math.max(high[k], p[k]);
    }
  };
  for (const { flight: f } of tracks) for (let i = 0; i < f.n; ++i) take([f.x[i], f.y[i], f.z[i]]);
  for (const p of [scene.start, ...scene.goals]) if (p) take(p);
  const world = scene.world === null ? undefined : page.worlds[scene.world];
  if (world && tracks.length === 0) {
    take(world.flight_bounds[0]);
    take(world.flight_bounds[1]);
  }
  return Number.isFinite(low[0])
    ? [low, high]
    : [
        [0, 0, 0],
        [10, 10, 3],
      ];
}

export function Replay(props: {
  page: PageData;
  scene: Scene;
  view: View;
  theme: Theme;
  change: (part: Partial<View>) => void;
  close: (() => void) | null;
  /** What it closes to. */
  list?: string;
  neighbours?: Neighbours;
}): JSX.Element {
  const { page, scene, theme, view } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  const stage = useRef<HTMLDivElement>(null);
  const viewer = useRef<Viewer | null>(null);
  const [failure, setFailure] = useState("");
  // Counts the viewers: what is shown in one is put into the next, too.
  const [remade, setRemade] = useState(0);
  const [playing, setPlaying] = useState(false);
  const [rate, setRate] = useState(1);
  const [hidden, setHidden] = useState<Set<string>>(new Set());
  const [layers, setLayers] = useState({ points: true, drawings: true, inset: true });
  const [labels, setLabels] = useState<Label[]>([]);
  const mode = (kModes.find(([m]) => m === view.camera)?.[0] ?? "orbit") as CameraMode;
  const color = (kColors.find(([c]) => c === view.color)?.[0] ?? "planner") as PathColor;

  const tracks = useMemo(
    () =>
      scene.entries.map(
        (e): Track => ({
          label: e.label,
          color: plannerHex(e.shape, theme),
          flight: readFlight(e.data),
          rig: page.rigs[e.data.rig] ?? { body: [0.5, 0.5, 0.2], cameras: [] },
          isMain: e.isMain,
          isShown: true,
          struck: e.data.touches,
        }),
      ),
    [scene, theme],
  );
  const [time, setTime] = useState(() => view.time ?? beginningOf(scene, tracks));
  // Another trial, in the same viewer.
  const begun = useRef(scene);
  useLayoutEffect(() => {
    if (begun.current === scene) return;
    begun.current = scene;
    setPlaying(false);
    setTime(view.time ?? beginningOf(scene, tracks));
  }, [scene]);
  const main = tracks.find((t) => t.isMain);
  // A map of its own has time only where something moves.
  const hasMotion = scene.world !== null && (page.worlds[scene.world]?.motions.length ?? 0) > 0;
  const hasTime = main !== undefined || hasMotion;
  const end = main ? Math.max(0.1, ...tracks.map((t) => t.flight.end_s)) : hasMotion ? 30 : 0.1;
  const box = useMemo(() => boxOf(tracks, page, scene), [tracks]);
  const seek = (t: number): void => setTime(Math.min(Math.max(t, 0), end));
  const place = useRef({ time, end });
  place.current = { time, end };

  useEffect(() => {
    try {
      const made = new Viewer(canvas.current!, page, theme === "dark");
      viewer.current = made;
      setRemade((count) => count + 1);
      made.onLabels = setLabels;
      made.setWorld(scene.world);
      made.setPathColor(color);
      made.setTracks(tracks, scene.start, scene.goals, scene.goalRadius);
      const measure = (): void => {
        const rect = stage.current?.getBoundingClientRect();
        if (rect && rect.width > 0) made.resize(Math.round(rect.width), Math.round(rect.height));
      };
      measure();
      made.setMode(mode, box[0], box[1], scene.start, scene.goals[0]);
      made.setTime(time);
      const observer = new ResizeObserver(measure);
      observer.observe(stage.current!);
      return () => {
        observer.disconnect();
        made.dispose();
        viewer.current = null;
      };
    } catch (error) {
      setFailure(
        `The 3-D view could not start: ${error instanceof Error ? error.message : String(error)}. It needs WebGL.`,
      );
      return undefined;
    }
  }, [scene, theme]);
  useEffect(() => {
    viewer.current?.setTime(time);
  }, [time, scene, theme]);
  useEffect(() => {
    viewer.current?.setMode(mode, box[0], box[1], scene.start, scene.goals[0]);
    viewer.current?.setTime(place.current.time);
  }, [mode]);
  useEffect(() => {
    viewer.current?.setPathColor(color);
  }, [color, scene, theme]);
  useEffect(() => {
    viewer.current?.setShown((t) => !hidden.has(t.label));
  }, [hidden, scene, theme]);
  useEffect(() => {
    viewer.current?.setLayers(layers.points, layers.drawings);
    viewer.current?.setInset(layers.inset && !scene.seen?.images.length);
  }, [layers, scene, theme]);
  // The link follows the time when it rests.
  useEffect(() => {
    if (playing) return undefined;
    const timer = setTimeout(() => props.change({ time }), 250);
    return () => clearTimeout(timer);
  }, [time, playing]);
  useEffect(() => {
    if (!playing) return undefined;
    let last = performance.now();
    let asked = 0;
    const step = (now: number): void => {
      const next = place.current.time + (rate * (now - last)) / 1000;
      last = now;
      setTime(Math.min(next, place.current.end));
      if (next >= place.current.end) setPlaying(false);
      else asked = requestAnimationFrame(step);
    };
    asked = requestAnimationFrame(step);
    return () => cancelAnimationFrame(asked);
  }, [playing, rate]);
  const play = (): void => {
    if (!playing && time >= end - 1e-3) setTime(0);
    setPlaying(!playing);
  };
  useEffect(() => {
    const keys = (e: KeyboardEvent): void => {
      const target = e.target as HTMLElement;
      const isSlider = target instanceof HTMLInputElement && target.type === "range";
      if (
        e.ctrlKey ||
        e.metaKey ||
        e.altKey ||
        ((target instanceof HTMLInputElement || target instanceof HTMLSelectElement) && !isSlider)
      )
        return;
      if (e.key === " " && target instanceof HTMLButtonElement) return;
      const step = e.shiftKey ? 1 : 0.1;
      if (e.key === " ") play();
      else if (e.key === "ArrowRight") seek(place.current.time + step);
      else if (e.key === "ArrowLeft") seek(place.current.time - step);
      else if (e.key === "Home") seek(0);
      else if (e.key === "End") seek(end);
      else if (["1", "2", "3"].includes(e.key)) props.change({ camera: kModes[Number(e.key) - 1][0] });
      else if (e.key === "c")
        props.change({ color: kColors[(kColors.findIndex(([k]) => k === color) + 1) % kColors.length][0] });
      else if (e.key === ",") setRate((r) => Math.max(r / 2, 0.125));
      else if (e.key === ".") setRate((r) => Math.min(r * 2, 8));
      else if (e.key === "n" && props.neighbours) props.neighbours.next?.();
      else if (e.key === "p" && props.neighbours) props.neighbours.previous?.();
      else if (e.key === "Escape" && props.close) props.close();
      else return;
      e.preventDefault();
    };
    window.addEventListener("keydown", keys);
    return () => window.removeEventListener("keydown", keys);
  });

  // Not every browser prints a canvas.
  const paper = usePaper();
  const picture = useMemo(() => (paper ? (viewer.current?.picture() ?? "") : ""), [paper]);
  const state = main?.flight.n ? stateAt(main.flight, time) : null;
  const ticks = useMemo(() => ticksOf(scene.entries.find((e) => e.isMain)), [scene]);
  const range = viewer.current?.range ?? [0, 1];
  const layer = (name: keyof typeof layers, what: string): JSX.Element => (
    <label>
      <input type="checkbox" checked={layers[name]} onChange={() => setLayers({ ...layers, [name]: !layers[name] })} />{" "}
      {what}
    </label>
  );
  return (
    <section class="replay" aria-label="Replay">
      <div class="replay-head">
        {props.close ? <button onClick={props.close}>← {props.list ?? "Trials"}</button> : null}
        {props.close ? <h2>{scene.title}</h2> : null}
        {props.neighbours ? <Steps {...props.neighbours} /> : null}
      </div>
      <div class="replay-body">
        <div class="stage" ref={stage}>
          <canvas
            ref={canvas}
            tabIndex={0}
            aria-label="3-D view of the flight; drag to turn, wheel to come nearer"
            role="img"
            data-position={state ? state.position.map((v) => v.toFixed(3)).join(" ") : ""}
            data-time={time.toFixed(3)}
          />
          {picture ? <img class="picture" src={picture} alt="The 3-D view as it was last" /> : null}
          {failure ? (
            <p class="failure" role="alert">
              {failure}
            </p>
          ) : null}
          {scene.world === null ? (
            <p class="failure">
              The map is not in this page:{" "}
              {page.scene_warnings.find((w) => w.includes("map")) ?? "it could not be made"}.
            </p>
          ) : null}
          <div class="names" aria-hidden="true">
            {unpiled(labels).map((l) => (
              <span style={{ left: `${l.x}px`, top: `${l.y}px`, borderColor: l.color }}>{l.label}</span>
            ))}
          </div>
          {color !== "planner" && tracks.length ? (
            <div class="scale" aria-hidden="true">
              <span>{color === "speed" ? "speed, m/s" : "clearance, m"}</span>
              <i style={{ background: `linear-gradient(to right, ${kScaleColors.join(", ")})` }} />
              <span>{digits(range[0], 2)}</span>
              <span>{digits(range[1], 2)}</span>
            </div>
          ) : null}
          {layers.inset && main && !scene.seen?.images.length && scene.world !== null ? (
            <span class="inset-name">depth from here (ideal camera)</span>
          ) : null}
          {scene.seen?.images.length && layers.inset ? (
            <SeenView
              page={page}
              scene={scene}
              time={time}
              viewer={viewer}
              rig={scene.entries[0]?.data.rig ?? 0}
              remade={remade}
            />
          ) : null}
        </div>
        <aside class="side" aria-label="Flights">
          <ul class="flights">
            {scene.entries.map((e) => (
              <li class={e.isMain ? "main" : ""}>
                <label>
                  <input
                    type="checkbox"
                    checked={!hidden.has(e.label)}
                    onChange={() =>
                      setHidden((h) => {
                        const next = new Set(h);
                        if (next.has(e.label)) next.delete(e.label);
                        else next.add(e.label);
                        return next;
                      })
                    }
                  />
                  <Swatch shape={e.shape} color={e.color} />
                  <strong>{e.label}</strong>
                </label>
                <span class="what">
                  trial {e.id}: {outcomeText(e.outcome)}
                  {e.cause ? `: ${e.cause}` : ""}
                </span>
                {e.reason ? <span class="why">{e.reason}</span> : null}
                {e.isMain && e.data.explanation ? <span class="why">{e.data.explanation}</span> : null}
              </li>
            ))}
          </ul>
          {state ? (
            <dl class="now">
              <dt>time</dt>
              <dd>
                {time.toFixed(2)} s
                {main && time > main.flight.end_s + 0.005 ? ` (ended at ${main.flight.end_s.toFixed(2)} s)` : ""}
              </dd>
              <dt>position</dt>
              <dd>{state.position.map((v) => v.toFixed(2)).join(", ")} m</dd>
              <dt>speed</dt>
              <dd>{state.speed.toFixed(2)} m/s</dd>
              <dt>clearance</dt>
              <dd>
                {Number.isNaN(state.clearance)
                  ? "–"
                  : state.clearance >= 5
                    ? "≥ 5 m"
                    : `${state.clearance.toFixed(2)} m`}
              </dd>
              {scene.entries
                .find((e) => e.isMain)
                ?.facts.map(([name, value]) => (
                  <>
                    <dt>{name}</dt>
                    <dd>{value}</dd>
                  </>
                ))}
            </dl>
          ) : null}
          {scene.seen?.log.length ? <Log scene={scene} time={time} /> : null}
          <details class="keys">
            <summary>Keys</summary>
            <dl>
              {kKeys.map(([key, what]) => (
                <>
                  <dt>
                    <kbd>{key}</kbd>
                  </dt>
                  <dd>{what}</dd>
                </>
              ))}
            </dl>
            <p>Drag turns, right drag moves, the wheel comes nearer.</p>
          </details>
          <p class="note">World frame: x east, y north, z up, metres.</p>
        </aside>
        <div class="controls" role="group" aria-label="Playing">
          {hasTime ? (
            <>
              <button class="play" onClick={play} aria-pressed={playing}>
                {playing ? "❚❚ Stop" : "▶ Play"}
              </button>
              <Slider
                time={time}
                end={end}
                ticks={ticks}
                seek={(t) => {
                  setPlaying(false);
                  seek(t);
                }}
              />
              <output>
                {time.toFixed(2)} / {end.toFixed(2)} s
              </output>
              <label>
                Speed{" "}
                <select value={String(rate)} onChange={(e) => setRate(Number(e.currentTarget.value))}>
                  {[0.125, 0.25, 0.5, 1, 2, 4, 8].map((r) => (
                    <option value={String(r)}>{r}×</option>
                  ))}
                </select>
              </label>
            </>
          ) : null}
          <Choice
            title="Camera"
            options={main ? kModes : kModes.filter(([m]) => m !== "follow")}
            value={mode}
            set={(camera) => {
              props.change({ camera });
              if (camera === mode) viewer.current?.setMode(mode, box[0], box[1], scene.start, scene.goals[0]);
            }}
          />
          {main ? (
            <Choice title="Paths by" options={kColors} value={color} set={(c) => props.change({ color: c })} />
          ) : null}
          {scene.seen?.images.some((i) => i.kind === "depth") ? layer("points", "points as seen") : null}
          {scene.seen?.drawings.length ? layer("drawings", "drawings") : null}
          {main ? layer("inset", "camera") : null}
        </div>
      </div>
      {main ? (
        <Plots
          scene={scene}
          tracks={tracks}
          hidden={hidden}
          time={time}
          end={end}
          seek={(t) => {
            setPlaying(false);
            seek(t);
          }}
        />
      ) : null}
    </section>
  );
}

function Steps({ text, next, previous }: Neighbours): JSX.Element {
  return (
    <div class="steps" role="group" aria-label="Trials">
      <button onClick={() => previous?.()} disabled={!previous} title="Key p">
        ‹ Previous
      </button>
      <span class="note" aria-live="polite">
        {text}
      </span>
      <button onClick={() => next?.()} disabled={!next} title="Key n">
        Next ›
      </button>
    </div>
  );
}

interface Label {
  label: string;
  color: string;
  x: number;
  y: number;
}
/** Names that would lie on others move up. */
function unpiled(labels: Label[]): Label[] {
  const height = 21;
  const placed: Label[] = [];
  for (const one of [...labels].sort((a, b) => b.y - a.y)) {
    let y = one.y;
    const half = (l: Label): number => Math.min(80, 12 + 3.6 * l.label.length);
    const isBeside = (l: Label): boolean => Math.abs(l.x - one.x) < half(l) + half(one);
    for (const other of placed) if (isBeside(other) && Math.abs(other.y - y) < height) y = other.y - height;
    placed.push({ ...one, y });
  }
  return placed;
}

function Choice<Value extends string>(props: {
  title: string;
  options: [Value, string][];
  value: Value;
  set: (v: Value) => void;
}): JSX.Element {
  return (
    <div class="choice" role="group" aria-label={props.title}>
      <span aria-hidden="true">{props.title}</span>
      {props.options.map(([v, name]) => (
        <button aria-pressed={v === props.value} onClick={() => props.set(v)}>
          {name}
        </button>
      ))}
    </div>
  );
}

function Log({ scene, time }: { scene: Scene; time: number }): JSX.Element {
  const lines = scene.seen!.log;
  const at = latest(lines, time);
  return (
    <details class="log">
      <summary>Log of the planner</summary>
      <ol>
        {lines.slice(Math.max(0, at - 7), at + 1).map((l) => (
          <li>
            <b>{l.t.toFixed(2)} s</b> {l.text}
          </li>
        ))}
      </ol>
    </details>
  );
}

/** The images that the planner was shown last, and its points and drawings in the 3-D view. */
function SeenView(props: {
  page: PageData;
  scene: Scene;
  time: number;
  viewer: { current: Viewer | null };
  rig: number;
  remade: number;
}): JSX.Element {
  const seen = props.scene.seen!;
  const cameras = props.page.rigs[props.rig]?.cameras ?? [];
  const places = useMemo(
    () =>
      [...new Set(seen.images.map((i) => i.camera))].map((camera) => seen.images.filter((i) => i.camera === camera)),
    [seen],
  );
  const canvases = useRef<(HTMLCanvasElement | null)[]>([]);
  const current = places.map((images) => latest(images, props.time));
  const drawing = latest(seen.drawings, props.time);
  useEffect(() => {
    const all: { points: Float32Array; colors: Float32Array }[] = [];
    places.forEach((images, k) => {
      const image = images[Math.max(current[k], 0)];
      const camera = cameras[image?.camera ?? 0];
      if (!image || !camera) return;
      const canvas = canvases.current[k];
      if (canvas) paint(image, camera, canvas);
      if (image.kind === "depth") all.push(pointsOf(image, camera));
    });
    const join = (parts: Float32Array[]): Float32Array => {
      const whole = new Float32Array(parts.reduce((n, p) => n + p.length, 0));
      let at = 0;
      for (const p of parts) {
        whole.set(p, at);
        at += p.length;
      }
      return whole;
    };
    props.viewer.current?.setPoints(
      all.length ? join(all.map((a) => a.points)) : null,
      all.length ? join(all.map((a) => a.colors)) : null,
    );
  }, [current.join(" "), props.remade]);
  useEffect(() => {
    props.viewer.current?.setDrawings(drawing < 0 ? [] : seen.drawings[drawing].drawings);
  }, [drawing, props.remade]);
  const kind = places[0]?.[0]?.kind ?? "depth";
  return (
    <div class="seen">
      {places.map((images, k) => (
        <canvas
          ref={(c) => {
            canvases.current[k] = c;
          }}
          role="img"
          aria-label={`What camera ${images[0].camera} showed the planner`}
        />
      ))}
      <span>
        {kind === "depth" ? "depth as the planner saw it: near red, far blue, invalid grey" : "what the planner saw"}
      </span>
    </div>
  );
}
