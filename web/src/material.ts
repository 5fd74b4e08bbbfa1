// The state as material files of the command.

import type { State } from "./state";

export type Material = Record<string, unknown>;

export const isFile = (state: State): boolean => /\.[a-z]+$/i.test(state.index);

function indexOf(state: State): unknown {
  if (state.index === "nk") return { n: state.n, k: state.k };
  return isFile(state) ? { file: state.index } : state.index;
}

export function nameOf(state: State): string {
  const of = state.index === "nk" ? `n = ${state.n}, k = ${state.k}` : state.index;
  return `${of}, sigma0 ${state.sigma} um, tau ${state.tau} um`;
}

export function materialOf(state: State, model: string = state.model): Material {
  return {
    name: nameOf(state),
    model,
    rms_roughness_um: state.sigma,
    correlation_length_um: state.tau,
    index: indexOf(state),
    diffuse_albedo: state.albedo,
  };
}

// A model without waves, whose width is to be matched, and where it holds that width.
export function microfacet(state: State, f0: number): { material: Material; keys: string[] } | null {
  const index = indexOf(state);
  switch (state.beside) {
    case "ggx":
    case "beckmann":
      return { material: { model: "walter", distribution: state.beside, alpha: 0.3, index }, keys: ["/alpha"] };
    case "ward":
      return {
        material: { model: "ward", kd: 0, lobes: [{ ks: f0, mx: 0.3, my: 0.3 }] },
        keys: ["/lobes/0/mx", "/lobes/0/my"],
      };
    case "cook_torrance":
      return { material: { model: "cook_torrance", kd: 0, lobes: [{ ks: 1, f0, m: 0.3 }] }, keys: ["/lobes/0/m"] };
    default:
      return null;
  }
}
