// Pages made of others: of 10,000 trials, and with what explain knows of failures.
import { readFileSync, writeFileSync } from "node:fs";
import { deflateSync, inflateSync } from "node:zlib";

// ---- What lib/results/page packs.

function varints(bytes, values) {
  let last = 0;
  for (const value of values) {
    const delta = value - last;
    last = value;
    let v = delta < 0 ? -2 * delta - 1 : 2 * delta;
    while (v >= 128) {
      bytes.push((v % 128) | 128);
      v = Math.floor(v / 128);
    }
    bytes.push(v);
  }
}
function unpackDeltas(text, count) {
  const bytes = inflateSync(Buffer.from(text, "base64"));
  let place = 0;
  let last = 0;
  return Array.from({ length: count }, () => {
    let value = 0;
    let factor = 1;
    for (;;) {
      const byte = bytes[place++];
      value += (byte & 127) * factor;
      if (byte < 128) break;
      factor *= 128;
    }
    last += value % 2 === 0 ? value / 2 : -(value + 1) / 2;
    return last;
  });
}
const packDeltas = (values) => {
  const bytes = [];
  varints(bytes, values);
  return deflateSync(Buffer.from(bytes)).toString("base64");
};
function manyFloats(text, count, total) {
  const bytes = inflateSync(Buffer.from(text, "base64"));
  const out = Buffer.alloc(4 * total);
  for (let k = 0; k < 4; ++k) for (let i = 0; i < total; ++i) out[k * total + i] = bytes[k * count + (i % count)];
  return deflateSync(out).toString("base64");
}
/** Writes the page `from` as `to`, its data changed. */
function remade(from, to, change) {
  const [before, rest] = readFileSync(from, "utf8").split('<script type="application/json" id="data">');
  const end = rest.indexOf("</script>");
  const page = JSON.parse(rest.slice(0, end));
  change(page);
  const data = JSON.stringify(page).replaceAll("<", "\\u003c");
  writeFileSync(to, `${before}<script type="application/json" id="data">${data}${rest.slice(end)}`);
}

/** Of a small page with one sweep, its trials again and again. */
export function makeLarge(from, to, total) {
  remade(from, to, (page) => {
    const t = page.sweeps[0].trials;
    const n = t.count;
    const more = (text) => {
      const few = unpackDeltas(text, n);
      return packDeltas(Array.from({ length: total }, (_, i) => few[i % n]));
    };
    for (const name of ["planner", "map", "mission", "outcome"]) t[name] = more(t[name]);
    t.id = packDeltas(Array.from({ length: total }, (_, i) => i + 1));
    const keys = Buffer.alloc(6 * total);
    for (let i = 0; i < total; ++i) keys.writeUIntBE(i * 7919 + 1, 6 * i, 6);
    t.key = deflateSync(keys).toString("base64");
    t.end_s = manyFloats(t.end_s, n, total);
    t.metrics = t.metrics.map((m) => manyFloats(m, n, total));
    for (const words of [t.reason, ...t.axes]) words.index = more(words.index);
    t.count = total;
  });
}

/** As the page of a run in that state. */
export function makeRun(from, to, run) {
  remade(from, to, (page) => {
    page.run = run;
  });
}

/** With facts and a paragraph for each flight that touched something. */
export function makeExplained(from, to) {
  remade(from, to, (page) => {
    for (const flight of page.flights.filter((f) => f.touches.length)) {
      const contact_s = flight.touches[0].t;
      flight.facts = { in_range_s: 0.2 * contact_s, mapped_s: null, last_chance_s: 0.7 * contact_s, contact_s };
      flight.explanation = "It saw the place too late.";
    }
  });
}
