// Curves, and lines over the time of a flight.
import type { JSX } from "preact";
import { useMemo } from "preact/hooks";
import type { Scale, TipText } from "./chart";
import { Chart, Legend, Sign, scaleOf, shortened, XAxis, YAxis } from "./chart";
import { Save } from "./save";
import { apart } from "./stats";

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

function pathOf(points: [number, number][], x: Scale, y: Scale, step?: boolean): string {
  return points
    .map(([px, py], i) => {
      const [across, up] = [x(px).toFixed(1), y(py).toFixed(1)];
      return i === 0 ? `M${across},${up}` : step ? `H${across}V${up}` : `L${across},${up}`;
    })
    .join("");
}

/** What a curve is of, `shift` px aside. */
function Points(props: { line: Line; x: Scale; y: Scale; shift: number; tip: (text: TipText) => object }): JSX.Element {
  const { line, x, y } = props;
  return (
    <>
      {line.dots?.map((dot) => (
        <g {...props.tip(dot.tip)}>
          <Sign shape={line.shape} x={x(dot.x) + props.shift} y={y(dot.y)} size={dot.size} color={line.color} />
        </g>
      ))}
    </>
  );
}

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
  /** The curves' names stand at their ends, where there is room. */
  ends?: boolean;
}): JSX.Element {
  const height = props.height ?? 280;
  return (
    <Chart
      height={height}
      label={props.label}
      draw={(width, tip) => {
        const [left, top, bottom] = [kLeft, 10, height - (props.xUnit ? 40 : 22)];
        const room = props.ends ? roomOfEnds(props.lines, width, bottom - top) : 0;
        const right = width - kRight - room;
        const x = scaleOf(props.x[0], props.x[1], left, right);
        const y = scaleOf(props.y[0], props.y[1], bottom, top);
        const path = (points: [number, number][]): string => pathOf(points, x, y, props.step);
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
                <Points
                  line={line}
                  x={x}
                  y={y}
                  shift={(props.spread ?? 5) * (k - (props.lines.length - 1) / 2)}
                  tip={tip}
                />
              </g>
            ))}
            {room ? (
              <Ends
                lines={props.lines}
                at={props.lines.map(({ points }) => {
                  const [px, py] = points[points.length - 1] ?? [NaN, NaN];
                  return [x(px), y(py)];
                })}
                right={right}
                room={room}
                ends={[top, bottom]}
              />
            ) : null}
          </>
        );
      }}
    />
  );
}

const kLetter = 14;

/** How much room the names take right of the curves: none where they would not fit. */
function roomOfEnds(lines: Line[], width: number, height: number): number {
  const drawn = lines.filter((line) => line.points.length > 1);
  const longest = Math.max(0, ...drawn.map((line) => line.label.length));
  return width < 480 || drawn.length < 2 || drawn.length * kLetter > height ? 0 : 16 + 6.6 * Math.min(longest, 22);
}

/** The names of curves at their ends, pushed apart, each with a line to its own. */
function Ends(props: {
  lines: Line[];
  at: [number, number][];
  right: number;
  room: number;
  ends: [number, number];
}): JSX.Element {
  const { lines, at, right } = props;
  const drawn = [...lines.keys()].filter((i) => lines[i].points.length > 1);
  const places = apart(
    drawn.map((i) => at[i][1]),
    kLetter,
    ...props.ends,
  );
  return (
    <g aria-hidden="true">
      {drawn.map((i, k) => (
        <>
          <path
            d={`M${at[i][0]},${at[i][1]}H${right}L${right + 10},${places[k]}`}
            fill="none"
            stroke={lines[i].color}
            stroke-width={1}
            stroke-dasharray="2 2"
          />
          <text x={right + 13} y={places[k] + 4} class="end">
            {shortened(lines[i].label, props.room - 10)}
          </text>
        </>
      ))}
    </g>
  );
}

/** Lines over the time of a flight, and one at the shown moment: a click or drag goes there. */
export function TimeChart(props: {
  /** Of the flight, in the names of saved files. */
  name: string;
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
      <div class="head">
        <h3>
          {props.title} <span class="unit">{props.unit}</span>
        </h3>
        <Save
          chart
          name={`${props.name} ${props.title}`}
          table={() => ({
            head: ["flight", "time, s", `${props.title.toLowerCase()}, ${props.unit}`],
            rows: lines.flatMap((line) => line.points.map(([t, v]) => [line.label, t, v])),
          })}
        />
      </div>
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
      {/* Only in files: on the page the list of flights says it for all charts. */}
      <Legend class="saved" items={lines} />
    </div>
  );
}
