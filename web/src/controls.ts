// The controls: every one writes a part of the state, and follows the state when it changes elsewhere.

import { brief, html } from "./dom";
import { hasBand, hasMirrors, hasRoughness, hasShortcut, isAnisotropic, isNumberOf, isTable, mayBeAnisotropic } from "./material";
import { choices, fromAddress, initial, presets, ranges, type Choice, type State } from "./state";

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
  finest: { key: "finest", label: "fractal from the period", unit: "µm", from: 0.01, to: 100, logarithmic: true },
  coarsest: { key: "coarsest", label: "to the period", unit: "µm", from: 0.1, to: 10000, logarithmic: true },
  share: { key: "share", label: "share of the second in σ₀²", unit: "", from: 0.001, to: 0.999 },
  tau2: { key: "tau2", label: "correlation length τ of the second", unit: "µm", from: 0.05, to: 200, logarithmic: true },
  nu2: { key: "nu2", label: "ν of the second", unit: "", from: 0.5, to: 5 },
  b2: { key: "b2", label: "B of the second", unit: "µm", from: 0.1, to: 1000, logarithmic: true },
  c2: { key: "c2", label: "C of the second", unit: "", from: 1.1, to: 6 },
  across: { key: "across", label: "length across (0: the same)", unit: "µm", from: 0, to: 20 },
  axis: { key: "axis", label: "azimuth of the first", unit: "°", from: -180, to: 180 },
  nu: { key: "nu", label: "ν of Matérn", unit: "", from: 0.5, to: 5 },
  shortest: { key: "shortest", label: "shortest period of σ₀ (0: all)", unit: "µm", from: 0, to: 5 },
  longest: { key: "longest", label: "its longest period (0: all)", unit: "µm", from: 0, to: 1000 },
  thickness: { key: "thickness", label: "thickness", unit: "µm", from: 0, to: 1 },
  albedo: { key: "albedo", label: "diffuse albedo", unit: "", from: 0, to: 1 },
  n: { key: "n", label: "n", unit: "", from: 0.05, to: 10, logarithmic: true },
  k: { key: "k", label: "k", unit: "", from: 0, to: 15 },
  lambda: { key: "lambda", label: "wavelength λ", unit: "µm", from: 0.2, to: 12, logarithmic: true },
  ti: { key: "ti", label: "incidence θᵢ", unit: "°", from: 0, to: 89.9 },
  tr: { key: "tr", label: "view θᵣ", unit: "°", from: 0, to: 89.9 },
  phi: { key: "phi", label: "azimuth φ", unit: "°", from: -180, to: 360 },
};

// Shown where the correlation of heights depends on them.
const ofCorrelation: (keyof State)[] = ["first", "second", "share", "tau", "nu", "b", "c", "psd", "finest", "coarsest", "tau2", "nu2", "b2", "c2", "psd2"];

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

  function select(key: Choice | "tolerance", label: string, options: Record<string, string>): HTMLElement {
    const element = html("select", { id: key });
    for (const [value, text] of Object.entries(options)) element.append(html("option", { value }, text));
    element.addEventListener("change", () => change({ [key]: key === "tolerance" ? Number(element.value) : element.value }));
    followers.push((state) => (element.value = String(state[key])));
    return html("div", { class: "field", id: `${key}-field` }, html("label", { for: key }, label), element);
  }
  const choice = (key: Choice, label: string) => select(key, label, choices[key]);

  function tick(key: "mixing" | "shortcut", label: string): HTMLElement {
    const element = html("input", { type: "checkbox", id: key });
    element.addEventListener("change", () => change({ [key]: element.checked }));
    followers.push((state) => (element.checked = state[key]));
    return html("div", { class: "field tick", id: `${key}-field` }, html("label", { for: key }, label), element);
  }

  const preset = html("select", { id: "preset" }, html("option", { value: "" }, "choose …"));
  presets.forEach((p, i) => preset.append(html("option", { value: i }, p.name)));
  preset.addEventListener("change", () => {
    if (preset.value !== "") apply(presets[Number(preset.value)].address);
  });
  followers.push((state) => {
    const now = JSON.stringify(state);
    const found = presets.findIndex((p) => JSON.stringify(fromAddress(p.address).state) === now);
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
  const correlation = choice("correlation", "correlation of heights");
  const heights = html("p", { class: "note", id: "heights-note" });
  followers.push((state) => {
    for (const option of correlation.querySelector("select")!.options)
      option.disabled = (option.value === "psd" || option.value === "autocorrelation") && state.heights === "none";
    heights.textContent = isTable(state) ? `Of ${state.heights}.` : "";
  });
  followers.push((state) => {
    indices(known, state.index);
    const show = (shown: boolean, ...keys: (keyof State)[]) => keys.forEach((key) => (document.getElementById(`${key}-field`)!.hidden = !shown));
    for (const key of ofCorrelation) show(isNumberOf(state, key), key);
    show(state.index === "nk", "n", "k");
    show(hasRoughness(state), "sigma", "shortest");
    show(hasBand(state), "longest");
    show(mayBeAnisotropic(state), "across");
    show(isAnisotropic(state), "axis");
    show(state.film !== "none", "thickness");
    const models = [state.model, state.beside];
    show(models.some((model) => hasMirrors(state, model)), "mirror", "mixing");
    show(models.some((model) => hasShortcut(state, model)), "shortcut");
    films(state.film);
  });

  const file = html("input", { type: "file", id: "file", multiple: true, "aria-describedby": "file-note" });
  file.addEventListener("change", () => {
    if (file.files) files(file.files);
    file.value = "";
  });

  const group = (title: string, ...children: (Node | string)[]) => html("fieldset", {}, html("legend", {}, title), ...children);
  form.append(
    html("div", { class: "field" }, html("label", { for: "preset" }, "Example"), preset),
    group("Surface", slider(sliders.sigma), slider(sliders.shortest), slider(sliders.longest), correlation, heights,
      choice("first", "its first part"), slider(sliders.nu), slider(sliders.tau), slider(sliders.finest), slider(sliders.coarsest),
      slider(sliders.b), slider(sliders.c), choice("psd", "this spectrum is of"),
      choice("second", "its second part"), slider(sliders.nu2), slider(sliders.tau2), slider(sliders.b2), slider(sliders.c2),
      choice("psd2", "this spectrum is of"), slider(sliders.share),
      slider(sliders.across), slider(sliders.axis),
      html("div", { class: "field" }, html("label", { for: "index" }, "optical constants"), index), note,
      slider(sliders.n), slider(sliders.k),
      html("div", { class: "field" }, html("label", { for: "film" }, "film on it"), film), slider(sliders.thickness), slider(sliders.albedo)),
    group("Light and view", slider(sliders.lambda), slider(sliders.ti), slider(sliders.tr), slider(sliders.phi),
      choice("in", "light"), choice("out", "analyser")),
    group("Model", choice("model", "model"), choice("beside", "beside it"), choice("mirror", "he_unified: mirror term"),
      tick("mixing", "he_unified: mixing of s and p"), tick("shortcut", "he_unified: shortcut of metals"),
      select("tolerance", "relative error", { "0.001": "10⁻³", "0.000001": "10⁻⁶", "1e-12": "10⁻¹²" })),
    group("Pictures", choice("radius", "radius of the plot"), choice("shape", "object"), choice("light", "colour of the object")),
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
