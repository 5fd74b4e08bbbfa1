// Values at the chosen pair, the energy by term, and whether the model can be believed.

import type { Finding } from "../client";
import { brief, card, html } from "../dom";
import type { Frame } from "../frame";

export function valuesView() {
  const view = card("values", "At this pair of directions");
  const rows: [string, string, (f: Frame) => number, string][] = [
    ["brdf", "BRDF", (f) => f.detail.directional_diffuse + f.detail.uniform_diffuse, "1/sr"],
    ["directional_diffuse", "directional diffuse", (f) => f.detail.directional_diffuse, "1/sr"],
    ["uniform_diffuse", "uniform diffuse", (f) => f.detail.uniform_diffuse, "1/sr"],
    ["specular_reflectance", "specular reflectance, at θᵢ", (f) => f.detail.specular_reflectance, ""],
    ["fresnel", "|F|², local", (f) => f.detail.fresnel, ""],
    ["shadowing", "shadowing S", (f) => f.detail.shadowing, ""],
    ["effective_roughness_um", "effective roughness σ", (f) => f.detail.effective_roughness_um, "µm"],
    ["n", "index n", (f) => f.description.n[0], ""],
    ["k", "index k", (f) => f.description.k[0], ""],
  ];
  async function update(frame: Frame): Promise<void> {
    const table = html("table", {},
      html("caption", {}, `θᵢ ${brief(frame.state.ti)}°, θᵣ ${brief(frame.state.tr)}°, φ ${brief(frame.state.phi)}°, ${brief(frame.state.lambda)} µm, unpolarised`));
    for (const [key, name, of, unit] of rows)
      table.append(html("tr", {}, html("th", { scope: "row" }, name),
        html("td", { "data-value": String(of(frame)), "data-key": key }, `${brief(of(frame), 6)} ${unit}`)));
    view.body.replaceChildren(table);
    view.note.textContent = frame.description.warnings.join(" ");
  }
  return { section: view.section, update };
}

export function energyView() {
  const view = card("energy", "Where the light goes");
  const last = { key: "" };
  async function update(frame: Frame): Promise<void> {
    const { state, engine, setting } = frame;
    const key = JSON.stringify([setting, state.ti]);
    if (key === last.key) return;
    const energy = await engine.energy(setting, state.ti);
    last.key = key;
    const total = energy.specular + energy.directional_diffuse + energy.uniform_diffuse;
    const parts: [string, string, number][] = [
      ["specular", "specular", energy.specular],
      ["lobe", "directional diffuse", energy.directional_diffuse],
      ["uniform", "uniform diffuse", energy.uniform_diffuse],
      ["lost", "not reflected", Math.max(0, 1 - total)],
    ];
    const all = Math.max(1, total);
    const text = parts.map(([, name, v]) => `${name} ${brief(100 * v, 4)} %`).join(", ");
    const bar = html("div", { class: "bar", role: "img", "aria-label": text });
    const list = html("dl", { class: "shares" });
    for (const [id, name, v] of parts) {
      bar.append(html("span", { class: `share ${id}`, style: `width: ${(100 * v) / all}%` }));
      list.append(html("div", {}, html("dt", { class: `key ${id}-key` }, name), html("dd", { "data-value": String(v), "data-key": `energy_${id}` }, `${brief(100 * v, 4)} %`)));
    }
    view.body.replaceChildren(bar, list);
    view.note.textContent = `Of unpolarised light from θᵢ ${brief(state.ti)}°, over the hemisphere.` +
      (total > 1 ? ` The terms add up to ${brief(100 * total, 5)} %: more than falls in, a flaw of the model there.` : "");
  }
  return { section: view.section, update };
}

const words = { fine: "fine", caution: "caution", outside: "outside" };

export function validityView() {
  const view = card("validity", "Can the model be believed here?");
  const line = (f: Finding) =>
    html("li", { class: f.severity },
      html("span", { class: "lamp", "aria-hidden": "true" }),
      html("strong", {}, `${f.criterion}: ${words[f.severity]}`),
      ` ${f.quantity} = ${f.measured === null ? "∞" : brief(f.measured)}, ${f.least ? "at least" : "at most"} ${brief(f.caution)} wanted.` +
        (f.severity === "fine" ? "" : ` ${f.reason}.`));
  async function update(frame: Frame): Promise<void> {
    const { validity } = frame.detail;
    const [least, most] = (validity.decibels ?? []).map((db) => brief(db, 2));
    const error = least === undefined ? "The error there has not been measured." : `Expected error ${least === most ? "" : `${least} to `}${most} dB.`;
    const verdict = { fine: "Yes.", caution: "With caution.", outside: "No: outside the model's validity." }[validity.severity];
    view.body.replaceChildren(
      html("p", { class: `verdict ${validity.severity}`, id: "verdict", "data-severity": validity.severity },
        html("span", { class: "lamp", "aria-hidden": "true" }), html("strong", {}, verdict), ` ${error}`),
      html("ul", { class: "findings" }, ...validity.findings.map(line)));
    view.note.textContent = validity.perturbation_advised ? "τ is below half a wavelength and σ₀ small: first-order perturbation theory would do better." : "";
  }
  return { section: view.section, update };
}
