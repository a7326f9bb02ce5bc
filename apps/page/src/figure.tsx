// A chart with its title and its numbers, and tables that scroll.
import type { ComponentChildren, JSX } from "preact";
import { useState } from "preact/hooks";
import { Name } from "./chart";
import { digits } from "./data";
import { usePaper } from "./paper";
import type { NumberTable } from "./save";
import { Save } from "./save";

/** Rows of numbers that are shown below a chart, and how many may be shown unasked on paper. */
const [kMostRows, kMostOnPaper] = [500, 16];

/** A number with all its digits for whoever asks, and a few to see. */
function NumberCell({ value }: { value: string | number | null }): JSX.Element {
  if (typeof value === "string")
    return (
      <td>
        <Name text={value} />
      </td>
    );
  const has = value !== null && !Number.isNaN(value);
  return (
    <td class="number" data-value={has ? String(value) : ""}>
      {Number.isInteger(value) ? String(value) : digits(value, usePaper() ? 3 : 4)}
    </td>
  );
}

/** A table that scrolls within its place. */
export function ScrollTable(props: {
  label: string;
  head: ComponentChildren[];
  /** Columns of numbers, which stand right. */
  right?: boolean[];
  children: ComponentChildren;
  class?: string;
  /** The buttons that save it stand elsewhere. */
  unsaved?: boolean;
  table?: () => NumberTable;
}): JSX.Element {
  const scrolling = (
    <div class={`scroll ${props.class ?? ""}`} tabIndex={0} role="region" aria-label={props.label}>
      <table>
        <thead>
          <tr>
            {props.head.map((h, i) => (
              <th scope="col" class={props.right?.[i] ? "number" : ""}>
                {h}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>{props.children}</tbody>
      </table>
    </div>
  );
  if (props.unsaved) return scrolling;
  return (
    <div class="with-save">
      {scrolling}
      <Save name={props.label} table={props.table} />
    </div>
  );
}

/** `hidden`: there, but not shown, which costs less than to make it again. */
export function Figure(props: {
  title: string;
  note?: string;
  name: string;
  /** A function where they are many: called when someone looks. */
  numbers: NumberTable | (() => NumberTable);
  wide?: boolean;
  hidden?: boolean;
  children: ComponentChildren;
}): JSX.Element {
  // Thousands of cells are made when someone looks.
  const [open, setOpen] = useState(false);
  const paper = usePaper();
  const table = (): NumberTable => (typeof props.numbers === "function" ? props.numbers() : props.numbers);
  const { head, rows } = open || paper ? table() : { head: [], rows: [] };
  const isOpen = open || (paper && rows.length <= kMostOnPaper);
  return (
    <figure class={props.wide ? "wide" : ""} data-figure={props.name} hidden={props.hidden}>
      <div class="whole">
        <figcaption>
          <div class="head">
            <h3>{props.title}</h3>
            <Save name={props.title} table={table} chart />
          </div>
          {props.note ? <p class="note">{props.note}</p> : null}
        </figcaption>
        {props.children}
      </div>
      <details open={isOpen} onToggle={(e) => (paper ? undefined : setOpen(e.currentTarget.open))}>
        <summary>Numbers</summary>
        {isOpen ? (
          <ScrollTable
            unsaved
            label={`Numbers of ${props.title}`}
            head={head}
            right={rows[0]?.map((c) => typeof c !== "string")}
          >
            {rows.slice(0, kMostRows).map((row) => (
              <tr>
                {row.map((c) => (
                  <NumberCell value={c} />
                ))}
              </tr>
            ))}
          </ScrollTable>
        ) : null}
        {isOpen && rows.length > kMostRows ? (
          <p class="note">
            The first {kMostRows} of {rows.length} rows; CSV has all.
          </p>
        ) : null}
      </details>
    </figure>
  );
}
