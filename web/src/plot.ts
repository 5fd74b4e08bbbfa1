// Axes, curves and labels as SVG, so that a picture can be taken away as it is.

import { svg } from "./dom";

export interface Axis {
  from: number;
  to: number;
  ticks: { at: number; label: string }[];
  title: string;
}

export interface Curve {
  points: [number, number][];
  class: string; // of the style sheet: "model", "beside", "measured"
  dots?: boolean;
}

export const superscript = (n: number): string => String(n).replace(/[-0-9]/g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]));

// Decades, at most `most` of them labelled.
export function decades(from: number, to: number, title: string, most = 7): Axis {
  const step = Math.max(1, Math.ceil((to - from) / most));
  const ticks = [];
  for (let e = Math.ceil(from / step) * step; e <= to; e += step) ticks.push({ at: e, label: `10${superscript(e)}` });
  return { from, to, ticks, title };
}

export function linear(from: number, to: number, title: string, most = 6): Axis {
  const raw = (to - from) / most;
  const power = 10 ** Math.floor(Math.log10(raw || 1));
  const step = power * ([1, 2, 5].find((s) => s * power >= raw) ?? 10);
  const ticks = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i)
    ticks.push({ at: i * step, label: String(Number((i * step).toPrecision(6))) });
  return { from, to, ticks, title };
}

const width = 480, height = 316, left = 78, right = 18, top = 12, bottom = 62; // room for letters that are read in a narrow card

export function plot(label: string, x: Axis, y: Axis, curves: Curve[]): SVGSVGElement {
  const px = (v: number) => left + ((v - x.from) / (x.to - x.from)) * (width - left - right);
  const py = (v: number) => height - bottom - ((v - y.from) / (y.to - y.from)) * (height - top - bottom);
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label });
  for (const tick of x.ticks) {
    root.append(svg("line", { class: "grid", x1: px(tick.at), x2: px(tick.at), y1: top, y2: height - bottom }));
    root.append(svg("text", { class: "tick", x: px(tick.at), y: height - bottom + 24, "text-anchor": "middle" }, tick.label));
  }
  for (const tick of y.ticks) {
    root.append(svg("line", { class: "grid", x1: left, x2: width - right, y1: py(tick.at), y2: py(tick.at) }));
    root.append(svg("text", { class: "tick", x: left - 7, y: py(tick.at) + 6, "text-anchor": "end" }, tick.label));
  }
  root.append(svg("text", { class: "axis", x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, x.title));
  const middle = (top + height - bottom) / 2;
  root.append(
    svg("text", { class: "axis", x: 16, y: middle, "text-anchor": "middle", transform: `rotate(-90 16 ${middle})` }, y.title),
  );
  const clip = (v: number, axis: Axis) => Math.min(Math.max(v, axis.from), axis.to);
  for (const curve of curves) {
    const inside = curve.points.filter(([a, b]) => Number.isFinite(b) && a >= x.from - 1e-9 && a <= x.to + 1e-9);
    if (curve.dots) {
      for (const [a, b] of inside)
        if (b >= y.from && b <= y.to) root.append(svg("circle", { class: curve.class, cx: px(a), cy: py(b), r: 3.2 }));
      continue;
    }
    const points = inside.map(([a, b]) => `${px(a).toFixed(2)},${py(clip(b, y)).toFixed(2)}`).join(" ");
    root.append(svg("polyline", { class: curve.class, points }));
  }
  return root;
}
