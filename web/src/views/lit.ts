// A sphere, a plate and the paper's cylinder under a small lamp and a sky, drawn by the shader that hts table export writes.

import type { Setting } from "../client";
import { canvas, card } from "../dom";
import { settingOf, type Frame } from "../frame";
import { hasFilm, isAnisotropic } from "../material";
import { choices, type State } from "../state";
import { byShader, composed, corners, screen, size, spots } from "./lit_shaders";

export const shaderWavelengths = Array.from({ length: 8 }, (_, i) => 0.4 + (0.3 * i) / 7);

export function compiled(gl: WebGL2RenderingContext, fragment: string): WebGLProgram {
  const program = gl.createProgram()!;
  for (const [type, text] of [[gl.VERTEX_SHADER, corners], [gl.FRAGMENT_SHADER, fragment]] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader) ?? "shader");
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, "corner");
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) ?? "program");
  return program;
}

function textureOf(gl: WebGL2RenderingContext): WebGLTexture {
  const texture = gl.createTexture()!;
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, size, size, 0, gl.RGBA, gl.FLOAT, null);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}

function framebufferOf(gl: WebGL2RenderingContext, textures: WebGLTexture[]): WebGLFramebuffer {
  const buffer = gl.createFramebuffer()!;
  gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
  const places = textures.map((texture, i) => {
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, texture, 0);
    return gl.COLOR_ATTACHMENT0 + i;
  });
  gl.drawBuffers(places);
  return buffer;
}

// Programs and pictures of the object.
class Stage {
  readonly byShader: WebGLProgram;
  readonly composed: WebGLProgram;
  readonly #spots: WebGLProgram;
  readonly #screen: WebGLProgram;
  readonly #pictures: WebGLTexture[];
  readonly #targets: WebGLFramebuffer[];
  readonly #asked: WebGLFramebuffer;
  readonly #answers: WebGLTexture[];
  passes = 0;
  grid = size;

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.byShader = compiled(gl, byShader);
    this.composed = compiled(gl, composed);
    this.#spots = compiled(gl, spots);
    this.#screen = compiled(gl, screen);
    this.#pictures = [textureOf(gl), textureOf(gl)];
    this.#targets = this.#pictures.map((picture) => framebufferOf(gl, [picture]));
    this.#asked = framebufferOf(gl, [0, 1, 2].map(() => textureOf(gl)));
    this.#answers = [0, 1, 2].map(() => textureOf(gl));
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  }

  place = (program: WebGLProgram, name: string) => this.gl.getUniformLocation(program, name);

  begin(grid: number): void {
    this.grid = grid;
    this.passes = 0;
  }
  lay(state: State): void {
    const a = (-state.ti * Math.PI) / 180;
    for (const program of [this.byShader, this.composed, this.#spots]) {
      this.gl.useProgram(program);
      this.gl.uniform1i(this.place(program, "shape"), Object.keys(choices.shape).indexOf(state.shape));
      this.gl.uniform3fv(this.place(program, "lamp"), [Math.sin(a) * 0.96, 0.28, Math.cos(a) * 0.96].map((v) => v / Math.hypot(0.96, 0.28)));
    }
  }

  #draw(program: WebGLProgram, target: WebGLFramebuffer | null, side: number): void {
    const gl = this.gl;
    gl.useProgram(program);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(0, 0, side, side);
    gl.uniform1i(this.place(program, "grid"), this.grid);
    gl.uniform1i(this.place(program, "pass_index"), this.passes);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  // One more pass, by the shader of the model or of what the engine has answered.
  add(program: WebGLProgram): void {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.#pictures[this.passes % 2]);
    this.#draw(program, this.#targets[(this.passes + 1) % 2], this.grid);
    ++this.passes;
  }

  show(): void {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.#pictures[this.passes % 2]);
    gl.useProgram(this.#screen);
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    gl.uniform3fv(this.place(this.#screen, "ground"), dark ? [0.1, 0.11, 0.13] : [0.93, 0.94, 0.95]);
    this.#draw(this.#screen, null, size);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until it is drawn
  }

  // Pixels that show the object, and nine numbers of each for the engine.
  ask(): { pixels: number[]; numbers: Float64Array } {
    const gl = this.gl, count = this.grid * this.grid;
    this.#draw(this.#spots, this.#asked, this.grid);
    const [viewer, light, chance] = [0, 1, 2].map((i) => {
      const read = new Float32Array(4 * count);
      gl.readBuffer(gl.COLOR_ATTACHMENT0 + i);
      gl.readPixels(0, 0, this.grid, this.grid, gl.RGBA, gl.FLOAT, read);
      return read;
    });
    const pixels: number[] = [];
    for (let i = 0; i < count; ++i) if (viewer[4 * i + 3] > 0) pixels.push(i);
    const numbers = new Float64Array(9 * pixels.length);
    pixels.forEach((pixel, i) => {
      [viewer, light, chance].forEach((of, j) => numbers.set(of.subarray(4 * pixel, 4 * pixel + 3), 9 * i + 3 * j));
    });
    return { pixels, numbers };
  }

  // Twelve numbers of each.
  answer(pixels: number[], numbers: Float64Array): void {
    const gl = this.gl;
    for (let j = 0; j < 3; ++j) {
      const data = new Float32Array(4 * this.grid * this.grid);
      pixels.forEach((pixel, i) => {
        data.set(numbers.subarray(12 * i + 3 * j, 12 * i + 3 * j + 3), 4 * pixel);
        data[4 * pixel + 3] = numbers[12 * i + 9 + j];
      });
      gl.activeTexture(gl.TEXTURE1 + j);
      gl.bindTexture(gl.TEXTURE_2D, this.#answers[j]);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, this.grid, this.grid, gl.RGBA, gl.FLOAT, data);
    }
    gl.useProgram(this.composed);
    ["lobe", "specular", "drawn"].forEach((name, j) => gl.uniform1i(this.place(this.composed, name), 1 + j));
  }
}

// What the shader of the model knows; the rest is for the engine.
const isOfShader = (state: State): boolean =>
  state.model === "he" && state.correlation === "gaussian" && !isAnisotropic(state) && !hasFilm(state);

const pictureTolerance = 1e-3;
const milliseconds = 40; // of the engine at a time, so that the other views need not wait

export function litView() {
  const view = card("lit", "Under a lamp and a sky");
  const picture = canvas(size, size, "An object of this surface, lit by a lamp and a sky");
  picture.id = "lit-picture";
  view.body.append(picture);
  const gl = picture.getContext("webgl2", { preserveDrawingBuffer: true, antialias: false });
  if (!gl || !gl.getExtension("EXT_color_buffer_float")) {
    view.note.textContent = "This browser draws no floating-point pictures (WebGL 2), which this view needs.";
    return { section: view.section, update: async () => {}, pause: () => {} };
  }
  const stage = new Stage(gl);
  let running = 0;
  let weights: number[] | null = null;
  const shown = () => {
    stage.show();
    picture.dataset.passes = String(stage.passes);
    picture.dataset.grid = String(stage.grid);
  };

  type Pass = () => Promise<boolean>; // false: something newer is to be drawn

  const shaderPass: Pass = async () => {
    stage.add(stage.byShader);
    return true;
  };

  function enginePass(frame: Frame, setting: Setting, colours: number[], turn: number): Pass {
    let portion = 256;
    return async () => {
      const { pixels, numbers } = stage.ask();
      const all = new Float64Array(12 * pixels.length);
      for (let i = 0; i < pixels.length; ) {
        const begin = performance.now(), next = Math.min(i + portion, pixels.length);
        all.set(await frame.engine.picture(setting, colours, numbers.slice(9 * i, 9 * next)), 12 * i);
        if (turn !== running) return false;
        portion = Math.max(64, Math.round((portion * milliseconds) / Math.max(performance.now() - begin, 1)));
        i = next;
      }
      stage.answer(pixels, all);
      stage.add(stage.composed);
      return true;
    };
  }

  // More passes while nothing changes, for some seconds of drawing: few where no graphics processor helps.
  async function refine(turn: number, pass: Pass, seconds: number): Promise<void> {
    for (let spent = 0; turn === running && stage.passes < 96 && (spent < seconds || stage.passes < 2); ) {
      const begin = performance.now();
      if (!(await pass())) return;
      shown();
      const took = (performance.now() - begin) / 1000;
      spent += took;
      await new Promise((resolve) => setTimeout(resolve, 1000 * took));
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
  }

  // A first picture at once; of the engine in coarse pixels, then in finer ones where that takes less than a second.
  async function paint(turn: number, pass: Pass, byShader: boolean): Promise<void> {
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (calm) {
      stage.begin(byShader ? size : size / 2);
      while (stage.passes < (byShader ? 4 : 2)) if (!(await pass())) return;
      return shown();
    }
    stage.begin(byShader ? size : size / 4);
    if (!(await pass())) return;
    shown();
    // a file that is replaced meanwhile ends it: the views say what is wrong with that
    (byShader ? refine(turn, pass, 2) : refineOfEngine(turn, pass)).catch(() => {});
  }

  // The first pass made ready what the others use; by the time of the second the grid is chosen.
  async function refineOfEngine(turn: number, pass: Pass): Promise<void> {
    const begin = performance.now();
    if (!(await pass())) return;
    shown();
    const took = performance.now() - begin, longest = 1500;
    if (4 * took < longest) stage.begin(16 * took < longest ? size : size / 2);
    await refine(turn, pass, 6);
  }

  async function update(frame: Frame): Promise<void> {
    const { state, engine } = frame;
    const one = state.light === "one", byShader = isOfShader(state);
    const wavelengths = one ? [state.lambda] : shaderWavelengths;
    const setting = { ...settingOf(state, wavelengths), tolerance: pictureTolerance };
    const { n, k, rms_roughness_um } = await engine.describe(setting);
    if (!weights) {
      const units = new Float64Array(64);
      for (let i = 0; i < 8; ++i) units[9 * i] = 1;
      weights = Array.from(await engine.colour(shaderWavelengths, units));
    }
    const colours = one ? [1, 1, 1] : weights;
    const padded = (list: number[], length = 8) => Float32Array.from({ length }, (_, i) => list[i] ?? 0);
    const place = (name: string) => stage.place(stage.byShader, name);
    stage.lay(state);
    gl!.useProgram(stage.byShader);
    gl!.uniform1fv(place("wavelength"), padded(wavelengths));
    gl!.uniform1fv(place("n"), padded(n));
    gl!.uniform1fv(place("k"), padded(k));
    gl!.uniform3fv(place("weight"), padded(colours, 24));
    gl!.uniform1i(place("count"), wavelengths.length);
    gl!.uniform1f(place("sigma0"), rms_roughness_um);
    gl!.uniform1f(place("tau"), state.tau);
    gl!.uniform1f(place("albedo"), state.albedo);
    const turn = ++running;
    await paint(turn, byShader ? shaderPass : enginePass(frame, setting, colours, turn), byShader);
    const how = byShader ? "drawn by the shader of the model, to 10⁻³" : "computed by the engine pixel by pixel, to 10⁻³";
    view.note.textContent = `${one ? `At ${state.lambda} µm alone, in grey` : "Spectral, eight wavelengths"}, ${how}; the noise of the sky falls while nothing changes. ` +
      "The light is unpolarised, the lamp stands at the angle of incidence" + (isAnisotropic(state) ? ", and azimuth 0 of the surface lies level." : ".");
  }
  return { section: view.section, update, pause: () => void ++running };
}
