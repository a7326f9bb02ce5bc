// What the overview shows of all trials, whatever the filters say: limits, contrast factors, the report's tables.
import type { JSX } from "preact";
import { Legend, Name } from "./chart";
import type { Mark } from "./charts";
import { IntervalChart } from "./charts";
import type { Cell, ReportTable, Sweep } from "./data";
import { digits, limitValue, lookOf, percent } from "./data";
import { Figure, ScrollTable } from "./figure";
import type { Line } from "./lines";
import { LineChart } from "./lines";

interface Props {
  sweep: Sweep;
  chosen: Int32Array;
}

/** A table's cells by the name of their column. */
export function columnsOf(table: ReportTable): (cells: Cell[], name: string, place?: number) => Cell {
  const at = new Map(table.columns.map((c, i): [string, number] => [c.name, i]));
  return (cells, name, place = 0) => cells[(at.get(name) ?? -1) + place] ?? null;
}

export const number = (cell: Cell): number =>
  typeof cell === "number" ? cell : cell === "inf" ? Infinity : cell === "-inf" ? -Infinity : NaN;

/** How far each planner goes, and the curves that say so. */
export function Limits({ sweep, chosen }: Props): JSX.Element | null {
  const rule = sweep.limit;
  const [limits, curve] = ["limits", "limit_curve"].map((name) => sweep.tables.find((t) => t.name === name));
  if (!rule || !limits || !curve) return null;
  const hidden = chosen.length !== sweep.t.count;
  const [ofLimit, ofCurve] = [columnsOf(limits), columnsOf(curve)];
  const found = limits.rows.map(({ cells }) => {
    const [value, lower, upper] = [0, 1, 2].map((place) => number(ofLimit(cells, "limit", place)));
    return {
      look: lookOf(
        sweep.planners.findIndex((p) => p.label === cells[0]),
        String(cells[0]),
      ),
      value,
      lower,
      upper,
      state: String(ofLimit(cells, "state")),
      trials: number(ofLimit(cells, "trial_count")),
    };
  });
  const marks: Mark[] = found.map((f) => ({
    ...f.look,
    value: f.value,
    lower: f.lower,
    upper: f.upper,
    text: Number.isFinite(f.value)
      ? undefined
      : Number.isNaN(f.value)
        ? ""
        : f.value > 0
          ? `> ${digits(rule.high)}`
          : `< ${digits(rule.low)}`,
    note: Number.isNaN(f.value) ? f.state : undefined,
    tip: `${f.look.label}: ${Number.isNaN(f.value) ? "" : `${limitValue(rule, f.value)}, 95 % interval ${digits(f.lower)} to ${digits(f.upper)}; `}${f.state}; ${f.trials} trials`,
  }));
  const lines: Line[] = found.map((f) => {
    const rows = curve.rows
      .filter(({ cells }) => cells[0] === f.look.label)
      .map(({ cells }) => ({
        x: number(ofCurve(cells, "value")),
        rate: [0, 1, 2].map((place) => number(ofCurve(cells, "fitted_rate", place))),
        trials: number(ofCurve(cells, "trial_count")),
        finished: number(ofCurve(cells, "finished_count")),
      }));
    return {
      ...f.look,
      points: rows.map((r): [number, number] => [r.x, r.rate[0]]),
      band: rows.map((r): [number, number, number] => [r.x, r.rate[1], r.rate[2]]),
      dots: rows
        .filter((r) => r.trials > 0)
        .map((r) => ({
          x: r.x,
          y: r.finished / r.trials,
          size: Math.min(6, 1.5 + Math.sqrt(r.trials) / 1.6),
          tip: `${f.look.label} at ${limitValue(rule, r.x)}: ${r.finished} of ${r.trials} reached the goal; fitted ${percent(r.rate[0])}`,
        })),
    };
  });
  const name = rule.field.slice(rule.field.indexOf(".") + 1);
  return (
    <>
      <Figure
        name="limit curves"
        wide
        hidden={hidden}
        title={`Success as ${name} changes`}
        note={`Curves are fitted, with 95 % bands; signs are trials at one value, larger where there are more. The dashed line is at ${Number((100 * rule.success_rate).toPrecision(4))} %. Of all trials.`}
        numbers={{
          head: ["planner", name, "finished", "trials", "fitted rate", "lower", "upper"],
          rows: curve.rows.map(({ cells }) => [
            String(cells[0]),
            number(ofCurve(cells, "value")),
            number(ofCurve(cells, "finished_count")),
            number(ofCurve(cells, "trial_count")),
            ...[0, 1, 2].map((place) => number(ofCurve(cells, "fitted_rate", place))),
          ]),
        }}
      >
        <Legend items={lines} />
        <LineChart
          lines={lines}
          x={[rule.low, rule.high]}
          y={[0, 1]}
          percent
          ends
          spread={0}
          level={rule.success_rate}
          xUnit={`${name}${rule.unit ? `, ${rule.unit}` : ""}`}
          label="Fitted rates of success along the range, by planner; their numbers are in the table below"
        />
      </Figure>
      <Figure
        name="limits"
        hidden={hidden}
        title={limits.title}
        note="With 95 % intervals; a line to the chart’s end continues beyond it. Of all trials."
        numbers={{
          head: ["planner", "limit", "lower", "upper", "state", "trials"],
          rows: found.map((f) => [
            f.look.label,
            ...[f.value, f.lower, f.upper].map((v) => (Number.isFinite(v) ? v : null)),
            f.state,
            f.trials,
          ]),
        }}
      >
        <IntervalChart
          marks={marks}
          values={{ low: rule.low, high: rule.high, unit: rule.unit || name }}
          label={`Limits by planner: ${marks.map((m) => m.tip).join("; ")}`}
        />
      </Figure>
    </>
  );
}

export function Contrasts({ sweep, chosen }: Props): JSX.Element | null {
  const table = sweep.tables.find((t) => t.name === "pairs");
  if (!table) return null;
  const of = columnsOf(table);
  const pairs: Mark[] = table.rows.map(({ cells }) => {
    const label = `${String(of(cells, "planner"))} / ${String(of(cells, "other_planner"))}`;
    const [value, lower, upper] = [0, 1, 2].map((place) => number(of(cells, "contrast_factor_smoothed", place)));
    const tip = `${label}: ${digits(value)} [${digits(lower)}, ${digits(upper)}]`;
    return { label, color: "var(--ink)", shape: 3, value, lower, upper, tip };
  });
  const ends = pairs.flatMap((p) => [p.value, p.lower, p.upper]).filter((v) => Number.isFinite(v) && v > 0);
  if (!ends.length) return null;
  return (
    <Figure
      name="contrasts"
      hidden={chosen.length !== sweep.t.count}
      title="Contrast factors"
      note="Failures per metre of the first planner over those of the second, smoothed: left of 1 the first is better. Of all trials."
      numbers={{
        head: ["pair", "contrast factor, smoothed", "lower", "upper"],
        rows: pairs.map((p) => [p.label, p.value, p.lower, p.upper].map((v) => (Number.isNaN(v) ? null : v))),
      }}
    >
      <IntervalChart
        marks={pairs}
        values={{ low: Math.min(0.5, ...ends), high: Math.max(2, ...ends), log: true }}
        labels={190}
        label="Contrast factors of pairs of planners; their numbers are in the table below"
      />
    </Figure>
  );
}

const cellText = (cell: Cell, decimals: number): string => {
  if (cell === null) return "–";
  if (typeof cell === "string") return cell === "inf" ? "∞" : cell === "-inf" ? "−∞" : cell;
  if (decimals >= 0 && !Number.isInteger(cell)) return cell.toFixed(decimals);
  return Number.isInteger(cell) ? String(cell) : digits(cell);
};

/** A table of the report as it is; numbers with all their digits as a data attribute and on hover. */
export function Report({ table, open }: { table: ReportTable; open?: boolean }): JSX.Element {
  const columns = table.columns
    .map((c, i) => ({ ...c, i }))
    .filter((c) => c.place !== "machine" && c.place !== "bound");
  const bounds = (i: number): boolean =>
    table.columns[i + 1]?.place === "bound" && table.columns[i + 2]?.place === "bound";
  return (
    <details class="report" data-table={table.name} open={open || table.name === "planners" || table.name === "limits"}>
      <summary>
        {table.title || table.name} <span class="count">{table.rows.length} rows</span>
      </summary>
      <ScrollTable
        label={table.title || table.name}
        right={columns.map((c) => table.rows.some((row) => typeof row.cells[c.i] === "number"))}
        table={() => ({ head: table.columns.map((c) => c.name), rows: table.rows.map((row) => row.cells) })}
        head={columns.map((c) => (
          <span title={c.doc || c.name}>
            {c.header}
            {c.unit ? <span class="unit"> {c.unit}</span> : null}
          </span>
        ))}
      >
        {table.rows.map((row) => (
          <tr>
            {columns.map((c) => {
              const cell = row.cells[c.i];
              const isNumber = typeof cell === "number";
              const text = cellText(cell, c.decimals);
              return (
                <td
                  class={isNumber ? "number" : ""}
                  data-column={c.name}
                  data-value={cell === null ? "" : String(cell)}
                  title={isNumber ? String(cell) : undefined}
                >
                  {row.best.includes(c.i) ? <strong>{text}*</strong> : c.place === "key" ? <Name text={text} /> : text}
                  {bounds(c.i) && (row.cells[c.i + 1] !== null || row.cells[c.i + 2] !== null) ? (
                    <span class="bounds">
                      {" "}
                      [{cellText(row.cells[c.i + 1], c.decimals)}, {cellText(row.cells[c.i + 2], c.decimals)}]
                    </span>
                  ) : null}
                </td>
              );
            })}
          </tr>
        ))}
      </ScrollTable>
    </details>
  );
}
