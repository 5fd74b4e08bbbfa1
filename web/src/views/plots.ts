// Logarithm of the BRDF over |beta - beta0|, and the spectrum with its colour.

import { css } from "../colours";
import { brief, card, html } from "../dom";
import { seenBrdf, settingOf, visible, type Frame } from "../frame";
import { decades, linear, plot, type Axis, type Curve } from "../plot";

const rad = Math.PI / 180;

// As optical designers draw scatter: beta is the direction cosine in the plane of incidence.
export function scatterView() {
  const view = card("scatter", "Scatter: log BRDF over |β − β₀|");
  const steps = 90;

  function branch(ti: number, sign: number): { x: number[]; triples: Float64Array } {
    const beta0 = Math.sin(ti * rad);
    const x: number[] = [];
    const triples: number[] = [];
    for (let i = 0; i <= steps; ++i) {
      const d = 10 ** (-3 + (3.3 * i) / steps);
      const beta = beta0 + sign * d;
      if (Math.abs(beta) > 0.9999) continue;
      x.push(Math.log10(d));
      triples.push(ti, Math.asin(Math.abs(beta)) / rad, beta >= 0 ? 180 : 0);
    }
    return { x, triples: Float64Array.from(triples) };
  }

  async function update(frame: Frame): Promise<void> {
    const { state } = frame;
    const curves: Curve[] = [];
    let top = -Infinity;
    for (const sign of [-1, 1]) {
      const { x, triples } = branch(state.ti, sign);
      const values = await seenBrdf(frame, frame.setting, triples);
      const logs = Array.from(values, (v) => (v > 0 ? Math.log10(v) : -Infinity));
      top = Math.max(top, ...logs);
      curves.push({ class: sign < 0 ? "model" : "model dashed", points: x.map((v, i) => [v, logs[i]]) });
      if (frame.beside) {
        const other = await frame.engine.evaluate(frame.beside.setting, "brdf", triples);
        curves.unshift({ class: sign < 0 ? "beside" : "beside dashed", points: x.map((v, i) => [v, Math.log10(other[i])]) });
      }
    }
    const points = (frame.measured?.points ?? []).filter((p) => Math.abs(p.ti - state.ti) <= 2 && Math.abs(Math.abs(p.phi) - 90) >= 85);
    curves.push({
      class: "measured", dots: true,
      points: points.map((p) => {
        const beta = Math.sin(p.tr * rad) * (Math.abs(p.phi) > 90 ? 1 : -1);
        return [Math.log10(Math.abs(beta - Math.sin(p.ti * rad))), Math.log10(p.brdf)];
      }),
    });
    const ceiling = Number.isFinite(top) ? Math.ceil(top + 0.1) : 1;
    const x: Axis = { from: -3, to: 0.3, title: "|β − β₀|", ticks: [-3, -2, -1, 0].map((e) => ({ at: e, label: ["0.001", "0.01", "0.1", "1"][e + 3] })) };
    view.body.replaceChildren(plot("BRDF over the distance of direction cosines from the specular direction, both logarithmic", x,
      decades(ceiling - 7, ceiling, "BRDF, 1/sr"), curves));
    view.note.textContent = "Solid: towards the normal and the light; dashed: towards the horizon.";
  }
  return { section: view.section, update };
}

export function spectrumView() {
  const view = card("spectrum", "Spectrum and colour");
  const patch = html("div", { id: "patch", role: "img" });
  const holder = html("div");
  view.body.append(holder, patch);

  async function update(frame: Frame): Promise<void> {
    const { state, engine } = frame;
    const triple = Float64Array.of(state.ti, state.tr, state.phi);
    const setting = settingOf(state, visible);
    const values = await seenBrdf(frame, setting, triple);
    const curves: Curve[] = [{ class: "model", points: visible.map((um, i) => [1000 * um, values[i]]) }];
    const largest = Math.max(...values, 1e-30);
    const points = (frame.measured?.points ?? []).filter((p) => Math.abs(p.ti - state.ti) <= 2 && Math.abs(p.tr - state.tr) <= 2);
    curves.push({ class: "measured", dots: true, points: points.map((p) => [1000 * p.um, p.brdf]) });
    const y = linear(0, largest * 1.1, "BRDF, 1/sr", 5);
    y.ticks = y.ticks.map((t) => ({ at: t.at, label: brief(t.at, 3) }));
    holder.replaceChildren(plot("BRDF in the chosen view direction over wavelength", linear(400, 700, "wavelength, nm"), y, curves));
    const rgb = await engine.colour(visible, values.map((v) => v * Math.PI));
    const brightest = Math.max(...rgb, 1e-30);
    patch.style.background = css(brightest > 1 ? rgb.map((c) => c / brightest) : rgb);
    patch.dataset.rgb = Array.from(rgb).join(" ");
    patch.setAttribute("aria-label", `Colour: linear sRGB ${Array.from(rgb, (c) => brief(c, 3)).join(", ")}`);
    view.note.textContent =
      `At θᵣ ${brief(state.tr)}°, φ ${brief(state.phi)}°; colour under D65, linear sRGB ${Array.from(rgb, (c) => brief(c, 3)).join(", ")}` +
      (brightest > 1 ? ", brighter than white: shown dimmed." : ".");
  }
  return { section: view.section, update };
}
