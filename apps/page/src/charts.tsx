// Charts of a row each: intervals, distributions, stacked bars.
import type { ComponentChildren, JSX } from "preact";
import type { Scale } from "./chart";
import { Chart, Fitting, logScaleOf, Sign, scaleOf, XAxis } from "./chart";
import { digits } from "./data";

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
  /** Within it a value makes no difference. */
  band?: [number, number];
}

interface Values {
  low: number;
  high: number;
  percent?: boolean;
  unit?: string;
  log?: boolean;
  /** A value whose line stands out; of logarithms 1. */
  origin?: number;
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
                origin={values.log ? 1 : values.origin}
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
          {m.band ? (
            <rect x={x(m.band[0])} width={x(m.band[1]) - x(m.band[0])} y={y - 12} height={24} class="indifferent" />
          ) : null}
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
