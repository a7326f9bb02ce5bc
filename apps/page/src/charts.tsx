// Charts as SVG.
import type { ComponentChildren, JSX } from "preact";
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { digits } from "./data";
import { ticks } from "./stats";

/** The width that a chart may take, px. */
function useWidth(): [{ current: HTMLDivElement | null }, number] {
  const ref = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(0);
  useLayoutEffect(() => {
    const element = ref.current!;
    const measure = (): void => setWidth(Math.max(220, Math.floor(element.clientWidth)));
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  return [ref, width];
}

interface Tip {
  x: number;
  y: number;
  text: string;
}

/** An SVG as wide as its place; `draw` gets its width and what shows a value beside the pointer. */
function Chart(props: {
  height: number;
  label: string;
  draw: (width: number, tip: (text: string) => object) => ComponentChildren;
}): JSX.Element {
  const [ref, width] = useWidth();
  const [tip, setTip] = useState<Tip | null>(null);
  const tipOf = (text: string): object => ({
    onPointerMove: (e: PointerEvent) => {
      const box = ref.current?.getBoundingClientRect();
      if (box) setTip({ x: Math.min(e.clientX - box.left, box.width - 190), y: e.clientY - box.top, text });
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

interface Scale {
  /** Pixels; those of the nearer end for values outside. */
  (value: number): number;
  ticks: (count: number) => number[];
}
function scaleOf(low: number, high: number, from: number, to: number): Scale {
  const span = high > low ? high - low : 1;
  return Object.assign((v: number) => from + Math.min(Math.max((v - low) / span, 0), 1) * (to - from), {
    ticks: (count: number) => ticks(low, high, count),
  });
}
/** The same over the values' logarithms. */
function logScaleOf(low: number, high: number, from: number, to: number): Scale {
  const scale = scaleOf(Math.log10(low), Math.log10(high), from, to);
  const marks = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100];
  return Object.assign((v: number) => scale(Math.log10(v)), {
    ticks: () => marks.filter((v) => v >= low && v <= high),
  });
}

const axisText = (v: number, percent?: boolean): string => (percent ? `${Math.round(100 * v)} %` : shortNumber(v));

/** Vertical grid lines from `top` to `bottom` with numbers below. */
function XAxis(props: {
  x: Scale;
  left: number;
  right: number;
  top: number;
  bottom: number;
  unit?: string;
  percent?: boolean;
  one?: boolean;
}): JSX.Element {
  const { x, top, bottom } = props;
  const count = Math.floor((props.right - props.left) / 50);
  return (
    <g class="axis" aria-hidden="true">
      {x.ticks(Math.min(Math.max(count, 3), 7)).map((v) => (
        <>
          <line x1={x(v)} x2={x(v)} y1={top} y2={bottom} class={props.one && v === 1 ? "one" : "grid"} />
          <text x={x(v)} y={bottom + 14} text-anchor="middle">
            {axisText(v, props.percent)}
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
function YAxis(props: { y: Scale; left: number; right: number; count: number; percent?: boolean }): JSX.Element {
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

/** Text that fits so many pixels, at about 6.6 each letter; the whole of it in a tooltip. */
function Fitting(props: { text: string; x: number; y: number; width: number }): JSX.Element {
  const most = Math.max(3, Math.floor(props.width / 6.6));
  const letters = [...props.text];
  const shown = letters.length > most ? `${letters.slice(0, most - 1).join("")}…` : props.text;
  return (
    <text x={props.x} y={props.y} class="label">
      {shown}
      {shown === props.text ? null : <title>{props.text}</title>}
    </text>
  );
}

/** `text` stands in place of the value; `note` in the row, where there is nothing to draw. A NaN is not drawn; an interval that is infinite goes to the chart's end. */
export interface Mark {
  label: string;
  color: string;
  shape: number;
  value: number;
  lower: number;
  upper: number;
  tip: string;
  text?: string;
  note?: string;
}

/** A small sign, another one for each planner: colour is not all that tells them apart. */
function Sign(props: { shape: number; x: number; y: number; size: number; color: string }): JSX.Element {
  const { x, y, size: s, color } = props;
  const path = [
    `M${x - s},${y}a${s},${s} 0 1,0 ${2 * s},0a${s},${s} 0 1,0 ${-2 * s},0`,
    `M${x - s},${y - s}h${2 * s}v${2 * s}h${-2 * s}z`,
    `M${x},${y - 1.3 * s}L${x + 1.2 * s},${y + 0.9 * s}H${x - 1.2 * s}z`,
    `M${x},${y - 1.4 * s}L${x + 1.4 * s},${y}L${x},${y + 1.4 * s}L${x - 1.4 * s},${y}z`,
    `M${x},${y + 1.3 * s}L${x + 1.2 * s},${y - 0.9 * s}H${x - 1.2 * s}z`,
    `M${x - s},${y - s / 3}h${s * 0.67}v${-s * 0.67}h${s * 0.67}v${s * 0.67}h${s * 0.67}v${s * 0.67}h${-s * 0.67}v${s * 0.67}h${-s * 0.67}v${-s * 0.67}h${-s * 0.67}z`,
  ][props.shape % 6];
  return <path d={path} fill={color} class="sign" />;
}

/** The sign of a planner, or without one a square of an outcome's colour, beside its name. */
export function Swatch(props: { shape?: number; color: string }): JSX.Element {
  return (
    <svg width="14" height="14" aria-hidden="true">
      {props.shape === undefined ? (
        <rect x={2} y={2} width={10} height={10} rx={2} fill={props.color} />
      ) : (
        <Sign shape={props.shape} x={7} y={7} size={4.5} color={props.color} />
      )}
    </svg>
  );
}

interface Values {
  low: number;
  high: number;
  percent?: boolean;
  unit?: string;
  log?: boolean;
}

const kRow = 34;

/** A row each: its label, and beside it what `draw` makes about a middle line. */
function RowChart<Row extends { label: string; tip?: string }>(props: {
  rows: Row[];
  label: string;
  /** Of the labels: at most so many px, and such a share of the width. */
  labels: [number, number];
  right: number;
  values?: Values;
  draw: (
    row: Row,
    y: number,
    x: Scale,
    left: number,
    width: number,
    tip: (text: string) => object,
  ) => ComponentChildren;
}): JSX.Element {
  const { rows, values } = props;
  const bottom = rows.length * kRow;
  return (
    <Chart
      height={bottom + (values ? (values.unit ? 40 : 26) : 4)}
      label={props.label}
      draw={(width, tip) => {
        const left = Math.min(props.labels[0], props.labels[1] * width);
        const right = width - props.right;
        const x = (values?.log ? logScaleOf : scaleOf)(values?.low ?? 0, values?.high ?? 1, left, right);
        return (
          <>
            {values ? (
              <XAxis
                x={x}
                left={left}
                right={right}
                top={2}
                bottom={bottom}
                percent={values.percent}
                unit={values.unit}
                one={values.log}
              />
            ) : null}
            {rows.map((row, i) => {
              const y = (i + 0.5) * kRow;
              return (
                <g {...(row.tip ? tip(row.tip) : {})}>
                  <rect x={0} y={i * kRow} width={width} height={kRow} class="hit" />
                  <Fitting text={row.label} x={0} y={y + 4} width={left - 12} />
                  {props.draw(row, y, x, left, width, tip)}
                </g>
              );
            })}
          </>
        );
      }}
    />
  );
}

/** Values with their intervals, a row each. */
export function IntervalChart(props: { marks: Mark[]; values: Values; label: string; labels?: number }): JSX.Element {
  const { percent } = props.values;
  return (
    <RowChart
      rows={props.marks}
      values={props.values}
      label={props.label}
      labels={[props.labels ?? 150, 0.36]}
      right={76}
      draw={(m, y, x, left, width) => (
        <>
          {Number.isNaN(m.lower + m.upper) ? null : (
            <line
              x1={x(m.lower)}
              x2={x(m.upper)}
              y1={y}
              y2={y}
              stroke={m.color}
              stroke-width={3}
              stroke-linecap="round"
              opacity={0.55}
            />
          )}
          {Number.isFinite(m.value) ? <Sign shape={m.shape} x={x(m.value)} y={y} size={5.5} color={m.color} /> : null}
          {m.note ? <Fitting text={m.note} x={left} y={y + 4} width={width - left - 76} /> : null}
          <text x={width - 2} y={y + 4} text-anchor="end" class="value">
            {m.text ?? (percent ? `${digits(100 * m.value, 3)} %` : digits(m.value))}
          </text>
        </>
      )}
    />
  );
}

export interface Line {
  label: string;
  color: string;
  dash: string;
  shape: number;
  points: [number, number][];
  band?: [number, number, number][];
  width?: number;
  dots?: { x: number; y: number; size: number; tip: string }[];
}

/** What lies left and right of a line chart's values, px. */
const [kLeft, kRight] = [46, 12];

/** Curves with the points that they are of, those of one place `spread` px apart, bands of [x, lower, upper] about them, a level to compare with, and shaded spans of x. */
export function LineChart(props: {
  lines: Line[];
  x: [number, number];
  y: [number, number];
  xUnit?: string;
  percent?: boolean;
  label: string;
  step?: boolean;
  height?: number;
  level?: number;
  spread?: number;
  spans?: [number, number][];
}): JSX.Element {
  const height = props.height ?? 280;
  return (
    <Chart
      height={height}
      label={props.label}
      draw={(width, tip) => {
        const [left, right, top, bottom] = [kLeft, width - kRight, 10, height - (props.xUnit ? 40 : 22)];
        const x = scaleOf(props.x[0], props.x[1], left, right);
        const y = scaleOf(props.y[0], props.y[1], bottom, top);
        const path = (points: [number, number][]): string =>
          points
            .map(([px, py], i) =>
              i === 0
                ? `M${x(px).toFixed(1)},${y(py).toFixed(1)}`
                : props.step
                  ? `H${x(px).toFixed(1)}V${y(py).toFixed(1)}`
                  : `L${x(px).toFixed(1)},${y(py).toFixed(1)}`,
            )
            .join("");
        const area = (band: [number, number, number][]): string =>
          `${path(band.map(([px, , upper]) => [px, upper]))}${path(band.map(([px, lower]): [number, number] => [px, lower]).reverse()).replace("M", "L")}Z`;
        return (
          <>
            {props.spans?.map(([from, to]) => (
              <rect x={x(from)} width={Math.max(2, x(to) - x(from))} y={top} height={bottom - top} class="span" />
            ))}
            <XAxis x={x} left={left} right={right} top={top} bottom={bottom} unit={props.xUnit} />
            <YAxis y={y} left={left} right={right} percent={props.percent} count={height < 200 ? 3 : 5} />
            {props.level === undefined ? null : (
              <line x1={left} x2={right} y1={y(props.level)} y2={y(props.level)} class="level" />
            )}
            {props.lines.map((line, k) => (
              <g>
                {line.band ? <path d={area(line.band)} fill={line.color} opacity={0.1} pointer-events="none" /> : null}
                {line.points.length > 1 ? (
                  <path
                    d={path(line.points)}
                    fill="none"
                    stroke={line.color}
                    stroke-width={line.width ?? 2.2}
                    stroke-dasharray={line.dash}
                    {...tip(line.label)}
                  />
                ) : null}
                {line.dots?.map((dot) => (
                  <g {...tip(dot.tip)}>
                    <Sign
                      shape={line.shape}
                      x={x(dot.x) + (props.spread ?? 5) * (k - (props.lines.length - 1) / 2)}
                      y={y(dot.y)}
                      size={dot.size}
                      color={line.color}
                    />
                  </g>
                ))}
              </g>
            ))}
          </>
        );
      }}
    />
  );
}

/** Lines over the time of a flight, and one at the shown moment: a click or drag goes there. */
export function TimeChart(props: {
  title: string;
  unit: string;
  lines: Line[];
  time: number;
  end: number;
  seek: (t: number) => void;
  spans?: [number, number][];
}): JSX.Element {
  const { lines, end, spans } = props;
  // Not drawn again while the flight plays.
  const chart = useMemo(() => {
    let [low, high] = [0, 0.1];
    for (const line of lines)
      for (const [, v] of line.points) {
        low = Math.min(low, v);
        high = Math.max(high, v);
      }
    return (
      <LineChart
        lines={lines}
        x={[0, end]}
        y={[low, 1.05 * high]}
        height={112}
        spans={spans}
        label={`${props.title} over time`}
      />
    );
  }, [lines, end, spans]);
  const seek = (e: PointerEvent): void => {
    const box = (e.currentTarget as Element).getBoundingClientRect();
    props.seek(((e.clientX - box.left - kLeft) / (box.width - kLeft - kRight)) * end);
  };
  return (
    <div class="plot">
      <h3>
        {props.title} <span class="unit">{props.unit}</span>
      </h3>
      <div
        class="timed"
        onPointerDown={(e) => {
          e.currentTarget.setPointerCapture(e.pointerId);
          seek(e);
        }}
        onPointerMove={(e) => (e.buttons & 1 ? seek(e) : undefined)}
      >
        {chart}
        <div class="moment" style={{ left: `calc(${kLeft}px + (100% - ${kLeft + kRight}px) * ${props.time / end})` }} />
      </div>
    </div>
  );
}

export interface Box {
  label: string;
  color: string;
  shape: number;
  sorted: Float64Array;
  mean: number;
  five: number[];
  tip: string;
}

/** Distributions: 5 %, quartiles and 95 %, the mean, and single values where there are few. */
export function BoxChart(props: { boxes: Box[]; values: Values; label: string }): JSX.Element {
  const { low, high } = props.values;
  return (
    <RowChart
      rows={props.boxes}
      values={props.values}
      label={props.label}
      labels={[130, 0.33]}
      right={14}
      draw={(b, y, x, left) => {
        if (!b.sorted.length)
          return (
            <text x={left + 4} y={y + 4} class="unit">
              no values
            </text>
          );
        const [p5, q1, q2, q3, p95] = b.five.map(x);
        return (
          <>
            {b.sorted.length <= 160
              ? [...b.sorted].map((v, k) =>
                  v >= low && v <= high ? (
                    <circle cx={x(v)} cy={y + 9 * Math.sin(k * 2.399)} r={1.6} fill={b.color} opacity={0.45} />
                  ) : null,
                )
              : null}
            <line x1={p5} x2={p95} y1={y} y2={y} stroke={b.color} stroke-width={1.5} />
            <rect
              x={q1}
              width={Math.max(1, q3 - q1)}
              y={y - 8}
              height={16}
              fill={b.color}
              opacity={0.3}
              stroke={b.color}
              rx={2}
            />
            <line x1={q2} x2={q2} y1={y - 8} y2={y + 8} stroke={b.color} stroke-width={2.5} />
            <Sign shape={b.shape} x={x(b.mean)} y={y} size={4} color={b.color} />
          </>
        );
      }}
    />
  );
}

export interface Bar {
  label: string;
  parts: { name: string; color: string; count: number }[];
}

/** Counts as stacked bars, a row each; `share`: all bars equally long. */
export function BarChart(props: { bars: Bar[]; label: string; share?: boolean }): JSX.Element {
  const sumOf = (bar: Bar): number => bar.parts.reduce((sum, p) => sum + p.count, 0);
  const most = Math.max(1, ...props.bars.map(sumOf));
  return (
    <RowChart
      rows={props.bars}
      label={props.label}
      labels={props.share ? [150, 0.33] : [320, 0.5]}
      right={46}
      draw={(bar, y, x, _, width, tip) => {
        const sum = sumOf(bar);
        let before = 0;
        return (
          <>
            {bar.parts
              .filter((p) => p.count > 0)
              .map((p) => {
                const from = x(before / (props.share ? sum : most));
                before += p.count;
                const length = x(before / (props.share ? sum : most)) - from;
                return (
                  <g {...tip(`${bar.label}: ${p.count} ${p.name} (${digits((100 * p.count) / sum, 3)} %)`)}>
                    <rect x={from} y={y - 11} width={Math.max(length - 1, 0.5)} height={22} fill={p.color} rx={2} />
                    {length > 24 ? (
                      <text x={from + length / 2} y={y + 4} text-anchor="middle" class="onbar">
                        {p.count}
                      </text>
                    ) : null}
                  </g>
                );
              })}
            <text x={width - 2} y={y + 4} text-anchor="end" class="value">
              {sum}
            </text>
          </>
        );
      }}
    />
  );
}

export function Legend(props: {
  items: { label: string; color: string; shape?: number; dash?: string }[];
}): JSX.Element {
  return (
    <ul class="legend">
      {props.items.map((item) => (
        <li>
          {item.shape === undefined ? (
            <Swatch color={item.color} />
          ) : (
            <svg width="22" height="14" aria-hidden="true">
              <line
                x1={0}
                x2={22}
                y1={7}
                y2={7}
                stroke={item.color}
                stroke-width={2}
                stroke-dasharray={item.dash ?? ""}
              />
              <Sign shape={item.shape} x={11} y={7} size={4.5} color={item.color} />
            </svg>
          )}
          {item.label}
        </li>
      ))}
    </ul>
  );
}
