// Everything that the page shows follows from this, and the address holds it.

const shapes = { gaussian: "Gaussian", exponential: "exponential", matern: "Matérn", k_correlation: "K-correlation" };
const spectra = { "2d": "the surface (2d)", "1d one-sided": "a profile (1d)" };
const polarised = { s: "s", p: "p", plus: "+45°", minus: "−45°", right: "right circular", left: "left circular" };

// What can be chosen, and how the page calls it.
export const choices = {
  model: { he: "He-Torrance 1991 (he)", he_unified: "its successor (he_unified)" },
  mirror: { closed: "closed form", second_order: "second order" },
  correlation: { ...shapes, sum: "sum of two", fractal: "fractal", psd: "power spectrum", autocorrelation: "table of C" },
  first: shapes,
  second: shapes,
  psd: spectra,
  psd2: spectra,
  light: { white: "white light", one: "one wavelength" },
  in: { none: "unpolarised", ...polarised },
  out: { none: "none", ...polarised },
  beside: {
    none: "nothing",
    ggx: "GGX (Walter)",
    beckmann: "Beckmann (Walter)",
    phong: "Phong (Walter)",
    ward: "Ward",
    ward_duer: "Ward-Duer",
    cook_torrance: "Cook-Torrance",
    kurt: "Kurt",
    blinn_phong: "Blinn-Phong",
    ashikhmin_shirley: "Ashikhmin-Shirley",
    ashikhmin: "Ashikhmin, Gaussian normals",
    he: "He-Torrance",
    he_unified: "he_unified",
  },
  radius: { relative: "over specular direction", absolute: "BRDF", log: "logarithm" },
  shape: { sphere: "sphere", plate: "plate", cylinder: "cylinder" },
} as const;
export type Choice = keyof typeof choices;
export type Chosen<Key extends Choice> = keyof (typeof choices)[Key];

export interface State {
  model: Chosen<"model">;
  mirror: Chosen<"mirror">; // this and the next two: of he_unified
  mixing: boolean; // of polarisations
  shortcut: boolean; // of metals
  sigma: number; // um
  tau: number; // um
  across: number; // um, the length (tau or B) along the second axis; 0: the same
  axis: number; // degrees, azimuth of the first axis from the plane of incidence
  correlation: Chosen<"correlation">;
  nu: number; // of Matern's correlation
  b: number; // um, B of the K-correlation
  c: number; // C of the K-correlation and of fractals
  psd: Chosen<"psd">; // which spectrum their numbers are of
  finest: number; // um, the periods between which a fractal is one
  coarsest: number;
  first: Chosen<"first">; // the parts of a sum: the first has the numbers above, the second those that end in 2
  second: Chosen<"second">;
  tau2: number;
  nu2: number;
  b2: number;
  c2: number;
  psd2: Chosen<"psd2">;
  share: number; // of the second in the variance of heights
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
  light: Chosen<"light">;
  ti: number; // degrees
  tr: number;
  phi: number;
  in: Chosen<"in">;
  out: Chosen<"out">;
  beside: Chosen<"beside">;
  tolerance: number;
  radius: Chosen<"radius">;
  shape: Chosen<"shape">;
}

export const initial: State = {
  model: "he",
  mirror: "closed",
  mixing: false,
  shortcut: false,
  sigma: 0.28,
  tau: 1.77,
  across: 0,
  axis: 0,
  correlation: "gaussian",
  nu: 1.5,
  b: 5,
  c: 2.5,
  psd: "2d",
  finest: 0.5,
  coarsest: 100,
  first: "gaussian",
  second: "gaussian",
  tau2: 0.5,
  nu2: 1.5,
  b2: 1,
  c2: 2.5,
  psd2: "2d",
  share: 0.1,
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

export const ranges: { [key in keyof State]?: [number, number] } = {
  sigma: [0, 100],
  tau: [0.01, 1000],
  across: [0, 1000],
  axis: [-180, 180],
  thickness: [0, 10],
  nu: [0.5, 10],
  b: [0.01, 10000],
  c: [0.1, 102],
  finest: [0.001, 10000],
  coarsest: [0.01, 100000],
  tau2: [0.01, 1000],
  nu2: [0.5, 10],
  b2: [0.01, 10000],
  c2: [1.1, 102],
  share: [1e-6, 0.999999],
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
  const put = (key: keyof State, value: unknown) => ((state as unknown as Record<string, unknown>)[key] = value);
  for (const [key, value] of new URLSearchParams(text)) {
    if (!Object.hasOwn(initial, key)) {
      problems.push(`${key}: not known`);
      continue;
    }
    const name = key as keyof State;
    const range = ranges[name];
    const names = Object.hasOwn(choices, key) ? Object.keys(choices[key as Choice]) : typeof initial[name] === "boolean" ? ["true", "false"] : null;
    if (range) {
      const number = value.trim() === "" ? NaN : Number(value);
      if (number >= range[0] && number <= range[1]) put(name, number);
      else problems.push(`${key} ${value}: must be from ${range[0]} to ${range[1]}`);
    } else if (names && !names.includes(value)) {
      problems.push(`${key} ${value}: must be one of ${names.join(", ")}`);
    } else {
      put(name, typeof initial[name] === "boolean" ? value === "true" : value);
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
  { name: "Two scales: waves of 8 µm and fine grain", address: "model=he_unified&sigma=0.12&correlation=sum&tau=8&second=exponential&tau2=0.7&share=0.15&tr=45&radius=log" },
  { name: "Silicon dioxide of 0.3 µm on aluminium", address: "sigma=0.05&tau=1&film=SiO2&thickness=0.3&tr=40" },
  { name: "Copper at grazing incidence", address: "sigma=0.15&tau=1&index=Cu&ti=80&tr=80&lambda=0.6" },
];
