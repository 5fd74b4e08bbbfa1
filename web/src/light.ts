// Polarised light in and an analyser before the receiver.

import type { Chosen, State } from "./state";

const stokes: Record<Chosen<"in">, [number, number, number, number]> = {
  none: [1, 0, 0, 0],
  s: [1, 1, 0, 0],
  p: [1, -1, 0, 0],
  plus: [1, 0, 1, 0],
  minus: [1, 0, -1, 0],
  right: [1, 0, 0, 1],
  left: [1, 0, 0, -1],
};

export const isPolarised = (state: State): boolean => state.in !== "none" || state.out !== "none";

// What the receiver sees per unit of light, from 16 elements at `at`: the first element of the analysed Stokes vector.
export function seen(state: State, m: Float64Array, at: number): number {
  const s = stokes[state.in];
  const a = stokes[state.out];
  let sum = 0;
  for (let i = 0; i < 4; ++i) {
    const row = m[at + 4 * i] * s[0] + m[at + 4 * i + 1] * s[1] + m[at + 4 * i + 2] * s[2] + m[at + 4 * i + 3] * s[3];
    sum += a[i] * row;
  }
  return state.out === "none" ? sum : sum / 2;
}

// The same of a depolariser.
export const seenOfDiffuse = (state: State, brdf: number): number => (state.out === "none" ? brdf : brdf / 2);
