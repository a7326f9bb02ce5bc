// Parts of check_page.mjs: printing, saved files, the chart of any numbers, a flight's slider and steps. Each takes what they share.
import { readFileSync } from "node:fs";

/** How wide the charts are while the page is ready for paper. */
const widths = (page) =>
  page.evaluate(async () => {
    window.dispatchEvent(new Event("beforeprint"));
    await new Promise((done) => setTimeout(done, 50));
    const all = [...document.querySelectorAll(".chart svg")].map((svg) => svg.getBoundingClientRect().width);
    window.dispatchEvent(new Event("afterprint"));
    return all;
  });
const groundOf = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);

export async function checkPaper({ opened, finish, check }) {
  const page = await opened("small.html", "#theme=dark");
  await page.waitForSelector('figure[data-figure="success"] svg');
  const dark = await groundOf(page);
  const wide = await widths(page);
  check(
    wide.length > 5 && Math.max(...wide) < 700 && Math.max(...wide) > 600,
    "before printing, charts are drawn at the paper’s width",
    wide.join(" "),
  );
  await page.emulateMedia({ media: "print" });
  await page.waitForFunction(() => document.documentElement.hasAttribute("data-paper"));
  await page.waitForSelector('figure[data-figure="success"] table');
  check((await groundOf(page)) === "rgb(255, 255, 255)", "a dark page is printed light");
  const color = await page.$eval('figure[data-figure="success"] .sign', (e) => getComputedStyle(e).fill);
  check(color === "rgb(0, 114, 178)", "and so are its planners’ colours", color);
  const seen = await page.$$eval(".chip, .save, nav, select", (all) => all.filter((e) => e.checkVisibility()).length);
  check(seen === 0, "no control is printed", `${seen} are`);
  const cut = await page.$$eval(".scroll", (all) =>
    all.filter((e) => e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1).map((e) => e.ariaLabel),
  );
  check(cut.length === 0, "no table is cut off", cut.join(", "));
  await page.emulateMedia({ media: "screen" });
  await page.waitForFunction(() => !document.documentElement.hasAttribute("data-paper"));
  const pdf = await page.pdf({ format: "A4", preferCSSPageSize: true });
  const sheets = pdf.toString("latin1").match(/\/Type\s*\/Page\b/g)?.length ?? 0;
  check(sheets >= 2 && sheets <= 9, `the overview makes a PDF of ${sheets} sheets`);
  check((await groundOf(page)) === dark, "afterwards the page is as before");
  await finish(page, "printing");
  const flight = await opened("small.html", "#tab=trials");
  await flight.click('tr[data-place="0"]');
  await flight.waitForSelector(".stage > canvas");
  await flight.emulateMedia({ media: "print" });
  const shown = await flight.waitForSelector(".picture");
  const isPicture = await shown.evaluate((e) => e.decode().then(() => e.naturalWidth > 100));
  check(isPicture && !(await flight.isVisible(".stage > canvas")), "a flight is printed as its last picture");
  await finish(flight, "printing a flight");
}

/** What a click saves: [name, content]. */
async function saved(page, selector) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(selector)]);
  return [download.suggestedFilename(), readFileSync(await download.path())];
}
/** RFC 4180. */
function readCsv(text) {
  const rows = [[]];
  for (const [, quoted, bare, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^",\r\n]*))(,|\r\n|$)/g)) {
    if (quoted === undefined && bare === "" && end === "") break;
    rows[rows.length - 1].push(quoted === undefined ? bare : quoted.replaceAll('""', '"'));
    if (end === "\r\n") rows.push([]);
  }
  return rows.slice(0, -1);
}
const same = (field, shown) => field === shown || (field !== "" && Number(field) === Number(shown));

export async function checkSaved({ opened, finish, check, run, figureRows, near, hostileLabel }) {
  const page = await opened("small.html", "#theme=dark");
  const rows = await figureRows(page, "success");
  const [name, bytes] = await saved(page, 'figure[data-figure="success"] .save button:has-text("CSV")');
  const [head, ...cells] = readCsv(bytes.toString());
  check(
    name === "small_Success_by_planner.csv" &&
      head.length === rows[0].length &&
      cells.length === rows.length &&
      cells.every((row, i) => row.every((field, k) => same(field, rows[i][k]))),
    "a chart’s CSV has the cells of its table",
    bytes.toString(),
  );
  check(!bytes.toString().replaceAll("\r\n", "").includes("\n"), "its lines end with CR LF");
  const [, planners] = await saved(page, 'details[data-table="planners"] .save button');
  const told = JSON.parse(run("report", "small.db", "--format", "json"))[0].tables.planners;
  const [columns, ...lines] = readCsv(planners.toString());
  const wrong = told.flatMap((row, i) =>
    Object.entries(row).filter(([key, value]) => !same(lines[i]?.[columns.indexOf(key)], String(value ?? ""))),
  );
  check(wrong.length === 0, "a table’s CSV has the report’s columns and numbers", JSON.stringify(wrong));
  const [, svg] = await saved(page, 'figure[data-figure="success"] .save button:has-text("SVG")');
  const text = svg.toString();
  check(
    text.startsWith("<?xml") && text.includes("straight_line") && !/class=|var\(|style=/.test(text),
    "a chart’s SVG stands alone",
  );
  check(text.includes("rgb(0, 114, 178)") && text.includes('fill="#ffffff"'), "on white, also of a dark page");
  const wellFormed = await page.evaluate(
    (t) => new DOMParser().parseFromString(t, "image/svg+xml").querySelector("parsererror") === null,
    text,
  );
  check(wellFormed, "it is well-formed");
  const [, png] = await saved(page, 'figure[data-figure="success"] .save button:has-text("PNG")');
  const width = Number(/<svg[^>]* width="(\d+)"/.exec(text)[1]);
  check(
    png.subarray(1, 4).toString() === "PNG" && near(png.readUInt32BE(16), 2 * width, 0.01),
    "and its PNG is twice as fine",
  );
  await finish(page, "saved files");
  const hostile = await opened("hostile.html", "#tab=trials");
  const [, trials] = await saved(hostile, ".trials .save button");
  const [names, row] = readCsv(trials.toString());
  check(
    row[names.indexOf("planner")] === hostileLabel && trials.includes('onerror=""window'),
    "the trials’ CSV quotes what needs it",
    trials.toString(),
  );
  await finish(hostile, "saved trials");
}

export async function checkSweeps({ opened, finish, check, run }) {
  const page = await opened("both.html");
  await page.click('nav button:has-text("All sweeps")');
  const shown = await page.$$eval('details[data-table="sweeps"] tbody tr', (rows) =>
    rows.map((row) => [0, 1].map((i) => row.children[i].dataset.value).join()),
  );
  const told = JSON.parse(run("report", "small.db", "hostile.db", "--format", "json"));
  const rows = told.find((section) => section.tables.sweeps).tables.sweeps;
  check(
    shown.length === 3 && shown.join(";") === rows.map((row) => `${row.planner},${row.of_sweep}`).join(";"),
    "planners of several sweeps are in one table, as in the report",
    shown.join("; "),
  );
  await page.selectOption(".sweeps select", { index: 1 });
  check(page.url().includes("sweep=1"), "and each sweep has its own overview");
  await finish(page, "several sweeps");
}

export async function checkScatter({ opened, finish, check, figureRows }) {
  const page = await opened("small.html");
  const figure = 'figure[data-figure="scatter"]';
  check((await figureRows(page, "scatter")).length === 20, "the scatter chart has a row for each trial");
  const hollow = await page.$$eval(`${figure} .chart .hollow`, (all) => all.filter((e) => e.getAttribute("d")).length);
  const filled = await page.$$eval(`${figure} .chart .sign`, (all) => all.filter((e) => e.getAttribute("d")).length);
  check(hollow > 0 && filled > 0, "failures are hollow");
  for (const [name, value] of [
    ["y", "flight_time_s"],
    ["x", "map.poisson_radius_m"],
  ])
    await page.selectOption(`${figure} select[name="${name}"]`, value);
  const head = await page.$$eval(`${figure} thead th`, (all) => all.map((e) => e.textContent));
  check(
    head[3].includes("poisson_radius_m") && head[4] === "flight time, s" && page.url().includes("y=flight_time_s"),
    "its two boxes choose what is drawn, and the link keeps it",
    head.join(", "),
  );
  const at = await page.$eval(`${figure} .chart svg`, (svg) => {
    svg.scrollIntoView({ block: "center" });
    const path = [...svg.querySelectorAll(".sign, .hollow")].find((e) => e.getAttribute("d"));
    const [x, y] = path
      .getAttribute("d")
      .slice(1)
      .split(/[,a-zA-Z]/)
      .map(Number);
    const box = svg.getBoundingClientRect();
    return [box.left + x, box.top + y];
  });
  await page.mouse.move(at[0] + 1, at[1]);
  check((await page.textContent(`${figure} .tip`)).includes("Click to see it"), "a sign says which trial it is");
  await page.mouse.click(at[0] + 1, at[1]);
  await page.waitForSelector(".stage > canvas");
  check(page.url().includes("trial="), "a click on it opens the flight");
  await finish(page, "scatter");
}

export async function checkSteps({ opened, finish, check }) {
  const page = await opened("explained.html");
  const colors = await page.$$eval(".filters .chip svg :is(path, rect)", (all) =>
    all.map((e) => getComputedStyle(e).fill),
  );
  check(new Set(colors).size === colors.length, "no outcome has a planner’s colour", colors.join(" "));
  const ends = await page.$$eval('figure[data-figure="arrivals"] .end', (all) => all.map((e) => e.getAttribute("y")));
  check(
    ends.length === 0 || Math.abs(ends[0] - ends[1]) >= 12,
    "the names at the curves’ ends don’t overlap",
    String(ends),
  );
  await page.click('.filters .chip:has-text("collided")');
  await page.click('nav button:has-text("Trials")');
  await page.click('tr[data-place="0"]');
  await page.waitForSelector(".stage > canvas");
  const time = () => page.$eval(".stage > canvas", (c) => Number(c.dataset.time));
  const begun = await time();
  const contact = await page.getAttribute('.ticks button[aria-label*="contact"]', "aria-label");
  const contact_s = Number(/[\d.]+(?= s)/.exec(contact)[0]);
  check(
    Math.abs(begun - Math.max(0, contact_s - 3)) < 0.1,
    "a failed flight begins 3 s before its end",
    `${begun} s, contact at ${contact_s} s`,
  );
  check(
    (await page.$eval('.choice[aria-label="Paths by"] [aria-pressed="true"]', (b) => b.textContent)) === "Planner",
    "paths have their planners’ colours",
  );
  check((await page.$$(".ticks button")).length === 3, "the slider has ticks at what is known, none for what is not");
  check((await page.textContent(".flights .main")).includes("saw the place too late"), "what explain says is there");
  await page.click('.ticks button[aria-label*="last chance"]');
  check(Math.abs((await time()) - 0.7 * contact_s) < 0.02, "a click on a tick goes there");
  const first = page.url();
  await page.keyboard.press("n");
  await page.waitForFunction(() => document.querySelector(".steps span").textContent.startsWith("2 of"));
  check(page.url() !== first, "n goes to the next trial");
  await page.click('.steps button:has-text("Previous")');
  await page.waitForFunction(() => document.querySelector(".steps span").textContent.startsWith("1 of"));
  check(await page.isDisabled('.steps button:has-text("Previous")'), "the first has none before it");
  await finish(page, "steps");
}
