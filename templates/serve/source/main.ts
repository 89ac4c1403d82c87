// The page of `barrier-check serve`: a design on the left, what it is and does on the right.

import { makeEditor } from "./editor";
import { byId, make, tabs } from "./elements";
import { makeForm } from "./form";
import { makePreview } from "./preview";
import { makeReports } from "./reports";
import * as server from "./server";
import { inTime, makeSimulation } from "./simulation";

const LOOK_AFTER = 250;

async function begin() {
  const message = byId("message", HTMLElement);
  const tell = (error: unknown) => {
    if (error instanceof DOMException && error.name === "AbortError") return;
    byId("message-text", HTMLElement).textContent = error instanceof Error ? error.message : String(error);
    message.hidden = false;
  };
  byId("message-close", HTMLButtonElement).addEventListener("click", () => (message.hidden = true));
  const start = await server.start();
  byId("folder", HTMLElement).textContent = start.folder;
  byId("program", HTMLElement).textContent = start.program;

  let open: server.Written | null = null;
  let waiting = 0;
  let asked: AbortController | null = null;
  let problems = 0;
  const which = byId("which", HTMLSelectElement);
  const state = byId("state", HTMLElement);
  const save = byId("save", HTMLButtonElement);
  const run = byId("run", HTMLButtonElement);
  const conflict = byId("conflict", HTMLElement);

  const editor = makeEditor(byId("text", HTMLElement), start.schema, () => changed(), () => void keep());
  const form = makeForm(byId("form", HTMLElement), start.schema, editor.text, editor.change, {
    undo: () => (editor.undo(), form.show(editor.text(), true)),
    redo: () => (editor.redo(), form.show(editor.text(), true)),
  });
  const preview = makePreview(
    {
      problems: byId("problems", HTMLElement),
      drawing: byId("drawing", HTMLElement),
      checks: byId("checks", HTMLElement),
      loads: byId("loads", HTMLElement),
      verdict: byId("verdict", HTMLElement),
    },
    (problem) => {
      chooseLeft("text");
      editor.goTo(problem.line ?? 1, problem.column ?? 1);
    },
  );
  const reports = makeReports(byId("reports", HTMLElement), (folder) => follow(folder), tell);
  const simulation = makeSimulation(
    byId("simulation", HTMLElement),
    () => void reports.refresh(),
    (folder, page) => {
      chooseRight("reports");
      void reports.refresh().then(() => reports.open(folder, page));
    },
    tell,
  );
  const follow = (folder: string) => {
    chooseRight("simulation");
    simulation.follow(folder);
  };
  const chooseLeft = tabs(byId("left-tabs", HTMLElement), (name) => name === "form" && form.show(editor.text()));
  const chooseRight = tabs(byId("right-tabs", HTMLElement), (name) => {
    // What the equations say is not what a run says.
    byId("verdict", HTMLElement).hidden = name === "simulation" || name === "reports";
    if (name === "reports") void reports.refresh();
  });

  const unsaved = () => open !== null && editor.text() !== open.text;
  const tellState = () => {
    state.textContent = open === null ? "" : unsaved() ? "not saved" : "saved";
    save.disabled = !unsaved();
    run.disabled = open === null || problems > 0;
  };
  const changed = () => {
    tellState();
    preview.outdated(true);
    window.clearTimeout(waiting);
    waiting = window.setTimeout(() => void look(), LOOK_AFTER);
  };
  const look = async () => {
    if (!open) return;
    asked?.abort();
    asked = new AbortController();
    try {
      const seen = await server.look(open.path, editor.text(), asked.signal);
      problems = seen.problems.length;
      preview.show(seen);
      preview.outdated(problems > 0);
      editor.underline(seen.problems);
      if (!byId("form", HTMLElement).hidden) form.show(editor.text());
      form.mark(seen.problems);
      byId("estimate", HTMLElement).textContent = seen.seen
        ? seen.seen.too_much || `${Math.round(seen.seen.grains)} grains, about ${inTime(seen.seen.seconds)} on one core for each packing`
        : "";
      tellState();
    } catch (error) {
      tell(error);
    }
  };
  const show = (written: server.Written) => {
    open = written;
    conflict.hidden = true;
    editor.open(written.text);
    window.history.replaceState(null, "", `#${encodeURIComponent(written.path)}`);
    document.title = `${written.path} · barrier-check`;
    choose(written.path);
    tellState();
    void look();
  };
  const keep = async (): Promise<boolean> => {
    if (!open) return false;
    if (!unsaved()) return true;
    try {
      const wrote = await server.write(open.path, editor.text(), open.digest);
      byId("conflict-text", HTMLElement).textContent = `${wrote.conflict ?? ""}.`;
      conflict.hidden = wrote.conflict === undefined;
      if (wrote.written && open?.path === wrote.written.path) open = wrote.written;
      tellState();
      return wrote.written !== undefined;
    } catch (error) {
      tell(error);
      return false;
    }
  };

  const list = (designs: string[]) => {
    which.replaceChildren(make("option", { value: "" }, "choose a design"), ...designs.map((path) => make("option", { value: path }, path)));
    if (open) choose(open.path);
  };
  const choose = (path: string) => {
    if (![...which.options].some((option) => option.value === path)) which.append(make("option", { value: path }, path));
    which.value = path;
  };
  list(start.designs);
  which.addEventListener("change", () => {
    if (which.value === "") return;
    if (unsaved() && !window.confirm(`What is changed in ${open?.path} is not saved. Lose it and open the other?`)) {
      which.value = open?.path ?? "";
      return;
    }
    void server.read(which.value).then(show).catch(tell);
  });
  save.addEventListener("click", () => void keep());
  run.addEventListener("click", () => {
    const seeds = byId("seeds", HTMLInputElement);
    if (!seeds.reportValidity()) return;
    // Not twice by a double click.
    run.disabled = true;
    void keep()
      .then(async (kept) => {
        if (kept && open) follow((await server.begin(open.path, Number(seeds.value))).folder);
      })
      .catch(tell)
      .finally(tellState);
  });
  byId("save-as", HTMLButtonElement).addEventListener("click", () => {
    const name = window.prompt("Name of the copy, a file in this folder", open?.path.replace(/(\.ya?ml)?$/, "_2.yaml"));
    if (!name) return;
    const path = /\.ya?ml$/.test(name) ? name : `${name}.yaml`;
    void server
      .write(path, editor.text(), null)
      .then((wrote) => (wrote.written ? show(wrote.written) : tell(`${wrote.conflict ?? wrote.wrong}: name another file`)))
      .catch(tell);
  });
  // In the text and in the form, where the field that is being typed into counts as well.
  window.addEventListener("keydown", (event) => {
    if (event.key.toLowerCase() !== "s" || !(event.ctrlKey || event.metaKey) || event.defaultPrevented) return;
    event.preventDefault();
    const focused = document.activeElement;
    if (focused instanceof HTMLInputElement) focused.dispatchEvent(new Event("change"));
    void keep();
  });
  byId("theirs", HTMLButtonElement).addEventListener("click", () => open && void server.read(open.path).then(show).catch(tell));
  byId("mine", HTMLButtonElement).addEventListener("click", () => {
    if (!open) return;
    const [path, text] = [open.path, editor.text()];
    void server
      .read(path)
      // It may be gone.
      .then((there) => there.digest, () => null)
      .then((digest) => server.write(path, text, digest))
      .then((wrote) => {
        if (wrote.written && open?.path === wrote.written.path) open = wrote.written;
        conflict.hidden = wrote.conflict === undefined;
        tellState();
      })
      .catch(tell);
  });
  // Another tab, or another program, may have changed the file.
  window.addEventListener("focus", () => {
    void server
      .start()
      .then((now) => list(now.designs))
      .catch(() => undefined);
    if (!open) return;
    void server
      .read(open.path)
      .then((there) => {
        if (!open || there.path !== open.path || there.digest === open.digest) return;
        if (unsaved()) {
          byId("conflict-text", HTMLElement).textContent = `${there.path} was changed elsewhere, in another tab or by another program, since it was read here.`;
          conflict.hidden = false;
        } else show(there);
      })
      .catch((error: unknown) => {
        if (!open || !(error instanceof server.Refused) || error.status !== 404) return;
        // Gone from the disk: nothing of it is saved any more.
        open = { ...open, text: "" };
        tellState();
      });
  });
  window.addEventListener("beforeunload", (event) => {
    if (unsaved()) event.preventDefault();
  });

  const mayLeave = () => !unsaved() || window.confirm(`What is changed in ${open?.path} is not saved. Lose it and open the other?`);
  newDesign(start, show, tell, mayLeave);
  const asks = decodeURIComponent(window.location.hash.slice(1));
  if (asks) void server.read(asks).then(show).catch(tell);
  void reports.refresh();
  const underWay = (await server.runs()).runs.find((each) => each.state === "running");
  if (underWay) follow(underWay.folder);
}

/** Ten questions, whose answers make a design that runs. */
function newDesign(start: server.Start, show: (written: server.Written) => void, tell: (error: unknown) => void, mayLeave: () => boolean) {
  const dialog = byId("new-dialog", HTMLDialogElement);
  const fields = byId("new-fields", HTMLElement);
  const wrong = byId("new-wrong", HTMLElement);
  const file = make("input", { id: "new-file", type: "text", required: true, value: "my_site.yaml", autocomplete: "off" });
  fields.append(make("label", { for: "new-file" }, "File, in this folder"), file);
  const answers = start.questions.map((question) => {
    const id = `new-${question.name}`;
    const field =
      question.name === "barrier"
        ? make("select", { id }, ...["net", "rings", "wall"].map((word) => make("option", {}, word)))
        : make("input", { id, type: "text", value: question.usual, autocomplete: "off" });
    fields.append(make("label", { for: id }, question.ask), field);
    return field;
  });
  byId("new", HTMLButtonElement).addEventListener("click", () => {
    if (!mayLeave()) return;
    wrong.textContent = "";
    dialog.showModal();
  });
  byId("new-cancel", HTMLButtonElement).addEventListener("click", () => dialog.close());
  byId("new-form", HTMLFormElement).addEventListener("submit", (event) => {
    event.preventDefault();
    const path = /\.ya?ml$/.test(file.value) ? file.value : `${file.value}.yaml`;
    server
      .makeNew(path, answers.map((answer) => answer.value))
      .then((wrote) => {
        wrong.textContent = wrote.wrong ?? (wrote.conflict ? `${wrote.conflict}: name another file` : "");
        if (!wrote.written) return;
        dialog.close();
        show(wrote.written);
      })
      .catch((error: unknown) => {
        dialog.close();
        tell(error);
      });
  });
}

begin().catch((error: unknown) => {
  const message = document.getElementById("message");
  const text = document.getElementById("message-text");
  if (message && text) {
    text.textContent = error instanceof Error ? error.message : String(error);
    message.hidden = false;
  }
});
