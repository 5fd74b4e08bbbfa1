// The state as material files of the command, and back.

import { choices, ranges, type Chosen, type State } from "./state";

export type Material = Record<string, unknown>;

// Names of built-in constants have no dot.
export const isFileName = (text: string): boolean => text.includes(".");
const fileOrName = (text: string): unknown => (isFileName(text) ? { file: text } : text);
const indexOf = (state: State): unknown => (state.index === "nk" ? { n: state.n, k: state.k } : fileOrName(state.index));

// ---- which numbers the choices leave to the controls

const numbersOf: Record<Chosen<"correlation">, readonly (keyof State)[]> = {
  gaussian: ["tau"],
  exponential: ["tau"],
  matern: ["tau", "nu"],
  k_correlation: ["b", "c", "psd"],
  sum: [],
  fractal: ["finest", "coarsest", "c", "psd"],
  psd: [],
  autocorrelation: [],
};

// Whether the correlation of heights depends on it.
export function isNumberOf(state: State, key: keyof State): boolean {
  if (state.correlation !== "sum") return numbersOf[state.correlation].includes(key);
  const second = numbersOf[state.second].map((name) => `${name}2`);
  return [...numbersOf[state.first], ...second, "first", "second", "share"].includes(key);
}
export const isTable = (state: State): boolean => state.correlation === "psd" || state.correlation === "autocorrelation";
export const hasRoughness = (state: State): boolean => state.correlation !== "psd"; // a power spectrum is absolute
export const hasBand = (state: State): boolean => hasRoughness(state) && state.shortest > 0;
export const mayBeAnisotropic = (state: State): boolean => !isTable(state) && state.correlation !== "sum" && state.correlation !== "fractal";
const length = (state: State): number => (state.correlation === "k_correlation" ? state.b : state.tau);
export const isAnisotropic = (state: State): boolean => mayBeAnisotropic(state) && state.across > 0 && state.across !== length(state);
export const hasFilm = (state: State): boolean => state.film !== "none" && state.thickness > 0;
// What he_unified leaves to choose, and what of it is known of Gaussian surfaces without a grain alone.
export const hasShortcut = (state: State, model: string): boolean => model === "he_unified" && !hasFilm(state);
export const hasMirrors = (state: State, model: string): boolean =>
  hasShortcut(state, model) && state.correlation === "gaussian" && !isAnisotropic(state);

// Dropped files that a material file names.
export const filesOf = (state: State): string[] =>
  [isFileName(state.index) ? state.index : "", isTable(state) ? state.heights : "", hasFilm(state) && isFileName(state.film) ? state.film : ""].filter(Boolean);

// ---- the state as a material file

// A shape of correlation, as the sum has two.
type Part = Pick<State, "tau" | "nu" | "b" | "c" | "psd"> & { type: Chosen<"first"> };
const secondOf = (state: State): Part => ({ type: state.second, tau: state.tau2, nu: state.nu2, b: state.b2, c: state.c2, psd: state.psd2 });

function shapeOf(part: Part, lengths: unknown = part.b): Material {
  switch (part.type) {
    case "matern":
      return { type: "matern", nu: part.nu };
    case "k_correlation":
      return { type: "k_correlation", B_um: lengths, C: part.c, psd: part.psd };
    default:
      return { type: part.type };
  }
}
const scaleOf = (part: Part): Material => (part.type === "k_correlation" ? shapeOf(part) : { ...shapeOf(part), length_um: part.tau });

function correlationOf(state: State, lengths: unknown): unknown {
  switch (state.correlation) {
    case "exponential":
      return state.correlation;
    case "fractal":
      return { type: "fractal", C: state.c, psd: state.psd, periods_um: [state.finest, state.coarsest] };
    case "psd":
    case "autocorrelation":
      return { type: state.correlation, file: state.heights };
    case "sum":
      return {
        type: "sum",
        of: [[Number((1 - state.share).toPrecision(15)), scaleOf({ ...state, type: state.first })], [state.share, scaleOf(secondOf(state))]],
      };
    default:
      return shapeOf({ ...state, type: state.correlation }, lengths);
  }
}

// "tau 1.77 um", "B 5 um, C 2.5".
const scaleName = (part: Part, lengths: unknown): string =>
  part.type === "k_correlation" ? `B ${lengths} um, C ${part.c}` : `tau ${lengths} um`;

function heightsName(state: State): string {
  switch (state.correlation) {
    case "psd":
    case "autocorrelation":
      return `heights of ${state.heights}`;
    case "fractal":
      return `fractal from ${state.finest} to ${state.coarsest} um, C ${state.c}`;
    case "sum": {
      const second = secondOf(state);
      return `${scaleName({ ...state, type: state.first }, state.first === "k_correlation" ? state.b : state.tau)} and ` +
        scaleName(second, second.type === "k_correlation" ? second.b : second.tau);
    }
    default:
      return scaleName({ ...state, type: state.correlation }, isAnisotropic(state) ? `${length(state)} and ${state.across}` : length(state));
  }
}

export function nameOf(state: State): string {
  const of = state.index === "nk" ? `n = ${state.n}, k = ${state.k}` : state.index;
  const film = hasFilm(state) ? ` under ${state.thickness} um of ${state.film}` : "";
  const sigma = hasRoughness(state) ? `, sigma0 ${state.sigma} um` : "";
  return `${of}${film}${sigma}, ${heightsName(state)}`;
}

export function materialOf(state: State, model: string = state.model): Material {
  const lengths = isAnisotropic(state) ? [length(state), state.across] : length(state);
  const material: Material = { name: nameOf(state), model };
  if (hasRoughness(state)) material.rms_roughness_um = state.sigma;
  if (state.correlation !== "sum" && isNumberOf(state, "tau")) material.correlation_length_um = lengths;
  if (isAnisotropic(state)) material.azimuth_deg = state.axis;
  if (state.correlation !== "gaussian") material.correlation = correlationOf(state, lengths);
  if (hasBand(state)) material.rms_band_um = [state.shortest, state.longest > 0 ? state.longest : "infinity"];
  material.index = indexOf(state);
  material.diffuse_albedo = state.albedo;
  if (hasFilm(state)) material.films = [{ index: fileOrName(state.film), thickness_um: state.thickness }];
  if (hasMirrors(state, model) && state.mirror !== "closed") material.mirror = state.mirror;
  if (hasMirrors(state, model) && state.mixing) material.polarisation_mixing = true;
  if (hasShortcut(state, model) && state.shortcut) material.conductor_shortcut = true;
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

function requireOnly(of: Material, ...keys: string[]): void {
  const other = Object.keys(of).find((key) => key !== "type" && !keys.includes(key));
  if (other) throw new Error(`"${other}" has no control here`);
}

// A part of a sum, whose controls have "2" at their ends if it is the second.
function scaleIn(of: Material, end: "" | "2"): Partial<State> {
  const numbers: Material = { [end ? "second" : "first"]: of.type };
  for (const [key, name] of [["length_um", "tau"], ["nu", "nu"], ["B_um", "b"], ["C", "c"], ["psd", "psd"]])
    if (key in of) numbers[name + end] = of[key];
  return numbers as Partial<State>;
}

function sumIn(value: unknown): Partial<State> {
  const parts = value as [number, Material][];
  if (parts.length !== 2) throw new Error(`a sum of ${parts.length} has no control here, a sum of two has`);
  const [[first, a], [second, b]] = parts;
  return { correlation: "sum", share: second / (first + second), ...scaleIn(a, ""), ...scaleIn(b, "2") };
}

function correlationIn(value: unknown, material: Material): Partial<State> {
  const of = (typeof value === "string" ? { type: value } : value) as Material;
  switch (of.type) {
    case "gaussian":
    case "exponential":
      return { correlation: of.type };
    case "matern":
      return { correlation: "matern", nu: of.nu as number };
    case "k_correlation":
      requireOnly(of, "B_um", "C", "psd");
      return { correlation: "k_correlation", c: of.C as number, psd: of.psd as State["psd"], ...lengthsOf("b", of.B_um, material) };
    case "sum":
      return sumIn(of.of);
    case "fractal": {
      const [finest, coarsest] = of.periods_um as [number, number];
      return { correlation: "fractal", c: of.C as number, psd: of.psd as State["psd"], finest, coarsest };
    }
    case "psd":
    case "autocorrelation":
      requireOnly(of, "file");
      return { correlation: of.type, heights: of.file as string };
    default:
      throw new Error(`"${of.type}" has no control here`);
  }
}

const readers: Record<string, Read> = {
  name: () => ({}),
  model: () => ({}),
  fitted: () => ({}),
  uncertainty: () => ({}),
  azimuth_deg: () => ({}),
  rms_roughness_um: (value) => ({ sigma: value as number }),
  diffuse_albedo: (value) => ({ albedo: value as number }),
  mirror: (value) => ({ mirror: value as State["mirror"] }),
  polarisation_mixing: (value) => ({ mixing: value as boolean }),
  conductor_shortcut: (value) => ({ shortcut: value as boolean }),
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

// A material file as the engine finds what it names, each file in the same folder, and these files.
export function parsed(text: string): { material: Material; files: string[] } {
  const files: string[] = [];
  const material = JSON.parse(text, (key, value) => {
    if (key !== "file" || typeof value !== "string") return value;
    files.push(value.replace(/^.*\//, ""));
    return files[files.length - 1];
  });
  return { material, files };
}

// What a material file that the engine reads says, in the terms of the controls; an Error that names file and key where there is no
// control for it.
export function stateOf(name: string, material: Material): Partial<State> {
  if (!Object.keys(choices.model).includes(String(material.model)))
    throw new Error(`${name}: key "model": must be ${Object.keys(choices.model).map((model) => `"${model}"`).join(" or ")} to be shown with these controls`);
  const part: Partial<State> = {
    model: material.model as State["model"], mirror: "closed", mixing: false, shortcut: false, across: 0, axis: 0, film: "none", albedo: 0,
    correlation: "gaussian", shortest: 0, longest: 0,
  };
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
