// The controls: every one writes a part of the state, and follows the state when it changes elsewhere.

import { brief, html } from "./dom";
import { besideNames } from "./frame";
import { hasBand, hasRoughness, hasTau, isAnisotropic, isKCorrelation, isTable } from "./material";
import { initial, presets, ranges, type State } from "./state";

type Change = (part: Partial<State>) => void;

export interface Controls {
  show(state: State): void;
  setIndices(names: string[]): void;
  setNote(text: string): void;
}

interface Slider {
  key: keyof State;
  label: string;
  unit: string;
  from: number;
  to: number;
  logarithmic?: boolean;
}

const sliders: Record<string, Slider> = {
  sigma: { key: "sigma", label: "rms roughness σ₀", unit: "µm", from: 0.001, to: 50, logarithmic: true },
  tau: { key: "tau", label: "correlation length τ", unit: "µm", from: 0.05, to: 200, logarithmic: true },
  b: { key: "b", label: "B", unit: "µm", from: 0.1, to: 1000, logarithmic: true },
  c: { key: "c", label: "C", unit: "", from: 1.1, to: 6 },
  across: { key: "across", label: "length across, 0: the same", unit: "µm", from: 0, to: 20 },
  axis: { key: "axis", label: "azimuth of the first", unit: "°", from: -180, to: 180 },
  nu: { key: "nu", label: "ν of Matérn", unit: "", from: 0.5, to: 5 },
  shortest: { key: "shortest", label: "σ₀ of periods from, 0: all", unit: "µm", from: 0, to: 5 },
  longest: { key: "longest", label: "to, 0: infinity", unit: "µm", from: 0, to: 1000 },
  thickness: { key: "thickness", label: "thickness", unit: "µm", from: 0, to: 1 },
  albedo: { key: "albedo", label: "diffuse albedo", unit: "", from: 0, to: 1 },
  n: { key: "n", label: "n", unit: "", from: 0.05, to: 10, logarithmic: true },
  k: { key: "k", label: "k", unit: "", from: 0, to: 15 },
  lambda: { key: "lambda", label: "wavelength λ", unit: "µm", from: 0.2, to: 12, logarithmic: true },
  ti: { key: "ti", label: "incidence θᵢ", unit: "°", from: 0, to: 89.9 },
  tr: { key: "tr", label: "view θᵣ", unit: "°", from: 0, to: 89.9 },
  phi: { key: "phi", label: "azimuth φ", unit: "°", from: -180, to: 360 },
};

const steps = 1000;

export function controls(form: HTMLFormElement, change: Change, apply: (address: string) => void, files: (list: FileList) => void): Controls {
  const followers: ((state: State) => void)[] = [];
  form.addEventListener("submit", (event) => event.preventDefault());

  function slider(s: Slider): HTMLElement {
    const log = s.logarithmic;
    const place = (v: number) => Math.round(steps * (log ? Math.log(Math.max(v, s.from) / s.from) / Math.log(s.to / s.from) : (v - s.from) / (s.to - s.from)));
    const value = (at: number) => {
      const x = at / steps;
      return Number((log ? s.from * (s.to / s.from) ** x : s.from + x * (s.to - s.from)).toPrecision(log ? 3 : 4));
    };
    const range = html("input", { type: "range", id: `${s.key}-slider`, min: 0, max: steps, step: 1, "aria-label": `${s.label}, slider` });
    const [least, most] = ranges[s.key]!;
    const number = html("input", { type: "number", id: s.key, min: least, max: most, step: "any", inputmode: "decimal" });
    range.addEventListener("input", () => change({ [s.key]: value(Number(range.value)) }));
    number.addEventListener("change", () => {
      const v = number.value.trim() === "" ? NaN : Number(number.value);
      const legal = v >= least && v <= most;
      number.setCustomValidity(legal ? "" : `${s.label}: must be from ${least} to ${most}`);
      if (legal) change({ [s.key]: v });
      else number.reportValidity();
    });
    followers.push((state) => {
      const v = state[s.key] as number;
      range.value = String(place(v));
      range.setAttribute("aria-valuetext", `${brief(v)} ${s.unit}`);
      if (document.activeElement !== number || Number(number.value) !== v) number.value = String(v);
      number.setCustomValidity("");
    });
    return html("div", { class: "field slider", id: `${s.key}-field` },
      html("label", { for: s.key }, s.label, s.unit ? html("span", { class: "unit" }, ` ${s.unit}`) : ""), number, range);
  }

  function select(key: keyof State, label: string, options: [string, string][]): HTMLElement {
    const element = html("select", { id: key });
    for (const [value, text] of options) element.append(html("option", { value }, text));
    element.addEventListener("change", () => change({ [key]: key === "tolerance" ? Number(element.value) : element.value } as Partial<State>));
    followers.push((state) => (element.value = String(state[key])));
    return html("div", { class: "field", id: `${key}-field` }, html("label", { for: key }, label), element);
  }

  const preset = html("select", { id: "preset" }, html("option", { value: "" }, "choose …"));
  presets.forEach((p, i) => preset.append(html("option", { value: i }, p.name)));
  preset.addEventListener("change", () => {
    if (preset.value !== "") apply(presets[Number(preset.value)].address);
  });
  followers.push((state) => {
    const now = JSON.stringify(state);
    const found = presets.findIndex((p) => JSON.stringify({ ...initial, ...Object.fromEntries(numbersOf(p.address)) }) === now);
    preset.value = found < 0 ? "" : String(found);
  });

  const index = html("select", { id: "index" });
  index.addEventListener("change", () => change({ index: index.value }));
  const note = html("p", { class: "note", id: "index-note" });
  const indices = (names: string[], chosen: string) => {
    index.replaceChildren(html("option", { value: "nk" }, "n and k by hand"), ...names.map((name) => html("option", { value: name }, name)));
    if (chosen !== "nk" && !names.includes(chosen)) index.append(html("option", { value: chosen }, chosen));
    index.value = chosen;
  };
  let known: string[] = [];

  const film = html("select", { id: "film" });
  film.addEventListener("change", () => change({ film: film.value }));
  const films = (chosen: string) => {
    const names = known.includes(chosen) || chosen === "none" ? known : [...known, chosen];
    film.replaceChildren(html("option", { value: "none" }, "none"), ...names.map((name) => html("option", { value: name }, name)));
    film.value = chosen;
  };
  // A table of heights is chosen by dropping its file.
  const correlation = select("correlation", "correlation of heights",
    [["gaussian", "Gaussian"], ["exponential", "exponential"], ["matern", "Matérn"], ["k_correlation", "K-correlation"], ["psd", "power spectrum"], ["autocorrelation", "table of C"]]);
  const heights = html("p", { class: "note", id: "heights-note" });
  followers.push((state) => {
    for (const option of correlation.querySelector("select")!.options)
      option.disabled = (option.value === "psd" || option.value === "autocorrelation") && state.heights === "none";
    heights.textContent = isTable(state) ? `Of ${state.heights}.` : "";
  });
  followers.push((state) => {
    indices(known, state.index);
    const hide = (key: string, hidden: boolean) => (document.getElementById(`${key}-field`)!.hidden = hidden);
    for (const key of ["n", "k"]) hide(key, state.index !== "nk");
    hide("sigma", !hasRoughness(state));
    hide("shortest", !hasRoughness(state));
    hide("longest", !hasBand(state));
    hide("tau", !hasTau(state));
    for (const key of ["b", "c", "psd"]) hide(key, !isKCorrelation(state));
    hide("across", isTable(state));
    hide("axis", !isAnisotropic(state));
    hide("nu", state.correlation !== "matern");
    hide("thickness", state.film === "none");
    films(state.film);
  });

  const file = html("input", { type: "file", id: "file", multiple: true, "aria-describedby": "file-note" });
  file.addEventListener("change", () => {
    if (file.files) files(file.files);
    file.value = "";
  });

  const light: [string, string][] = [["none", "unpolarised"], ["s", "s"], ["p", "p"], ["plus", "+45°"], ["minus", "−45°"], ["right", "right circular"], ["left", "left circular"]];
  const group = (title: string, ...children: (Node | string)[]) => html("fieldset", {}, html("legend", {}, title), ...children);
  form.append(
    html("div", { class: "field" }, html("label", { for: "preset" }, "Example"), preset),
    group("Surface", slider(sliders.sigma), slider(sliders.shortest), slider(sliders.longest), correlation, heights, slider(sliders.nu),
      slider(sliders.tau), slider(sliders.b), slider(sliders.c),
      select("psd", "B and C are those of", [["2d", "the surface (2d)"], ["1d one-sided", "a profile (1d)"]]),
      slider(sliders.across), slider(sliders.axis),
      html("div", { class: "field" }, html("label", { for: "index" }, "optical constants"), index), note,
      slider(sliders.n), slider(sliders.k),
      html("div", { class: "field" }, html("label", { for: "film" }, "film on it"), film), slider(sliders.thickness), slider(sliders.albedo)),
    group("Light and view", slider(sliders.lambda), slider(sliders.ti), slider(sliders.tr), slider(sliders.phi),
      select("in", "light", light), select("out", "analyser", [["none", "none"], ...light.slice(1)])),
    group("Model", select("model", "model", [["he", "He-Torrance 1991 (he)"], ["he_unified", "its successor (he_unified)"]]),
      select("beside", "beside it", [["none", "nothing"], ...Object.entries(besideNames)]),
      select("tolerance", "relative error", [["0.001", "10⁻³"], ["0.000001", "10⁻⁶"], ["1e-12", "10⁻¹²"]])),
    group("Pictures", select("radius", "radius of the plot", [["relative", "over specular direction"], ["absolute", "BRDF"], ["log", "logarithm"]]),
      select("shape", "object", [["sphere", "sphere"], ["plate", "plate"], ["cylinder", "cylinder"]]),
      select("light", "colour of the object", [["white", "white light"], ["one", "one wavelength"]])),
    group("Your files", html("label", { for: "file" }, "Choose files, or drop them anywhere"), file,
      html("p", { class: "note", id: "file-note" }, "Optical constants of refractiveindex.info, material files, power spectra and correlation functions (CSV), ",
        "measured points (CSV, ASTM E1392, FRED, LightTools, BiRD)."),
      html("div", { class: "field" }, html("label", { for: "mirror-azimuth" }, "mirror direction in FRED's files"),
        html("select", { id: "mirror-azimuth" }, html("option", { value: 0 }, "azimuth 0°"), html("option", { value: 180 }, "azimuth 180°")))),
  );
  // a number of the tolerance is written in several ways
  followers.push((state) => {
    const tolerance = form.querySelector<HTMLSelectElement>("#tolerance")!;
    const option = [...tolerance.options].find((o) => Number(o.value) === state.tolerance);
    if (!option) tolerance.append(html("option", { value: state.tolerance }, String(state.tolerance)));
    tolerance.value = option?.value ?? String(state.tolerance);
  });

  return {
    show: (state) => followers.forEach((follow) => follow(state)),
    setIndices: (names) => {
      known = names;
      indices(known, index.value || initial.index);
    },
    setNote: (text) => (note.textContent = text),
  };
}

// An address of a preset, numbers as numbers.
const numbersOf = (address: string): [string, unknown][] =>
  [...new URLSearchParams(address)].map(([key, value]) => [key, key in ranges ? Number(value) : value]);
