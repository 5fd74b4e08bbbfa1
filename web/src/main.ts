// The page: a state, the engine, and the views that follow.

import "./style.css";
import { Engine } from "./client";
import { controls } from "./controls";
import { brief, html } from "./dom";
import { frameOf, settingOf, withBeside, type Frame, type Measured } from "./frame";
import { filesOf, isFileName, parsed, stateOf } from "./material";
import { fromAddress, initial, toAddress, type State } from "./state";
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
let known: string[] = [], constants: string[] = [];
const fitting = html("div", { id: "fitting" });

const say = (text: string) => (status.textContent = text);
let ofDrawing = false; // whether what is complained of goes away with the next good drawing
function complain(text: string, drawing = false): void {
  problem.textContent = text;
  ofDrawing = drawing;
}

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
const lit = litView();
const views = [polar, hemisphereView(change), lit, scatterView(), spectrumView(), valuesView(), validityView(), energyView(), muellerView(), phiView()];
const away = takeAway(polar.root, say);
main.append(...views.map((v) => v.section), away.section);
polar.section.append(fitting);

// ---- drawing: the newest state wins, the plot of the plane of incidence comes first, and the lit object last

let dirty = false, busy = false;

const drawn = [...views.filter((view) => view !== lit), lit];

function schedule(): void {
  dirty = true;
  lit.pause();
  if (!busy && engine) void drawAll();
}

async function drawAll(): Promise<void> {
  busy = true;
  while (dirty) {
    dirty = false;
    const now = state;
    try {
      requireFiles(filesOf(now));
      const frame = await frameOf(now, engine, measured);
      const failed = await drawOne(frame);
      if (!dirty) {
        if (failed.length || ofDrawing) complain([...new Set(failed)].join(" "), true);
        history.replaceState(null, "", toAddress(now) ? `#${toAddress(now)}` : location.pathname + location.search);
        await describeIndex(now);
        document.body.dataset.drawn = JSON.stringify(now);
      }
    } catch (error) {
      complain(error instanceof Error ? error.message : String(error), true);
      document.body.dataset.drawn = JSON.stringify(now);
    }
  }
  busy = false;
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
  for (const view of drawn) {
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
  const of = await engine.indexOf(files.has(now.index) ? { file: "/" + now.index } : { name: now.index });
  panel.setNote(`${of.source} ${brief(of.from_um)} to ${brief(of.to_um)} µm. ${of.warnings.join(" ")}`);
}

// ---- files

// Files by name, as the engine has them; one that cannot be used leaves what stood there before.
const files = new Map<string, Uint8Array>();

async function keep<T>(name: string, data: Uint8Array, use: () => Promise<T>): Promise<T> {
  const before = files.get(name);
  await engine.putFile(name, data);
  try {
    const result = await use();
    files.set(name, data);
    return result;
  } catch (error) {
    if (before) await engine.putFile(name, before);
    throw error;
  }
}

function requireFiles(names: string[]): void {
  const missing = names.find((name) => !files.has(name));
  if (missing) throw new Error(missing === "none" ? "correlation of heights: drop the file of its table onto the page" : `${missing}: is not here; drop the file onto the page`);
}

const describe = (part: Partial<State>) => engine.describe(settingOf({ ...state, ...part }, [part.lambda ?? state.lambda]));

async function takeMaterial(name: string, text: string): Promise<string> {
  const { material, files: named } = parsed(text);
  requireFiles(named);
  await engine.describe({ material, file: name, wavelengths: [state.lambda] });
  change(stateOf(name, material));
  const unused = "uncertainty" in material ? " Its uncertainty is not used here; hts eval --uncertainty carries it to the BRDF." : "";
  return `${name}: the material is shown.${unused}`;
}

async function takePoints(name: string, text: string): Promise<string> {
  const mirror = Number((document.getElementById("mirror-azimuth") as HTMLSelectElement).value);
  const { points, wavelength_from_page, notes } = await engine.curve(name, text, state.lambda, mirror);
  measured = { name, points: points.map(([ti, tr, phi, um, brdf]) => ({ ti, tr, phi, um, brdf })) };
  showFitting([wavelength_from_page ? "The file names no wavelength: the page's is taken." : "", ...notes].filter(Boolean).join(" "));
  change({ ti: Number(points[Math.floor(points.length / 2)][0].toPrecision(9)), lambda: points[0][3] });
  return `${name}: ${points.length} measured points are shown beside the model.`;
}

async function takeHeights(name: string, data: Uint8Array, correlation: "psd" | "autocorrelation"): Promise<string> {
  const part = { correlation, heights: name } as const;
  await keep(name, data, () => describe(part));
  change(part);
  return `${name}: the heights follow this ${correlation === "psd" ? "power spectrum" : "correlation function"}.`;
}

async function takeConstants(name: string, data: Uint8Array): Promise<string> {
  if (!isFileName(name)) throw new Error(`${name}: must have an ending, such as .yml, to be read as optical constants`);
  const of = await keep(name, data, () => engine.indexOf({ file: "/" + name }));
  if (!constants.includes(name)) constants.push(name);
  panel.setIndices([...known, ...constants]);
  described = "";
  change({ index: name, lambda: Math.min(Math.max(state.lambda, of.from_um), of.to_um) });
  return `${name}: the optical constants are used.`;
}

const isJson = (file: File) => /\.json$/i.test(file.name);

async function takeOne(file: File): Promise<string> {
  const data = new Uint8Array(await file.arrayBuffer());
  const name = file.name, text = new TextDecoder().decode(data);
  if (await engine.isScatterFile(text)) return takePoints(name, text);
  if (isJson(file)) return takeMaterial(name, text);
  const header = text.split(/\r?\n/).find((line) => line.trim() && !line.startsWith("#")) ?? "";
  if (/frequency_per_um/.test(header)) return takeHeights(name, data, "psd");
  if (/distance_um/.test(header)) return takeHeights(name, data, "autocorrelation");
  if (/theta_i_deg/.test(header) || (/\.csv$/i.test(name) && /brdf/.test(header))) return takePoints(name, text);
  return takeConstants(name, data);
}

async function take(list: FileList): Promise<void> {
  complain("");
  for (const file of [...list].sort((a, b) => Number(isJson(a)) - Number(isJson(b)))) { // materials after the files they name
    try {
      say(await takeOne(file));
    } catch (error) {
      complain(error instanceof Error ? error.message : String(error));
    }
  }
}

function showFitting(note: string): void {
  const albedo = html("input", { type: "checkbox", id: "fit-albedo" });
  const run = html("button", { type: "button", id: "fit" }, "Fit σ₀ and τ to the points");
  const remove = html("button", { type: "button", id: "remove-points" }, "Remove the points");
  const result = html("p", { class: "note", id: "fit-result", "aria-live": "polite" }, note);
  run.addEventListener("click", async () => {
    const points = Float64Array.from(measured!.points.flatMap((p) => [p.ti, p.tr, p.phi, p.um, p.brdf]));
    run.disabled = true;
    try {
      const fit = await engine.fit(settingOf({ ...state, across: 0, correlation: "gaussian", shortest: 0 }, [state.lambda], "he"), albedo.checked, points);
      const [s, t] = fit.relative_errors.map((e) => (e === null || e > 1 ? "open" : `± ${brief(100 * e, 2)} %`));
      result.textContent = `σ₀ ${brief(fit.rms_roughness_um)} µm (${s}), τ ${brief(fit.correlation_length_um)} µm (${t}), albedo ${brief(fit.diffuse_albedo)}; ` +
        `rms distance ${brief(fit.rms_db, 3)} dB over ${fit.points} points. The errors take the distances for noise.`;
      const round = (v: number) => Number(v.toPrecision(6));
      change({ model: "he", across: 0, correlation: "gaussian", shortest: 0, sigma: round(fit.rms_roughness_um), tau: round(fit.correlation_length_um), albedo: round(fit.diffuse_albedo) });
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
  (window as unknown as { hts: object }).hts = { engine, settingOf, state: () => state, measured: () => measured, change };
  schedule();
}
void start();
