// How far the run is that the page is of. While it goes on the page loads itself again: a script can't ask a file whether it changed.
import type { JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import type { RunData } from "./data";

const kEvery_s = 5;
/** Without a new page for so long, or for so many times its usual pause, the run may have ended. */
const [kSilence_s, kSilentTimes] = [60, 4];

/** What a reload would lose: where the page stands, and what is open in it. */
interface Place {
  scroll: number;
  /** By name: what was flown since may have added others. */
  open: Record<string, boolean>;
}
const placeName = (): string => `avoidbench ${location.pathname}`;
const foldable = (): [string, HTMLDetailsElement][] =>
  [...document.querySelectorAll("details")].map((d) => [
    d.dataset.table ?? d.closest("figure")?.dataset.figure ?? d.className,
    d,
  ]);

function loadAgain(): void {
  try {
    const place: Place = {
      scroll: window.scrollY,
      open: Object.fromEntries(foldable().map(([name, d]) => [name, d.open])),
    };
    sessionStorage.setItem(placeName(), JSON.stringify(place));
  } catch {
    // Without a store it begins at its top.
  }
  location.reload();
}

/** Goes back to where the page was before it loaded itself again. */
function restorePlace(): void {
  try {
    const stored = sessionStorage.getItem(placeName());
    sessionStorage.removeItem(placeName());
    if (stored === null) return;
    const place = JSON.parse(stored) as Place;
    for (const [name, d] of foldable()) d.open = place.open[name] ?? d.open;
    // Once what has opened has its height.
    requestAnimationFrame(() => requestAnimationFrame(() => window.scrollTo(0, place.scroll)));
  } catch {
    // The same.
  }
}

function durationText(s: number): string {
  const whole = Math.max(0, Math.round(s));
  if (whole >= 3600) return `${Math.floor(whole / 3600)} h ${Math.floor(whole / 60) % 60} min`;
  return whole >= 60 ? `${Math.floor(whole / 60)} min ${whole % 60} s` : `${whole} s`;
}

/** Someone is typing, or something is selected. */
function isBusy(): boolean {
  const at = document.activeElement;
  return at instanceof HTMLInputElement || at instanceof HTMLSelectElement || window.getSelection()?.type === "Range";
}

function countText(run: RunData): string {
  if (!run.is_open) return `${run.done} of ${run.total} trials`;
  return `${run.done} trials so far`;
}

function Running({ run, held }: { run: RunData; held: boolean }): JSX.Element {
  const [paused, setPaused] = useState(false);
  const [now_s, setNow] = useState(Date.now() / 1000);
  const every_s = run.every_s ?? kEvery_s;
  const isSilent = run.written_s !== undefined && now_s - run.written_s > Math.max(kSilence_s, kSilentTimes * every_s);
  useEffect(() => {
    const loaded = performance.now();
    const timer = setInterval(() => {
      setNow(Date.now() / 1000);
      const isDue = performance.now() - loaded >= 1000 * every_s;
      if (isDue && !paused && !held && !document.hidden && !isBusy()) loadAgain();
    }, 1000);
    return () => clearInterval(timer);
  }, [paused, held]);
  const time = run.written_s === undefined ? "" : new Date(1000 * run.written_s).toLocaleTimeString();
  const left = run.left_s == null ? "" : `, about ${durationText(run.left_s)} left`;
  const reload = held ? "not loaded again while a flight is shown" : `loaded again every ${durationText(every_s)}`;
  const next = paused ? "not loaded again" : reload;
  return (
    <>
      <span>
        <b>{isSilent ? "No news of this run" : "Running"}</b>: {countText(run)}
        {isSilent ? "" : left}
      </span>
      {run.is_open ? null : <progress max={run.total} value={run.done} aria-label="Trials flown" />}
      <span class="note">
        {time ? `as of ${time}; ` : ""}
        {isSilent ? "it may have ended without a last page" : next}
      </span>
      <button type="button" aria-pressed={paused} onClick={() => setPaused(!paused)}>
        Pause
      </button>
      {held || paused ? (
        <button type="button" onClick={loadAgain}>
          Load again
        </button>
      ) : null}
    </>
  );
}

/** `held`: it must not load itself again now. */
export function RunBanner({ run, held }: { run: RunData; held: boolean }): JSX.Element {
  useEffect(restorePlace, []);
  return (
    <div class={`run ${run.state}`} data-run={run.state} role="status" aria-live="off">
      {run.state === "running" ? (
        <Running run={run} held={held} />
      ) : (
        <span>
          <b>{run.state === "complete" ? "Complete" : "Interrupted"}</b>: {countText(run)}
          {run.state === "complete" ? "" : " were flown; the same command resumes it"}
        </span>
      )}
    </div>
  );
}
