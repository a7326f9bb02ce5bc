// Parts of check_page.mjs: the page of a run, while it flies and afterwards.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";

const stateOf = (page) => page.getAttribute("[data-run]", "data-run");
const doneOf = async (page) => Number(/[\d]+(?= of| trials)/.exec(await page.textContent("[data-run]"))[0]);
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

export async function checkRun({ opened, finish, check, program, folder, at }) {
  const words = [
    "run",
    "small.yaml",
    "--set",
    "trials=400",
    "--jobs",
    "1",
    "--db",
    "long.db",
    "--quiet",
    "--grace",
    "0",
  ];
  const run = spawn(program, [...words, "--page", "long.html"], { cwd: folder, stdio: "ignore" });
  const ended = new Promise((done) => run.on("exit", done));
  while (!existsSync(at("long.html"))) await pause(50);
  const page = await opened("long.html", "#theme=dark");
  let loads = 0;
  page.on("load", () => {
    loads += 1;
  });
  check((await stateOf(page)) === "running", "the page of a run is there before its first trial");
  await page.waitForSelector('figure[data-figure="success"] svg', { timeout: 60000 });
  check(loads > 0 && page.url().endsWith("theme=dark"), "it loads itself again, with what was flown since");
  const ids = await page.$$eval(".examples button", (all) => all.map((e) => e.textContent));
  check(!ids.includes("trial 0"), "every trial has its number, also those that ended while it was written");
  const before = await doneOf(page);
  // Where someone reads is kept.
  await page.click('figure[data-figure="success"] summary');
  await page.evaluate(() => window.scrollTo(0, 300));
  const seen = loads;
  await page.waitForFunction(
    (n) => Number(/\d+(?= of)/.exec(document.querySelector("[data-run]").textContent)[0]) > n,
    before,
    {
      timeout: 60000,
    },
  );
  await page.waitForTimeout(300);
  check(loads > seen && (await doneOf(page)) > before, "and again");
  const place = await page.evaluate(() => window.scrollY);
  check(Math.abs(place - 300) < 3, "it stays where it was scrolled to", `${place} px`);
  check((await page.$('figure[data-figure="success"] details[open]')) !== null, "what was open is open again");
  await page.click('.run button:has-text("Pause")');
  const paused = loads;
  await pause(6500);
  check(loads === paused, "Pause holds it");
  await page.click('.run button:has-text("Load again")');
  await page.waitForFunction(() => document.querySelector('.run button[aria-pressed="false"]'));
  // A flight that is looked at is not taken away.
  await page.click('nav button:has-text("Trials")');
  await page.click('tr[data-place="0"]');
  await page.waitForSelector(".stage > canvas");
  const flight = loads;
  await pause(6500);
  check(loads === flight, "while a flight is shown the page stays");
  await page.click('nav button:has-text("Overview")');
  run.kill("SIGTERM");
  check((await ended) === 75, "the run was stopped");
  await page.waitForSelector('[data-run="interrupted"]', { timeout: 60000 });
  const last = loads;
  await pause(6500);
  check(loads === last, "the last page says so and loads itself no more");
  await finish(page, "the page of a run");
}

/** Of a run that ended without a last page, as by a power cut. */
export async function checkSilentRun({ opened, finish, check, makeRun, at }) {
  const state = { state: "running", total: 40, done: 20, is_open: false, left_s: 100, every_s: 5 };
  makeRun(at("small.html"), at("silent.html"), { ...state, written_s: Date.now() / 1000 - 3600 });
  const page = await opened("silent.html");
  check((await page.textContent("[data-run]")).includes("No news"), "an old page says that the run may have ended");
  await finish(page, "the page of a run that went silent");
  makeRun(at("small.html"), at("complete.html"), { state: "complete", total: 20, done: 20, is_open: false });
  const last = await opened("complete.html");
  let loads = 0;
  last.on("load", () => {
    loads += 1;
  });
  await pause(6500);
  check(
    (await last.textContent("[data-run]")).includes("Complete: 20 of 20"),
    "the last page says that all were flown",
  );
  check(loads === 0 && (await last.$$(".run button, .run progress")).length === 0, "and stays as it is");
  await finish(last, "the page of a complete run");
}
