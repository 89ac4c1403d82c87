// The design as text: completion, hover and underlined problems.

import { type Completion, type CompletionContext, type CompletionResult, autocompletion } from "@codemirror/autocomplete";
import { redo, undo } from "@codemirror/commands";
import { yaml } from "@codemirror/lang-yaml";
import { HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import { EditorState, Transaction } from "@codemirror/state";
import { EditorView, hoverTooltip, keymap } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { basicSetup } from "codemirror";

import { make } from "./elements";
import { allowed, isList, isSection, nodeAt, placeAt, properties, units, words } from "./keys";
import type { Problem, Schema } from "./server";

export interface Editor {
  view: EditorView;
  text(): string;
  /** Puts another design in its place, without a way back to the one before. */
  open(text: string): void;
  /** Changes the text, so that it can be undone. */
  change(text: string): void;
  undo(): void;
  redo(): void;
  underline(problems: Problem[]): void;
  goTo(line: number, column: number): void;
}

const colours = HighlightStyle.define([
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: "#0b4f8a", fontWeight: "600" },
  { tag: [tags.string, tags.content], color: "#1d2329" },
  { tag: [tags.number, tags.bool, tags.null], color: "#7a2e00" },
  { tag: tags.comment, color: "#5b6670", fontStyle: "italic" },
  { tag: [tags.punctuation, tags.separator, tags.squareBracket, tags.brace], color: "#4b5560" },
]);

function complete(schema: Schema) {
  return (context: CompletionContext): CompletionResult | null => {
    const place = placeAt(context.state.doc.toString(), context.pos);
    const line = context.state.doc.lineAt(context.pos);
    if (context.state.sliceDoc(line.from, context.pos).includes("#")) return null;
    if (place.value) {
      const node = nodeAt(schema, [...place.section, place.key]);
      if (!node) return null;
      const typed = context.state.sliceDoc(place.from, context.pos);
      const number = /^([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?) ?[A-Za-z%]*$/.exec(typed);
      const unit = units(node);
      if (number && unit.length > 0) {
        return { from: place.from, options: unit.map((label) => ({ label: `${number[1]} ${label}`, type: "unit" })), filter: true };
      }
      const options = words(node).map((label): Completion => ({ label, type: "enum" }));
      if (node.type === "boolean") options.push({ label: "true" }, { label: "false" });
      if (node.default !== undefined && options.length === 0 && node.default !== "") options.push({ label: String(node.default), detail: "default" });
      return options.length > 0 ? { from: place.from, options } : null;
    }
    const node = nodeAt(schema, place.section);
    if (!node || (!context.explicit && place.key === "")) return null;
    const indent = " ".repeat(place.from - line.from + 2);
    const options = Object.entries(properties(node)).map(([label, of]): Completion => ({
      label,
      type: isSection(of) ? "namespace" : "property",
      info: of.description ?? "",
      apply: isList(of) ? `${label}:\n${indent}- ` : isSection(of) && words(of).length === 0 ? `${label}:\n${indent}` : `${label}: `,
    }));
    return { from: place.from, options, validFor: /^[\w-]*$/ };
  };
}

function hover(schema: Schema) {
  return hoverTooltip((view, position) => {
    const line = view.state.doc.lineAt(position);
    const word = view.state.wordAt(position);
    if (!word) return null;
    // The whole key counts, wherever on it the pointer is.
    const behind = /^[\w-]*\s*:/.exec(view.state.sliceDoc(word.from, line.to));
    if (!behind) return null;
    const place = placeAt(view.state.doc.toString(), word.to);
    const node = nodeAt(schema, [...place.section, place.key]);
    if (!node) return null;
    const dom = make("div", { class: "told" }, make("strong", {}, [...place.section.filter((step) => typeof step === "string"), place.key].join(".")));
    if (node.description) dom.append(make("div", {}, node.description));
    const may = allowed(node);
    if (may) dom.append(make("div", { class: "soft" }, may));
    return { pos: word.from, end: word.to, above: true, create: () => ({ dom }) };
  });
}

export function sentence(problem: Problem): string {
  const hint = problem.hint ? ` Hint: ${problem.hint}.` : "";
  return `${problem.path ? `${problem.path}: ` : ""}found ${problem.found}; allowed is ${problem.allowed}.${hint}`;
}

export function makeEditor(parent: HTMLElement, schema: Schema, changed: () => void, save: () => void): Editor {
  const extensions = [
    keymap.of([{ key: "Mod-s", preventDefault: true, run: () => (save(), true) }]),
    basicSetup,
    yaml(),
    syntaxHighlighting(colours),
    autocompletion({ override: [complete(schema)] }),
    hover(schema),
    lintGutter(),
    EditorView.contentAttributes.of({ "aria-label": "Text of the design" }),
    EditorView.updateListener.of((update) => {
      if (update.docChanged) changed();
    }),
  ];
  const view = new EditorView({ parent, state: EditorState.create({ doc: "", extensions }) });
  return {
    view,
    text: () => view.state.sliceDoc(),
    // With the ends of lines that it has.
    open: (text) => view.setState(EditorState.create({ doc: text, extensions: [extensions, EditorState.lineSeparator.of(text.includes("\r\n") ? "\r\n" : "\n")] })),
    change: (written) => {
      // Places count the end of a line as one letter.
      const text = written.replaceAll("\r\n", "\n");
      const before = view.state.doc.toString();
      let from = 0;
      while (from < before.length && from < text.length && before[from] === text[from]) from += 1;
      let end = 0;
      while (end < before.length - from && end < text.length - from && before[before.length - 1 - end] === text[text.length - 1 - end]) end += 1;
      view.dispatch({
        changes: { from, to: before.length - end, insert: text.slice(from, text.length - end) },
        annotations: Transaction.userEvent.of("input.form"),
      });
    },
    undo: () => void undo(view),
    redo: () => void redo(view),
    underline: (problems) => {
      const document = view.state.doc;
      const diagnostics = problems.map((problem): Diagnostic => {
        const line = document.line(Math.min(Math.max(problem.line ?? 1, 1), document.lines));
        const from = Math.min(line.from + Math.max((problem.column ?? 1) - 1, 0), line.to);
        const word = /^[^\s,{}[\]#]+/.exec(document.sliceString(from, line.to));
        const to = problem.line === null ? line.to : Math.max(from + (word?.[0].length ?? 1), from);
        return { from, to: Math.min(to, line.to), severity: "error", message: sentence(problem) };
      });
      view.dispatch(setDiagnostics(view.state, diagnostics));
    },
    goTo: (line, column) => {
      const at = view.state.doc.line(Math.min(line, view.state.doc.lines));
      view.dispatch({ selection: { anchor: Math.min(at.from + column - 1, at.to) }, scrollIntoView: true });
      view.focus();
    },
  };
}
