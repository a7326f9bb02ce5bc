// What every chart is made of: an SVG as wide as its place, scales, axes, signs, legends.
import type { ComponentChildren, JSX } from "preact";
import { createContext } from "preact";
import { useContext, useLayoutEffect, useRef, useState } from "preact/hooks";
import { plannerColor } from "./data";
import { kPaperEvent } from "./paper";
import { ticks } from "./stats";

/** The width that a chart may take, px. */
export function useWidth(): [{ current: HTMLDivElement | null }, number] {
  const ref = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(0);
  useLayoutEffect(() => {
    const element = ref.current!;
    const measure = (): void => setWidth(Math.max(220, Math.floor(element.clientWidth)));
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    window.addEventListener(kPaperEvent, measure);
    return () => {
      observer.disconnect();
      window.removeEventListener(kPaperEvent, measure);
    };
  }, []);
  return [ref, width];
}

interface Tip {
  x: number;
  y: number;
  text: string;
}

/** What stands beside the pointer: a text, or the one of a place in the chart, null where there is none. */
export type TipText = string | ((x: number, y: number) => string | null);

/** An SVG as wide as its place; `draw` gets its width and what shows a value beside the pointer. */
export function Chart(props: {
  height: number;
  label: string;
  draw: (width: number, tip: (text: TipText) => object) => ComponentChildren;
}): JSX.Element {
  const [ref, width] = useWidth();
  const [tip, setTip] = useState<Tip | null>(null);
  const tipOf = (of: TipText): object => ({
    onPointerMove: (e: PointerEvent) => {
      const box = ref.current?.getBoundingClientRect();
      if (!box) return;
      const [x, y] = [e.clientX - box.left, e.clientY - box.top];
      const text = typeof of === "string" ? of : of(x, y);
      setTip(text === null ? null : { x: Math.min(x, box.width - 190), y, text });
    },
    onPointerLeave: () => setTip(null),
  });
  return (
    <div class="chart" ref={ref}>
      {width > 0 ? (
        <svg
          width={width}
          height={props.height}
          viewBox={`0 0 ${width} ${props.height}`}
          role="img"
          aria-label={props.label}
        >
          {props.draw(width, tipOf)}
        </svg>
      ) : (
        <div style={{ height: `${props.height}px` }} />
      )}
      {tip ? (
        <div class="tip" style={{ left: `${tip.x + 12}px`, top: `${tip.y + 12}px` }}>
          {tip.text}
        </div>
      ) : null}
    </div>
  );
}

export interface Scale {
  /** Pixels; those of the nearer end for values outside. */
  (value: number): number;
  ticks: (count: number) => number[];
}
export function scaleOf(low: number, high: number, from: number, to: number): Scale {
  const span = high > low ? high - low : 1;
  return Object.assign((v: number) => from + Math.min(Math.max((v - low) / span, 0), 1) * (to - from), {
    ticks: (count: number) => ticks(low, high, count),
  });
}
/** The same over the values' logarithms. */
export function logScaleOf(low: number, high: number, from: number, to: number): Scale {
  const scale = scaleOf(Math.log10(low), Math.log10(high), from, to);
  const marks = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100];
  return Object.assign((v: number) => scale(Math.log10(v)), {
    ticks: () => marks.filter((v) => v >= low && v <= high),
  });
}

const axisText = (v: number, percent?: boolean): string =>
  percent ? `${Math.round(100 * v)} %`.replace("-", "−") : shortNumber(v);

/** Vertical grid lines from `top` to `bottom` with numbers below. */
export function XAxis(props: {
  x: Scale;
  left: number;
  right: number;
  top: number;
  bottom: number;
  unit?: string;
  percent?: boolean;
  /** A value whose line stands out. */
  origin?: number;
  /** Stand in place of the numbers 0, 1, … */
  words?: string[];
}): JSX.Element {
  const { x, top, bottom, words } = props;
  const count = Math.floor((props.right - props.left) / 50);
  return (
    <g class="axis" aria-hidden="true">
      {(words ? [...words.keys()] : x.ticks(Math.min(Math.max(count, 3), 7))).map((v) => (
        <>
          <line x1={x(v)} x2={x(v)} y1={top} y2={bottom} class={v === props.origin ? "one" : "grid"} />
          <text x={x(v)} y={bottom + 14} text-anchor="middle">
            {words ? shortened(words[v], (props.right - props.left) / words.length) : axisText(v, props.percent)}
          </text>
        </>
      ))}
      {props.unit ? (
        <text x={(props.left + props.right) / 2} y={bottom + 29} text-anchor="middle" class="unit">
          {props.unit}
        </text>
      ) : null}
    </g>
  );
}
export function YAxis(props: { y: Scale; left: number; right: number; count: number; percent?: boolean }): JSX.Element {
  const { y, left, right } = props;
  return (
    <g class="axis" aria-hidden="true">
      {y.ticks(props.count).map((v) => (
        <>
          <line x1={left} x2={right} y1={y(v)} y2={y(v)} class="grid" />
          <text x={left - 6} y={y(v) + 4} text-anchor="end">
            {axisText(v, props.percent)}
          </text>
        </>
      ))}
    </g>
  );
}
const shortNumber = (v: number): string =>
  (Math.abs(v) >= 10000 ? `${Number((v / 1000).toPrecision(3))}k` : String(Number(v.toPrecision(6)))).replace("-", "−");

/** What of a text fits so many pixels, at about 6.6 each letter. */
export function shortened(text: string, width: number): string {
  const most = Math.max(3, Math.floor(width / 6.6));
  const letters = [...text];
  return letters.length > most ? `${letters.slice(0, most - 1).join("")}…` : text;
}

/** Text that fits so many pixels; the whole of it in a tooltip. */
export function Fitting(props: { text: string; x: number; y: number; width: number }): JSX.Element {
  const shown = shortened(props.text, props.width);
  return (
    <text x={props.x} y={props.y} class="label">
      {shown}
      {shown === props.text ? null : <title>{props.text}</title>}
    </text>
  );
}

/** The outline of a small sign, another one for each planner: colour is not all that tells them apart. */
export function signPath(shape: number, x: number, y: number, s: number): string {
  return [
    `M${x - s},${y}a${s},${s} 0 1,0 ${2 * s},0a${s},${s} 0 1,0 ${-2 * s},0`,
    `M${x - s},${y - s}h${2 * s}v${2 * s}h${-2 * s}z`,
    `M${x},${y - 1.3 * s}L${x + 1.2 * s},${y + 0.9 * s}H${x - 1.2 * s}z`,
    `M${x},${y - 1.4 * s}L${x + 1.4 * s},${y}L${x},${y + 1.4 * s}L${x - 1.4 * s},${y}z`,
    `M${x},${y + 1.3 * s}L${x + 1.2 * s},${y - 0.9 * s}H${x - 1.2 * s}z`,
    `M${x - s},${y - s / 3}h${s * 0.67}v${-s * 0.67}h${s * 0.67}v${s * 0.67}h${s * 0.67}v${s * 0.67}h${-s * 0.67}v${s * 0.67}h${-s * 0.67}v${-s * 0.67}h${-s * 0.67}z`,
  ][shape % 6];
}
export function Sign(props: { shape: number; x: number; y: number; size: number; color: string }): JSX.Element {
  return <path d={signPath(props.shape, props.x, props.y, props.size)} fill={props.color} class="sign" />;
}

/** The sign of a planner, hollow where a failure is meant, or without one a square of an outcome's colour, beside its name. */
export function Swatch(props: { shape?: number; color: string; hollow?: boolean }): JSX.Element {
  const { shape, color } = props;
  return (
    <svg width="14" height="14" aria-hidden="true">
      {shape === undefined ? (
        <rect x={2} y={2} width={10} height={10} rx={2} fill={color} />
      ) : props.hollow ? (
        <path d={signPath(shape, 7, 7, 4.5)} fill="none" stroke={color} class="hollow" />
      ) : (
        <Sign shape={shape} x={7} y={7} size={4.5} color={color} />
      )}
    </svg>
  );
}

/** Which planner has a label, by its index. */
export const Planners = createContext(new Map<string, number>());

/** A planner's name in a table, with its sign; any other text as it is. */
export function Name({ text }: { text: string }): ComponentChildren {
  const planner = useContext(Planners).get(text);
  return planner === undefined ? (
    text
  ) : (
    <span class="with-sign">
      <Swatch shape={planner} color={plannerColor(planner)} />
      {text}
    </span>
  );
}

export function Legend(props: {
  class?: string;
  /** With a line where they have a dash. */
  items: { label: string; color: string; shape?: number; dash?: string; hollow?: boolean }[];
}): JSX.Element {
  return (
    <ul class={`legend ${props.class ?? ""}`}>
      {props.items.map((item) => (
        <li>
          {item.shape === undefined || item.dash === undefined ? (
            <Swatch {...item} />
          ) : (
            <svg width="22" height="14" aria-hidden="true">
              <line x1={0} x2={22} y1={7} y2={7} stroke={item.color} stroke-width={2} stroke-dasharray={item.dash} />
              <Sign shape={item.shape} x={11} y={7} size={4.5} color={item.color} />
            </svg>
          )}
          {item.label}
        </li>
      ))}
    </ul>
  );
}
