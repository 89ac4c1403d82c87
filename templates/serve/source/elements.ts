// Small helpers to make elements. Text never becomes markup, except pictures and pages that the server has drawn.

type Child = Node | string | null | undefined | false;

export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | boolean | number> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return element;
}

export function button(label: string, act: () => void, attributes: Record<string, string | boolean> = {}): HTMLButtonElement {
  const made = make("button", { type: "button", ...attributes }, label);
  made.addEventListener("click", act);
  return made;
}

/** A picture that the server has drawn. */
export function picture(svg: string): HTMLElement {
  const holder = make("div", { class: "picture" });
  holder.innerHTML = svg;
  return holder;
}

export function byId<T extends HTMLElement>(id: string, kind: new () => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`the page has no ${id}`);
  return found;
}

/** Tabs that arrow keys walk through, each with its panel. */
export function tabs(list: HTMLElement, chosen: (name: string) => void): (name: string) => void {
  const all = [...list.querySelectorAll<HTMLButtonElement>("[role=tab]")];
  const choose = (name: string) => {
    for (const tab of all) {
      const is = tab.dataset["name"] === name;
      tab.setAttribute("aria-selected", String(is));
      tab.tabIndex = is ? 0 : -1;
      const panel = document.getElementById(tab.getAttribute("aria-controls") ?? "");
      if (panel) panel.hidden = !is;
    }
    chosen(name);
  };
  for (const [place, tab] of all.entries()) {
    tab.addEventListener("click", () => choose(tab.dataset["name"] ?? ""));
    tab.addEventListener("keydown", (event) => {
      const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
      const next = all[(place + step + all.length) % all.length];
      if (step !== 0 && next) {
        event.preventDefault();
        next.focus();
        choose(next.dataset["name"] ?? "");
      }
    });
  }
  return choose;
}
