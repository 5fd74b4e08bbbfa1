// The plane of incidence as the paper draws it: radius over angle, the light to the left, and its arrow to drag.

import { brief, card, html, svg } from "../dom";
import { seenBrdf, type Frame } from "../frame";
import type { State } from "../state";

const width = 680, height = 372, centre = width / 2, base = 332, size = 292;
const rad = Math.PI / 180;
const decadesShown = 4;
export const angles = Array.from({ length: 181 }, (_, i) => i - 90);

// Towards the viewer at angle `a` of the plane of incidence, positive on the mirror's side.
const at = (a: number, r: number): [number, number] => [centre + Math.sin(a * rad) * r * size, base - Math.cos(a * rad) * r * size];
const shaft = (a: number, r: number) => at(a, r).map((v) => v.toFixed(2)).join(",");

export const triplesOf = (ti: number): Float64Array => {
  const out = new Float64Array(3 * angles.length);
  angles.forEach((a, i) => out.set([ti, Math.abs(a), a >= 0 ? 180 : 0], 3 * i));
  return out;
};

export function polarView(change: (part: Partial<State>) => void) {
  const view = card("polar", "Plane of incidence");
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, id: "polar-picture", role: "group", "aria-labelledby": "polar-title" });
  const handle = svg("g", {
    id: "arrow", tabindex: 0, role: "slider", class: "handle", "aria-label": "Angle of incidence, in degrees",
    "aria-valuemin": 0, "aria-valuemax": 89.9,
  });
  view.body.append(root);
  // The handle stays where it is, and its parts too: a pointer that drags it would lose it otherwise.
  const ray = svg("line", { class: "light" }), head = svg("path", { class: "light-head", d: "M -7 -16 L 7 -16 L 0 0 Z" });
  const grip = svg("circle", { class: "grip", r: 13 });
  const plot = svg("g");
  handle.append(ray, head, grip);
  root.append(plot, handle);
  let ti = 30, dragging = false;

  const set = (angle: number) => {
    ti = Math.min(Math.max(Math.round(angle * 10) / 10, 0), 89.9);  // at once, so that keys pressed in haste all count
    change({ ti });
  };
  const angleOf = (event: PointerEvent): number => {
    const box = root.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * width - centre;
    const y = base - ((event.clientY - box.top) / box.height) * height;
    return Math.atan2(-x, Math.max(y, 1)) / rad;
  };
  handle.addEventListener("pointerdown", (event) => {
    dragging = true;
    handle.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  handle.addEventListener("pointermove", (event) => dragging && set(Math.round(angleOf(event))));
  handle.addEventListener("pointerup", () => (dragging = false));
  handle.addEventListener("pointercancel", () => (dragging = false));
  handle.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 10 : 1;
    const to: Record<string, number> = { ArrowLeft: ti + step, ArrowUp: ti - step, ArrowRight: ti - step, ArrowDown: ti + step, Home: 0, End: 89 };
    if (!(event.key in to)) return;
    event.preventDefault();
    set(to[event.key]);
  });

  function arrow(angle: number): void {
    ti = angle;
    handle.setAttribute("aria-valuenow", String(angle));
    handle.setAttribute("aria-valuetext", `${angle} degrees`);
    const [x, y] = at(-angle, 1.04), [tx, ty] = at(-angle, 0.06);
    for (const [name, value] of Object.entries({ x1: x, y1: y, x2: tx, y2: ty })) ray.setAttribute(name, String(value));
    head.setAttribute("transform", `translate(${tx} ${ty}) rotate(${angle === 0 ? 0 : -angle})`);
    grip.setAttribute("cx", String(x));
    grip.setAttribute("cy", String(y));
  }

  // The paper's scale is the value in the specular direction; a logarithm shows four decades.
  function radiusOf(state: State, values: Float64Array, mirror: number) {
    const largest = values.reduce((a, b) => Math.max(a, b), 0);
    const unit = state.radius === "relative" && mirror > 0 ? mirror : largest || 1;
    const ends = Math.max(largest / unit, 1e-30);
    const scale = state.radius === "relative" ? Math.max(1, ends) : 1;
    return {
      unit: state.radius === "log" ? largest : unit,
      at: (v: number) =>
        state.radius === "log" ? Math.max(0, 1 + Math.log10(Math.max(v, 1e-300) / (largest || 1)) / decadesShown) : v / unit / scale,
      scale,
    };
  }

  async function update(frame: Frame): Promise<void> {
    const { state } = frame;
    const triples = triplesOf(state.ti);
    const values = await seenBrdf(frame, frame.setting, triples);
    const mirror = (await seenBrdf(frame, frame.setting, Float64Array.of(state.ti, state.ti, 180)))[0];
    const other = frame.beside ? await frame.engine.evaluate(frame.beside.setting, "brdf", triples) : null;
    const radius = radiusOf(state, values, mirror);
    const path = (list: Float64Array) => angles.map((a, i) => shaft(a, Math.min(radius.at(list[i]), 1.12))).join(" ");
    const parts: SVGElement[] = [];
    for (const r of [0.25, 0.5, 0.75, 1]) {
      const [x0, y0] = at(-90, r), [x1, y1] = at(90, r);
      parts.push(svg("path", { class: "grid", d: `M ${x0} ${y0} A ${r * size} ${r * size} 0 0 1 ${x1} ${y1}`, fill: "none" }));
    }
    for (const a of [-60, -30, 0, 30, 60]) {
      parts.push(svg("polyline", { class: "grid", points: `${shaft(a, 0)} ${shaft(a, 1)}` }));
      if (Math.abs(a + state.ti) < 8) continue; // the light stands there
      const [x, y] = at(a, 1.06);
      parts.push(svg("text", { class: "tick", x, y: y + 3, "text-anchor": "middle" }, `${a < 0 ? "−" : ""}${Math.abs(a)}°`));
    }
    parts.push(svg("line", { class: "surface", x1: centre - size * 1.1, x2: centre + size * 1.1, y1: base, y2: base }));
    parts.push(svg("text", { class: "tick", x: centre - size * 1.1, y: base + 22 }, "viewed on the light's side"));
    parts.push(svg("text", { class: "tick", x: centre + size * 1.1, y: base + 22, "text-anchor": "end" }, "on the mirror's side"));
    if (other) parts.push(svg("polyline", { class: "beside", id: "polar-beside", points: path(other) }));
    parts.push(svg("polyline", { class: "model", id: "polar-curve", points: path(values) }));
    for (const p of frame.measured?.points ?? []) {
      if (Math.abs(p.ti - state.ti) > 2 || Math.abs(Math.abs(p.phi) - 90) < 85) continue;
      const [cx, cy] = at(Math.abs(p.phi) > 90 ? p.tr : -p.tr, Math.min(radius.at(p.brdf), 1.12));
      parts.push(svg("circle", { class: "measured", cx, cy, r: 3.2 }));
    }
    if (frame.specular > 1e-12) {
      const [x, y] = at(state.ti, 1.02);
      parts.push(svg("line", { class: "specular", x1: centre, y1: base, x2: x, y2: y }));
    }
    plot.replaceChildren(...parts);
    arrow(state.ti);
    root.dataset.mirror = String(mirror);
    const note: (Node | string)[] = [
      state.radius === "relative" ? `Radius: BRDF over that in the specular direction, ${brief(mirror)} /sr; the outer arc is ${brief(radius.scale)}.`
        : state.radius === "log" ? `Radius: logarithm of the BRDF, four decades; the outer arc is ${brief(radius.unit)} /sr.`
        : `Radius: the BRDF; the outer arc is ${brief(radius.unit)} /sr.`,
      frame.specular > 1e-12 ? html("span", { class: "key specular-key" }, `mirror direction: specular reflectance ${brief(frame.specular)}, a delta, not to scale`) : "",
    ];
    if (frame.beside) {
      const match = frame.beside.match;
      const width = match ? `, best ${match.exponent ? `exponent ${brief(2 / match.width ** 2)}` : `width ${brief(match.width)}`}, rms difference ${brief(100 * match.distance, 2)} % of the lobe's` : "";
      note.push(html("span", { class: "key beside-key", id: "beside-key" }, `${frame.beside.name}${width}`));
    }
    view.note.replaceChildren(...note);
  }

  return { section: view.section, update, root, focus: () => handle.focus() };
}
