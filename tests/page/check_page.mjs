// The pages in a real browser: check_page.mjs PROGRAM PAGE_FOLDER HOSTILE_PLANNER. Exit code 77: there is no browser.
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { checkComparison, makeComparisons } from "./comparison_parts.mjs";
import { makeExplained, makeLarge, makeRun } from "./made_pages.mjs";
import { checkPaper, checkSaved, checkScatter, checkSteps, checkSweeps } from "./page_parts.mjs";
import { checkRun, checkSilentRun } from "./run_parts.mjs";

const [program, packages, hostile] = process.argv.slice(2);
const browserFile = [
  process.env.AVOIDBENCH_CHROMIUM,
  "/usr/bin/chromium",
  "/usr/bin/chromium-browser",
  "/usr/bin/google-chrome",
].find((f) => f && existsSync(f));
if (!browserFile) {
  console.log("passed over: no chromium here (Debian: apt install chromium)");
  process.exit(77);
}
const require = createRequire(join(packages, "package.json"));
const { chromium } = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

const folder = mkdtempSync(join(tmpdir(), "avoidbench_page_"));
const at = (name) => join(folder, name);
let failed = 0;
function check(isTrue, what, details = "") {
  console.log(`${isTrue ? "ok  " : "FAIL"} ${what}${isTrue || details === "" ? "" : `: ${details}`}`);
  if (!isTrue) failed += 1;
}
function run(...words) {
  const end = spawnSync(program, words, { encoding: "utf8", cwd: folder, maxBuffer: 1 << 28 });
  if (end.status !== 0) throw new Error(`avoidbench ${words.join(" ")}: ${end.status}\n${end.stderr}`);
  return end.stdout;
}
const near = (a, b, relative) => a === b || Math.abs(a - b) <= relative * Math.max(Math.abs(a), Math.abs(b), 1e-12);

// ---- Databases and pages.

const hostileLabel = `<img src=x onerror="window.hacked=3">`;
function makeFiles() {
  writeFileSync(
    at("small.yaml"),
    `sweep: small
seed: 7
maps: {generator: hall, area_m: [10, 14], poisson_radius_m: [2.6, 3.2, 3.8, 4.4, 5.0]}
trials: 2
planners:
  - straight_line
  - reactive
sensor: {preset: depth_ideal, width_px: 80, height_px: 60}
mission: {time_limit_s: 12}
`,
  );
  writeFileSync(
    at("hostile.yaml"),
    `sweep: hostile
seed: 7
maps: {generator: hall, area_m: [10, 14], poisson_radius_m: 3}
trials: 1
planners:
  - {plugin: ${JSON.stringify(hostile)}, label: ${JSON.stringify(hostileLabel)}}
sensor: {preset: depth_ideal, width_px: 80, height_px: 60}
mission: {time_limit_s: 3}
`,
  );
  run("run", "small.yaml", "--db", "small.db", "--jobs", "2");
  run("run", "hostile.yaml", "--db", "hostile.db");
  run("report", "small.db", "--page", "small.html");
  const first = readFileSync(at("small.html"));
  run("report", "small.db", "--page", "small.html");
  check(first.equals(readFileSync(at("small.html"))), "the same database gives the same page, byte for byte");
  run("report", "hostile.db", "--page", "hostile.html");
  run("replay", "hostile.db", "1", "--page", "hostile_flight.html");
  const list = JSON.parse(run("replay", "small.db", "--list", "--planner", "reactive", "--format", "json"));
  run("replay", "small.db", String(list[0].id ?? list[0].trial ?? 1), "--page", "flight.html");
  run("maps", "show", "forest", "--page", "map.html");
  run("limit", "small.yaml", "--over", "max_speed_mps=1..5", "--max-trials", "18", "--quiet", "--db", "limit.db");
  run("report", "limit.db", "--page", "limit.html");
  run("report", "small.db", "hostile.db", "--page", "both.html");
  makeExplained(at("small.html"), at("explained.html"));
  makeBoard();
  makeComparisons({ run, program, spawnSync, folder, at });
}

/** Two results of a tiny suite on one board, one with a label that tries to be markup. */
function makeBoard() {
  const script = join(dirname(fileURLToPath(import.meta.url)), "../suite/make_suite.sh");
  execFileSync(script, ["tiny"], {
    cwd: folder,
    env: { ...process.env, PATH: `${dirname(program)}:${process.env.PATH}` },
  });
  const flown = ["suite", "run", "tiny/depth", "--split", "dev", "--quiet"];
  run(...flown, "--planner", "straight_line", "--label", hostileLabel, "--folder", "slow");
  run(...flown, "--planner", "omniscient", "--folder", "ceiling");
  run("suite", "board", "slow", "ceiling", "--suite", "tiny/depth", "--page", "board.html");
}

// ---- The browser.

let browser;
async function opened(name, hash = "", size = { width: 1280, height: 900 }) {
  const page = await browser.newPage({ viewport: size });
  page.problems = [];
  page.on("console", (m) => {
    // Software rendering says so; that is no fault of the page.
    if (
      (m.type() === "error" || m.type() === "warning") &&
      !/swiftshader|GPU stall|GL Driver|software WebGL/i.test(m.text())
    )
      page.problems.push(`console: ${m.text()}`);
  });
  page.on("pageerror", (e) => page.problems.push(`error: ${e.message}`));
  page.on("request", (r) => {
    if (!/^(file|data|blob):/.test(r.url())) page.problems.push(`request: ${r.url()}`);
  });
  page.on("dialog", (d) => {
    page.problems.push(`dialog: ${d.message()}`);
    void d.dismiss();
  });
  const begun = Date.now();
  await page.goto(`file://${at(name)}${hash}`);
  await page.waitForSelector("h1");
  page.opened_ms = Date.now() - begun;
  return page;
}
async function finish(page, what) {
  check(page.problems.length === 0, `${what}: no error in the console, no request`, page.problems.join("; "));
  await page.close();
}
/** How many colours a canvas shows. */
const coloursOf = (page, selector) =>
  page.$eval(selector, (canvas) => {
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [64, 48];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0, 64, 48);
    const data = context.getImageData(0, 0, 64, 48).data;
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
    return colours.size;
  });
const figureRows = async (page, name) => {
  const figure = `figure[data-figure="${name}"]`;
  if (!(await page.$(`${figure} details[open]`))) await page.click(`${figure} summary`);
  await page.waitForSelector(`${figure} tbody tr`);
  return page.$$eval(`${figure} tbody tr`, (rows) =>
    rows.map((row) => [...row.children].map((c) => c.dataset.value ?? c.textContent)),
  );
};

async function checkNumbers() {
  const report = JSON.parse(run("report", "small.db", "--format", "json"))[0];
  const page = await opened("small.html");
  let compared = 0;
  const wrong = [];
  for (const [table, rows] of Object.entries(report.tables)) {
    const shown = await page.$$eval(`details[data-table="${table}"] tbody tr`, (trs) =>
      trs.map((tr) => Object.fromEntries([...tr.children].map((c) => [c.dataset.column, c.dataset.value]))),
    );
    if (shown.length !== rows.length) wrong.push(`${table} has ${shown.length} rows, not ${rows.length}`);
    for (const [i, row] of rows.entries()) {
      for (const [column, value] of Object.entries(shown[i] ?? {})) {
        compared += 1;
        const given = row[column];
        // Infinity is null in JSON.
        if (
          typeof given === "number"
            ? Number(value) !== given
            : given === null
              ? !["", "inf", "-inf"].includes(value)
              : value !== String(given)
        )
          wrong.push(`${table} ${i} ${column}: ${value}, not ${given}`);
      }
    }
  }
  check(
    compared > 100 && wrong.length === 0,
    `${compared} numbers of all tables equal report --format json`,
    wrong.slice(0, 5).join("; "),
  );
  await checkCharts(page, report.tables, "all trials");
  // The same with a filter, against the report's own.
  await page.click('.filters .chip:has-text("reactive")');
  await page.waitForFunction(() => document.querySelector(".shown").textContent.startsWith("10 of 20"));
  await checkCharts(
    page,
    JSON.parse(run("report", "small.db", "--where", "planner = reactive", "--format", "json"))[0].tables,
    "filtered",
  );
  check(page.url().includes("f.planner="), "the link holds the filter");
  const again = await opened("small.html", new URL(page.url()).hash);
  check((await again.textContent(".shown")).startsWith("10 of 20"), "a link shows the same again");
  await finish(again, "link");
  await finish(page, "overview");
}

async function checkCharts(page, tables, what) {
  const wrong = [];
  const success = await figureRows(page, "success");
  tables.planners.forEach((row, i) => {
    const [label, trials, finished, rate, lower, upper] = success[i] ?? [];
    if (label !== row.planner || Number(trials) !== row.trial_count || Number(finished) !== row.finished_count)
      wrong.push(`${label}: ${trials} ${finished}`);
    for (const [value, name] of [
      [rate, "success_rate"],
      [lower, "success_rate_lower"],
      [upper, "success_rate_upper"],
    ]) {
      const given =
        row[name] ?? row[Object.keys(row).find((k) => k.startsWith("success_rate") && k.endsWith(name.slice(13)))];
      if (!near(Number(value), given, 1e-9)) wrong.push(`${label} ${name}: ${value}, not ${given}`);
    }
  });
  const metric = await figureRows(page, "metric mission_progress_pct");
  tables.planners.forEach((row, i) => {
    if (!near(Number(metric[i]?.[2]), row.mission_progress_pct, 1e-6))
      wrong.push(`progress ${metric[i]?.[2]}, not ${row.mission_progress_pct}`);
  });
  const outcomes = await figureRows(page, "outcomes");
  tables.outcomes.forEach((row, i) => {
    const counts = Object.entries(row)
      .filter(([k]) => k.endsWith("_count"))
      .map(([, v]) => v);
    if (counts.some((c, k) => Number(outcomes[i]?.[k + 1]) !== c)) wrong.push(`outcomes ${outcomes[i]}`);
  });
  check(
    wrong.length === 0,
    `charts of ${what}: rates, intervals, means and outcomes equal the report's`,
    wrong.slice(0, 4).join("; "),
  );
}

async function checkLimits() {
  const { limits, limit_curve } = JSON.parse(run("report", "limit.db", "--format", "json"))[0].tables;
  const page = await opened("limit.html");
  check(
    (await page.$$(".filters fieldset:first-of-type .chip")).length === 2,
    "where a limit is looked for a planner is one, whatever the value",
  );
  const same = (shown, given) => (given === null ? ["", "NaN"].includes(shown) : Number(shown) === given);
  const rows = await figureRows(page, "limits");
  check(
    rows.length === 2 &&
      limits.every(
        (l, i) =>
          rows[i][0] === l.planner &&
          same(rows[i][1], l.limit) &&
          same(rows[i][2], l.limit_lower) &&
          same(rows[i][3], l.limit_upper) &&
          same(rows[i][5], l.trial_count),
      ),
    "limits equal the report’s",
    JSON.stringify([rows, limits]),
  );
  const points = await figureRows(page, "limit curves");
  check(
    points.length === limit_curve.length &&
      limit_curve.every(
        (l, i) => same(points[i][1], l.value) && same(points[i][3], l.trial_count) && same(points[i][4], l.fitted_rate),
      ),
    "and so do their curves",
  );
  check((await page.$('figure[data-figure="success"]')) === null, "rates over all values are not shown");
  await page.selectOption('select[name="planner.max_speed_mps"]', { index: 1 });
  await page.waitForSelector('figure[data-figure="success"] svg');
  check(true, "those of one value are");
  await finish(page, "limits");
}

async function checkTable() {
  const page = await opened("small.html", "#tab=trials");
  await page.waitForSelector("tr[data-trial]");
  check((await page.$$("tr[data-trial]")).length === 20, "the table has all trials");
  await page.click('th button:has-text("outcome")');
  const first = await page.textContent('tr[data-place="0"]');
  await page.click('th button:has-text("outcome")');
  check(first !== (await page.textContent('tr[data-place="0"]')), "a heading sorts");
  await page.fill("input[type=search]", "straight");
  await page.waitForFunction(() => document.querySelector(".shown").textContent.startsWith("10 of 20"));
  check((await page.$$("tr[data-trial]")).length === 10, "the search finds");
  await page.fill("input[type=search]", "");
  await page.waitForFunction(() => document.querySelectorAll("tr[data-trial]").length === 20);
  await page.waitForTimeout(200);
  // By keys alone: to a row, two down, open, play, end, back.
  await page.focus('tr[data-place="0"]');
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  const isThere = await page
    .waitForFunction(() => document.activeElement.dataset.place === "2", null, { timeout: 10000 })
    .catch(() => null);
  check(isThere !== null, "arrow keys go through the rows");
  await page.keyboard.press("Enter");
  await page.waitForSelector(".stage > canvas");
  await checkReplay(page);
  await page.keyboard.press("Escape");
  await page.waitForSelector("tr[data-trial]");
  check(true, "Escape goes back to the trials");
  await page.click('tr[data-place="1"]');
  await page.waitForSelector(".stage > canvas");
  await page.waitForTimeout(300);
  check((await coloursOf(page, ".stage > canvas")) > 20, "a click opens a replay whose canvas is not blank");
  await finish(page, "trials and replay");
}

const placeOf = (page) => page.$eval(".stage > canvas", (c) => c.dataset.position);
const momentOf = (page) => page.$eval(".stage > canvas", (c) => Number(c.dataset.time));
async function checkReplay(page) {
  await page.waitForTimeout(400);
  check((await coloursOf(page, ".stage > canvas")) > 20, "Enter opens a replay whose canvas is not blank");
  check((await page.$$(".flights li")).length === 2, "both planners of the mission are there");
  check((await page.$$(".plot svg")).length >= 2, "there are plots");
  const before = await placeOf(page);
  await page.focus("input[type=range]");
  await page.keyboard.press("End");
  await page.waitForTimeout(100);
  check(before !== (await placeOf(page)), "the slider moves the vehicle");
  const end = await momentOf(page);
  const { width } = await (await page.$(".plot svg")).boundingBox();
  await page.click(".plot svg", { position: { x: 46 + (width - 58) / 2, y: 40 } });
  const middle = await momentOf(page);
  check(Math.abs(middle - end / 2) < 0.05, "a click in a plot goes there", `${middle} s of ${end} s`);
  await page.focus("input[type=range]");
  await page.keyboard.press("Home");
  await page.waitForFunction(() => document.querySelector(".stage > canvas").dataset.time === "0.000");
  await page.keyboard.press(" ");
  await page.waitForFunction(() => Number(document.querySelector(".stage > canvas").dataset.time) > 0.05);
  await page.keyboard.press(" ");
  check(end > 1, "space plays");
  for (const key of ["2", "3", "1", "c"]) await page.keyboard.press(key);
  await page.waitForTimeout(200);
  check(new URL(page.url()).hash.includes("camera="), "keys choose the camera");
}

async function checkHostile() {
  for (const [name, hash] of [
    ["hostile.html", ""],
    ["hostile.html", "#tab=trials"],
    ["hostile.html", "#tab=about"],
    ["hostile_flight.html", ""],
  ]) {
    const page = await opened(name, hash);
    if (hash === "#tab=trials") {
      await page.click("tr[data-trial]");
      await page.waitForSelector(".stage > canvas");
    }
    await page.waitForTimeout(200);
    const text = await page.textContent("#app");
    const isInert =
      (await page.evaluate(() => window.hacked === undefined)) && (await page.$$("#app img, #app script")).length === 0;
    check(isInert, `${name}${hash}: hostile words are inert`);
    check(
      text.includes(hash === "#tab=about" || name === "hostile.html" ? hostileLabel : "onerror="),
      `${name}${hash}: they are shown as text`,
    );
    await finish(page, `${name}${hash}`);
  }
}

async function checkFlightAndMap() {
  const page = await opened("flight.html");
  await page.waitForSelector(".seen canvas");
  await page.keyboard.press("Shift+ArrowRight");
  await page.waitForTimeout(500);
  check((await coloursOf(page, ".seen canvas")) > 5, "the flight’s page shows the depth that was seen");
  check((await coloursOf(page, ".stage > canvas")) > 20, "and the flight");
  check((await page.textContent(".plots")).includes("CPU time"), "and plots of the commands");
  await finish(page, "flight");
  const map = await opened("map.html");
  await map.waitForTimeout(800);
  check((await coloursOf(map, ".stage > canvas")) > 20, "the map’s page shows the map");
  await finish(map, "map");
}

function checkFilm() {
  const without = spawnSync(program, ["replay", "hostile.db", "1", "--video", "a.mp4"], {
    encoding: "utf8",
    cwd: folder,
    env: { ...process.env, PATH: folder },
  });
  check(
    without.status === 2 && without.stderr.includes("apt install ffmpeg"),
    "without ffmpeg --video says what is missing",
    without.stderr,
  );
  const wrong = spawnSync(program, ["replay", "hostile.db", "1", "--video", "a.avi"], {
    encoding: "utf8",
    cwd: folder,
  });
  check(wrong.status === 2 && wrong.stderr.includes(".webm"), "--video says which endings there are", wrong.stderr);
  if (spawnSync("ffprobe", ["-version"]).status !== 0) {
    console.log("     passed over: no ffmpeg here, no film");
    return;
  }
  for (const ending of ["mp4", "webm", "gif"]) {
    run("replay", "hostile.db", "1", "--video", `film.${ending}`);
    const found = execFileSync(
      "ffprobe",
      [
        "-v",
        "error",
        "-count_frames",
        "-select_streams",
        "v",
        "-show_entries",
        "stream=width,height,nb_read_frames",
        "-of",
        "csv=p=0",
        at(`film.${ending}`),
      ],
      { encoding: "utf8" },
    );
    const [width, , frames] = found.trim().split(",").map(Number);
    check(width === (ending === "gif" ? 800 : 1280) && frames > 12, `film.${ending} has ${frames} frames`, found);
  }
}

async function checkLarge() {
  makeLarge(at("small.html"), at("large.html"), 10000);
  const page = await opened("large.html", "#tab=trials");
  await page.waitForSelector("tr[data-trial]");
  check((await page.$$("tr[data-trial]")).length < 120, "10,000 trials: only the rows that are seen are made");
  await page.$eval(".trials .table", (e) => {
    e.scrollTop = e.scrollHeight / 2;
  });
  await page.waitForFunction(() => Number(document.querySelector("tr[data-place]").dataset.place) > 4000);
  check(true, "10,000 trials scroll");
  const timed = (selector) =>
    page.evaluate(async (s) => {
      const frames = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 0)));
      await frames();
      const begun = performance.now();
      document.querySelectorAll(s)[1].click();
      await frames();
      return [performance.now() - begun, document.querySelector(".shown").textContent];
    }, selector);
  const [table_ms, half] = await timed(".filters .chip");
  check(half.replaceAll(/\D/g, "").startsWith("500010000"), "10,000 trials: a filter acts before the next frame", half);
  check((await page.$$("tr[data-trial]")).length < 120, "10,000 trials: a filter makes only the rows that are seen");
  await page.click('nav button:has-text("Overview")');
  await page.waitForSelector('figure[data-figure="success"] svg');
  const [overview_ms, all] = await timed(".filters .chip");
  check(all.replaceAll(/\D/g, "").startsWith("10000"), "10,000 trials: and is taken off before the next frame", all);
  // It should take less than 200 ms; a machine with other work to do takes longer, so no check depends on it.
  console.log(
    `     10,000 trials: opened in ${page.opened_ms} ms; a filter takes ${table_ms.toFixed(0)} ms in the table, ${overview_ms.toFixed(0)} ms in the overview`,
  );
  await finish(page, "10,000 trials");
}

async function checkBoard() {
  const page = await opened("board.html");
  const scores = await page.$$eval('details[data-table="scores"] tbody tr', (rows) =>
    rows.map((row) => [...row.children].map((c) => c.dataset.value)),
  );
  check(
    scores.length === 2 && scores[0][0] === "omniscient (sees the map)",
    "the ceiling stands first",
    String(scores),
  );
  const told = JSON.parse(run("suite", "board", "slow", "ceiling", "--suite", "tiny/depth", "--format", "json"))[0]
    .tables.scores;
  check(Number(scores[0][1]) === told[0].score_mps, "scores are those of the command");
  const links = await page.$$eval("tr[data-result] a", (all) => all.map((a) => a.getAttribute("href")));
  check(
    links.length >= 8 && links.every((link) => existsSync(at(decodeURI(link)))),
    "every link leads to a file of its result",
    links.join(", "),
  );
  const curve = await figureRows(page, "speeds");
  check(curve.length >= 2 && curve[0].length === 3, "S(v) has its numbers");
  check((await page.evaluate(() => window.hacked)) === undefined, "a label is text on a board");
  await finish(page, "board");
}

async function checkAccess() {
  for (const [name, hash] of [
    ["board.html", ""],
    ["board.html", "#theme=dark"],
    ["small.html", ""],
    ["small.html", "#theme=dark"],
    ["small.html", "#tab=trials"],
    ["small.html", "#tab=about"],
    ["flight.html", ""],
    ["flight.html", "#theme=dark"],
    ["map.html", ""],
    ["comparison.html", ""],
    ["comparison.html", "#theme=dark"],
    ["comparison.html", "#tab=trials"],
    ["tables.html", "#tab=trials&theme=dark"],
  ]) {
    const page = await opened(name, hash);
    await page.waitForTimeout(300);
    await page.evaluate(axe);
    const found = await page.evaluate(async () =>
      (await window.axe.run(document, { resultTypes: ["violations"] })).violations
        .filter((v) => v.impact === "serious" || v.impact === "critical")
        .map(
          (v) =>
            `${v.id} (${v.nodes.length}): ${v.nodes[0].html.slice(0, 160)} ${v.nodes[0].failureSummary?.slice(0, 200) ?? ""}`,
        ),
    );
    check(found.length === 0, `${name}${hash}: axe-core finds no serious problem`, found.join("\n"));
    await page.close();
  }
  for (const [name, hash] of [
    ["small.html", ""],
    ["comparison.html", ""],
    ["comparison.html", "#tab=trials"],
  ]) {
    const phone = await opened(name, hash, { width: 390, height: 844 });
    const wide = await phone.evaluate(() => document.documentElement.scrollWidth);
    check(wide <= 390, `${name}${hash}: on a phone nothing is wider than the screen`, `${wide} px`);
    await finish(phone, `phone ${name}${hash}`);
  }
}

try {
  makeFiles();
  const program_kb = statSync(at("hostile.html")).size / 1000;
  check(program_kb < 1100, `a page of one trial has ${program_kb.toFixed(0)} kB`);
  browser = await chromium.launch({
    executablePath: browserFile,
    args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox", "--disable-dev-shm-usage"],
  });
  for (const part of [
    checkNumbers,
    checkLimits,
    checkTable,
    checkHostile,
    checkFlightAndMap,
    checkFilm,
    checkBoard,
    checkLarge,
    checkAccess,
    checkPaper,
    checkSaved,
    checkScatter,
    checkSteps,
    checkRun,
    checkSilentRun,
    checkSweeps,
    checkComparison,
  ]) {
    const begun = Date.now();
    await part({ opened, finish, check, run, figureRows, near, hostileLabel, program, folder, at, makeRun, coloursOf });
    console.log(`     ${part.name}: ${((Date.now() - begun) / 1000).toFixed(1)} s`);
  }
} catch (error) {
  check(false, "the test itself", error.stack);
} finally {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
}
console.log(failed === 0 ? "all well" : `${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
