// The page of a board: results of a suite side by side, how fast they reach their goals, what flew, and where its flights are.
import type { JSX } from "preact";
import { Legend, Name, Planners } from "./chart";
import type { BoardData, BoardResult, Look } from "./data";
import { lookOf, outcomeText } from "./data";
import { Figure, ScrollTable } from "./figure";
import type { Line } from "./lines";
import { LineChart } from "./lines";
import { Report } from "./report";

interface Shown {
  result: BoardResult;
  look: Look;
}

/** S(v) of every result, over all its missions. */
function Curves({ shown }: { shown: Shown[] }): JSX.Element {
  const lines: Line[] = shown.map(({ result, look }) => {
    // A step holds at its speed and down to the step before; the line falls behind it.
    const points: [number, number][] = result.curve.map(([speed], k) => [speed, result.curve[k + 1]?.[1] ?? 0]);
    return { ...look, points: [[0, 1], ...points] };
  });
  const fastest = Math.max(1, ...shown.flatMap(({ result }) => result.curve.map(([speed]) => speed)));
  return (
    <Figure
      name="speeds"
      wide
      title="Goal velocity that missions reach"
      note="Share of all missions that reached the goal with at least this goal velocity (shortest path over flight time)."
      numbers={{
        head: ["result", "goal velocity, m/s", "share of missions"],
        rows: shown.flatMap(({ result }) => result.curve.map(([speed, share]) => [result.label, speed, share])),
      }}
    >
      <Legend items={lines} />
      <LineChart
        lines={lines}
        x={[0, fastest]}
        y={[0, 1]}
        percent
        step
        xUnit="m/s"
        level={0.9}
        height={260}
        label="Share of missions that reached the goal with at least a goal velocity, by result"
      />
    </Figure>
  );
}

const kLinks: [keyof BoardResult["links"], string][] = [
  ["flights", "flights"],
  ["causes", "causes"],
  ["report", "report"],
  ["trials", "trials.csv"],
  ["planner", "planner.yaml"],
];

function Results({ shown }: { shown: Shown[] }): JSX.Element {
  return (
    <ScrollTable label="Results" head={["result", "files", "planner", "failures", "tuned on", "licence"]}>
      {shown.map(({ result }) => (
        <tr data-result={result.label}>
          <td>
            <Name text={result.label} />
            {result.is_privileged ? <span class="note"> sees the map: no competitor</span> : null}
          </td>
          <td>
            {kLinks.map(([name, text]) =>
              result.links[name] ? (
                <>
                  <a href={encodeURI(result.links[name]!)}>{text}</a>{" "}
                </>
              ) : null,
            )}
          </td>
          <td title={`${result.settings}, SHA-256 ${result.digest}`}>
            {result.name} {result.version}
            {result.source ? ` · ${result.source}` : ""}
          </td>
          <td>
            {result.failures.length === 0
              ? "none"
              : result.failures.map(([cause, count]) => `${outcomeText(cause)} ${count}`).join(", ")}
          </td>
          <td>{result.tuned_on || "–"}</td>
          <td>{result.licence || "–"}</td>
        </tr>
      ))}
    </ScrollTable>
  );
}

export function Board({ board }: { board: BoardData }): JSX.Element {
  const shown = board.results.map((result, i) => ({ result, look: lookOf(i, result.label) }));
  // Tables say of some that they see the map.
  const places = shown.flatMap(({ result }, i): [string, number][] => [
    [result.label, i],
    [`${result.label} (sees the map)`, i],
  ]);
  return (
    <Planners.Provider value={new Map(places)}>
      <section class="board" data-board={board.title}>
        <h2>{board.title}</h2>
        {board.tables.map((table) => (
          <Report table={table} open={table.name === "scores"} />
        ))}
        <Curves shown={shown} />
        <Results shown={shown} />
      </section>
    </Planners.Provider>
  );
}
