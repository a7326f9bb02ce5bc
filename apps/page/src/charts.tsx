// Charts as SVG, each with its numbers as a table.
import type { ComponentChildren, JSX } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { digits } from "./data";
import { ticks } from "./stats";

export interface NumberTable {
  head: string[];
  rows: (string | number | null)[][];
}

/** A number with all its digits for whoever asks, and a few to see. */
function NumberCell({ value }: { value: string | number | null }): JSX.Element {
  if (typeof value === "string") return <td>{value}</td>;
  const has = value !== null && !Number.isNaN(value);
  return (
    <td class="number" data-value={has ? String(value) : ""}>
      {Number.isInteger(value) ? String(value) : digits(value, 4)}
    </td>
  );
}

/** `hidden`: there, but not shown, which costs less than to make it anew. */
export function Figure(props: {
  title: string;
  note?: string;
  name: string;
  numbers: NumberTable;
  wide?: boolean;
  hidden?: boolean;
  children: ComponentChildren;
}): JSX.Element {
  // Thousands of cells are made when someone looks.
  const [open, setOpen] = useState(false);
  useEffect(() => {
    const show = (): void => setOpen(true);
    window.addEventListener("beforeprint", show);
    return () => window.removeEventListener("beforeprint", show);
  }, []);
  return (
    <figure class={props.wide ? "wide" : ""} data-figure={props.name} hidden={props.hidden}>
      <figcaption>
        <h3>{props.title}</h3>
        {props.note ? <p class="note">{props.note}</p> : null}
      </figcaption>
      {props.children}
      <details open={open} onToggle={(e) => setOpen((e.currentTarget as HTMLDetailsElement).open)}>
        <summary>Numbers</summary>
        {open ? (
          <div class="scroll" tabIndex={0} role="region" aria-label={`Numbers of ${props.title}`}>
            <table>
              <thead>
                <tr>
                  {props.numbers.head.map((h) => (
                    <th scope="col">{h}</th>
                  ))}
                </tr>
              </thead>
              <tbody>
                {props.numbers.rows.map((row) => (
                  <tr>
                    {row.map((c) => (
                      <NumberCell value={c} />
                    ))}
                  </tr>
                ))}
              </tbody>
            </table>
          </div>
        ) : null}
      </details>
    </figure>
  );
}

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
export function Chart(props: {
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

export interface Scale {
  (value: number): number;
  low: number;
  high: number;
}
export function scaleOf(low: number, high: number, from: number, to: number): Scale {
  const span = high > low ? high - low : 1;
  return Object.assign((v: number) => from + ((v - low) / span) * (to - from), { low, high });
}

/** Vertical grid lines with numbers below. */
export function XAxis(props: {
  x: Scale;
  top: number;
  bottom: number;
  count?: number;
  unit?: string;
  percent?: boolean;
}): JSX.Element {
  const { x, top, bottom } = props;
  return (
    <g class="axis" aria-hidden="true">
      {ticks(x.low, x.high, props.count ?? 5).map((v) => (
        <>
          <line x1={x(v)} x2={x(v)} y1={top} y2={bottom} class="grid" />
          <text x={x(v)} y={bottom + 14} text-anchor="middle">
            {props.percent ? `${Math.round(100 * v)} %` : shortNumber(v)}
          </text>
        </>
      ))}
      {props.unit ? (
        <text x={(x(x.low) + x(x.high)) / 2} y={bottom + 29} text-anchor="middle" class="unit">
          {props.unit}
        </text>
      ) : null}
    </g>
  );
}
export function YAxis(props: {
  y: Scale;
  left: number;
  right: number;
  count?: number;
  percent?: boolean;
}): JSX.Element {
  const { y, left, right } = props;
  return (
    <g class="axis" aria-hidden="true">
      {ticks(y.low, y.high, props.count ?? 4).map((v) => (
        <>
          <line x1={left} x2={right} y1={y(v)} y2={y(v)} class="grid" />
          <text x={left - 6} y={y(v) + 4} text-anchor="end">
            {props.percent ? `${Math.round(100 * v)} %` : shortNumber(v)}
          </text>
        </>
      ))}
    </g>
  );
}
const shortNumber = (v: number): string =>
  (Math.abs(v) >= 10000 ? `${Number((v / 1000).toPrecision(3))}k` : String(Number(v.toPrecision(6)))).replace("-", "−");

/** Text that fits so many pixels, at about 6.6 each letter; the whole of it in a tooltip. */
export function Fitting(props: { text: string; x: number; y: number; width: number; anchor?: string }): JSX.Element {
  const most = Math.max(3, Math.floor(props.width / 6.6));
  const letters = [...props.text];
  const shown = letters.length > most ? `${letters.slice(0, most - 1).join("")}…` : props.text;
  return (
    <text x={props.x} y={props.y} text-anchor={props.anchor ?? "start"} class="label">
      {shown}
      {shown === props.text ? null : <title>{props.text}</title>}
    </text>
  );
}

/** `text` stands in place of the value; `note` in the row, where there is nothing to draw. */
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
export function Sign(props: { shape: number; x: number; y: number; size: number; color: string }): JSX.Element {
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

/** Values with their intervals, a row each. */
export function IntervalChart(props: {
  marks: Mark[];
  low: number;
  high: number;
  percent?: boolean;
  unit?: string;
  label: string;
}): JSX.Element {
  const row = 34;
  const height = props.marks.length * row + (props.unit ? 40 : 26);
  return (
    <Chart
      height={height}
      label={props.label}
      draw={(width, tip) => {
        const left = Math.min(150, width * 0.33);
        const x = scaleOf(props.low, props.high, left, width - 76);
        return (
          <>
            <XAxis
              x={x}
              top={4}
              bottom={props.marks.length * row}
              percent={props.percent}
              unit={props.unit}
              count={width < 420 ? 3 : 5}
            />
            {props.marks.map((m, i) => {
              const y = i * row + row / 2;
              const shown = Number.isFinite(m.value);
              return (
                <g {...tip(m.tip)}>
                  <rect x={0} y={i * row} width={width} height={row} class="hit" />
                  <Fitting text={m.label} x={0} y={y + 4} width={left - 12} />
                  {Number.isFinite(m.lower) ? (
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
                  ) : null}
                  {shown ? <Sign shape={m.shape} x={x(m.value)} y={y} size={5.5} color={m.color} /> : null}
                  {m.note ? <Fitting text={m.note} x={left} y={y + 4} width={width - left - 76} /> : null}
                  <text x={width - 2} y={y + 4} text-anchor="end" class="value">
                    {m.text ?? (props.percent ? `${digits(100 * m.value, 3)} %` : digits(m.value))}
                  </text>
                </g>
              );
            })}
          </>
        );
      }}
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
  dots: { x: number; y: number; size: number; tip: string }[];
}

/** Curves with the points that they are of, those of one place `spread` px apart, bands of [x, lower, upper] about them, and a level to compare with. */
export function LineChart(props: {
  lines: Line[];
  x: [number, number];
  y: [number, number];
  xUnit: string;
  percent?: boolean;
  label: string;
  step?: boolean;
  height?: number;
  level?: number;
  spread?: number;
}): JSX.Element {
  const height = props.height ?? 280;
  return (
    <Chart
      height={height}
      label={props.label}
      draw={(width, tip) => {
        const [left, right, top, bottom] = [46, width - 12, 10, height - 40];
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
            <XAxis x={x} top={top} bottom={bottom} unit={props.xUnit} count={width < 420 ? 4 : 7} />
            <YAxis y={y} left={left} right={right} percent={props.percent} count={5} />
            {props.level === undefined ? null : (
              <line
                x1={left}
                x2={right}
                y1={y(props.level)}
                y2={y(props.level)}
                class="interval"
                stroke-dasharray="4 4"
              />
            )}
            {props.lines.map((line, k) => (
              <g>
                {line.band ? <path d={area(line.band)} fill={line.color} opacity={0.1} pointer-events="none" /> : null}
                {line.points.length > 1 ? (
                  <path
                    d={path(line.points)}
                    fill="none"
                    stroke={line.color}
                    stroke-width={2.2}
                    stroke-dasharray={line.dash}
                    {...tip(line.label)}
                  />
                ) : null}
                {line.dots.map((dot) => (
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
export function BoxChart(props: { boxes: Box[]; low: number; high: number; unit: string; label: string }): JSX.Element {
  const row = 36;
  const height = props.boxes.length * row + 40;
  return (
    <Chart
      height={height}
      label={props.label}
      draw={(width, tip) => {
        const left = Math.min(130, width * 0.33);
        const x = scaleOf(props.low, props.high, left, width - 14);
        const inside = (v: number): number => x(Math.min(Math.max(v, props.low), props.high));
        return (
          <>
            <XAxis x={x} top={2} bottom={props.boxes.length * row} unit={props.unit} count={4} />
            {props.boxes.map((b, i) => {
              const y = i * row + row / 2;
              const [p5, q1, q2, q3, p95] = b.five;
              return (
                <g {...tip(b.tip)}>
                  <rect x={0} y={i * row} width={width} height={row} class="hit" />
                  <Fitting text={b.label} x={0} y={y + 4} width={left - 12} />
                  {b.sorted.length ? (
                    <>
                      {b.sorted.length <= 160
                        ? [...b.sorted].map((v, k) =>
                            v >= props.low && v <= props.high ? (
                              <circle
                                cx={x(v)}
                                cy={y + 9 * Math.sin(k * 2.399)}
                                r={1.6}
                                fill={b.color}
                                opacity={0.45}
                              />
                            ) : null,
                          )
                        : null}
                      <line x1={inside(p5)} x2={inside(p95)} y1={y} y2={y} stroke={b.color} stroke-width={1.5} />
                      <rect
                        x={inside(q1)}
                        width={Math.max(1, inside(q3) - inside(q1))}
                        y={y - 8}
                        height={16}
                        fill={b.color}
                        opacity={0.3}
                        stroke={b.color}
                        rx={2}
                      />
                      <line x1={inside(q2)} x2={inside(q2)} y1={y - 8} y2={y + 8} stroke={b.color} stroke-width={2.5} />
                      <Sign shape={b.shape} x={inside(b.mean)} y={y} size={4} color={b.color} />
                    </>
                  ) : (
                    <text x={left + 4} y={y + 4} class="unit">
                      no values
                    </text>
                  )}
                </g>
              );
            })}
          </>
        );
      }}
    />
  );
}

export interface Bar {
  label: string;
  parts: { name: string; color: string; count: number }[];
  onClick?: () => void;
}

/** Counts as stacked bars, a row each; `share`: all bars equally long. */
export function BarChart(props: { bars: Bar[]; label: string; share?: boolean }): JSX.Element {
  const row = 32;
  const sums = props.bars.map((b) => b.parts.reduce((sum, p) => sum + p.count, 0));
  const most = Math.max(1, ...sums);
  return (
    <Chart
      height={props.bars.length * row + 4}
      label={props.label}
      draw={(width, tip) => {
        const left = props.share ? Math.min(150, width * 0.33) : Math.min(320, width * 0.5);
        return props.bars.map((bar, i) => {
          const full = width - left - 46;
          let at = left;
          return (
            <g>
              <Fitting text={bar.label} x={0} y={i * row + 20} width={left - 10} />
              {bar.parts
                .filter((p) => p.count > 0)
                .map((p) => {
                  const length = (full * p.count) / (props.share ? sums[i] || 1 : most);
                  const from = at;
                  at += length;
                  return (
                    <g
                      {...tip(`${bar.label}: ${p.count} ${p.name} (${digits((100 * p.count) / (sums[i] || 1), 3)} %)`)}
                    >
                      <rect
                        x={from}
                        y={i * row + 5}
                        width={Math.max(length - 1, 0.5)}
                        height={row - 10}
                        fill={p.color}
                        rx={2}
                      />
                      {length > 24 ? (
                        <text x={from + length / 2} y={i * row + 20} text-anchor="middle" class="onbar">
                          {p.count}
                        </text>
                      ) : null}
                    </g>
                  );
                })}
              <text x={width - 2} y={i * row + 20} text-anchor="end" class="value">
                {sums[i]}
              </text>
            </g>
          );
        });
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
          <svg width="22" height="14" aria-hidden="true">
            {item.shape === undefined ? (
              <rect x={3} y={1} width={15} height={12} rx={2} fill={item.color} />
            ) : (
              <>
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
              </>
            )}
          </svg>
          {item.label}
        </li>
      ))}
    </ul>
  );
}
