// What the views of one state are drawn from.

import type { Engine, Description, Detail, Match, Setting } from "./client";
import { isPolarised, seen, seenOfDiffuse } from "./light";
import { materialOf, microfacet } from "./material";
import { choices, type State } from "./state";

export interface Point {
  ti: number;
  tr: number;
  phi: number;
  um: number;
  brdf: number;
}

export interface Measured {
  name: string;
  points: Point[];
}

export interface Frame {
  state: State;
  engine: Engine;
  setting: Setting; // at the wavelength of the state
  description: Description;
  detail: Detail;
  specular: number; // of the polarisation chosen
  beside: { setting: Setting; name: string; match: (Match & { exponent: boolean }) | null } | null;
  measured: Measured | null;
}

export const visible = Array.from({ length: 31 }, (_, i) => Number((0.4 + 0.01 * i).toFixed(2)));

export const settingOf = (state: State, wavelengths: number[], model: string = state.model): Setting => ({
  material: materialOf(state, model),
  wavelengths,
  tolerance: state.tolerance,
});

// BRDF of pairs as the receiver sees it, at all wavelengths of the setting.
export async function seenBrdf(frame: Frame, setting: Setting, triples: Float64Array): Promise<Float64Array> {
  const { state, engine } = frame;
  if (!isPolarised(state)) return engine.evaluate(setting, "brdf", triples);
  const count = triples.length / 3;
  const matrices = await engine.evaluate(setting, "mueller", triples);
  const diffuse = seenOfDiffuse(state, state.albedo / Math.PI);
  return Float64Array.from({ length: count * setting.wavelengths.length }, (_, i) => seen(state, matrices, 16 * i) + diffuse);
}

export async function frameOf(state: State, engine: Engine, measured: Measured | null): Promise<Frame> {
  const setting = settingOf(state, [state.lambda]);
  const pair = Float64Array.of(state.ti, state.tr, state.phi);
  const [description, detail] = await Promise.all([engine.describe(setting), engine.detail(setting, pair)]);
  const frame: Frame = { state, engine, setting, description, detail, specular: detail.specular_reflectance, beside: null, measured };
  if (isPolarised(state)) frame.specular = seen(state, await engine.evaluate(setting, "specular_mueller", pair), 0);
  return frame;
}

// The model beside, its width matched to the lobe at the angle of incidence.
export async function withBeside(frame: Frame): Promise<Frame> {
  const { state, engine, setting, description } = frame;
  const name = choices.beside[state.beside];
  if (state.beside === "none" || state.beside === state.model) return frame;
  if (state.beside === "he" || state.beside === "he_unified")
    return { ...frame, beside: { setting: settingOf(state, [state.lambda], state.beside), name, match: null } };
  const n = description.n[0], k = description.k[0];
  const f0 = ((n - 1) ** 2 + k ** 2) / ((n + 1) ** 2 + k ** 2);
  const facets = microfacet(state, f0)!;
  const match = { ...(await engine.match(setting, facets, state.ti)), exponent: facets.exponents !== undefined };
  return { ...frame, beside: { setting: { material: match.material, wavelengths: [state.lambda] }, name, match } };
}
