// A run: begun, watched, stopped, and what came of it.

import { button, make } from "./elements";
import { makeReplay } from "./replay";
import * as server from "./server";

export interface Simulation {
  /** Follows a run of this server. */
  follow(folder: string): void;
}

const EVERY = 500;

export function makeSimulation(panel: HTMLElement, ended: () => void, open: (folder: string, page: string) => void, tell: (error: unknown) => void): Simulation {
  const bar = make("progress", { max: 1, value: 0, "aria-label": "Share of the run that is done" });
  const words = make("p", { role: "status" }, "Nothing is being simulated.");
  const force = make("div", { class: "force" });
  const messages = make("pre", { class: "messages", tabindex: 0, "aria-label": "What the run has told" });
  const replay = makeReplay();
  let folder = "";
  let timer = 0;
  const stop = button("Stop, and keep what it has come to", () => void server.stop(folder).catch(tell));
  const resume = button("Go on with it", () => {
    server
      .resume(folder)
      .then(() => follow(folder))
      .catch(tell);
  });
  const show = make("div", { class: "actions" }, stop, resume);
  const several = make(
    "p",
    { class: "soft", hidden: true },
    "Every packing is simulated with the flow as it is and, where a partial factor stands on the loads, with the factored flow; the force and the picture are of the first simulation.",
  );
  panel.replaceChildren(words, bar, several, show, force, replay.element, messages);
  [bar, stop, resume, replay.element, messages].forEach((part) => (part.hidden = true));

  const look = async () => {
    let now: server.Progress;
    const asked = folder;
    try {
      now = await server.progress(folder, replay.last());
    } catch (error) {
      // The server may be on its way back; a run that it does not know is none to wait for.
      if (error instanceof server.Refused && error.status === 404) {
        words.textContent = "This run is not known to the server any more: see Reports.";
        [bar, stop].forEach((part) => (part.hidden = true));
        return;
      }
      words.textContent = error instanceof Error ? error.message : String(error);
      timer = window.setTimeout(() => void look(), 4 * EVERY);
      return;
    }
    if (asked !== folder) return;
    replay.add(now.pictures);
    replay.element.hidden = replay.last() === 0;
    force.replaceChildren(chart(now.force));
    messages.textContent = now.messages.join("\n");
    messages.hidden = now.messages.length === 0;
    const running = now.state === "running";
    stop.hidden = !running;
    stop.disabled = now.stopped;
    bar.hidden = !running;
    resume.hidden = running || !now.kept;
    if (running) {
      words.textContent = `out/${folder}: ${now.stopped ? "stopping; the run is kept at its next stop …" : progressInWords(now)}`;
      several.hidden = (now.told?.simulations ?? 1) < 2;
      if (now.told) bar.value = now.told.share;
      else bar.removeAttribute("value");
      timer = window.setTimeout(() => void look(), EVERY);
      return;
    }
    several.hidden = true;
    words.textContent = `out/${folder}: ${endInWords(now)}`;
    ended();
    if (now.page) open(folder, now.page);
  };
  const follow = (of: string) => {
    folder = of;
    window.clearTimeout(timer);
    replay.clear();
    replay.element.hidden = true;
    force.replaceChildren();
    words.textContent = "The run begins …";
    [bar, stop].forEach((part) => (part.hidden = false));
    resume.hidden = true;
    stop.disabled = false;
    void look();
  };
  return { follow };
}

function progressInWords({ told, taken }: server.Progress): string {
  if (!told) return `The flow is being packed (${inTime(taken)}) …`;
  const which = told.simulations > 1 ? `simulation ${told.simulation} of ${told.simulations}: ` : "";
  const left = told.left === null ? "" : `; about ${inTime(told.left)} left, until ${clock(told.left)}`;
  return `${Math.round(100 * told.share)} % after ${inTime(taken)}${left}. ${which}${told.time.toFixed(2)} s of the event, force on the barrier ${kilonewton(told.force)}.`;
}

function endInWords(now: server.Progress): string {
  if (now.exit_code === 0) return `The run is over after ${inTime(now.taken)}: PASS.`;
  if (now.page && now.exit_code === 1) return `The run is over after ${inTime(now.taken)}: FAIL.`;
  if (now.page) return `The run is over after ${inTime(now.taken)}: UNDECIDED.`;
  if (now.stopped && now.kept) return "The run was stopped. What it has come to is kept, and it goes on from where it was kept last.";
  if (now.stopped) return "The run was stopped before there was anything to keep.";
  return "The run ended without a report; see below what it told.";
}

function clock(left: number): string {
  return new Date(Date.now() + 1000 * left).toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });
}

export function inTime(seconds: number): string {
  if (seconds < 90) return `${Math.round(seconds)} s`;
  if (seconds < 5400) return `${Math.round(seconds / 60)} minutes`;
  return `${(seconds / 3600).toFixed(1)} hours`;
}

function kilonewton(force: number): string {
  const value = Math.abs(force / 1000);
  return `${value < 0.005 ? "0" : value < 10 ? value.toFixed(2) : value < 100 ? value.toFixed(1) : value.toFixed(0)} kN`;
}

/** Force over time, as far as it is known. */
function chart(points: [number, number][]): Node {
  if (points.length < 2) return document.createTextNode("");
  const [width, height, margin] = [640, 160, 64];
  const last = points.at(-1)?.[0] ?? 1;
  const highest = Math.max(...points.map(([, force]) => force), 1e-9);
  const at = ([time, force]: [number, number]) =>
    `${(margin + ((width - margin - 8) * time) / last).toFixed(1)},${(height - 24 - ((height - 40) * force) / highest).toFixed(1)}`;
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const add = (tag: string, attributes: Record<string, string>, text = "") => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.textContent = text;
    svg.append(element);
  };
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", `Force on the barrier, at most ${kilonewton(highest)} so far`);
  add("path", { d: `M${margin},12V${height - 24}H${width - 8}`, fill: "none", stroke: "#5b6670" });
  add("polyline", { points: points.map(at).join(" "), fill: "none", stroke: "#0b4f8a", "stroke-width": "1.5" });
  add("text", { x: "0", y: "20", "font-size": "12", fill: "#1d2329" }, kilonewton(highest));
  add("text", { x: String(width - 8), y: String(height - 6), "font-size": "12", "text-anchor": "end", fill: "#1d2329" }, `${last.toFixed(2)} s`);
  add("text", { x: String(margin), y: String(height - 6), "font-size": "12", fill: "#1d2329" }, "force on the barrier, single samples");
  return svg;
}
