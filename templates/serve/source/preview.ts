// What the equations say of the design while it is typed, and what it looks like.

import { make, picture } from "./elements";
import { sentence } from "./editor";
import type { Chart, Look, Problem, Seen } from "./server";

export interface Preview {
  show(look: Look): void;
  /** The design is being looked at, or has problems: what is shown is of the last good text. */
  outdated(outdated: boolean): void;
}

interface Panels {
  problems: HTMLElement;
  drawing: HTMLElement;
  checks: HTMLElement;
  loads: HTMLElement;
  verdict: HTMLElement;
}

export function makePreview(panels: Panels, goTo: (problem: Problem) => void): Preview {
  return {
    show: (look) => {
      problems(panels.problems, look.problems, goTo);
      if (look.seen) seen(panels, look.seen);
      else panels.verdict.replaceChildren(make("span", { class: "badge fail" }, `${look.problems.length} ${look.problems.length === 1 ? "problem" : "problems"}`));
    },
    outdated: (outdated) => {
      for (const panel of [panels.drawing, panels.checks, panels.loads]) panel.classList.toggle("outdated", outdated);
    },
  };
}

function problems(panel: HTMLElement, list: Problem[], goTo: (problem: Problem) => void) {
  panel.replaceChildren(
    ...list.map((problem) => {
      const place = problem.line === null ? "" : `line ${problem.line}: `;
      const link = make("button", { type: "button", class: "problem" }, place + sentence(problem));
      link.addEventListener("click", () => goTo(problem));
      return make("li", {}, link);
    }),
  );
  panel.hidden = list.length === 0;
}

function figure(chart: Chart): HTMLElement {
  return make("figure", {}, make("h3", {}, chart.title), picture(chart.svg), make("p", { class: "soft" }, chart.note));
}

function table(heads: string[], rows: (Node | string)[][], label: string): HTMLElement {
  const head = make("tr", {}, ...heads.map((text) => make("th", { scope: "col" }, text)));
  const body = rows.map((row) => make("tr", {}, ...row.map((cell) => make("td", {}, cell))));
  return make("div", { class: "wide", tabindex: 0, role: "region", "aria-label": label }, make("table", {}, make("thead", {}, head), make("tbody", {}, ...body)));
}

function seen(panels: Panels, seen: Seen) {
  panels.verdict.replaceChildren(
    make("span", { class: `badge ${seen.verdict}` }, seen.verdict),
    " by the equations alone: ",
    seen.verdict_line,
  );
  const warnings = seen.warnings.length > 0 ? make("ul", { class: "warnings" }, ...seen.warnings.map((text) => make("li", {}, text))) : null;
  panels.drawing.replaceChildren(make("h2", {}, seen.title), ...seen.drawings.map(figure));
  const rows = seen.checks.map((check) => [
    check.title,
    check.guideline,
    check.capacity,
    check.utilisation,
    make("span", { class: `badge ${check.verdict}` }, check.verdict),
  ]);
  const open = seen.open.map((reason) => make("li", {}, make("strong", {}, reason.checks), ` — ${reason.why}`));
  panels.checks.replaceChildren(
    ...[
      warnings && make("h3", {}, "What a reviewer should know first"),
      warnings,
      seen.utilisation && figure(seen.utilisation),
      table(["Check", "Demand by the equations", "Capacity", "Used", "Verdict"], rows, "Checks"),
      open.length > 0 && make("h3", {}, "Why checks are open"),
      open.length > 0 && make("ul", {}, ...open),
    ].filter((part): part is HTMLElement => part instanceof HTMLElement),
  );
  const cases = seen.cases.map((of) =>
    make(
      "figure",
      { class: "case" },
      make("h3", {}, of.title),
      picture(of.svg),
      make("p", {}, `${of.total} in all; ${of.force_per_width} at the deepest metre`),
      make("p", { class: "soft" }, of.formula),
      make("p", { class: "soft" }, of.working),
    ),
  );
  panels.loads.replaceChildren(make("div", { class: "cases" }, ...cases));
}
