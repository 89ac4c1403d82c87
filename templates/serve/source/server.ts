// What the server answers, and how it is asked.

export interface Problem {
  path: string;
  line: number | null;
  column: number | null;
  found: string;
  allowed: string;
  hint: string | null;
}

export interface Chart {
  title: string;
  svg: string;
  note: string;
}

export interface Check {
  title: string;
  guideline: string;
  capacity: string;
  working: string;
  utilisation: string;
  verdict: string;
  source: string;
}

export interface LoadCase {
  title: string;
  deposit: string;
  moving: string;
  force_per_width: string;
  total: string;
  formula: string;
  working: string;
  svg: string;
}

export interface Seen {
  title: string;
  verdict: string;
  verdict_line: string;
  checks: Check[];
  open: { why: string; checks: string }[];
  warnings: string[];
  cases: LoadCase[];
  utilisation: Chart | null;
  drawings: Chart[];
  grains: number;
  seconds: number;
  too_much: string;
}

export interface Look {
  problems: Problem[];
  seen: Seen | null;
}

export interface Written {
  path: string;
  text: string;
  digest: string;
}

/** What became of a text that was to be written: one of these. */
export interface Wrote {
  written?: Written;
  conflict?: string;
  wrong?: string;
}

export interface Start {
  program: string;
  folder: string;
  designs: string[];
  questions: { name: string; ask: string; usual: string }[];
  schema: Schema;
}

export interface Schema {
  type?: string | string[];
  description?: string;
  default?: unknown;
  const?: unknown;
  enum?: unknown[];
  pattern?: string;
  minimum?: number;
  maximum?: number;
  maxProperties?: number;
  properties?: Record<string, Schema>;
  required?: string[];
  items?: Schema | Schema[];
  anyOf?: Schema[];
  oneOf?: Schema[];
}

export interface Listed {
  folder: string;
  title: string;
  state: "running" | "kept" | "done";
  verdict: string;
  files: string[];
  page: string | null;
  written: number;
}

/** The flow from the side, in cm. */
export interface Picture {
  time: number;
  grains: [number, number, number, number][];
  ropes: [number, number, number, number, number, number][];
  one_of: number;
}

export interface Told {
  share: number;
  simulations: number;
  simulation: number;
  time: number;
  force: number;
  taken: number;
  left: number | null;
}

export interface Progress {
  state: "running" | "ended";
  taken: number;
  told: Told | null;
  force: [number, number][];
  pictures: [number, Picture][];
  messages: string[];
  stopped: boolean;
  kept: boolean;
  exit_code: number | null;
  page: string | null;
}

/** The secret of this server: behind the # of the address that it printed, and from then on in what the browser keeps for this host and port. */
const KEPT = "barrier-check-token";
const brought = /^#token=([0-9a-f]+)$/.exec(window.location.hash)?.[1];
if (brought) {
  window.localStorage.setItem(KEPT, brought);
  // It does not stay in the address, where it could be seen over a shoulder.
  window.history.replaceState(null, "", "/");
}
const token = brought ?? window.localStorage.getItem(KEPT) ?? "";

/** What the server said in the place of an answer. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    message: string,
  ) {
    super(message);
  }
}

async function ask<T>(method: string, address: string, body?: unknown, signal?: AbortSignal): Promise<T> {
  const headers: Record<string, string> = { "X-Barrier-Check-Token": token };
  const request: RequestInit = { method, headers };
  if (signal) request.signal = signal;
  if (body !== undefined) {
    headers["Content-Type"] = "application/json";
    request.body = JSON.stringify(body);
  }
  let answer: Response;
  try {
    answer = await fetch(address, request);
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new Refused(0, "The server does not answer. Is barrier-check still running?");
  }
  const told: unknown = await answer.json().catch(() => null);
  if (!answer.ok) {
    const why = told && typeof told === "object" && "error" in told ? String(told.error) : answer.statusText;
    throw new Refused(answer.status, why);
  }
  return told as T;
}

const named = (name: string) => encodeURIComponent(name);

export const start = () => ask<Start>("GET", "/api/start");
export const read = (path: string) => ask<Written>("GET", `/api/design?path=${named(path)}`);
export const write = (path: string, text: string, before: string | null) =>
  ask<Wrote>("PUT", "/api/design", { path, text, before });
export const makeNew = (path: string, answers: string[]) => ask<Wrote>("POST", "/api/new", { path, answers });
export const look = (path: string, text: string, signal: AbortSignal) =>
  ask<Look>("POST", "/api/look", { path, text }, signal);
export const runs = () => ask<{ runs: Listed[] }>("GET", "/api/runs");
export const begin = (path: string, seeds: number) => ask<{ folder: string }>("POST", "/api/runs", { path, seeds });
export const progress = (folder: string, after: number) =>
  ask<Progress>("GET", `/api/runs/${named(folder)}?after=${after}`);
export const stop = (folder: string) => ask<object>("POST", `/api/runs/${named(folder)}/stop`);
export const resume = (folder: string) => ask<object>("POST", `/api/runs/${named(folder)}/resume`);
export const compare = (folders: [string, string]) => ask<{ page: string }>("POST", "/api/compare", { folders });
export const addressOf = (folder: string, file: string) => `/report/${token}/${named(folder)}/${named(file)}`;
