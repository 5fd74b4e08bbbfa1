// The page: a state, the engine, and the views that follow.

import "./style.css";
import { Engine } from "./client";
import { controls } from "./controls";
import { brief, html } from "./dom";
import { frameOf, settingOf, withBeside, type Frame, type Measured } from "./frame";
import { isFile, type Material } from "./material";
import { fromAddress, initial, ranges, toAddress, type State } from "./state";
import { takeAway } from "./takeaway";
import { litView } from "./views/lit";
import { hemisphereView, muellerView, phiView } from "./views/maps";
import { energyView, validityView, valuesView } from "./views/numbers";
import { scatterView, spectrumView } from "./views/plots";
import { polarView } from "./views/polar";

const main = document.getElementById("views")!;
const status = document.getElementById("status")!;
const problem = html("p", { id: "problem", role: "alert" });
status.after(problem);

let state: State = { ...initial };
let engine: Engine;
let measured: Measured | null = null;
const files = new Set<string>();
let known: string[] = [];
const fitting = html("div", { id: "fitting" });

const say = (text: string) => (status.textContent = text);
const complain = (text: string) => (problem.textContent = text);

function change(part: Partial<State>): void {
  state = { ...state, ...part };
  panel.show(state);
  schedule();
}

function restore(address: string): void {
  const restored = fromAddress(address);
  state = restored.state;
  complain(restored.problems.length ? `The address was not understood whole: ${restored.problems.join("; ")}.` : "");
  panel.show(state);
  schedule();
}

const panel = controls(document.getElementById("controls") as HTMLFormElement, change, restore, (list) => void take(list));
const polar = polarView(change);
const views = [polar, hemisphereView(change), litView(), scatterView(), spectrumView(), valuesView(), validityView(), energyView(), muellerView(), phiView()];
const away = takeAway(polar.root, say);
main.append(...views.map((v) => v.section), away.section);
polar.section.append(fitting);

// ---- drawing: the newest state wins, and the plot of the plane of incidence comes first

let dirty = false, busy = false;

function schedule(): void {
  dirty = true;
  if (!busy && engine) void drawAll();
}

async function drawAll(): Promise<void> {
  busy = true;
  while (dirty) {
    dirty = false;
    const now = state;
    try {
      const frame = await frameOf(now, engine, measured);
      const failed = await drawOne(frame);
      if (!dirty) {
        complainOf(failed);
        history.replaceState(null, "", toAddress(now) ? `#${toAddress(now)}` : location.pathname + location.search);
        await describeIndex(now);
        document.body.dataset.drawn = JSON.stringify(now);
      }
    } catch (error) {
      complain(error instanceof Error ? error.message : String(error));
      document.body.dataset.drawn = JSON.stringify(now);
    }
  }
  busy = false;
}

let complained = false;
function complainOf(failed: string[]): void {
  if (failed.length) complain([...new Set(failed)].join(" "));
  else if (complained) complain("");
  complained = failed.length > 0;
}

// A view that has nothing to draw, say since the constants end before the visible, does not keep the others waiting.
async function drawOne(frame: Frame): Promise<string[]> {
  const failed: string[] = [];
  let full = frame;
  try {
    full = await withBeside(frame);
  } catch (error) {
    failed.push(`The model beside: ${error instanceof Error ? error.message : String(error)}.`);
  }
  away.update(full);
  for (const view of views) {
    if (dirty) return failed;
    try {
      await view.update(full);
      view.section.classList.remove("failed");
    } catch (error) {
      view.section.classList.add("failed");
      failed.push(`${view.section.querySelector("h2")!.textContent}: ${error instanceof Error ? error.message : String(error)}.`);
    }
  }
  return failed;
}

let described = "";
async function describeIndex(now: State): Promise<void> {
  if (now.index === described) return;
  described = now.index;
  if (now.index === "nk") return panel.setNote("");
  const of = await engine.indexOf(isFile(now) ? { file: "/" + now.index } : { name: now.index });
  panel.setNote(`${of.source} ${brief(of.from_um)} to ${brief(of.to_um)} µm. ${of.warnings.join(" ")}`);
}

// ---- files

const stateOfMaterial: Record<string, keyof State> = { rms_roughness_um: "sigma", correlation_length_um: "tau", diffuse_albedo: "albedo" };

function materialFile(name: string, text: string): Partial<State> {
  const material = JSON.parse(text) as Material;
  if (material.model !== "he" && material.model !== "he_unified")
    throw new Error(`${name}: key "model": must be "he" or "he_unified" to be shown with these controls`);
  const part: Partial<State> = { model: material.model, across: 0, film: "none", albedo: 0, correlation: "gaussian" };
  for (const [key, value] of Object.entries(material)) {
    if (key === "correlation_length_um" && Array.isArray(value)) {
      Object.assign(part, { tau: value[0], across: value[1], axis: Number(material.azimuth_deg ?? 0) });
      continue;
    }
    if (key === "correlation") {
      const of = value as { type?: string; nu?: number } | string;
      if (of === "gaussian" || of === "exponential") part.correlation = of;
      else if (typeof of === "object" && of.type === "matern") Object.assign(part, { correlation: "matern", nu: of.nu });
      else throw new Error(`${name}: key "correlation": Gaussian, exponential and Matern have a control here`);
      continue;
    }
    if (key === "films") {
      const films = value as { index: string; thickness_um: number }[];
      if (films.length > 1 || (films[0] && typeof films[0].index !== "string")) throw new Error(`${name}: key "films": one film of built-in constants has a control here`);
      if (films[0]) Object.assign(part, { film: films[0].index, thickness: films[0].thickness_um });
      continue;
    }
    if (key === "azimuth_deg" || key === "name" || key === "model" || key === "index" || key === "fitted") continue;
    const target = stateOfMaterial[key];
    if (!target || typeof value !== "number") throw new Error(`${name}: key "${key}": has no control here`);
    const [least, most] = ranges[target]!;
    if (!(value >= least && value <= most)) throw new Error(`${name}: key "${key}" ${value}: must be from ${least} to ${most}`);
    part[target] = value as never;
  }
  const index = material.index as { n?: number; k?: number } | string | undefined;
  if (typeof index === "string") part.index = index;
  else if (index && typeof index.n === "number") Object.assign(part, { index: "nk", n: index.n, k: index.k ?? 0 });
  else throw new Error(`${name}: key "index": must be a built-in name or n and k to be shown with these controls`);
  return part;
}

async function takeOne(file: File): Promise<string> {
  const data = new Uint8Array(await file.arrayBuffer());
  const name = file.name.replaceAll(/[^\w.+-]/g, "_");
  const text = new TextDecoder().decode(data);
  if (/\.json$/i.test(name)) {
    const part = materialFile(file.name, text);
    await engine.describe(settingOf({ ...state, ...part }, [state.lambda]));
    change(part);
    return `${file.name}: the material is shown.`;
  }
  const header = text.split(/\r?\n/).find((line) => line.trim() && !line.startsWith("#")) ?? "";
  if (/theta_i_deg/.test(header) || (/\.csv$/i.test(name) && /brdf/.test(header))) {
    const { points, wavelength_from_page } = await engine.curve(file.name, text, state.lambda);
    measured = { name: file.name, points: points.map(([ti, tr, phi, um, brdf]) => ({ ti, tr, phi, um, brdf })) };
    showFitting(wavelength_from_page);
    change({ ti: points[Math.floor(points.length / 2)][0], lambda: points[0][3] });
    return `${file.name}: ${points.length} measured points are shown beside the model.`;
  }
  await engine.putFile(name, data);
  const of = await engine.indexOf({ file: "/" + name });
  files.add(name);
  panel.setIndices([...known, ...files]);
  described = "";
  change({ index: name, lambda: Math.min(Math.max(state.lambda, of.from_um), of.to_um) });
  return `${file.name}: the optical constants are used.`;
}

async function take(list: FileList): Promise<void> {
  complain("");
  for (const file of list) {
    try {
      say(await takeOne(file));
    } catch (error) {
      complain(error instanceof Error ? error.message : String(error));
    }
  }
}

function showFitting(wavelength_from_page: boolean): void {
  const albedo = html("input", { type: "checkbox", id: "fit-albedo" });
  const run = html("button", { type: "button", id: "fit" }, "Fit σ₀ and τ to the points");
  const remove = html("button", { type: "button", id: "remove-points" }, "Remove the points");
  const result = html("p", { class: "note", id: "fit-result", "aria-live": "polite" },
    wavelength_from_page ? "The file names no wavelength: the page's is taken." : "");
  run.addEventListener("click", async () => {
    const points = Float64Array.from(measured!.points.flatMap((p) => [p.ti, p.tr, p.phi, p.um, p.brdf]));
    run.disabled = true;
    try {
      const fit = await engine.fit(settingOf(state, [state.lambda], "he"), albedo.checked, points);
      const [s, t] = fit.relative_errors.map((e) => (e === null || e > 1 ? "open" : `± ${brief(100 * e, 2)} %`));
      result.textContent = `σ₀ ${brief(fit.rms_roughness_um)} µm (${s}), τ ${brief(fit.correlation_length_um)} µm (${t}), albedo ${brief(fit.diffuse_albedo)}; ` +
        `rms distance ${brief(fit.rms_db, 3)} dB over ${fit.points} points. The errors take the distances for noise.`;
      const round = (v: number) => Number(v.toPrecision(6));
      change({ model: "he", across: 0, correlation: "gaussian", sigma: round(fit.rms_roughness_um), tau: round(fit.correlation_length_um), albedo: round(fit.diffuse_albedo) });
    } catch (error) {
      complain(error instanceof Error ? error.message : String(error));
    }
    run.disabled = false;
  });
  remove.addEventListener("click", () => {
    measured = null;
    fitting.replaceChildren();
    schedule();
  });
  fitting.replaceChildren(html("p", {}, html("span", { class: "key measured-key" }, measured!.name)),
    html("div", { class: "buttons" }, run, html("label", {}, albedo, " albedo too"), remove), result);
}

document.addEventListener("dragover", (event) => event.preventDefault());
document.addEventListener("drop", (event) => {
  event.preventDefault();
  if (event.dataTransfer?.files.length) void take(event.dataTransfer.files);
});
addEventListener("hashchange", () => restore(location.hash.slice(1)));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", schedule);

// ---- start

async function start(): Promise<void> {
  restore(location.hash.slice(1));
  try {
    engine = await Engine.start();
    const { version, indices } = await engine.catalogue();
    known = indices;
    panel.setIndices(known);
    panel.show(state);
    say(`hts ${version}. Move a control, or drag the arrow of the light.`);
  } catch (error) {
    complain(`The engine did not start: ${error instanceof Error ? error.message : String(error)}`);
    return;
  }
  (window as unknown as { hts: object }).hts = { engine, settingOf, state: () => state, change };
  schedule();
}
void start();
