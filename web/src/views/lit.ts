// A sphere, a plate and the paper's cylinder under a small lamp and a sky, drawn by the shader that hts table export writes.

import model from "../../../tables/formats/glsl/he_torrance.glsl?raw";
import type { Setting } from "../client";
import { canvas, card } from "../dom";
import { settingOf, type Frame } from "../frame";
import { hasFilm, isAnisotropic } from "../material";
import { choices, type State } from "../state";

const size = 320;
export const shaderWavelengths = Array.from({ length: 8 }, (_, i) => 0.4 + (0.3 * i) / 7);

// What all programs of the object share: its shape, the lamp and the sky.
const world = `#version 300 es
precision highp float;
precision highp int;
uniform int shape, pass_index, grid;   // grid: pixels of a side
uniform vec3 lamp;                     // towards it
uniform sampler2D before;

const float PI = 3.14159265;
const float LAMP_COS = 0.9998;         // half angle 1.15 degrees
const float LAMP_SOLID_ANGLE = 6.2831853 * (1.0 - LAMP_COS);
const float LAMP = 0.8 * PI;           // irradiance facing it
const vec3 TO_VIEWER = vec3(0.0, 0.0, 1.0);

uint state;
float uniform01() {
    state = state * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    word = (word >> 22u) ^ word;
    return float(word >> 8u) / 16777216.0;
}

// Brightness of a sky that is lit from above, with a window behind the viewer; white.
float sky(vec3 d) {
    float s = mix(0.10, 0.55, smoothstep(-0.3, 0.9, d.y));
    vec3 w = normalize(vec3(-0.75, 0.55, 0.75));
    float a = max(abs(dot(d, normalize(vec3(0.707, 0.0, 0.707)))), abs(d.y - 0.45)) ;
    return s + (dot(d, w) > 0.0 && a < 0.32 ? 1.6 : 0.0);
}

// What a mirror shows of both.
float mirrored(vec3 normal) {
    vec3 d = reflect(-TO_VIEWER, normal);
    return sky(d) + (dot(d, lamp) > LAMP_COS ? LAMP / LAMP_SOLID_ANGLE : 0.0);
}

bool hit(vec2 p, out vec3 normal) {
    if (shape == 0) {
        float r2 = dot(p, p) / 0.81;
        if (r2 >= 1.0) return false;
        normal = vec3(p / 0.9, sqrt(1.0 - r2));
        return true;
    }
    if (shape == 1) {
        // a plate that lies before the viewer, tilted back
        if (abs(p.x) > 0.85 || abs(p.y) > 0.55) return false;
        normal = normalize(vec3(-0.35 * p.x, 0.55 - 0.35 * p.y, 1.0));
        return true;
    }
    if (abs(p.x) > 0.62 || abs(p.y) > 0.85) return false;
    float x = p.x / 0.62;
    normal = vec3(x, 0.0, sqrt(1.0 - x * x));
    return true;
}

// A point of the object in this pixel, and viewer and lamp in the frame of its surface, whose x lies level.
struct Spot {
    bool seen;
    vec3 wo, wl;
    mat3 frame;   // tangent, bitangent, normal
};
Spot spot() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    state = uint(pixel.x) * 1973u + uint(pixel.y) * 9277u + uint(pass_index) * 26699u + 1u;
    uniform01();
    vec2 p = (gl_FragCoord.xy + vec2(uniform01(), uniform01()) - 0.5) / (0.5 * float(grid)) - 1.0;
    Spot s;
    vec3 normal;
    s.seen = hit(p, normal);
    if (!s.seen) return s;
    vec3 tangent = normalize(abs(normal.y) < 0.9999 ? cross(vec3(0.0, 1.0, 0.0), normal) : vec3(1.0, 0.0, 0.0));
    s.frame = mat3(tangent, cross(normal, tangent), normal);
    s.wo = TO_VIEWER * s.frame;
    s.wl = lamp * s.frame;
    s.seen = s.wo.z > 0.0;
    return s;
}

// The mean of this pass and those before.
vec4 averaged(vec3 rgb, bool seen) {
    vec4 sum = seen ? vec4(max(rgb, vec3(0.0)), 1.0) : vec4(0.0);
    vec4 old = pass_index > 0 ? texelFetch(before, ivec2(gl_FragCoord.xy), 0) : vec4(0.0);
    return (old * float(pass_index) + sum) / float(pass_index + 1);
}
`;

// The model he of a Gaussian surface, wholly in the shader.
const byShader = `${world}
${model}
const int COUNT = 8;
uniform float wavelength[COUNT], n[COUNT], k[COUNT];
uniform vec3 weight[COUNT];
uniform float sigma0, tau, albedo;
uniform int count;
out vec4 colour;

vec3 brdf(vec3 wi, vec3 wo) {
    HtsPair pair = hts_pair(sigma0, tau, wi, wo);
    vec3 rgb = vec3(0.0);
    for (int w = 0; w < COUNT; ++w) {
        if (w >= count) break;
        rgb += weight[w] * (hts_pair_brdf(pair, wavelength[w], n[w], k[w]) + albedo / HTS_PI);
    }
    return rgb;
}

void main() {
    Spot s = spot();
    vec3 rgb = vec3(0.0);
    if (s.seen) {
        if (s.wl.z > 0.0) rgb += brdf(s.wl, s.wo) * s.wl.z * LAMP;
        for (int w = 0; w < COUNT; ++w) {
            if (w >= count) break;
            rgb += weight[w] * hts_he_specular(s.wo, wavelength[w], sigma0, tau, n[w], k[w]) * mirrored(s.frame[2]);
        }
        // the sky is drawn at one wavelength and evaluated at all
        int chosen = min(int(uniform01() * float(count)), count - 1);
        HtsDraw d = hts_he_sample(s.wo, vec3(uniform01(), uniform01(), uniform01()), wavelength[chosen], sigma0, tau,
                                  n[chosen], k[chosen], albedo);
        if (!d.specular && d.pdf > 0.0) {
            // one density for all wavelengths: the mean of those by which any of them would have drawn it
            float density = 0.0;
            for (int w = 0; w < COUNT; ++w) {
                if (w >= count) break;
                density += hts_he_pdf(s.wo, d.direction, wavelength[w], sigma0, tau, n[w], k[w], albedo) / float(count);
            }
            rgb += brdf(d.direction, s.wo) * d.direction.z / density * sky(s.frame * d.direction);
        }
    }
    colour = averaged(rgb, s.seen);
}
`;

// Every other surface is evaluated by the engine, pixel by pixel: what it must be told of each …
const spots = `${world}
layout(location = 0) out vec4 viewer;
layout(location = 1) out vec4 light;
layout(location = 2) out vec4 chance;
void main() {
    Spot s = spot();
    viewer = vec4(s.seen ? s.wo : vec3(0.0), s.seen ? 1.0 : 0.0);
    light = vec4(s.seen ? s.wl : vec3(0.0), 0.0);
    chance = vec4(uniform01(), uniform01(), uniform01(), 0.0);
}
`;
// … and what becomes of its answers. The fourth numbers are a direction drawn from the diffuse terms.
const composed = `${world}
uniform sampler2D lobe, specular, drawn;
out vec4 colour;
void main() {
    Spot s = spot();
    vec3 rgb = vec3(0.0);
    if (s.seen) {
        ivec2 at = ivec2(gl_FragCoord.xy);
        vec4 a = texelFetch(lobe, at, 0), b = texelFetch(specular, at, 0), c = texelFetch(drawn, at, 0);
        rgb = a.rgb * max(s.wl.z, 0.0) * LAMP + b.rgb * mirrored(s.frame[2]);
        if (c.a > 0.0) rgb += c.rgb * sky(s.frame * vec3(a.a, b.a, c.a));
    }
    colour = averaged(rgb, s.seen);
}
`;

const screen = `#version 300 es
precision highp float;
uniform sampler2D image;
uniform vec3 ground;
uniform int grid;
out vec4 colour;
void main() {
    vec4 c = texelFetch(image, ivec2(gl_FragCoord.xy) * grid / ${size}, 0);
    vec3 v = c.rgb;
    float y = dot(v, vec3(0.2126, 0.7152, 0.0722));
    v *= (1.0 + y / 16.0) / (1.0 + y);                       // Reinhard's curve, white at 4
    v = mix(12.92 * v, 1.055 * pow(max(v, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, v));
    colour = vec4(mix(ground, v, c.a), 1.0);
}
`;

const corners = `#version 300 es
in vec2 corner;
void main() { gl_Position = vec4(corner, 0.0, 1.0); }
`;

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
