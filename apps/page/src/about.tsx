// What the page is of: commands, versions, digests, dates.
import type { ComponentChildren, JSX } from "preact";
import { Name } from "./chart";
import type { PageData, Sweep } from "./data";
import { ScrollTable } from "./figure";

export function About({ page, sweep }: { page: PageData; sweep: Sweep | null }): JSX.Element {
  const words = (value: unknown): string => (typeof value === "string" ? value : JSON.stringify(value));
  const code = (text?: string): ComponentChildren => text && <code>{text}</code>;
  const facts: [string, ComponentChildren][] = [
    ["page written by", `avoidbench ${page.program.version}, git ${page.program.git}, ${page.program.compiler}`],
    ["command", code(page.command)],
    ["map’s SHA-256", code(page.digest ?? page.world_digest)],
    ["planner’s SHA-256", code(page.planner_digest)],
    ["trials", sweep?.conditions.length ? `those with ${sweep.conditions.join(" and ")}` : null],
    [
      "flights",
      page.flights_left_out ? (
        <>
          {page.flights.length} are in this page, {page.flights_left_out} did not fit (<code>--page-size</code>)
        </>
      ) : null,
    ],
  ];
  return (
    <section class="about" aria-label="About this page">
      <h2>Where this comes from</h2>
      <dl>
        {facts
          .filter(([, what]) => what)
          .map(([name, what]) => (
            <>
              <dt>{name}</dt>
              <dd>{what}</dd>
            </>
          ))}
      </dl>
      {page.scene_warnings.length ? (
        <>
          <h3>What could not be shown</h3>
          <ul>
            {page.scene_warnings.map((w) => (
              <li>{w}</li>
            ))}
          </ul>
        </>
      ) : null}
      {sweep ? (
        <>
          <h3>Runs</h3>
          <ul class="runs">
            {sweep.runs.map((r) => (
              <li>
                <b>{r.date}</b> avoidbench {r.program}, git {r.git}, {r.compiler}
                <br />
                <code>{r.command}</code>
              </li>
            ))}
          </ul>
          <h3>Planners</h3>
          <ScrollTable label="Planners" head={["label", "name", "version", "SHA-256 of its file", "parameters"]}>
            {sweep.planners.map((p) => (
              <tr>
                <td>
                  <Name text={p.label} />
                </td>
                <td>
                  {p.name}
                  {p.is_privileged ? " (sees the world itself)" : ""}
                </td>
                <td>{p.version}</td>
                <td data-value={p.digest}>
                  <code title={p.digest}>{p.digest.slice(0, 16)}…</code>
                </td>
                <td class="wrap">
                  {p.parameters && typeof p.parameters === "object"
                    ? Object.entries(p.parameters)
                        .map(([k, v]) => `${k} ${words(v)}`)
                        .join(", ")
                    : "–"}
                </td>
              </tr>
            ))}
          </ScrollTable>
          <h3>Maps</h3>
          <ScrollTable label="Maps" head={["map", "traversability", "SHA-256"]}>
            {sweep.maps.slice(0, 500).map((m) => (
              <tr>
                <td>{m.text}</td>
                <td class="number">{m.traversability?.toPrecision(4) ?? "–"}</td>
                <td data-value={m.digest}>
                  <code title={m.digest}>{m.digest.slice(0, 16)}…</code>
                </td>
              </tr>
            ))}
          </ScrollTable>
        </>
      ) : null}
      <p class="note">
        This file needs no network and uses none. Links that include the part after # show the same view again.
      </p>
    </section>
  );
}
