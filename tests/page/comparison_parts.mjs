// Parts of check_page.mjs: the page of a comparison.
import { readFileSync, writeFileSync } from "node:fs";

/** Two runs of a planner, of which the new one sees less, and their pages: of databases and of tables. */
export function makeComparisons({ run, program, spawnSync, folder, at }) {
  run("run", "small.yaml", "--set", "planners=[reactive]", "--set", "trials=6", "--db", "base.db", "--quiet");
  const worse = ["--set", "planners=[reactive]", "--set", "trials=6", "--set", "sensor.max_range_m=1.2"];
  run("run", "small.yaml", ...worse, "--db", "new.db", "--quiet");
  const compare = (...words) => {
    const end = spawnSync(program, ["compare", ...words], { encoding: "utf8", cwd: folder });
    if (end.status > 1) throw new Error(`avoidbench compare ${words.join(" ")}: ${end.status}\n${end.stderr}`);
    return end.stdout;
  };
  compare("base.db", "new.db", "--page", "comparison.html");
  compare("base.db", "--bless", "base.csv");
  compare("new.db", "--bless", "new.csv");
  compare("base.csv", "new.csv", "--page", "tables.html");
  compare("base.csv", "new.db", "--page", "half.html");
  writeFileSync(at("comparison.json"), compare("base.db", "new.db", "--format", "json"));
}

export async function checkComparison({ opened, finish, check, figureRows, coloursOf, at }) {
  const told = JSON.parse(readFileSync(at("comparison.json"), "utf8"));
  const page = await opened("comparison.html");
  const wrong = [];
  for (const row of told.metrics) {
    const shown = (await figureRows(page, `change ${row.metric}`)).find(([planner]) => planner === row.planner);
    const given = [row.pair_count, row.base_mean, row.new_mean, row.change, row.change_lower, row.change_upper];
    given.forEach((value, i) => {
      if (value === null ? shown?.[i + 1] !== "" : Number(shown?.[i + 1] || NaN) !== value)
        wrong.push(`${row.metric} ${i}: ${shown?.[i + 1]}, not ${value}`);
    });
  }
  check(wrong.length === 0, "changes and intervals equal compare --format json", wrong.slice(0, 4).join("; "));
  const [[, lost, won]] = await figureRows(page, "fates");
  const [planner] = told.planners;
  check(
    Number(lost) === planner.lost_count && Number(won) === planner.gained_count && Number(lost) > 0,
    `${lost} lost and ${won} won, as compare says`,
  );
  await page.click('button:has-text("with another outcome")');
  await page.waitForSelector("tr[data-pair]");
  const flips = await page.$$eval("tr[data-pair]", (rows) =>
    rows.map((row) => [5, 2, 3].map((i) => row.children[i].textContent.trim().replaceAll(" ", "_"))),
  );
  const same = told.flips.every(({ mission_index, before, after }) =>
    flips.some((f) => Number(f[0]) === mission_index && f[1] === before && f[2] === after),
  );
  check(flips.length === told.flips.length && same, "its missions are those with another outcome, with both outcomes");
  const shown = (text) => page.waitForFunction((t) => document.querySelector(".shown").textContent.startsWith(t), text);
  await page.click('.filters .chip:has-text("lost")');
  await shown("0 of 30");
  check((await page.$$("tr[data-pair]")).length === 0, "filters choose");
  await page.click('.filters .chip:has-text("lost")');
  await page.fill("input[type=search]", "no such map");
  await shown("0 of 30");
  await page.fill("input[type=search]", "collided");
  await shown(`${flips.length} of 30`);
  check(true, "and so does the search");
  await page.click('tr[data-pair="0"] button');
  await page.waitForSelector(".stage > canvas");
  await page.waitForTimeout(400);
  check((await coloursOf(page, ".stage > canvas")) > 20, "a mission's scene is not blank");
  const sides = await page.$$eval(".flights li strong", (all) => all.map((e) => e.textContent));
  check(sides.join() === "new,base", "it has both flights", sides.join());
  const outcomes = await page.$$eval(".flights .what", (all) => all.map((e) => e.textContent.split(": ")[1]));
  check(outcomes[0] !== outcomes[1] && outcomes[1] === "reached goal", "with both outcomes", outcomes.join());
  check((await page.textContent(".now")).includes("(base "), "and both sides' metrics");
  const first = page.url();
  await page.keyboard.press("n");
  await page.waitForFunction(() => document.querySelector(".steps span").textContent.startsWith("2 of"));
  check(page.url() !== first, "n goes to the next mission");
  const again = await opened("comparison.html", new URL(first).hash);
  await again.waitForSelector(".stage > canvas");
  check(true, "a link shows the same mission again");
  await finish(again, "a comparison's link");
  await finish(page, "comparison");
  for (const [name, text, count] of [
    ["tables.html", "both sides are tables of trials", 0],
    ["half.html", "The base is a table of trials", 30],
  ]) {
    const side = await opened(name, "#tab=trials");
    check((await side.textContent(".no-flights")).includes(text), `${name} says why flights are missing`);
    const buttons = (await side.$$("tr[data-pair] button")).length;
    check(buttons === count, `and ${count} of its missions have one`, String(buttons));
    await finish(side, name);
  }
}
