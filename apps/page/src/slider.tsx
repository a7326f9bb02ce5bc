// The slider of a flight's time, with ticks at what is known of it.
import type { JSX } from "preact";
import { useWidth } from "./chart";
import { outcomeColor } from "./data";
import type { Entry } from "./replay";
import { apart } from "./stats";

interface Tick {
  time: number;
  text: string;
  meaning: string;
}

/** By the names of explain's facts. */
const kFacts: [string, string, string][] = [
  ["in_range_s", "first seen", "The struck place was in view and in range"],
  ["sensed_s", "sensed", "Its depth was in the planner’s images"],
  ["mapped_s", "mapped", "The planner’s map had it as occupied"],
  ["last_chance_s", "last chance", "Reacting and braking could still have avoided the contact"],
];

/** What happened when, first things first. */
export function ticksOf(entry: Entry | undefined): Tick[] {
  if (!entry) return [];
  const facts = entry.data.facts ?? {};
  const known = kFacts.flatMap(([name, text, meaning]): Tick[] => {
    const time = facts[name];
    return typeof time === "number" && Number.isFinite(time) ? [{ time, text, meaning }] : [];
  });
  const contact = entry.data.touches[0]?.t ?? facts.contact_s;
  if (typeof contact === "number" && Number.isFinite(contact))
    known.push({ time: contact, text: "contact", meaning: "The vehicle touched an obstacle" });
  return known.sort((a, b) => a.time - b.time);
}

/** Half a thumb's width: where the slider's ends are, px. */
const kThumb = 8;

function Ticks(props: { ticks: Tick[]; end: number; seek: (t: number) => void }): JSX.Element {
  const { ticks, end } = props;
  const [ref, width] = useWidth();
  const at = ticks.map(({ time }) => kThumb + (time / end) * (width - 2 * kThumb));
  const gap = 6.4 * Math.max(...ticks.map(({ text }) => text.length)) + 8;
  const hasNames = width > gap * ticks.length;
  const names = apart(at, gap, gap / 2, width - gap / 2);
  return (
    <div class="ticks" ref={ref} style={{ height: hasNames ? "28px" : "14px" }}>
      <svg width={width} height={12} aria-hidden="true">
        {ticks.map(({ text }, i) => (
          <path
            d={`M${at[i]},0V5L${hasNames ? names[i] : at[i]},12`}
            fill="none"
            stroke={text === "contact" ? outcomeColor(1) : "var(--soft)"}
            stroke-width={2}
          />
        ))}
      </svg>
      {ticks.map(({ time, text, meaning }, i) => (
        <button
          style={{ left: `${hasNames ? names[i] : at[i]}px` }}
          title={`${meaning}, ${time.toFixed(2)} s`}
          aria-label={`Go to ${text}, ${time.toFixed(2)} s`}
          onClick={() => props.seek(time)}
        >
          {hasNames ? text : ""}
        </button>
      ))}
    </div>
  );
}

export function Slider(props: { time: number; end: number; ticks: Tick[]; seek: (t: number) => void }): JSX.Element {
  const { time, end, ticks, seek } = props;
  return (
    <div class={`slider ${ticks.length ? "with-ticks" : ""}`}>
      <input
        type="range"
        min={0}
        max={end}
        step={0.01}
        value={time}
        aria-label="Time, s"
        aria-valuetext={`${time.toFixed(2)} seconds`}
        onInput={(e) => seek(Number(e.currentTarget.value))}
      />
      {ticks.length ? <Ticks ticks={ticks} end={end} seek={seek} /> : null}
    </div>
  );
}
