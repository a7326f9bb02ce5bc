// What the page is of: commands, versions, digests, dates.
import type { JSX } from "preact";
import type { PageData, Sweep } from "./data";

export function About({ page, sweep }: { page: PageData; sweep: Sweep | null }): JSX.Element {
  const words = (value: unknown): string => (typeof value === "string" ? value : JSON.stringify(value));
  return (
    <section class="about" aria-label="About this page">
      <h2>Where this comes from</h2>
      <dl>
        <dt>page written by</dt>
        <dd>
          avoidbench {page.program.version}, git {page.program.git}, {page.program.compiler}
        </dd>
        <dt>command</dt>
        <dd>
          <code>{page.command}</code>
        </dd>
        {page.digest ? (
          <>
            <dt>map’s SHA-256</dt>
            <dd>
              <code>{page.digest}</code>
            </dd>
          </>
        ) : null}
        {page.world_digest ? (
          <>
            <dt>map’s SHA-256</dt>
            <dd>
              <code>{page.world_digest}</code>
            </dd>
          </>
        ) : null}
        {page.planner_digest ? (
          <>
            <dt>planner’s SHA-256</dt>
            <dd>
              <code>{page.planner_digest}</code>
            </dd>
          </>
        ) : null}
        {sweep?.conditions.length ? (
          <>
            <dt>trials</dt>
            <dd>those with {sweep.conditions.join(" and ")}</dd>
          </>
        ) : null}
        {page.flights_left_out ? (
          <>
            <dt>flights</dt>
            <dd>
              {page.flights.length} are in this page, {page.flights_left_out} had no room (<code>--page-size</code>)
            </dd>
          </>
        ) : null}
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
          <div class="scroll" tabIndex={0} role="region" aria-label="Planners">
            <table>
              <thead>
                <tr>
                  <th scope="col">label</th>
                  <th scope="col">name</th>
                  <th scope="col">version</th>
                  <th scope="col">SHA-256 of its file</th>
                  <th scope="col">parameters</th>
                </tr>
              </thead>
              <tbody>
                {sweep.planners.map((p) => (
                  <tr>
                    <td>{p.label}</td>
                    <td>
                      {p.name}
                      {p.is_privileged ? " (sees the world itself)" : ""}
                    </td>
                    <td>{p.version}</td>
                    <td>
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
              </tbody>
            </table>
          </div>
          <h3>Maps</h3>
          <div class="scroll" tabIndex={0} role="region" aria-label="Maps">
            <table>
              <thead>
                <tr>
                  <th scope="col">map</th>
                  <th scope="col">traversability</th>
                  <th scope="col">SHA-256</th>
                </tr>
              </thead>
              <tbody>
                {sweep.maps.slice(0, 500).map((m) => (
                  <tr>
                    <td>{m.text}</td>
                    <td class="number">{m.traversability?.toPrecision(4) ?? "–"}</td>
                    <td>
                      <code title={m.digest}>{m.digest.slice(0, 16)}…</code>
                    </td>
                  </tr>
                ))}
              </tbody>
            </table>
          </div>
        </>
      ) : null}
      <p class="note">
        This file needs no network and asks for none. Links with what stands after # show the same view again.
      </p>
    </section>
  );
}
