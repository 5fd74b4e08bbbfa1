// Colour maps, and linear light on a screen.

// Viridis (S. van der Walt and N. Smith, CC0), every eighth of it.
const stops = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];

export function viridis(x: number): [number, number, number] {
  const at = Math.min(Math.max(x, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  return stops[i].map((v, c) => v + (stops[i + 1][c] - v) * (at - i)) as [number, number, number];
}

// Blue for -1, white for 0, red for 1.
export function diverging(x: number): [number, number, number] {
  const v = Math.min(Math.max(x, -1), 1);
  const to = v < 0 ? [33, 102, 172] : [178, 24, 43];
  return to.map((c) => 247 + (c - 247) * Math.abs(v)) as [number, number, number];
}

export const encoded = (v: number): number => {
  const c = Math.min(Math.max(v, 0), 1);
  return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055));
};

export const css = (rgb: ArrayLike<number>): string => `rgb(${encoded(rgb[0])} ${encoded(rgb[1])} ${encoded(rgb[2])})`;
