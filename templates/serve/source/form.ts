// The design as a form, made from the schema. What is changed here is changed in the text, whose comments stay.

import { type Document, isScalar, parseDocument, stringify } from "yaml";

import { button, make } from "./elements";
import { allowed, isChoice, isList, isSection, item, nodeAt, properties, units, words } from "./keys";
import { sentence } from "./editor";
import type { Problem, Schema } from "./server";

type Path = (string | number)[];

export interface Form {
  /** Shows a text; what is being typed into stays as it is. */
  show(text: string, anyway?: boolean): void;
  /** Tells what is wrong beside the fields. */
  mark(problems: Problem[]): void;
}

/** The parts of a text that begin with a key at its left edge, each with what stands below it. */
function parts(text: string): [string, string][] {
  return text.split(/^(?=[A-Za-z_][\w-]*\s*:)/m).map((part) => [/^[A-Za-z_][\w-]*/.exec(part)?.[0] ?? "", part]);
}

/** A text that was written anew, with those parts as they were before in which nothing has changed: writing anew moves comments. */
function grafted(before: string, after: string): string {
  const old = new Map(parts(before));
  const same = (a: string, b: string) => JSON.stringify(parseDocument(a).toJS()) === JSON.stringify(parseDocument(b).toJS());
  const text = parts(after).map(([key, part]) => {
    const was = old.get(key);
    return was !== undefined && same(was, part) ? was : part;
  });
  // Only if it is the same design all the same.
  const joined = text.join("");
  return same(joined, after) ? joined : after;
}

const idOf = (path: Path) => `field-${path.join("-")}`;
const nameOf = (path: Path) => path.map((step) => (typeof step === "number" ? `[${step + 1}]` : step)).join(".").replaceAll(".[", "[");
const inWords = (key: string) => key.replaceAll("_", " ");

export function makeForm(parent: HTMLElement, schema: Schema, current: () => string, change: (text: string) => void, history: { undo: () => void; redo: () => void }): Form {
  let marked: Problem[] = [];
  const wrong = make("p", { class: "wrong", role: "alert" });
  const bar = make("div", { class: "actions" }, button("Undo", history.undo), button("Redo", history.redo));
  const unfolded = new Set<string>(["project", "channel", "flow", "barrier"]);

  /** Changes one value of the text: only its own letters where it is there already. */
  const set = (path: Path, value: unknown) => {
    const text = current();
    const document = parseDocument(text);
    const there = document.getIn(path, true);
    if (isScalar(there) && there.range && (typeof value !== "object" || value === null)) {
      const written = stringify(value, { lineWidth: 0 }).trimEnd();
      const glue = text[there.range[0] - 1] === ":" ? " " : "";
      change(text.slice(0, there.range[0]) + glue + written + text.slice(there.range[1]));
      return;
    }
    const told = rewrite((document) => document.setIn(path, document.createNode(value, { aliasDuplicateObjects: false })));
    unfolded.add(nameOf(path));
    draw();
    if (told) return;
    const field = window.document.getElementById(idOf(path)) ?? parent.querySelector(`[data-name="${CSS.escape(nameOf(path))}"] input, [data-name="${CSS.escape(nameOf(path))}"] select, [data-name="${CSS.escape(nameOf(path))}"] summary`);
    if (field instanceof HTMLElement) field.focus();
  };
  const remove = (path: Path) => {
    rewrite((document) => document.deleteIn(path));
    draw();
    window.document.getElementById(`${idOf(path.slice(0, -1))}-add`)?.focus();
  };
  /** Changes the structure of the text; what stands in the way, if anything does. */
  const rewrite = (act: (document: Document) => void): string => {
    const document = parseDocument(current());
    try {
      act(document);
      change(grafted(current(), document.toString({ lineWidth: 0 })));
      wrong.textContent = "";
    } catch {
      wrong.textContent = "This cannot be changed in the form, because the text repeats a part by an alias (`*name`): change it in the tab Text.";
    }
    return wrong.textContent;
  };

  const valueAt = (path: Path): unknown =>
    path.reduce<unknown>((at, step) => (typeof at === "object" && at !== null ? (at as Record<string | number, unknown>)[step] : undefined), parseDocument(current()).toJS());

  /** What stands in a place before anything is given there. */
  const empty = (node: Schema): unknown => {
    const some = words(node);
    if (some.length > 0) return some.includes(String(node.default)) ? node.default : some[0];
    if (isSection(node)) return Object.fromEntries((node.required ?? []).map((key) => [key, empty(properties(node)[key] ?? {})]));
    if (isList(node)) return Array.isArray(node.items) ? node.items.map(empty) : [emptyItem(node)];
    if (node.default !== undefined) return node.default;
    if (node.type === "boolean") return false;
    if (node.type === "integer" || node.type === "number") return node.minimum ?? 0;
    const unit = units(node)[0];
    return unit ? `0 ${unit}` : "?";
  };
  const emptyItem = (node: Schema): unknown => empty(Array.isArray(node.items) ? {} : (node.items ?? {}));
  const copy = (value: unknown): unknown => JSON.parse(JSON.stringify(value));

  const field = (path: Path, node: Schema, value: unknown, required: boolean): HTMLElement => {
    const id = idOf(path);
    const last = path.at(-1);
    const unit = units(node).slice(0, 3).join(", ");
    const label = typeof last === "number" ? `${last + 1}${unit ? ` (${unit})` : ""}` : inWords(String(last));
    const told = make("small", { id: `${id}-told` }, [node.description, allowed(node)].filter(Boolean).join("; "));
    const some = words(node);
    let input: HTMLInputElement | HTMLSelectElement;
    const described = { id, "aria-describedby": `${id}-told ${id}-wrong` };
    if (some.length > 0 || node.type === "boolean") {
      input = make("select", described);
      const options = node.type === "boolean" ? ["true", "false"] : some;
      if (!options.includes(String(value))) input.append(make("option", {}, String(value)));
      for (const option of options) input.append(make("option", { selected: option === String(value) }, option));
    } else {
      input = make("input", { ...described, type: "text", autocomplete: "off", value: value === null || value === undefined ? "" : String(value) });
    }
    input.addEventListener("change", () => {
      const typed = input.value.trim();
      const numeric = node.type === "number" || node.type === "integer" || node.type === undefined;
      if (node.type === "boolean") set(path, typed === "true");
      else if (numeric && typed !== "" && Number.isFinite(Number(typed))) set(path, Number(typed));
      else set(path, typed);
    });
    const row = make("div", { class: "field" }, make("label", { for: id }, label), input, told, make("p", { class: "wrong", id: `${id}-wrong` }));
    if (!required) row.append(button("×", () => remove(path), { class: "remove", title: `Remove ${nameOf(path)}`, "aria-label": `Remove ${nameOf(path)}` }));
    row.dataset["path"] = path.join(".");
    return row;
  };

  const list = (path: Path, node: Schema, value: unknown): HTMLElement => {
    const items = Array.isArray(value) ? (value as unknown[]) : [];
    const holder = make("div", { class: "list" });
    items.forEach((each, place) => {
      const of = item(node, place);
      if (!of) return;
      const here = [...path, place];
      const row = make("div", { class: isSection(of) ? "item" : "item plain" }, any(here, of, each, true));
      row.append(button("×", () => remove(here), { class: "remove", title: `Remove ${nameOf(here)}`, "aria-label": `Remove ${nameOf(here)}` }));
      holder.append(row);
    });
    if (!Array.isArray(node.items)) {
      const add = () => {
        // What was typed since the form was drawn is in the text alone.
        const now = valueAt(path);
        const those: unknown[] = Array.isArray(now) ? now : [];
        set(path, [...those, those.length > 0 ? copy(those[those.length - 1]) : emptyItem(node)]);
      };
      holder.append(button(`Add to ${inWords(nameOf(path.slice(-2)))}`, add));
    }
    return holder;
  };

  const any = (path: Path, node: Schema, value: unknown, required: boolean): HTMLElement => {
    const scalar = value === null || typeof value !== "object";
    if (isList(node) && !scalar) {
      const last = path.at(-1);
      if (Array.isArray(node.items)) return list(path, node, value);
      return fold(path, typeof last === "number" ? nameOf(path) : String(last), node, required, list(path, node, value));
    }
    if (isSection(node) && !scalar) {
      const body = section(path, node, value as Record<string, unknown>);
      return typeof path.at(-1) === "number" ? body : fold(path, String(path.at(-1)), node, required, body);
    }
    return field(path, node, value, required);
  };

  const fold = (path: Path, key: string, node: Schema, required: boolean, body: HTMLElement): HTMLElement => {
    const name = nameOf(path);
    const summary = make("summary", {}, make("span", {}, inWords(key)), make("small", {}, node.description ?? ""));
    const details = make("details", { open: unfolded.has(name) || path.length > 2 }, summary);
    details.addEventListener("toggle", () => (details.open ? unfolded.add(name) : unfolded.delete(name)));
    details.dataset["name"] = name;
    details.append(body);
    if (!required) details.append(make("div", { class: "actions" }, button(`Remove ${inWords(key)}`, () => remove(path))));
    return details;
  };

  const section = (path: Path, node: Schema, value: Record<string, unknown>): HTMLElement => {
    const holder = make("div", { class: "section" });
    const known = properties(node);
    const choice = isChoice(node);
    // In the order of the text.
    for (const [key, each] of Object.entries(value ?? {})) {
      const of = known[key];
      if (of) holder.append(any([...path, key], of, each, choice || (node.required ?? []).includes(key)));
      else holder.append(make("p", { class: "wrong" }, `${nameOf([...path, key])} is no key that is known here.`));
    }
    const missing = Object.keys(known).filter((key) => !(value && key in value));
    const given = Object.keys(value ?? {}).filter((key) => key in known);
    const only = given[0];
    if (choice && given.length <= 1 && missing.length > 0) {
      const id = `${idOf(path)}-which`;
      const select = make("select", { id });
      if (!only) select.append(make("option", { value: "" }, "choose"));
      for (const key of Object.keys(known)) select.append(make("option", { value: key, selected: key === only }, inWords(key)));
      select.addEventListener("change", () => {
        const chosen = select.value;
        if (!chosen) return;
        const before = only ? valueAt([...path, only]) : undefined;
        const has = typeof before === "object" && before !== null && Object.keys(before).length > 0;
        if (has && !window.confirm(`What is given under ${inWords(only ?? "")} is taken out of the text, but for keys that ${inWords(chosen)} has as well. It can be undone.`)) {
          select.value = only ?? "";
          return;
        }
        const fresh = empty(known[chosen] ?? {});
        const keys = properties(known[chosen] ?? {});
        const kept = has && !Array.isArray(before) ? Object.entries(before).filter(([key]) => key in keys) : [];
        set(path, { [chosen]: typeof fresh === "object" && !Array.isArray(fresh) ? { ...fresh, ...(copy(Object.fromEntries(kept)) as object) } : fresh });
      });
      holder.prepend(make("div", { class: "field" }, make("label", { for: id }, `which ${inWords(String(path.at(-1) ?? "design"))}`), select));
    } else if (missing.length > 0) {
      const id = `${idOf(path)}-add`;
      const select = make("select", { id }, make("option", { value: "" }, "…"));
      for (const key of missing) select.append(make("option", { value: key, title: known[key]?.description ?? "" }, inWords(key)));
      select.addEventListener("change", () => {
        const of = known[select.value];
        if (of) set([...path, select.value], empty(of));
      });
      holder.append(make("div", { class: "add" }, make("label", { for: id }, path.length === 0 ? "add" : `add to ${inWords(nameOf(path.slice(-2)))}`), select));
    }
    return holder;
  };

  const markAll = () => {
    for (const row of parent.querySelectorAll<HTMLElement>(".field[data-path]")) {
      const of = marked.filter((problem) => problem.path === row.dataset["path"]);
      const wrong = row.querySelector(".wrong");
      if (wrong) wrong.textContent = of.map(sentence).join(" ");
      row.querySelector("input, select")?.setAttribute("aria-invalid", String(of.length > 0));
    }
  };

  const draw = () => {
    const document: Document = parseDocument(current());
    const focused = window.document.activeElement?.id;
    const scroll = parent.scrollTop;
    const empty = current().trim() === "";
    const value: unknown = document.errors.length > 0 ? null : empty ? {} : document.toJS();
    if (value === null || typeof value !== "object" || Array.isArray(value)) {
      parent.replaceChildren(make("p", { class: "soft" }, "The text is no YAML that a form could show: mend it in the tab Text first."));
      return;
    }
    parent.replaceChildren(bar, wrong, section([], nodeAt(schema, []) ?? {}, value as Record<string, unknown>));
    parent.scrollTop = scroll;
    markAll();
    if (focused?.startsWith("field-")) window.document.getElementById(focused)?.focus();
  };

  return {
    show: (_, anyway) => {
      // Whoever is typing into a field goes on.
      if (!anyway && parent.contains(window.document.activeElement) && window.document.activeElement instanceof HTMLInputElement) return;
      draw();
    },
    mark: (problems) => {
      marked = problems;
      markAll();
    },
  };
}
