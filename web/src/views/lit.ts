// A sphere, a plate and the paper's cylinder under a small lamp and a sky, drawn by the shader that hts table export writes.

import model from "../../../tables/formats/glsl/he_torrance.glsl?raw";
import { canvas, card } from "../dom";
import { hasFilm, isAnisotropic } from "../material";
import { settingOf, type Frame } from "../frame";

const size = 320;
export const shaderWavelengths = Array.from({ length: 8 }, (_, i) => 0.4 + (0.3 * i) / 7);

const scene = `#version 300 es
precision highp float;
precision highp int;
${model}
const int COUNT = 8;
uniform float wavelength[COUNT], n[COUNT], k[COUNT];
uniform vec3 weight[COUNT];
uniform float sigma0, tau, albedo, exposure;
uniform int shape, count, pass_index;
uniform vec3 lamp;      // towards it
uniform sampler2D before;
out vec4 colour;

const float LAMP_COS = 0.9998;                 // half angle 1.15 degrees
const float LAMP_SOLID_ANGLE = 6.2831853 * (1.0 - LAMP_COS);

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

bool hit(vec2 p, out vec3 normal, out vec3 along) {
    along = vec3(1.0, 0.0, 0.0);
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

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    state = uint(pixel.x) * 1973u + uint(pixel.y) * 9277u + uint(pass_index) * 26699u + 1u;
    uniform01();
    vec2 p = (gl_FragCoord.xy + vec2(uniform01(), uniform01()) - 0.5) / ${size / 2}.0 - 1.0;
    vec3 normal, x;
    vec4 sum = vec4(0.0);
    if (hit(p, normal, x)) {
        vec3 tangent = normalize(abs(normal.y) < 0.9 ? cross(vec3(0.0, 1.0, 0.0), normal) : cross(normal, vec3(1.0, 0.0, 0.0)));
        vec3 bitangent = cross(normal, tangent);
        vec3 view = vec3(0.0, 0.0, 1.0);
        vec3 wo = vec3(dot(view, tangent), dot(view, bitangent), dot(view, normal));
        vec3 wl = vec3(dot(lamp, tangent), dot(lamp, bitangent), dot(lamp, normal));
        vec3 rgb = vec3(0.0);
        if (wl.z > 0.0 && wo.z > 0.0) {
            HtsPair pair = hts_pair(sigma0, tau, wl, wo);
            for (int w = 0; w < COUNT; ++w) {
                if (w >= count) break;
                float f = hts_pair_brdf(pair, wavelength[w], n[w], k[w]) + albedo / HTS_PI;
                rgb += weight[w] * f * wl.z * HTS_PI * 0.8;
            }
        }
        // the sky: the mirror direction as it is, the rest drawn at one wavelength and evaluated at all
        vec3 mirrored = reflect(-view, normal);
        float lamp_seen = dot(mirrored, lamp) > LAMP_COS ? 0.8 * HTS_PI / LAMP_SOLID_ANGLE : 0.0;
        float light = sky(mirrored) + lamp_seen;
        int chosen = min(int(uniform01() * float(count)), count - 1);
        HtsDraw d = hts_he_sample(wo, vec3(uniform01(), uniform01(), uniform01()), wavelength[chosen], sigma0, tau,
                                  n[chosen], k[chosen], albedo);
        for (int w = 0; w < COUNT; ++w) {
            if (w >= count) break;
            rgb += weight[w] * hts_he_specular(wo, wavelength[w], sigma0, tau, n[w], k[w]) * light;
        }
        if (!d.specular && d.pdf > 0.0) {
            // one density for all wavelengths: the mean of those by which any of them would have drawn it
            float density = 0.0;
            for (int w = 0; w < COUNT; ++w) {
                if (w >= count) break;
                density += hts_he_pdf(wo, d.direction, wavelength[w], sigma0, tau, n[w], k[w], albedo) / float(count);
            }
            vec3 world = d.direction.x * tangent + d.direction.y * bitangent + d.direction.z * normal;
            HtsPair pair = hts_pair(sigma0, tau, wo, d.direction);
            for (int w = 0; w < COUNT; ++w) {
                if (w >= count) break;
                float f = hts_pair_brdf(pair, wavelength[w], n[w], k[w]) + albedo / HTS_PI;
                rgb += weight[w] * f * d.direction.z / density * sky(world);
            }
        }
        sum = vec4(max(rgb, vec3(0.0)), 1.0);
    }
    vec4 old = pass_index > 0 ? texelFetch(before, pixel, 0) : vec4(0.0);
    colour = (old * float(pass_index) + sum) / float(pass_index + 1);
}
`;

const screen = `#version 300 es
precision highp float;
uniform sampler2D image;
uniform vec3 ground;
out vec4 colour;
void main() {
    vec4 c = texelFetch(image, ivec2(gl_FragCoord.xy), 0);
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

function targetOf(gl: WebGL2RenderingContext): { texture: WebGLTexture; buffer: WebGLFramebuffer } {
  const texture = gl.createTexture()!;
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, size, size, 0, gl.RGBA, gl.FLOAT, null);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  const buffer = gl.createFramebuffer()!;
  gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  return { texture, buffer };
}

export function litView() {
  const view = card("lit", "Under a lamp and a sky");
  const picture = canvas(size, size, "An object of this surface, lit by a lamp and a sky");
  picture.id = "lit-picture";
  view.body.append(picture);
  const gl = picture.getContext("webgl2", { preserveDrawingBuffer: true, antialias: false });
  if (!gl || !gl.getExtension("EXT_color_buffer_float")) {
    view.note.textContent = "This browser draws no floating-point pictures (WebGL 2), which this view needs.";
    return { section: view.section, update: async () => {} };
  }
  const [draw, show] = [compiled(gl, scene), compiled(gl, screen)];
  const targets = [targetOf(gl), targetOf(gl)];
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  gl.viewport(0, 0, size, size);
  const place = (name: string) => gl.getUniformLocation(draw, name);
  let passes = 0, running = 0;
  let weights: Float64Array | null = null;

  function pass(): void {
    const [from, to] = [targets[passes % 2], targets[(passes + 1) % 2]];
    gl!.useProgram(draw);
    gl!.bindFramebuffer(gl!.FRAMEBUFFER, to.buffer);
    gl!.bindTexture(gl!.TEXTURE_2D, from.texture);
    gl!.uniform1i(place("pass_index"), passes);
    gl!.drawArrays(gl!.TRIANGLES, 0, 3);
    gl!.useProgram(show);
    gl!.bindFramebuffer(gl!.FRAMEBUFFER, null);
    gl!.bindTexture(gl!.TEXTURE_2D, to.texture);
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    gl!.uniform3fv(gl!.getUniformLocation(show, "ground"), dark ? [0.1, 0.11, 0.13] : [0.93, 0.94, 0.95]);
    gl!.drawArrays(gl!.TRIANGLES, 0, 3);
    picture.dataset.passes = String(++passes);
  }
  // More samples while nothing changes, for some two seconds of drawing: few where no graphics processor helps.
  function refine(turn: number, spent: number): void {
    if (turn !== running || passes >= 96 || (spent > 2000 && passes >= 2)) return;
    const begin = performance.now();
    pass();
    gl!.readPixels(0, 0, 1, 1, gl!.RGBA, gl!.UNSIGNED_BYTE, new Uint8Array(4)); // waits until it is drawn
    const took = performance.now() - begin;
    setTimeout(() => requestAnimationFrame(() => refine(turn, spent + took)), Math.max(0, 2 * took - 16));
  }

  async function update(frame: Frame): Promise<void> {
    const { state, engine } = frame;
    const one = state.light === "one";
    const wavelengths = one ? [state.lambda] : shaderWavelengths;
    const { n, k } = await engine.describe(settingOf({ ...state, film: "none", correlation: "gaussian" }, wavelengths));
    if (!weights) {
      const units = new Float64Array(64);
      for (let i = 0; i < 8; ++i) units[9 * i] = 1;
      weights = await engine.colour(shaderWavelengths, units);
    }
    gl!.useProgram(draw);
    const padded = (list: number[]) => Float32Array.from({ length: 8 }, (_, i) => list[i] ?? 0);
    gl!.uniform1fv(place("wavelength"), padded(wavelengths));
    gl!.uniform1fv(place("n"), padded(n));
    gl!.uniform1fv(place("k"), padded(k));
    gl!.uniform3fv(place("weight"), one ? new Float32Array(24).fill(1) : Float32Array.from(weights));
    gl!.uniform1i(place("count"), wavelengths.length);
    gl!.uniform1f(place("sigma0"), state.sigma);
    gl!.uniform1f(place("tau"), state.tau);
    gl!.uniform1f(place("albedo"), state.albedo);
    gl!.uniform1i(place("shape"), ["sphere", "plate", "cylinder"].indexOf(state.shape));
    const a = (-state.ti * Math.PI) / 180;
    gl!.uniform3fv(place("lamp"), [Math.sin(a) * 0.96, 0.28, Math.cos(a) * 0.96].map((v) => v / Math.hypot(0.96, 0.28)));
    passes = 0;
    refine(++running, 0);
    const more = [state.model === "he" ? "" : state.model, isAnisotropic(state) ? "two correlation lengths" : "", hasFilm(state) ? "films" : "", state.correlation === "gaussian" ? "" : "this correlation"].filter(Boolean);
    const model = more.length ? ` The shader does not know ${more.join(" and ")}: it shows the model he with σ₀ and τ alone.` : "";
    view.note.textContent = (one ? `At ${state.lambda} µm alone, in grey.` : "Spectral, eight wavelengths; the lamp stands at the angle of incidence.") + model;
  }
  return { section: view.section, update };
}
