// Values at the chosen pair, the energy by term, and whether the model can be believed.

import type { Finding, Severity } from "../client";
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
  const whole: (typeof rows)[number] = ["rms_roughness_um", "σ₀ of all frequencies", (f) => f.description.rms_roughness_um, "µm"];
  async function update(frame: Frame): Promise<void> {
    const shown = frame.description.rms_roughness_um === frame.state.sigma ? rows : [...rows, whole];
    const table = html("table", {},
      html("caption", {}, `θᵢ ${brief(frame.state.ti)}°, θᵣ ${brief(frame.state.tr)}°, φ ${brief(frame.state.phi)}°, ${brief(frame.state.lambda)} µm, unpolarised`));
    for (const [key, name, of, unit] of shown)
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
    const { distance } = frame.detail;
    const apart = distance.studied ? ` The lobe is expected ${brief(distance[state.model].unpolarised, 2)} dB (rms) from exact scattering.` : "";
    view.note.textContent = `Of unpolarised light from θᵢ ${brief(state.ti)}°, over the hemisphere.` + apart +
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
  const verdictOf = (severity: Severity, verdict: string, text: string) =>
    html("p", { class: `verdict ${severity}`, id: "verdict", "data-severity": severity },
      html("span", { class: "lamp", "aria-hidden": "true" }), html("strong", {}, verdict), ` ${text}`);

  // As hts info prints it: distances from exact scattering, of both theories.
  function distances(frame: Frame): HTMLElement {
    const { distance } = frame.detail;
    if (!distance.studied) return html("p", { class: "note", id: "distance" }, `${distance.severity ? "" : "Nothing like this surface was solved exactly. "}Studied of ${distance.substance}: ${distance.range}.`);
    const table = html("table", { id: "distance" },
      html("caption", {}, `Expected distance from exact scattering at θᵢ ${brief(frame.state.ti)}°, dB, between ${distance.cases} cases of ${distance.substance}`),
      html("tr", {}, html("td", {}), ...["TE", "TM", "unpolarised"].map((name) => html("th", { scope: "col" }, name))));
    for (const model of ["he", "he_unified"] as const) {
      const { te, tm, unpolarised } = distance[model];
      table.append(html("tr", {}, html("th", { scope: "row" }, model), ...[te, tm, unpolarised].map((v, i) =>
        html("td", { "data-value": String(v), "data-key": `${model}_${["te", "tm", "unpolarised"][i]}` }, v.toFixed(2)))));
    }
    return table;
  }

  async function update(frame: Frame): Promise<void> {
    const { validity, distance } = frame.detail;
    if (distance.severity) {
      const db = brief(distance.he_unified.unpolarised, 2);
      const text = {
        fine: ["Yes.", `${db} dB from exact scattering are expected, at most ${distance.fine} wanted.`],
        caution: ["With caution.", `${db} dB from exact scattering are expected, at most ${distance.fine} wanted.`],
        outside: ["Not known to be.", distance.studied ? `${db} dB from exact scattering are expected, more than ${distance.greatest}.` : "Nothing like it was solved exactly."],
      }[distance.severity];
      view.body.replaceChildren(verdictOf(distance.severity, text[0], text[1]), distances(frame));
      view.note.textContent = "By this distance, since he_unified assumes less than he: its mirror is not shadowed, light that is reflected again returns, and where the surface curves within a wavelength it is perturbation theory.";
      return;
    }
    const error = validity.decibels ? `Expected error ${validity.decibels[0]} to ${validity.decibels[1]} dB.` : "The error there has not been measured.";
    const verdict = { fine: "Yes.", caution: "With caution.", outside: "No: outside the model's assumptions." }[validity.severity];
    view.body.replaceChildren(verdictOf(validity.severity, verdict, error), html("ul", { class: "findings" }, ...validity.findings.map(line)), distances(frame));
    view.note.textContent = validity.perturbation_advised ? "τ is below half a wavelength and σ₀ small: first-order perturbation theory would do better." : "";
  }
  return { section: view.section, update };
}
