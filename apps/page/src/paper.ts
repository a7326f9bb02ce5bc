// Printing: light colours, charts as wide as the paper, tables with all their rows. What needs more than a style listens.
import { useEffect, useState } from "preact/hooks";
import type { Theme } from "./data";
import { showTheme } from "./data";

/** Of the window, when the page was made ready for paper, or for the screen again. */
export const kPaperEvent = "paper";
const isOnPaper = (): boolean => document.documentElement.hasAttribute("data-paper");

/** Watches for printing; `theme` is that of the screen. */
export function watchPaper(theme: () => Theme): void {
  const show = (paper: boolean): void => {
    if (paper === isOnPaper()) return;
    document.documentElement.toggleAttribute("data-paper", paper);
    showTheme(paper ? "light" : theme());
    window.dispatchEvent(new Event(kPaperEvent));
  };
  window.addEventListener("beforeprint", () => show(true));
  window.addEventListener("afterprint", () => show(false));
  window.matchMedia("print").addEventListener("change", (e) => show(e.matches));
}

/** Whether it is shown on paper. */
export function usePaper(): boolean {
  const [paper, setPaper] = useState(isOnPaper);
  useEffect(() => {
    const read = (): void => setPaper(isOnPaper());
    window.addEventListener(kPaperEvent, read);
    return () => window.removeEventListener(kPaperEvent, read);
  }, []);
  return paper;
}
