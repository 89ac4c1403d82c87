// Earlier runs: their reports, those that can be gone on with, and two of them side by side.

import { button, make } from "./elements";
import * as server from "./server";

export interface Reports {
  refresh(): Promise<void>;
  open(folder: string, page: string): void;
}

export function makeReports(panel: HTMLElement, follow: (folder: string) => void, tell: (error: unknown) => void): Reports {
  const holder = make("div", { class: "wide" });
  const compare = button("Hold the two that are ticked side by side", () => void side());
  const frame = make("iframe", { title: "Report", class: "report", hidden: true });
  const apart = make("p", { hidden: true });
  panel.replaceChildren(holder, make("div", { class: "actions" }, compare), apart, frame);
  const ticked = () => [...holder.querySelectorAll<HTMLInputElement>("input:checked")].map((box) => box.value);
  const able = () => (compare.disabled = ticked().length !== 2);

  let known: server.Listed[] = [];
  const open = (folder: string, page: string) => {
    const address = server.addressOf(folder, page);
    frame.src = address;
    frame.hidden = false;
    const files = known.find((run) => run.folder === folder)?.files ?? [];
    const links = files.flatMap((file) => [", ", make("a", { href: server.addressOf(folder, file), download: file }, file)]);
    apart.replaceChildren(make("a", { href: address, target: "_blank", rel: "noopener" }, "Open this report in a tab of its own"), ...links, ` (in out/${folder})`);
    apart.hidden = false;
    frame.scrollIntoView({ block: "nearest" });
  };
  const side = async () => {
    const [a, b] = ticked();
    if (!a || !b) return;
    try {
      const { page } = await server.compare([a, b]);
      const [folder, file] = page.split("/");
      await refresh();
      if (folder && file) open(folder, file);
    } catch (error) {
      tell(error);
    }
  };
  const draw = (runs: server.Listed[]) => {
    known = runs;
    if (runs.length === 0) {
      holder.replaceChildren(make("p", { class: "soft" }, "No report yet: run a design."));
      able();
      return;
    }
    const row = (run: server.Listed) => {
      const box = make("input", { type: "checkbox", value: run.folder, "aria-label": `Compare ${run.folder}`, disabled: run.page !== "report.html" });
      box.addEventListener("change", able);
      const page = run.page;
      const actions = [
        page && run.state !== "running" ? button("Open", () => open(run.folder, page), { "aria-label": `Open the report ${run.folder}` }) : null,
        run.state === "kept" ? button("Go on with it", () => void server.resume(run.folder).then(() => follow(run.folder)).catch(tell), { "aria-label": `Go on with it: ${run.folder}` }) : null,
        run.state === "running" ? button("Watch", () => follow(run.folder), { "aria-label": `Watch the run ${run.folder}` }) : null,
      ];
      const state = run.state === "kept" ? "interrupted, kept" : run.state;
      const verdict = run.verdict ? make("span", { class: `badge ${run.verdict}` }, run.verdict) : "";
      const when = run.page ? new Date(1000 * run.written).toLocaleString() : "";
      const cells = [box, run.folder, run.title, verdict, run.state === "done" ? when : state, make("span", { class: "actions" }, ...actions)];
      return make("tr", {}, ...cells.map((cell) => make("td", {}, cell)));
    };
    const heads = ["Compare", "Folder", "Design", "Verdict", "Written", ""].map((text) => make("th", { scope: "col" }, text));
    holder.replaceChildren(make("table", {}, make("thead", {}, make("tr", {}, ...heads)), make("tbody", {}, ...runs.map(row))));
    able();
  };
  const refresh = () => server.runs().then(({ runs }) => draw(runs)).catch(tell);
  return { refresh, open };
}
