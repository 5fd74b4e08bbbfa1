// Elements in few words.

type Attributes = Record<string, string | number | boolean | undefined>;
type Child = Node | string;

function fill(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes))
    if (value !== undefined && value !== false) element.setAttribute(name, value === true ? "" : String(value));
  element.append(...children);
}

export function html<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fill(element, attributes, children);
  return element;
}

// A number as a reader wants it.
export function brief(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(digits)));
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const raised = exponent.replace("+", "").replace(/[-0-9]/g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]));
  return `${Number(mantissa)}·10${raised}`;
}

export interface Card {
  section: HTMLElement;
  body: HTMLElement;
  note: HTMLElement;
}

// A view: heading, what it shows, and a line below it.
export function card(id: string, title: string): Card {
  const body = html("div", { class: "body" });
  const note = html("p", { class: "note", id: `${id}-note` });
  const section = html("section", { id, class: "card", "aria-labelledby": `${id}-title` },
    html("h2", { id: `${id}-title` }, title), body, note);
  return { section, body, note };
}

// A canvas in device pixels, of a size in CSS pixels; with a description for those who do not see it.
export function canvas(width: number, height: number, label: string): HTMLCanvasElement {
  return html("canvas", { width, height, role: "img", "aria-label": label });
}
