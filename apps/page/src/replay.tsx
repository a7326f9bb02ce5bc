// A mission in 3-D with all its flights, plots below and one time slider.
import type { JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { Sign } from "./charts";
import type { FlightData, PageData, Seen, Vector } from "./data";
import { digits, outcomeText } from "./data";
import { placeOf, readFlight, stateAt } from "./flight";
import { deltasOf, floatsOf } from "./packed";
import type { Series } from "./plots";
import { Plot } from "./plots";
import { latest, paint, pointsOf } from "./seen";
import type { CameraMode, PathColor, Track } from "./viewer";
import { kScaleColors, Viewer } from "./viewer";

export interface Entry {
  label: string;
  color: string;
  shape: number;
  data: FlightData;
  isMain: boolean;
  outcome: string;
  reason: string;
  cause: string;
  id: number;
  key: string;
  facts: [string, string][];
}
export interface Scene {
  title: string;
  world: number | null;
  start: Vector | null;
  goal: Vector | null;
  goalRadius: number;
  entries: Entry[];
  seen: Seen | null;
  missions: { index: number; start: Vector; goal: Vector }[];
}

const kModes: [CameraMode, string][] = [
  ["orbit", "Free"],
  ["follow", "Follow"],
  ["top", "Top"],
];
const kColors: [PathColor, string][] = [
  ["speed", "Speed"],
  ["clearance", "Clearance"],
  ["planner", "Planner"],
];
const kKeys: [string, string][] = [
  ["space", "play or stop"],
  ["← →", "a tenth of a second; with shift a second"],
  ["Home End", "begin, end"],
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
  for (const p of [scene.start, scene.goal]) if (p) take(p);
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
  time: number | null;
  camera: string;
  color: string;
  theme: string;
  change: (part: { time?: number; camera?: string; color?: string }) => void;
  close: (() => void) | null;
}): JSX.Element {
  const { page, scene, theme } = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  const stage = useRef<HTMLDivElement>(null);
  const viewer = useRef<Viewer | null>(null);
  const [failure, setFailure] = useState("");
  // Counts the viewers: what is shown in one is put into the next, too.
  const [remade, setRemade] = useState(0);
  const [time, setTime] = useState(props.time ?? 0);
  const [playing, setPlaying] = useState(false);
  const [rate, setRate] = useState(1);
  const [hidden, setHidden] = useState<Set<string>>(new Set());
  const [layers, setLayers] = useState({ points: true, drawings: true, inset: true });
  const [labels, setLabels] = useState<{ label: string; color: string; x: number; y: number }[]>([]);
  const mode = (kModes.find(([m]) => m === props.camera)?.[0] ?? "orbit") as CameraMode;
  const color = (kColors.find(([c]) => c === props.color)?.[0] ?? "speed") as PathColor;

  const tracks = useMemo(
    () =>
      scene.entries.map(
        (e): Track => ({
          label: e.label,
          color: e.color,
          flight: readFlight(e.data),
          rig: page.rigs[e.data.rig] ?? { body: [0.5, 0.5, 0.2], cameras: [] },
          isMain: e.isMain,
          isShown: true,
          struck: e.data.touches.map((t) => ({ t: t.t, obstacle: t.obstacle })),
        }),
      ),
    [scene],
  );
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
      made.setTracks(tracks, scene.start, scene.goal, scene.goalRadius);
      const measure = (): void => {
        const rect = stage.current?.getBoundingClientRect();
        if (rect && rect.width > 0) made.resize(Math.round(rect.width), Math.round(rect.height));
      };
      measure();
      made.setMode(mode, box[0], box[1], scene.start, scene.goal);
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
    viewer.current?.setMode(mode, box[0], box[1], scene.start, scene.goal);
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
      else if (e.key === "Escape" && props.close) props.close();
      else return;
      e.preventDefault();
    };
    window.addEventListener("keydown", keys);
    return () => window.removeEventListener("keydown", keys);
  });

  const state = main?.flight.n ? stateAt(main.flight, time) : null;
  const range = viewer.current?.range ?? [0, 1];
  return (
    <section class="replay" aria-label="Replay">
      <div class="replay-head">
        {props.close ? <button onClick={props.close}>← Trials</button> : null}
        {props.close ? <h2>{scene.title}</h2> : null}
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
            {labels.map((l) => (
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
                  <svg width="14" height="14" aria-hidden="true">
                    <Sign shape={e.shape} x={7} y={7} size={5} color={e.color} />
                  </svg>
                  <strong>{e.label}</strong>
                </label>
                <span class="what">
                  trial {e.id}: {outcomeText(e.outcome)}
                  {e.cause ? `: ${e.cause}` : ""}
                </span>
                {e.reason ? <span class="why">{e.reason}</span> : null}
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
              <input
                type="range"
                min={0}
                max={end}
                step={0.01}
                value={time}
                aria-label="Time, s"
                aria-valuetext={`${time.toFixed(2)} seconds`}
                onInput={(e) => {
                  setPlaying(false);
                  seek(Number(e.currentTarget.value));
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
              if (camera === mode) viewer.current?.setMode(mode, box[0], box[1], scene.start, scene.goal);
            }}
          />
          {main ? (
            <Choice title="Paths by" options={kColors} value={color} set={(c) => props.change({ color: c })} />
          ) : null}
          {scene.seen?.images.some((i) => i.kind === "depth") ? (
            <label>
              <input
                type="checkbox"
                checked={layers.points}
                onChange={() => setLayers({ ...layers, points: !layers.points })}
              />{" "}
              points as seen
            </label>
          ) : null}
          {scene.seen?.drawings.length ? (
            <label>
              <input
                type="checkbox"
                checked={layers.drawings}
                onChange={() => setLayers({ ...layers, drawings: !layers.drawings })}
              />{" "}
              drawings
            </label>
          ) : null}
          {main ? (
            <label>
              <input
                type="checkbox"
                checked={layers.inset}
                onChange={() => setLayers({ ...layers, inset: !layers.inset })}
              />{" "}
              camera
            </label>
          ) : null}
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
          theme={theme}
        />
      ) : null}
    </section>
  );
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

function Plots(props: {
  scene: Scene;
  tracks: Track[];
  hidden: Set<string>;
  time: number;
  end: number;
  seek: (t: number) => void;
  theme: string;
}): JSX.Element {
  const { scene, tracks, hidden } = props;
  const shown = tracks.filter((t) => !hidden.has(t.label)).sort((a, b) => Number(a.isMain) - Number(b.isMain));
  const name = shown.map((t) => t.label).join("\n");
  const of = (value: (t: Track) => ArrayLike<number>): Series[] =>
    shown.map((t) => ({
      label: t.label,
      color: t.color,
      t: t.flight.t,
      v: value(t),
      isMain: t.isMain,
      dash: scene.entries.findIndex((e) => e.label === t.label),
    }));
  const speed = useMemo(() => of((t) => t.flight.speed), [name, tracks]);
  const clearance = useMemo(() => of((t) => t.flight.clearance), [name, tracks]);
  const main = tracks.find((t) => t.isMain)!;
  const entry = scene.entries.find((e) => e.isMain)!;
  const commands = useMemo((): { title: string; unit: string; series: Series[] }[] => {
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
          series: [{ label: entry.label, color: entry.color, t, v: floatsOf(text, calls.n), isMain: true }],
        }))
        .filter((p) => Array.from(p.series[0].v).some(Number.isFinite));
    }
    const ahead = of((t) => {
      const a = t.flight.ahead;
      return a ? t.flight.t.map((_, i) => Math.hypot(a[0][i], a[1][i], a[2][i])) : [];
    }).filter((s) => s.v.length > 0);
    return ahead.length ? [{ title: "Commanded position ahead of the vehicle", unit: "m", series: ahead }] : [];
  }, [name, tracks, scene]);
  // When the planner had no plan.
  const bands = useMemo((): [number, number][] => {
    const changes: [number, number][] = scene.seen?.calls.n ? statusChanges(scene.seen) : entry.data.status;
    return changes.flatMap(([from, status], i) =>
      status === 0 ? [] : [[from, changes[i + 1]?.[0] ?? main.flight.end_s] as [number, number]],
    );
  }, [scene]);
  const common = { time: props.time, end: props.end, seek: props.seek, theme: props.theme };
  return (
    <div class="plots">
      <Plot title="Speed" unit="m/s" series={speed} {...common} />
      <Plot title="Clearance" unit="m" series={clearance} {...common} />
      {commands.map((c) => (
        <Plot title={c.title} unit={c.unit} series={c.series} bands={bands} {...common} />
      ))}
      <p class="note">
        {bands.length ? "Shaded: the planner answered without a command. " : ""}Clearance is to the nearest surface, 5 m
        at most{scene.seen ? "" : "; between two samples shown the least is told"}.
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

export { placeOf };
