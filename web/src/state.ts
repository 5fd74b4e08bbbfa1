// Everything that the page shows follows from this, and the address holds it.

export type Model = "he" | "he_unified";
export type Polarisation = "none" | "s" | "p" | "plus" | "minus" | "right" | "left";
const besides = ["none", "ggx", "beckmann", "phong", "ward", "ward_duer", "cook_torrance", "kurt", "blinn_phong", "ashikhmin_shirley", "ashikhmin", "he", "he_unified"] as const;
export type Beside = (typeof besides)[number];
export type Radius = "relative" | "absolute" | "log";
export type Shape = "sphere" | "plate" | "cylinder";
export type Correlation = "gaussian" | "exponential" | "matern" | "k_correlation" | "psd" | "autocorrelation";

export interface State {
  model: Model;
  sigma: number; // um
  tau: number; // um
  across: number; // um, the length (tau or B) along the second axis; 0: the same
  axis: number; // degrees, azimuth of the first axis from the plane of incidence
  correlation: Correlation;
  nu: number; // of Matern's correlation
  b: number; // um, B of the K-correlation
  c: number; // C of the K-correlation
  psd: "2d" | "1d one-sided"; // which spectrum its numbers are of
  heights: string; // the dropped file of a power spectrum or a correlation function, or "none"
  shortest: number; // um, periods between which sigma holds; 0: all
  longest: number; // um; 0: no longest
  index: string; // a built-in name, "nk", or the name of a dropped file
  n: number;
  k: number;
  film: string; // "none", or the name of optical constants
  thickness: number; // um, of the film
  albedo: number;
  lambda: number; // um
  light: "white" | "one";
  ti: number; // degrees
  tr: number;
  phi: number;
  in: Polarisation;
  out: Polarisation;
  beside: Beside;
  tolerance: number;
  radius: Radius;
  shape: Shape;
}

export const initial: State = {
  model: "he",
  sigma: 0.28,
  tau: 1.77,
  across: 0,
  axis: 0,
  correlation: "gaussian",
  nu: 1.5,
  b: 5,
  c: 2.5,
  psd: "2d",
  heights: "none",
  shortest: 0,
  longest: 0,
  index: "Al",
  n: 1.5,
  k: 0,
  film: "none",
  thickness: 0.1,
  albedo: 0,
  lambda: 0.5,
  light: "white",
  ti: 30,
  tr: 30,
  phi: 180,
  in: "none",
  out: "none",
  beside: "none",
  tolerance: 1e-6,
  radius: "relative",
  shape: "sphere",
};

const polarisations = ["none", "s", "p", "plus", "minus", "right", "left"];
const choices: { [key in keyof State]?: readonly (string | number)[] } = {
  model: ["he", "he_unified"],
  correlation: ["gaussian", "exponential", "matern", "k_correlation", "psd", "autocorrelation"],
  psd: ["2d", "1d one-sided"],
  light: ["white", "one"],
  in: polarisations,
  out: polarisations,
  beside: besides,
  radius: ["relative", "absolute", "log"],
  shape: ["sphere", "plate", "cylinder"],
};
export const ranges: { [key in keyof State]?: [number, number] } = {
  sigma: [0, 100],
  tau: [0.01, 1000],
  across: [0, 1000],
  axis: [-180, 180],
  thickness: [0, 10],
  nu: [0.5, 10],
  b: [0.01, 10000],
  c: [1.1, 102],
  shortest: [0, 10000],
  longest: [0, 100000],
  n: [0.01, 100],
  k: [0, 100],
  albedo: [0, 1],
  lambda: [0.05, 100],
  ti: [0, 89.9],
  tr: [0, 89.9],
  phi: [-360, 360],
  tolerance: [1e-12, 1e-3],
};

// What is not as in `initial`, as a query: "sigma=0.1&index=Au".
export function toAddress(state: State): string {
  const query = new URLSearchParams();
  for (const key of Object.keys(initial) as (keyof State)[])
    if (state[key] !== initial[key]) query.set(key, String(state[key]));
  return query.toString();
}

export interface Restored {
  state: State;
  problems: string[];
}

// Values that an address may not have are left as they are, and named.
export function fromAddress(text: string): Restored {
  const state: State = { ...initial };
  const problems: string[] = [];
  const put = <K extends keyof State>(key: K, value: State[K]) => (state[key] = value);
  for (const [key, value] of new URLSearchParams(text)) {
    if (!(key in initial)) {
      problems.push(`${key}: not known`);
      continue;
    }
    const name = key as keyof State;
    const range = ranges[name];
    const choice = choices[name];
    if (range) {
      const number = value.trim() === "" ? NaN : Number(value);
      if (number >= range[0] && number <= range[1]) put(name, number as never);
      else problems.push(`${key} ${value}: must be from ${range[0]} to ${range[1]}`);
    } else if (choice && !choice.includes(value)) {
      problems.push(`${key} ${value}: must be one of ${choice.join(", ")}`);
    } else {
      put(name, value as never);
    }
  }
  return { state, problems };
}

export interface Preset {
  name: string;
  address: string;
}

// The four surfaces of He et al. 1991, as the material files in cli/data have them, and some finishes.
export const presets: Preset[] = [
  { name: "Roughened aluminium, 0.5 µm (Fig. 8)", address: "" },
  { name: "Roughened aluminium, 2 µm (Fig. 7)", address: "lambda=2&ti=45&tr=45&light=one" },
  { name: "Magnesium oxide ceramic (Fig. 9)", address: "sigma=1.45&tau=13.2&index=MgO&albedo=0.9&ti=45&tr=45" },
  { name: "220-grit sandpaper (Fig. 10)", address: "sigma=44&tau=10&index=Al2O3&ti=60&tr=60" },
  { name: "Smooth blue plastic (Fig. 11)", address: "sigma=0&tau=1&index=PMMA&albedo=0.15&lambda=0.46&ti=20&tr=20" },
  { name: "Fine aluminium: lobe and mirror", address: "sigma=0.05&tau=1" },
  { name: "Brushed-fine gold", address: "sigma=0.12&tau=1.2&index=Au&lambda=0.6&shape=cylinder" },
  { name: "Brushed steel, two correlation lengths", address: "sigma=0.15&tau=8&across=1&axis=60&index=Fe&tr=40&phi=150" },
  { name: "Polished optic: K-correlation, 3 nm from 633 nm on", address: "model=he_unified&sigma=0.003&correlation=k_correlation&b=5.02655&c=3&shortest=0.6328&lambda=0.6328&tr=40&radius=log" },
  { name: "Silicon dioxide of 0.3 µm on aluminium", address: "sigma=0.05&tau=1&film=SiO2&thickness=0.3&tr=40" },
  { name: "Copper at grazing incidence", address: "sigma=0.15&tau=1&index=Cu&ti=80&tr=80&lambda=0.6" },
];
