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
  const tau = isAnisotropic(state) ? `${state.tau} and ${state.across}` : state.tau;
  const film = hasFilm(state) ? ` under ${state.thickness} um of ${state.film}` : "";
  return `${of}${film}, sigma0 ${state.sigma} um, tau ${tau} um`;
}

export const isAnisotropic = (state: State): boolean => state.across > 0 && state.across !== state.tau;
export const hasFilm = (state: State): boolean => state.film !== "none" && state.thickness > 0;

export function materialOf(state: State, model: string = state.model): Material {
  const material: Material = {
    name: nameOf(state),
    model,
    rms_roughness_um: state.sigma,
    correlation_length_um: isAnisotropic(state) ? [state.tau, state.across] : state.tau,
    index: indexOf(state),
    diffuse_albedo: state.albedo,
  };
  if (isAnisotropic(state)) material.azimuth_deg = state.axis;
  if (state.correlation === "exponential") material.correlation = state.correlation;
  if (state.correlation === "matern") material.correlation = { type: "matern", nu: state.nu };
  if (hasFilm(state)) material.films = [{ index: state.film, thickness_um: state.thickness }];
  return material;
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
