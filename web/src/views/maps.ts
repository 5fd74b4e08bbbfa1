// The hemisphere of views, as a map of the BRDF and as the sixteen elements of the Mueller matrix.

import { diverging, viridis } from "../colours";
import { brief, canvas, card } from "../dom";
import { seenBrdf, type Frame } from "../frame";
import type { State } from "../state";

const rad = Math.PI / 180;

// Cells of a square over the disc of direction cosines: x towards the mirror's side, y up.
interface Disc {
  size: number;
  cells: Int32Array;
  triples: Float64Array;
}
function discOf(size: number, ti: number): Disc {
  const cells: number[] = [], triples: number[] = [];
  for (let row = 0; row < size; ++row)
    for (let column = 0; column < size; ++column) {
      const x = (2 * column + 1) / size - 1, y = 1 - (2 * row + 1) / size;
      const r = Math.hypot(x, y);
      if (r >= 0.9995) continue;
      cells.push(row * size + column);
      triples.push(ti, Math.asin(r) / rad, 180 + Math.atan2(y, x) / rad);
    }
  return { size, cells: Int32Array.from(cells), triples: Float64Array.from(triples) };
}

function paint(target: HTMLCanvasElement, left: number, top: number, disc: Disc, colour: (i: number) => [number, number, number]): void {
  const context = target.getContext("2d")!;
  const image = context.createImageData(disc.size, disc.size);
  disc.cells.forEach((cell, i) => image.data.set([...colour(i), 255], 4 * cell));
  context.putImageData(image, left, top);
}

export function hemisphereView(change: (part: Partial<State>) => void) {
  const view = card("hemisphere", "Hemisphere of views");
  const size = 120, shown = 360;
  const small = canvas(size, size, "");
  const picture = canvas(shown, shown, "Map of the BRDF over all views");
  picture.id = "hemisphere-map";
  view.body.append(picture);
  picture.addEventListener("click", (event) => {
    const box = picture.getBoundingClientRect();
    const x = (2 * (event.clientX - box.left)) / box.width - 1, y = 1 - (2 * (event.clientY - box.top)) / box.height;
    const r = Math.hypot(x, y);
    if (r < 0.999) change({ tr: Math.round((Math.asin(r) / rad) * 10) / 10, phi: Math.round(180 + Math.atan2(y, x) / rad) });
  });

  async function update(frame: Frame): Promise<void> {
    const { state } = frame;
    const disc = discOf(size, state.ti);
    const values = await seenBrdf(frame, frame.setting, disc.triples);
    const top = Math.log10(values.reduce((a, b) => Math.max(a, b), 1e-300));
    paint(small, 0, 0, disc, (i) => viridis(1 + (Math.log10(Math.max(values[i], 1e-300)) - top) / 5));
    const context = picture.getContext("2d")!;
    context.clearRect(0, 0, shown, shown);
    context.imageSmoothingEnabled = true;
    context.drawImage(small, 0, 0, shown, shown);
    const mark = (theta: number, phi: number, text: string) => {
      const x = (shown / 2) * (1 - Math.sin(theta * rad) * Math.cos(phi * rad)), y = (shown / 2) * (1 + Math.sin(theta * rad) * Math.sin(phi * rad));
      context.lineWidth = 4;
      context.strokeStyle = "rgb(0 0 0 / 70%)";
      context.fillStyle = "#fff";
      context.font = "bold 15px system-ui, sans-serif";
      context.textAlign = x > shown / 2 ? "right" : "left";
      context.beginPath();
      context.arc(x, y, 5, 0, 7);
      context.stroke();
      context.fill();
      const to = x + (x > shown / 2 ? -10 : 10);
      context.strokeText(text, to, y + 5);
      context.fillText(text, to, y + 5);
    };
    mark(state.ti, 0, "light");
    mark(state.tr, state.phi, "view");
    view.note.textContent = `Direction cosines; logarithmic, five decades below ${brief(10 ** top)} /sr. A click chooses the view.`;
    picture.dataset.peak = String(10 ** top);
  }
  return { section: view.section, update };
}

export function muellerView() {
  const view = card("mueller", "Mueller matrix");
  const size = 64, gap = 4, side = 4 * size + 3 * gap;
  const picture = canvas(side, side, "Sixteen maps: the Mueller matrix over all views");
  picture.id = "mueller-maps";
  view.body.append(picture);

  async function update(frame: Frame): Promise<void> {
    const { state, description, engine, setting } = frame;
    const context = picture.getContext("2d")!;
    context.clearRect(0, 0, side, side);
    if (!description.polarised) {
      view.note.textContent = "This model has no polarisation.";
      return;
    }
    const disc = discOf(size, state.ti);
    const all = await engine.evaluate(setting, "mueller", disc.triples);
    let top = 1e-300;
    for (let i = 0; i < all.length; i += 16) top = Math.max(top, all[i]);
    for (let e = 0; e < 16; ++e)
      paint(picture, (e % 4) * (size + gap), Math.floor(e / 4) * (size + gap), disc, (i) => {
        const first = all[16 * i];
        return e === 0 ? viridis(1 + Math.log10(Math.max(first, 1e-300) / top) / 5) : diverging(first > 0 ? all[16 * i + e] / first : 0);
      });
    const here = await engine.evaluate(setting, "mueller", Float64Array.of(state.ti, state.tr, state.phi));
    picture.dataset.here = Array.from(here).join(" ");
    const polarisation = here[0] > 0 ? Math.hypot(here[4], here[8], here[12]) / here[0] : 0;
    view.note.textContent =
      `Of the directional-diffuse term: first element logarithmic, the others over it, blue −1 to red 1. ` +
      `At the chosen view unpolarised light becomes ${brief(100 * polarisation, 3)} % polarised.`;
  }
  return { section: view.section, update };
}

export function phiView() {
  const view = card("plane", "Φ(g, t) and where this view is");
  const size = 60, shown = 300;
  const small = canvas(size, size, "");
  const picture = canvas(shown, shown, "");
  picture.id = "phi-map";
  view.body.append(picture);
  const g = [-4, 5], t = [-4, 7]; // decades
  let painted = false;

  async function paintPlane(frame: Frame): Promise<void> {
    const pairs = new Float64Array(2 * size * size);
    for (let row = 0; row < size; ++row)
      for (let column = 0; column < size; ++column) {
        pairs[2 * (row * size + column)] = 10 ** (g[0] + ((column + 0.5) / size) * (g[1] - g[0]));
        pairs[2 * (row * size + column) + 1] = 10 ** (t[1] - ((row + 0.5) / size) * (t[1] - t[0]));
      }
    const logs = await frame.engine.logPhi(pairs);
    const context = small.getContext("2d")!;
    const image = context.createImageData(size, size);
    logs.forEach((v, i) => image.data.set([...viridis(1 + v / Math.LN10 / 8), 255], 4 * i));
    context.putImageData(image, 0, 0);
    painted = true;
  }

  async function update(frame: Frame): Promise<void> {
    if (!painted) await paintPlane(frame);
    const context = picture.getContext("2d")!;
    context.drawImage(small, 0, 0, shown, shown);
    const { detail } = frame;
    const x = (shown * (Math.log10(Math.max(detail.g, 1e-9)) - g[0])) / (g[1] - g[0]);
    const y = (shown * (t[1] - Math.log10(Math.max(detail.t, 1e-9)))) / (t[1] - t[0]);
    context.lineWidth = 3;
    context.strokeStyle = "#000";
    context.fillStyle = "#fff";
    context.beginPath();
    context.arc(Math.min(Math.max(x, 6), shown - 6), Math.min(Math.max(y, 6), shown - 6), 6, 0, 7);
    context.stroke();
    context.fill();
    const text = `g = ${brief(detail.g)}, t = ${brief(detail.t)}: regime ${detail.regime}, Φ by ${detail.method}.`;
    picture.setAttribute("aria-label", `Plane of g and t. ${text}`);
    view.note.textContent = `${text} Across: g from 10⁻⁴ to 10⁵; up: t from 10⁻⁴ to 10⁷; colour: Φ, eight decades below 1.`;
  }
  return { section: view.section, update };
}
