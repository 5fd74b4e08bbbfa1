// The engine as the page calls it.

import packedEngine from "@engine/engine.bin?url";
import EngineWorker from "./worker?worker&inline";
import type { Answer, Call } from "./worker";
import type { Facets, Material } from "./material";

export class EngineError extends Error {}

export interface Setting {
  material: Material;
  file?: string; // of the material, for messages
  wavelengths: number[];
  tolerance?: number;
  outside?: "error" | "hold";
}
export interface Description {
  name: string;
  model: string;
  source: string;
  warnings: string[];
  polarised: boolean;
  specular_term: boolean;
  rough_surface: boolean;
  rms_roughness_um: number; // of all frequencies
  n: number[];
  k: number[];
}
export interface Finding {
  criterion: string;
  quantity: string;
  reason: string;
  measured: number | null;
  caution: number;
  outside: number;
  least: boolean;
  severity: Severity;
}
export interface Decibels {
  te: number;
  tm: number;
  unpolarised: number;
}
export type Severity = "fine" | "caution" | "outside";
export interface Detail {
  directional_diffuse: number;
  uniform_diffuse: number;
  specular_reflectance: number;
  g: number;
  t: number;
  effective_roughness_um: number;
  shadowing: number;
  fresnel: number;
  method: string;
  regime: string;
  validity: { severity: Severity; findings: Finding[]; decibels?: [number, number]; perturbation_advised: boolean };
  distance: {
    studied: boolean;
    he: Decibels;
    he_unified: Decibels;
    substance: string;
    cases: number;
    range: string;
    fine: number;
    greatest: number;
    severity?: Severity; // of he_unified, which is judged by it
  };
}
export interface Energy {
  specular: number;
  directional_diffuse: number;
  uniform_diffuse: number;
}
export interface Fit {
  rms_roughness_um: number;
  correlation_length_um: number;
  diffuse_albedo: number;
  relative_errors: [number | null, number | null];
  points: number;
  rms_db: number;
}
export interface Curve {
  points: number[][]; // theta_i, theta_r, phi [deg], wavelength [um], BRDF [1/sr]
  wavelength_from_page: boolean;
  notes: string[];
}
export interface Match {
  width: number;
  distance: number;
  material: Material;
}
export type Of = "brdf" | "directional_diffuse" | "specular" | "mueller" | "specular_mueller";

// The engine stands gzipped beside the page, or in it.
async function engineBytes(): Promise<ArrayBuffer> {
  const inlined = document.getElementById("engine");
  const packed = inlined
    ? new Blob([Uint8Array.from(atob(inlined.textContent ?? ""), (c) => c.charCodeAt(0))])
    : await (await fetch(packedEngine)).blob();
  return new Response(packed.stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

export class Engine {
  private readonly worker = new EngineWorker();
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private last = 0;

  static async start(): Promise<Engine> {
    const engine = new Engine();
    engine.worker.onmessage = (event: MessageEvent<Answer>) => {
      engine.waiting.get(event.data.id)?.(event.data);
      engine.waiting.delete(event.data.id);
    };
    const bytes = await engineBytes();
    await engine.call({ id: 0, start: bytes }, [bytes]);
    return engine;
  }

  private async call(call: Call, transfer: Transferable[] = []): Promise<{ answer: never; output: Float64Array }> {
    call.id = ++this.last;
    const { text, output } = await new Promise<Answer>((resolve) => {
      this.waiting.set(call.id, resolve);
      this.worker.postMessage(call, transfer);
    });
    const answer = JSON.parse(text);
    if (answer.error) throw new EngineError(answer.error.replace(/^\//, "")); // dropped files stand in the root folder
    return { answer: answer as never, output };
  }

  private request<T>(request: object, input: Float64Array = new Float64Array(0), outputs = 0): Promise<{ answer: T; output: Float64Array }> {
    return this.call({ id: 0, request: JSON.stringify(request), input, outputs });
  }

  // A dropped file, where materials find it by its name.
  async putFile(name: string, data: Uint8Array): Promise<void> {
    await this.call({ id: 0, file: name, data });
    await this.request({ do: "forget" });
  }

  // Triples theta_i, theta_r, phi_r [deg]; for each pair all wavelengths, of matrices 16 elements each.
  async evaluate(setting: Setting, of: Of, triples: Float64Array): Promise<Float64Array> {
    const matrices = of === "mueller" || of === "specular_mueller";
    const outputs = (triples.length / 3) * setting.wavelengths.length * (matrices ? 16 : 1);
    // The mirror term is no part of the lobe, and the tables of a second-order one take a while.
    const { mirror, ...lobe } = setting.material;
    const material = of.startsWith("specular") ? setting.material : lobe;
    return (await this.request({ do: "evaluate", of, ...setting, material }, triples, outputs)).output;
  }
  describe = async (setting: Setting) => (await this.request<Description>({ do: "describe", ...setting })).answer;
  detail = async (setting: Setting, triple: Float64Array) =>
    (await this.request<Detail>({ do: "detail", ...setting }, triple)).answer;
  energy = async (setting: Setting, theta_i_deg: number) =>
    (await this.request<Energy>({ do: "energy", theta_i_deg, ...setting })).answer;
  colour = async (wavelengths: number[], spectra: Float64Array) =>
    (await this.request({ do: "colour", wavelengths }, spectra, (3 * spectra.length) / wavelengths.length)).output;
  logPhi = async (pairs: Float64Array) => (await this.request({ do: "phi" }, pairs, pairs.length / 2)).output;
  indexOf = async (what: { name: string } | { file: string }) =>
    (await this.request<{ source: string; warnings: string[]; from_um: number; to_um: number }>({ do: "index", ...what })).answer;
  catalogue = async () => (await this.request<{ version: string; indices: string[] }>({ do: "catalogue" })).answer;
  shader = async (setting: Setting, language: "glsl" | "wgsl") =>
    (await this.request<{ text: string }>({ do: "shader", language, ...setting })).answer.text;
  match = async (setting: Setting, beside: Facets, theta_i_deg: number) =>
    (await this.request<Match>({ do: "match", beside: beside.material, keys: beside.keys, exponents: beside.exponents ?? [], theta_i_deg, ...setting })).answer;
  // Whether a text is a scatter file of another program, CSV apart.
  isScatterFile = async (text: string) => (await this.request<{ is: boolean }>({ do: "is_scatter_file", text })).answer.is;
  curve = async (file: string, text: string, wavelength_um: number, mirror_azimuth_deg: number) =>
    (await this.request<Curve>({ do: "curve", file, text, wavelength_um, mirror_azimuth_deg })).answer;
  // Of pixels nine numbers each, twelve: web/engine/engine.hpp.
  picture = async (setting: Setting, weights: number[], pixels: Float64Array) =>
    (await this.request({ do: "picture", weights, ...setting }, pixels, (pixels.length / 9) * 12)).output;
  fit = async (setting: Setting, albedo: boolean, points: Float64Array) =>
    (await this.request<Fit>({ do: "fit", albedo, ...setting }, points)).answer;
}
