// The table of trials: only the rows that are seen are made, so that ten thousand scroll.
import type { JSX } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { Swatch } from "./chart";
import type { Sweep } from "./data";
import { digits, metricWords, outcomeColor, outcomeText, plannerColor } from "./data";
import { usePaper } from "./paper";
import { Save, shortest } from "./save";
import type { View } from "./state";

const kRow = 32;
const kMostOnPaper = 2000;

interface Column {
  id: string;
  title: string;
  unit?: string;
  number?: boolean;
  width: number;
  value: (i: number) => number | string | null;
  cell?: (i: number) => JSX.Element;
}

function columnsOf(sweep: Sweep): Column[] {
  const t = sweep.t;
  const all: Column[] = [
    { id: "id", title: "trial", number: true, width: 64, value: (i) => t.id[i] },
    {
      id: "planner",
      title: "planner",
      width: 150,
      value: (i) => sweep.planners[t.planner[i]].label,
      cell: (i) => (
        <span class="with-sign">
          <Swatch shape={t.planner[i]} color={plannerColor(t.planner[i])} />
          {sweep.planners[t.planner[i]].label}
        </span>
      ),
    },
    { id: "map", title: "map", width: 210, value: (i) => sweep.maps[t.map[i]].text },
    { id: "mission", title: "mission", number: true, width: 74, value: (i) => t.mission[i] },
    {
      id: "outcome",
      title: "outcome",
      width: 132,
      value: (i) => outcomeText(sweep.outcomes[t.outcome[i]]),
      cell: (i) => (
        <span class="with-sign">
          <Swatch color={outcomeColor(t.outcome[i])} />
          {outcomeText(sweep.outcomes[t.outcome[i]])}
        </span>
      ),
    },
    { id: "end_s", title: "end", unit: "s", number: true, width: 76, value: (i) => t.end_s[i] },
  ];
  for (const axis of t.axes) {
    if (axis.field === "map_seed") continue; // the map's words have it
    const number = axis.words.every((w) => typeof w === "number");
    all.push({
      id: axis.field,
      title: axis.field,
      number,
      width: Math.max(130, 40 + 7.4 * axis.field.length),
      value: (i) => axis.words[axis.of[i]],
    });
  }
  const why = t.cause ?? t.reason;
  all.push({
    id: "reason",
    title: t.cause ? "cause" : "reason",
    width: 330,
    value: (i) => why.words[why.of[i]] || (t.reason.words[t.reason.of[i]] as string),
  });
  for (const name of sweep.usual_metrics) {
    const at = sweep.metrics.findIndex((m) => m.name === name);
    all.push({
      id: name,
      title: metricWords(name),
      unit: sweep.metrics[at].unit,
      number: true,
      width: 40 + 7.4 * (metricWords(name).length + sweep.metrics[at].unit.length),
      value: (i) => t.metrics[at][i],
    });
  }
  return all;
}

/** All trials; what has no value comes last, whichever way. */
function sorted(count: number, column: Column, down: boolean): Int32Array {
  const values = Array.from({ length: count }, (_, i) => column.value(i));
  const none = (v: number | string | null): boolean =>
    v === null || v === "" || (typeof v === "number" && Number.isNaN(v));
  return Int32Array.from(values.keys()).sort((a, b) => {
    const x = values[a];
    const y = values[b];
    if (none(x) || none(y)) return Number(none(x)) - Number(none(y)) || a - b;
    const [u, v] = typeof x === "number" && typeof y === "number" ? [x, y] : [String(x), String(y)];
    const order = Number(u > v) - Number(u < v);
    return (down ? -order : order) || a - b;
  });
}

/** Those of `order` that are chosen: a filter need not sort again. */
function chosenOf(order: Int32Array, chosen: Int32Array): Int32Array {
  const isChosen = new Uint8Array(order.length);
  for (const i of chosen) isChosen[i] = 1;
  return order.filter((i) => isChosen[i] === 1);
}

/** The chosen trials in the table's order. */
export function useOrder(sweep: Sweep, chosen: Int32Array, view: View): { columns: Column[]; order: Int32Array } {
  const columns = useMemo(() => columnsOf(sweep), [sweep]);
  const column = columns.find((c) => c.id === view.sort) ?? columns[0];
  const all = useMemo(() => sorted(sweep.t.count, column, view.down), [sweep, column, view.down]);
  const order = useMemo(() => chosenOf(all, chosen), [all, chosen]);
  return { columns, order };
}

export function TrialTable(props: {
  sweep: Sweep;
  columns: Column[];
  order: Int32Array;
  view: View;
  change: (part: Partial<View>) => void;
  open: (trial: number) => void;
}): JSX.Element {
  const { sweep, columns, order, view, change, open } = props;
  const column = columns.find((c) => c.id === view.sort) ?? columns[0];
  const paper = usePaper();
  const box = useRef<HTMLDivElement>(null);
  const [top, setTop] = useState(0);
  const [height, setHeight] = useState(600);
  const [focus, setFocus] = useState(0);
  // Keys may come faster than the table is drawn.
  const focused = useRef(0);
  const wanted = useRef(false);
  useEffect(() => {
    const measure = (): void => setHeight(box.current?.clientHeight ?? 600);
    measure();
    window.addEventListener("resize", measure);
    return () => window.removeEventListener("resize", measure);
  }, []);
  useEffect(() => {
    // Where it is there already, asking the browser would make it lay out the page at once.
    if (box.current && top > 0) box.current.scrollTop = 0;
    setTop(0);
    setFocus(0);
    focused.current = 0;
  }, [order]);
  useEffect(() => {
    if (!wanted.current) return;
    // The row of the last key, which may be drawn only by the next turn.
    const row = box.current?.querySelector<HTMLElement>(`[data-place="${focused.current}"]`);
    if (!row) return;
    wanted.current = false;
    row.focus({ preventScroll: true });
  });
  const first = paper ? 0 : Math.max(0, Math.floor(top / kRow) - 8);
  const last = Math.min(order.length, paper ? kMostOnPaper : Math.ceil((top + height) / kRow) + 8);
  const go = (place: number): void => {
    const to = Math.min(Math.max(place, 0), order.length - 1);
    wanted.current = true;
    focused.current = to;
    setFocus(to);
    const element = box.current;
    const head = 40;
    if (!element) return;
    if (to * kRow < element.scrollTop) element.scrollTop = to * kRow;
    else if ((to + 1) * kRow > element.scrollTop + element.clientHeight - head)
      element.scrollTop = (to + 1) * kRow - element.clientHeight + head;
    setTop(element.scrollTop);
  };
  const keys = (e: KeyboardEvent): void => {
    const page = Math.max(1, Math.floor(height / kRow) - 2);
    const at = focused.current;
    const moves: Record<string, number> = {
      ArrowDown: at + 1,
      ArrowUp: at - 1,
      PageDown: at + page,
      PageUp: at - page,
      Home: 0,
      End: order.length - 1,
    };
    if (e.key in moves) {
      e.preventDefault();
      go(moves[e.key]);
    }
    if (e.key === "Enter" && order.length) {
      e.preventDefault();
      open(order[at]);
    }
  };
  const width = columns.reduce((sum, c) => sum + c.width, 40);
  return (
    <section aria-label="Trials" class="trials">
      <div class="head">
        <p class="note" aria-live="polite">
          {order.length} of {sweep.t.count} trials. A click or Enter opens a flight; ▶ marks those that are in this
          page.
        </p>
        <Save
          name="trials"
          table={() => ({
            head: ["key", ...columns.map((c) => c.id)],
            rows: Array.from(order, (i) => [sweep.t.key[i], ...columns.map((c) => shortest(c.value(i)))]),
          })}
        />
      </div>
      {paper && last < order.length ? (
        <p class="note">
          The first {last} of {order.length} trials; CSV has all.
        </p>
      ) : null}
      <div class="table" ref={box} onScroll={(e) => setTop(e.currentTarget.scrollTop)} tabIndex={-1}>
        <table
          role="grid"
          aria-rowcount={order.length + 1}
          aria-label="Trials"
          style={paper ? "" : { width: `${width}px` }}
        >
          <thead>
            <tr aria-rowindex={1}>
              <th scope="col" style={paper ? "" : { width: "40px" }}>
                <span class="hidden">flight</span>
              </th>
              {columns.map((c) => (
                <th
                  scope="col"
                  style={paper ? "" : { width: `${c.width}px` }}
                  aria-sort={c === column ? (view.down ? "descending" : "ascending") : "none"}
                >
                  <button onClick={() => change({ sort: c.id, down: c === column ? !view.down : false })}>
                    {c.title}
                    {c.unit ? <span class="unit"> {c.unit}</span> : null}
                    <span aria-hidden="true">{c === column ? (view.down ? " ▼" : " ▲") : ""}</span>
                  </button>
                </th>
              ))}
            </tr>
          </thead>
          <tbody onKeyDown={keys}>
            {first > 0 ? <tr aria-hidden="true" style={{ height: `${first * kRow}px` }} /> : null}
            {Array.from(order.slice(first, last), (i, k) => {
              const place = first + k;
              return (
                <tr
                  key={i}
                  aria-rowindex={place + 2}
                  data-place={place}
                  data-trial={sweep.t.key[i]}
                  class={sweep.t.flight[i] >= 0 ? "has-flight" : ""}
                  tabIndex={place === focus ? 0 : -1}
                  onFocus={() => {
                    if (!wanted.current) {
                      focused.current = place;
                      setFocus(place);
                    }
                  }}
                  onClick={() => open(i)}
                  style={paper ? "" : { height: `${kRow}px` }}
                >
                  <td class="play">{sweep.t.flight[i] >= 0 ? "▶" : ""}</td>
                  {columns.map((c) => {
                    const value = c.value(i);
                    const isReal = c.number && typeof value === "number" && !Number.isInteger(value);
                    const text = isReal || value === null ? digits(value as number | null) : String(value);
                    return (
                      <td class={c.number ? "number" : ""} title={!c.number && text.length > 24 ? text : undefined}>
                        {c.cell ? c.cell(i) : text}
                      </td>
                    );
                  })}
                </tr>
              );
            })}
            {last < order.length && !paper ? (
              <tr aria-hidden="true" style={{ height: `${(order.length - last) * kRow}px` }} />
            ) : null}
          </tbody>
        </table>
      </div>
    </section>
  );
}
