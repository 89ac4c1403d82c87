// The keys of a design, as the schema has them: which there are at a place, and what is told of each.

import type { Schema } from "./server";

/** All keys that a node of the schema may have, whichever of its forms it takes. */
export function properties(node: Schema): Record<string, Schema> {
  const forms = [...(node.anyOf ?? []), ...(node.oneOf ?? [])];
  return Object.assign({}, ...forms.map(properties), node.properties ?? {}) as Record<string, Schema>;
}

/** Whether only one of its keys may be given. */
export function isChoice(node: Schema): boolean {
  return node.maxProperties === 1 || (node.anyOf ?? []).some((form) => form.maxProperties === 1);
}

/** Words that may stand in the place of a section. */
export function words(node: Schema): string[] {
  const own = node.enum ?? (node.const === undefined ? [] : [node.const]);
  return [...own, ...(node.anyOf ?? []).flatMap(words)].map(String);
}

export function isSection(node: Schema): boolean {
  return Object.keys(properties(node)).length > 0;
}

export function isList(node: Schema): boolean {
  return node.type === "array";
}

/** What stands at a place of a list. */
export function item(node: Schema, place: number): Schema | undefined {
  return Array.isArray(node.items) ? node.items[place] : node.items;
}

/** The node at a path; a number is a place in a list. */
export function nodeAt(schema: Schema, path: readonly (string | number)[]): Schema | undefined {
  let node: Schema | undefined = schema;
  for (const step of path) {
    if (!node) return undefined;
    node = typeof step === "number" ? item(node, step) : properties(node)[step];
  }
  return node;
}

/** The units that a quantity may have. */
export function units(node: Schema): string[] {
  const found = /\*\(((?:\([^()]*\)|[^()])*)\) \*\$$/.exec(node.pattern ?? "");
  if (!found) return [];
  const plain = (found[1] ?? "").replaceAll("(\\^?2|²)", "2").replaceAll("(\\^?3|³)", "3").replaceAll("(deg|°)", "deg");
  return plain.split("|").filter((unit) => /^[A-Za-z%‰][A-Za-z0-9/%]*$/.test(unit));
}

/** What may be given, in words. */
export function allowed(node: Schema): string {
  const told: string[] = [];
  const some = words(node);
  if (some.length > 0) told.push(`one of: ${some.join(", ")}`);
  const unit = units(node);
  if (unit.length > 0) told.push(`a number with unit (${unit.slice(0, 8).join(", ")})`);
  else if (node.type === "integer") told.push("a whole number");
  else if (node.type === "number") told.push("a number");
  else if (node.type === "boolean") told.push("true or false");
  if (node.minimum !== undefined && node.maximum !== undefined) told.push(`from ${node.minimum} to ${node.maximum}`);
  if (node.default !== undefined && node.default !== "" && node.default !== "-") told.push(`by default ${String(node.default)}`);
  return told.join("; ");
}

/** Where in the text of a design a place is. */
export interface Place {
  /** Of the section that the line stands in. */
  section: (string | number)[];
  /** The key on the line, or what is there of it. */
  key: string;
  /** Whether the place is behind the colon of the key. */
  value: boolean;
  /** Where the key, or the value, begins. */
  from: number;
}

/**
 * The place at an offset of a text, by indentation alone, so that it is known while the text is no YAML yet. Of several keys on one line in
 * braces the last before the offset counts.
 */
export function placeAt(text: string, offset: number): Place {
  const start = text.lastIndexOf("\n", offset - 1) + 1;
  const before = text.slice(0, start).split("\n").slice(0, -1);
  const line = text.slice(start, offset);
  const stack: { indent: number; step: string | number }[] = [];
  const enter = (full: string): string => {
    let rest = full;
    let indent = rest.length - rest.trimStart().length;
    rest = rest.trimStart();
    const leave = (bound: number) => {
      while (stack.length > 0 && (stack.at(-1)?.indent ?? 0) >= bound) stack.pop();
    };
    while (rest.startsWith("- ") || rest === "-") {
      // A dash may stand as far in as the key of its list.
      while (stack.length > 0 && (stack.at(-1)?.indent ?? 0) >= indent && !(stack.at(-1)?.indent === indent && typeof stack.at(-1)?.step === "string")) stack.pop();
      const last = stack.at(-1);
      if (!last || typeof last.step === "string" || last.indent < indent) stack.push({ indent: indent + 0.5, step: 0 });
      indent += 2;
      rest = rest.slice(2);
    }
    leave(indent);
    stack.push({ indent, step: "" });
    return rest;
  };
  for (const full of before) {
    if (full.trim() === "" || full.trimStart().startsWith("#")) continue;
    const rest = enter(full);
    const key = /^([\w-]+)\s*:/.exec(rest)?.[1];
    stack.pop();
    const indent = full.length - full.trimStart().length + (full.trimStart().length - rest.length);
    if (key) stack.push({ indent, step: key });
  }
  const rest = enter(line);
  stack.pop();
  const section: (string | number)[] = stack.map((level) => level.step);
  let inner = rest;
  let from = offset - rest.length;
  for (;;) {
    const open = /^([\w-]+)\s*:\s*([{[])/.exec(inner);
    if (!open || inner.length < open[0].length) break;
    section.push(open[1] ?? "");
    if (open[2] === "[") section.push(0);
    inner = inner.slice(open[0].length);
    from += open[0].length;
    const cut = Math.max(inner.lastIndexOf(","), inner.lastIndexOf("{"));
    if (cut >= 0) {
      inner = inner.slice(cut + 1);
      from += cut + 1;
    }
    const space = inner.length - inner.trimStart().length;
    inner = inner.slice(space);
    from += space;
  }
  const colon = /^([\w-]+)\s*:\s*/.exec(inner);
  if (colon) return { section, key: colon[1] ?? "", value: true, from: from + colon[0].length };
  return { section, key: inner, value: false, from };
}
