// What stands around every page: its title, its parts, the state of its run, its colours.
import type { ComponentChildren, JSX } from "preact";
import type { PageData, Theme } from "./data";
import { RunBanner } from "./live";
import type { View } from "./state";

export function usedTheme(view: View): Theme {
  const usual = window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  return (view.theme || usual) as Theme;
}

export interface Shown {
  page: PageData;
  view: View;
  change: (part: Partial<View>) => void;
}

export function Frame(
  props: Shown & {
    tabs: [string, string][];
    subtitle: string;
    title: string;
    children: ComponentChildren;
    sweeps?: JSX.Element | null;
  },
): JSX.Element {
  const { view, change } = props;
  const theme = usedTheme(view);
  return (
    <>
      <a
        class="skip"
        href="#main"
        onClick={(e) => {
          e.preventDefault();
          document.getElementById("main")?.focus();
        }}
      >
        To the content
      </a>
      <header>
        <div class="title">
          <h1>{props.title}</h1>
          <p>{props.subtitle}</p>
        </div>
        {props.sweeps}
        <nav aria-label="Parts of the page">
          {props.tabs.map(([id, name]) => (
            <button aria-current={view.tab === id ? "page" : undefined} onClick={() => change({ tab: id })}>
              {name}
            </button>
          ))}
        </nav>
        <button
          class="theme"
          onClick={() => change({ theme: theme === "dark" ? "light" : "dark" })}
          aria-label={`Switch to ${theme === "dark" ? "light" : "dark"} colours`}
        >
          {theme === "dark" ? "☀" : "☾"}
        </button>
      </header>
      {props.page.run ? <RunBanner run={props.page.run} held={view.tab === "replay"} /> : null}
      <main id="main" tabIndex={-1}>
        {props.children}
      </main>
      <footer>
        avoidbench {props.page.program.version} ({props.page.program.git}) · <code>{props.page.command}</code>
      </footer>
    </>
  );
}
