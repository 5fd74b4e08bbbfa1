// The state as material files of the command, and back.

import { ranges, type State } from "./state";

export type Material = Record<string, unknown>;

const isFileName = (text: string): boolean => /\.[a-z]+$/i.test(text);

function indexOf(state: State): unknown {
  if (state.index === "nk") return { n: state.n, k: state.k };
  return isFileName(state.index) ? { file: state.index } : state.index;
}

// Which numbers the correlation leaves to the controls.
export const isTable = (state: State): boolean => state.correlation === "psd" || state.correlation === "autocorrelation";
export const isKCorrelation = (state: State): boolean => state.correlation === "k_correlation";
export const hasTau = (state: State): boolean => !isTable(state) && !isKCorrelation(state);
export const hasRoughness = (state: State): boolean => state.correlation !== "psd"; // a power spectrum is absolute
export const hasBand = (state: State): boolean => hasRoughness(state) && state.shortest > 0;
const length = (state: State): number => (isKCorrelation(state) ? state.b : state.tau);
export const isAnisotropic = (state: State): boolean => !isTable(state) && state.across > 0 && state.across !== length(state);
export const hasFilm = (state: State): boolean => state.film !== "none" && state.thickness > 0;

// Dropped files that a material file names.
export const filesOf = (state: State): string[] =>
  [isFileName(state.index) ? state.index : "", isTable(state) ? state.heights : "", hasFilm(state) && isFileName(state.film) ? state.film : ""].filter(Boolean);

export function nameOf(state: State): string {
  const of = state.index === "nk" ? `n = ${state.n}, k = ${state.k}` : state.index;
  const film = hasFilm(state) ? ` under ${state.thickness} um of ${state.film}` : "";
  const lengths = isAnisotropic(state) ? `${length(state)} and ${state.across}` : length(state);
  const sigma = hasRoughness(state) ? `, sigma0 ${state.sigma} um` : "";
  const heights = isTable(state) ? `, heights of ${state.heights}` : isKCorrelation(state) ? `, B ${lengths} um, C ${state.c}` : `, tau ${lengths} um`;
  return `${of}${film}${sigma}${heights}`;
}

function correlationOf(state: State, lengths: unknown): unknown {
  switch (state.correlation) {
    case "matern":
      return { type: "matern", nu: state.nu };
    case "k_correlation":
      return { type: "k_correlation", B_um: lengths, C: state.c, psd: state.psd };
    case "psd":
    case "autocorrelation":
      return { type: state.correlation, file: state.heights };
    default:
      return state.correlation;
  }
}

export function materialOf(state: State, model: string = state.model): Material {
  const lengths = isAnisotropic(state) ? [length(state), state.across] : length(state);
  const material: Material = { name: nameOf(state), model };
  if (hasRoughness(state)) material.rms_roughness_um = state.sigma;
  if (hasTau(state)) material.correlation_length_um = lengths;
  if (isAnisotropic(state)) material.azimuth_deg = state.axis;
  if (state.correlation !== "gaussian") material.correlation = correlationOf(state, lengths);
  if (hasBand(state)) material.rms_band_um = [state.shortest, state.longest > 0 ? state.longest : "infinity"];
  material.index = indexOf(state);
  material.diffuse_albedo = state.albedo;
  if (hasFilm(state)) material.films = [{ index: isFileName(state.film) ? { file: state.film } : state.film, thickness_um: state.thickness }];
  return material;
}

// ---- a material file as a part of the state

type Read = (value: unknown, material: Material) => Partial<State>;

const lengthsOf = (key: "tau" | "b", value: unknown, material: Material): Partial<State> =>
  Array.isArray(value) ? { [key]: value[0], across: value[1], axis: Number(material.azimuth_deg ?? 0) } : { [key]: value };

const fileOf = (value: unknown): string | null => {
  const of = value as { file?: unknown };
  return typeof value === "string" ? value : typeof of?.file === "string" ? of.file : null;
};

function correlationIn(value: unknown, material: Material): Partial<State> {
  const of = (typeof value === "string" ? { type: value } : value) as Record<string, unknown>;
  const only = (...keys: string[]) => {
    const other = Object.keys(of).find((key) => key !== "type" && !keys.includes(key));
    if (other) throw new Error(`"${other}" has no control here`);
  };
  switch (of.type) {
    case "gaussian":
    case "exponential":
      only();
      return { correlation: of.type };
    case "matern":
      only("nu");
      return { correlation: "matern", nu: of.nu as number };
    case "k_correlation":
      only("B_um", "C", "psd");
      return { correlation: "k_correlation", c: of.C as number, psd: of.psd as State["psd"], ...lengthsOf("b", of.B_um, material) };
    case "psd":
    case "autocorrelation":
      only("file");
      return { correlation: of.type, heights: of.file as string };
    default:
      throw new Error(`"${of.type}" has no control here`);
  }
}

const readers: Record<string, Read> = {
  name: () => ({}),
  model: () => ({}),
  fitted: () => ({}),
  azimuth_deg: () => ({}),
  rms_roughness_um: (value) => ({ sigma: value as number }),
  diffuse_albedo: (value) => ({ albedo: value as number }),
  correlation_length_um: (value, material) => lengthsOf("tau", value, material),
  correlation: correlationIn,
  rms_band_um: (value) => {
    const [shortest, longest] = value as [number, number | "infinity"];
    return { shortest, longest: longest === "infinity" ? 0 : longest };
  },
  films: (value) => {
    const films = value as { index: unknown; thickness_um: unknown }[];
    if (films.length === 0) return {};
    const film = fileOf(films[0].index);
    if (films.length > 1 || film === null || typeof films[0].thickness_um !== "number")
      throw new Error("one film of built-in constants or of a dropped file has a control here");
    return { film, thickness: films[0].thickness_um };
  },
  index: (value) => {
    const file = fileOf(value), of = value as { n?: unknown; k?: unknown };
    if (file !== null) return { index: file };
    if (typeof of?.n !== "number") throw new Error("must be a built-in name, a dropped file, or n and k to be shown with these controls");
    return { index: "nk", n: of.n, k: (of.k ?? 0) as number };
  },
};

// What a material file says, in the terms of the controls; an Error that names file and key where there is no control for it.
export function stateOf(name: string, material: Material): Partial<State> {
  if (material.model !== "he" && material.model !== "he_unified")
    throw new Error(`${name}: key "model": must be "he" or "he_unified" to be shown with these controls`);
  const part: Partial<State> = { model: material.model, across: 0, axis: 0, film: "none", albedo: 0, correlation: "gaussian", shortest: 0, longest: 0 };
  for (const [key, value] of Object.entries(material)) {
    const read = readers[key];
    if (!read) throw new Error(`${name}: key "${key}": has no control here`);
    try {
      Object.assign(part, read(value, material));
    } catch (error) {
      throw new Error(`${name}: key "${key}": ${error instanceof Error ? error.message : String(error)}`);
    }
  }
  for (const [key, value] of Object.entries(part)) {
    const range = ranges[key as keyof State];
    if (range && !(typeof value === "number" && value >= range[0] && value <= range[1]))
      throw new Error(`${name}: ${key} ${JSON.stringify(value)}: must be a number from ${range[0]} to ${range[1]} to be shown with these controls`);
  }
  return part;
}

// A model without waves whose width is to be matched, and where it holds that width, or an exponent in its place.
export interface Facets {
  material: Material;
  keys: string[];
  exponents?: string[];
}
export function microfacet(state: State, f0: number): Facets | null {
  const index = indexOf(state);
  switch (state.beside) {
    case "ggx":
    case "beckmann":
      return { material: { model: "walter", distribution: state.beside, alpha: 0.3, index }, keys: ["/alpha"] };
    case "phong":
      return { material: { model: "walter", distribution: "phong", exponent: 20, index }, keys: [], exponents: ["/exponent"] };
    case "ward":
    case "ward_duer":
      return { material: { model: state.beside, kd: 0, lobes: [{ ks: f0, mx: 0.3, my: 0.3 }] }, keys: ["/lobes/0/mx", "/lobes/0/my"] };
    case "cook_torrance":
      return { material: { model: "cook_torrance", kd: 0, lobes: [{ ks: 1, f0, m: 0.3 }] }, keys: ["/lobes/0/m"] };
    case "kurt":
      return { material: { model: "kurt", kd: 0, lobes: [{ ks: 1, f0, mx: 0.3, my: 0.3, alpha: 0 }] }, keys: ["/lobes/0/mx", "/lobes/0/my"] };
    case "blinn_phong":
      return { material: { model: "blinn_phong", kd: 0, lobes: [{ ks: f0, exponent: 20 }] }, keys: [], exponents: ["/lobes/0/exponent"] };
    case "ashikhmin_shirley":
      return { material: { model: "ashikhmin_shirley", rd: 0, f0, nx: 20, ny: 20 }, keys: [], exponents: ["/nx", "/ny"] };
    case "ashikhmin":
      return {
        material: { model: "ashikhmin", normals: { type: "gaussian", sigma_x: 0.2, sigma_y: 0.2 }, f0, diffuse_albedo: 0 },
        keys: ["/normals/sigma_x", "/normals/sigma_y"],
      };
    default:
      return null;
  }
}
