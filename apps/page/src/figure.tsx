// A chart with its title and its numbers, and tables that scroll.
import type { ComponentChildren, JSX } from "preact";
import { useEffect, useState } from "preact/hooks";
import { digits } from "./data";

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

/** A table that scrolls within its place. */
export function ScrollTable(props: {
  label: string;
  head: ComponentChildren[];
  children: ComponentChildren;
  class?: string;
}): JSX.Element {
  return (
    <div class={`scroll ${props.class ?? ""}`} tabIndex={0} role="region" aria-label={props.label}>
      <table>
        <thead>
          <tr>
            {props.head.map((h) => (
              <th scope="col">{h}</th>
            ))}
          </tr>
        </thead>
        <tbody>{props.children}</tbody>
      </table>
    </div>
  );
}

/** `hidden`: there, but not shown, which costs less than to make it again. */
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
          <ScrollTable label={`Numbers of ${props.title}`} head={props.numbers.head}>
            {props.numbers.rows.map((row) => (
              <tr>
                {row.map((c) => (
                  <NumberCell value={c} />
                ))}
              </tr>
            ))}
          </ScrollTable>
        ) : null}
      </details>
    </figure>
  );
}
