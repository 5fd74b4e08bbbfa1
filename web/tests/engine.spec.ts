// The engine's numbers: those of the command, and the shader's beside them.

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { drawn, expect, open, test } from "./page";

const command = process.env.HTS ?? new URL("../../build/release/bin/hts", import.meta.url).pathname;

// The same numbers in every run.
function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
const between = (u: number, from: number, to: number) => from * (to / from) ** u;

interface Row {
  lambda: number;
  sigma: number;
  tau: number;
  n: number;
  k: number;
  pairs: [number, number, number][];
}

function surfaces(count: number, pairs: number, seed: number): Row[] {
  const u = randomNumbers(seed);
  return Array.from({ length: count }, () => {
    const sigma = between(u(), 0.005, 3);
    const tau = sigma / between(u(), 0.01, 0.6);
    return {
      lambda: between(u(), 0.3, 10), sigma, tau, n: between(u(), 0.2, 6), k: u() < 0.3 ? 0 : between(u(), 0.01, 20),
      pairs: Array.from({ length: pairs }, (_, i): [number, number, number] => {
        const ti = 88 * u();
        // half of the views near the mirror direction
        return i % 2 ? [ti, 88 * u(), 360 * u()] : [ti, Math.min(Math.abs(ti + 8 * (u() - 0.5)), 88), 180 + 10 * (u() - 0.5)];
      }),
    };
  });
}

const materialOf = (row: Row) => ({
  model: "he", rms_roughness_um: row.sigma, correlation_length_um: row.tau, index: { n: row.n, k: row.k },
});

test("values of the page are the command's, to twice the stated bound, at 10000 points", async ({ page }) => {
  test.skip(!existsSync(command), `no command ${command} to compare with: ./run build makes it`);
  const rows = surfaces(100, 100, 7);
  const folder = mkdtempSync(join(tmpdir(), "hts-page-"));
  const lines = rows.flatMap((r) => r.pairs.map(([ti, tr, phi]) => [r.lambda, ti, 0, tr, phi, r.n, r.k, r.sigma, r.tau].join(",")));
  writeFileSync(join(folder, "points.csv"),
    ["wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,n,k,rms_roughness_um,correlation_length_um", ...lines, ""].join("\n"));
  execFileSync(command, ["eval", "--points", join(folder, "points.csv"), "--tolerance", "1e-12", "--output", join(folder, "values.csv")]);
  const [header, ...answer] = readFileSync(join(folder, "values.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  const column = (name: string) => answer.map((line) => Number(line[header.indexOf(name)]));
  const expected = { brdf: column("brdf"), specular: column("specular_reflectance") };

  await open(page);
  for (const of of ["brdf", "specular"] as const) {
    const settings = rows.map((row) => ({ setting: { material: materialOf(row), wavelengths: [row.lambda], tolerance: 1e-12 }, triples: row.pairs.flat() }));
    const values = await page.evaluate(async ([list, of]) => {
      const all: number[] = [];
      for (const { setting, triples } of list) all.push(...(await window.hts.engine.evaluate(setting, of, Float64Array.from(triples))));
      return all;
    }, [settings, of] as const);
    expect(values.length).toBe(expected[of].length);
    let worst = 0, compared = 0;
    values.forEach((v, i) => {
      const e = expected[of][i];
      if (e < 1e-280) return;
      ++compared;
      worst = Math.max(worst, Math.abs(v / e - 1));
    });
    console.log(`${of}: ${compared} values beside the command's, worst relative difference ${worst.toExponential(2)}`);
    expect(compared).toBeGreaterThan(9000);
    expect(worst).toBeLessThanOrEqual(8e-12);
  }
});

// Four numbers for each of size x size items, from four each of three inputs.
type Run = (text: string, size: number, data: Float32Array[]) => Promise<Float32Array>;

const inWebGl: Run = async (text, size, data) => {
  const gl = new OffscreenCanvas(size, size).getContext("webgl2")!;
  gl.getExtension("EXT_color_buffer_float");
  const program = gl.createProgram()!;
  const sources = [
    "#version 300 es\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }",
    `#version 300 es\nprecision highp float;\n${text}
     uniform sampler2D a, b, c; out vec4 result;
     void main() {
       ivec2 at = ivec2(gl_FragCoord.xy);
       vec4 i = texelFetch(a, at, 0), o = texelFetch(b, at, 0), m = texelFetch(c, at, 0);
       result = vec4(hts_he_brdf(i.xyz, o.xyz, i.w, o.w, m.x, m.y, m.z, 0.0));
     }`,
  ];
  sources.forEach((source, i) => {
    const shader = gl.createShader(i ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader)!);
    gl.attachShader(program, shader);
  });
  gl.linkProgram(program);
  gl.useProgram(program);
  const texture = (pixels: Float32Array | null) => {
    const made = gl.createTexture()!;
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, size, size, 0, gl.RGBA, gl.FLOAT, pixels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return made;
  };
  const target = texture(null);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  data.forEach((pixels, i) => {
    gl.activeTexture(gl.TEXTURE0 + i);
    texture(pixels);
    gl.uniform1i(gl.getUniformLocation(program, "abc"[i]), i);
  });
  gl.viewport(0, 0, size, size);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const read = new Float32Array(4 * size * size);
  gl.readPixels(0, 0, size, size, gl.RGBA, gl.FLOAT, read);
  return read;
};

const inWebGpu: Run = async (text, size, data) => {
  const gpu = (navigator as unknown as { gpu: any }).gpu;
  const device = await (await gpu.requestAdapter()).requestDevice();
  const module = device.createShaderModule({
    code: `${text}
      @group(0) @binding(0) var<storage, read> a : array<vec4<f32>>;
      @group(0) @binding(1) var<storage, read> b : array<vec4<f32>>;
      @group(0) @binding(2) var<storage, read> c : array<vec4<f32>>;
      @group(0) @binding(3) var<storage, read_write> result : array<vec4<f32>>;
      @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id : vec3<u32>) {
        if (id.x >= arrayLength(&a)) { return; }
        let i = a[id.x];
        let o = b[id.x];
        let m = c[id.x];
        result[id.x] = vec4<f32>(hts_he_brdf(i.xyz, o.xyz, i.w, o.w, m.x, m.y, m.z, 0.0));
      }`,
  });
  for (const message of (await module.getCompilationInfo()).messages) throw new Error(`${message.lineNum}: ${message.message}`);
  const pipeline = device.createComputePipeline({ layout: "auto", compute: { module, entryPoint: "main" } });
  const bytes = 16 * size * size, [storage, copyFrom, copyTo, mapRead] = [128, 4, 8, 1];
  const buffers = [...data, null].map((values) => {
    const buffer = device.createBuffer({ size: bytes, usage: storage | (values ? copyTo : copyFrom) });
    if (values) device.queue.writeBuffer(buffer, 0, values);
    return buffer;
  });
  const answer = device.createBuffer({ size: bytes, usage: copyTo | mapRead });
  const encoder = device.createCommandEncoder(), pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0), entries: buffers.map((buffer, binding) => ({ binding, resource: { buffer } })),
  }));
  pass.dispatchWorkgroups(Math.ceil((size * size) / 64));
  pass.end();
  encoder.copyBufferToBuffer(buffers[3], 0, answer, 0, bytes);
  device.queue.submit([encoder.finish()]);
  await answer.mapAsync(mapRead);
  return new Float32Array(answer.getMappedRange());
};

for (const [language, where, run] of [["glsl", "WebGL", inWebGl], ["wgsl", "WebGPU", inWebGpu]] as const)
  test(`the shader agrees with the model in ${where} at 10000 pairs`, async ({ page }) => {
    await open(page);
    const rows = surfaces(100, 100, 9), size = 100;
    const { text, data, expected, peaks } = await page.evaluate(async ([rows, language, size]) => {
      const engine = window.hts.engine;
      const text = await engine.shader(
        { material: { model: "he", rms_roughness_um: 0.28, correlation_length_um: 1.77, index: "Al" }, wavelengths: [0.4, 0.5, 0.6, 0.7] }, language);
      const data = [0, 1, 2].map(() => new Float32Array(4 * size * size));
      const expected: number[] = [], peaks: number[] = [];
      for (let s = 0; s < rows.length; ++s) {
        const row = rows[s];
        const single = [row.sigma, row.tau, row.n, row.k, row.lambda].map(Math.fround);
        const triples: number[] = [], mirrors: number[] = [];
        row.pairs.forEach(([ti, tr, phi], i) => {
          const vector = (theta: number, azimuth: number) =>
            [Math.sin(theta) * Math.cos(azimuth), Math.sin(theta) * Math.sin(azimuth), Math.cos(theta)].map(Math.fround);
          const rad = Math.PI / 180;
          const wi = vector(ti * rad, 0), wo = vector(tr * rad, phi * rad);
          const at = 4 * (s * size + i);
          data[0].set([...wi, single[4]], at);
          data[1].set([...wo, single[0]], at);
          data[2].set([single[1], single[2], single[3], 0], at);
          const angle = (v: number[]) => Math.atan2(Math.hypot(v[0], v[1]), v[2]) / rad;
          triples.push(angle(wi), angle(wo), Math.atan2(wo[1], wo[0]) / rad - Math.atan2(wi[1], wi[0]) / rad);
          mirrors.push(angle(wi), angle(wi), 180);
        });
        const setting = {
          material: { model: "he", rms_roughness_um: single[0], correlation_length_um: single[1], index: { n: single[2], k: single[3] } },
          wavelengths: [single[4]], tolerance: 1e-12,
        };
        expected.push(...(await engine.evaluate(setting, "brdf", Float64Array.from(triples))));
        peaks.push(...(await engine.evaluate(setting, "brdf", Float64Array.from(mirrors))));
      }
      return { text, data: data.map((values) => [...values]), expected, peaks };
    }, [rows, language, size] as const);
    const read = await page.evaluate(`(${run})(${JSON.stringify(text)}, ${size},
      ${JSON.stringify(data)}.map((values) => Float32Array.from(values))).then((read) => [...read])`) as number[];
    const errors = expected.flatMap((e, i) =>
      e > 1e-6 * Math.max(peaks[i], e) && e > 1e-25 ? [Math.abs(read[4 * i] / e - 1)] : []).sort((x, y) => x - y);
    const worst = errors[errors.length - 1], median = errors[errors.length >> 1];
    console.log(`${where}: ${errors.length} of 10000 pairs above 1e-6 of the peak, worst ${worst.toExponential(2)}, median ${median.toExponential(2)}`);
    expect(errors.length).toBeGreaterThan(5000);
    expect(worst).toBeLessThanOrEqual(1e-3);
  });

test("how long a frame takes", async ({ page }) => {
  await open(page);
  const times = await page.evaluate(async () => {
    const triples = new Float64Array(3 * 181);
    for (let i = 0; i < 181; ++i) triples.set([30, Math.abs(i - 90), i >= 90 ? 180 : 0], 3 * i);
    const wavelengths = Array.from({ length: 31 }, (_, i) => 0.4 + 0.01 * i);
    const all: Record<string, number> = {};
    for (const tolerance of [1e-3, 1e-6, 1e-12]) {
      const setting = { material: { model: "he", rms_roughness_um: 0.28, correlation_length_um: 1.77, index: "Al" }, wavelengths, tolerance };
      let best = Infinity;
      for (let i = 0; i < 12; ++i) {
        const begin = performance.now();
        const values = await window.hts.engine.evaluate(setting, "brdf", triples);
        if (values.length !== 181 * 31 || !(values[120 * 31] > 0)) throw new Error("values");
        best = Math.min(best, performance.now() - begin);
      }
      all[tolerance] = best;
    }
    return all;
  });
  console.log(`181 angles x 31 wavelengths, best of 12: ${Object.entries(times).map(([t, ms]) => `${ms.toFixed(2)} ms at ${t}`).join(", ")}`);
  await drawn(page);
});
