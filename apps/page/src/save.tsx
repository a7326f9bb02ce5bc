// Tables as CSV, charts as SVG and PNG: files that stand alone.
import type { JSX } from "preact";
import { currentTheme, showTheme } from "./data";

export interface NumberTable {
  head: string[];
  rows: (string | number | null)[][];
}

/** As lib/base/table/csv.cpp writes it: quotes where needed, an apostrophe before what a spreadsheet would run. */
function csvField(value: string | number | null): string {
  if (value === null || Number.isNaN(value)) return "";
  if (typeof value === "number") return Number.isFinite(value) ? String(value) : value > 0 ? "inf" : "-inf";
  const isNumber = value.trim() === value && Number.isFinite(Number(value || NaN));
  const word = /^'*[=+\-@\t\r]/.test(value) && !isNumber && !/^[+-]?inf$/.test(value) ? `'${value}` : value;
  return /[,"\r\n]|^#/.test(word) ? `"${word.replaceAll('"', '""')}"` : word;
}
/** A number that a page has in single precision with the fewest digits that say it. */
export function shortest<Value>(value: Value): Value | number {
  if (typeof value !== "number" || Math.fround(value) !== value || Number.isInteger(value)) return value;
  for (let count = 6; count < 9; ++count) {
    const few = Number(value.toPrecision(count));
    if (Math.fround(few) === value) return few;
  }
  return Number(value.toPrecision(9));
}
export const csvOf = (table: NumberTable): string =>
  [table.head, ...table.rows].map((row) => `${row.map(csvField).join(",")}\r\n`).join("");

/** What a table shows; numbers with all their digits where it has them. */
export function tableOf(table: HTMLTableElement): NumberTable {
  const cells = (row: HTMLTableRowElement): string[] =>
    [...row.cells].map((c) => c.dataset.value ?? c.textContent?.trim() ?? "");
  const [head, ...rows] = [...table.rows].map(cells);
  return { head, rows };
}

/** What the style gives the parts of a chart, as attributes of their own. */
const kLook = [
  "fill",
  "stroke",
  "stroke-width",
  "stroke-dasharray",
  "stroke-linecap",
  "opacity",
  "font-size",
  "font-weight",
  "paint-order",
];
function withLook(from: Element): Element {
  const copy = from.cloneNode(true) as Element;
  const parts = [...from.querySelectorAll("*")];
  [...copy.querySelectorAll("*")].forEach((part, i) => {
    const look = getComputedStyle(parts[i]);
    const isText = part.tagName === "text";
    for (const name of kLook) {
      const value = look.getPropertyValue(name);
      const isUsual = ["none", "normal", "butt", "1", "1px"].includes(value) || (name.startsWith("font") && !isText);
      if (isUsual && !(name === "fill" && value === "none")) part.removeAttribute(name);
      else part.setAttribute(name, value);
    }
    part.removeAttribute("class");
  });
  for (const unseen of copy.querySelectorAll('[fill="rgba(0, 0, 0, 0)"]')) unseen.remove();
  return copy;
}

const kPad = 14;
const kFont = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", Arial, sans-serif';
const kSpace = "http://www.w3.org/2000/svg";

/** The chart of a figure with its title and legend, on white. */
export function svgOf(figure: Element): SVGSVGElement {
  const chart = figure.querySelector<SVGSVGElement>(".chart svg")!;
  const width = chart.width.baseVal.value + 2 * kPad;
  const svg = document.createElementNS(kSpace, "svg");
  const add = (name: string, attributes: Record<string, string | number>, text = ""): void => {
    const part = document.createElementNS(kSpace, name);
    for (const [key, value] of Object.entries(attributes)) part.setAttribute(key, String(value));
    part.textContent = text;
    svg.append(part);
  };
  const place = (part: Element, x: number, y: number): void => {
    part.setAttribute("x", String(x));
    part.setAttribute("y", String(y));
    part.setAttribute("overflow", "visible");
    part.removeAttribute("aria-hidden");
    svg.append(part);
  };
  const before = currentTheme();
  showTheme("light");
  try {
    const pen = document.createElement("canvas").getContext("2d")!;
    pen.font = `12.5px ${kFont}`;
    add("rect", { width: "100%", height: "100%", fill: "#ffffff" });
    const title = figure.querySelector("h3")?.textContent ?? "";
    const shown = title.charAt(0).toUpperCase() + title.slice(1);
    add("text", { x: kPad, y: 24, "font-size": 15, "font-weight": 600, fill: "#1c2228" }, shown);
    let [x, y] = [kPad, 48];
    const items = [...figure.querySelectorAll(".legend li")];
    for (const item of items) {
      const sign = item.querySelector("svg")!;
      const words = item.textContent ?? "";
      const room = sign.width.baseVal.value + 5 + pen.measureText(words).width;
      if (x > kPad && x + room > width - kPad) [x, y] = [kPad, y + 19];
      place(withLook(sign), x, y - 11);
      add("text", { x: x + sign.width.baseVal.value + 5, y, "font-size": 12.5, fill: "#1c2228" }, words);
      x += room + 16;
    }
    const top = items.length ? y + 12 : 36;
    place(withLook(chart), kPad, top);
    const height = top + chart.height.baseVal.value + kPad;
    for (const [key, value] of Object.entries({ width, height, viewBox: `0 0 ${width} ${height}` }))
      svg.setAttribute(key, String(value));
    svg.setAttribute("font-family", kFont);
  } finally {
    showTheme(before);
  }
  return svg;
}

const fileOf = (svg: SVGSVGElement): Blob =>
  new Blob([`<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(svg)}\n`], {
    type: "image/svg+xml",
  });

/** Twice as fine as on the screen. */
async function pictureOf(svg: SVGSVGElement): Promise<Blob> {
  const address = URL.createObjectURL(fileOf(svg));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [2 * svg.width.baseVal.value, 2 * svg.height.baseVal.value];
    canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done, failed) =>
      canvas.toBlob((blob) => (blob ? done(blob) : failed(new Error("the browser made no PNG")))),
    );
  } finally {
    URL.revokeObjectURL(address);
  }
}

function download(content: Blob, name: string, ending: string): void {
  const link = document.createElement("a");
  const page = document.title.replace(/ · avoidbench$/, "");
  link.href = URL.createObjectURL(content);
  link.download = `${`${page} ${name}`.replace(/[^\p{L}\p{N}.-]+/gu, "_").slice(0, 100)}.${ending}`;
  link.click();
  // The browser may still read it.
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

/** Small buttons that save a table, the one beside them if none is given, or the chart of the figure that they are in. */
export function Save(props: { name: string; table?: () => NumberTable; chart?: boolean }): JSX.Element {
  const { name } = props;
  const hostOf = (e: Event): Element => (e.currentTarget as Element).closest("figure, .plot, .with-save")!;
  const csv = (e: Event): void => {
    const table = props.table?.() ?? tableOf(hostOf(e).querySelector("table")!);
    download(new Blob([csvOf(table)], { type: "text/csv;charset=utf-8" }), name, "csv");
  };
  const button = (text: string, act: (e: Event) => void): JSX.Element => (
    <button type="button" title={`Save as ${text}`} aria-label={`Save as ${text}: ${name}`} onClick={act}>
      {text}
    </button>
  );
  return (
    <span class="save">
      {button("CSV", csv)}
      {props.chart ? (
        <>
          {button("SVG", (e) => download(fileOf(svgOf(hostOf(e))), name, "svg"))}
          {button("PNG", (e) => void pictureOf(svgOf(hostOf(e))).then((png) => download(png, name, "png")))}
        </>
      ) : null}
    </span>
  );
}
