// Surfaces beyond two numbers: correlations, bands, files of heights, and the lit object that shows them.

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { drawn, drop, expect, open, shown, test, value, type View } from "./page";

const command = process.env.HTS ?? new URL("../../build/release/bin/hts", import.meta.url).pathname;

// A K-correlation of B = 5 um and C = 3, 10 nm rms: A = sigma^2 B^2 (C - 2)/(2 pi).
const spectrum = (): string => {
  const rows = ["frequency_per_um,psd_um4"];
  for (let f = 0.002; f < 3; f *= 1.1) rows.push(`${f},${((1e-4 * 25) / (2 * Math.PI)) * (1 + (5 * f) ** 2) ** -1.5}`);
  return rows.join("\n") + "\n";
};
const correlationFunction = (): string => {
  const rows = ["distance_um,autocorrelation", "0,1"];
  for (let x = 0.01; x < 30; x *= 1.1) rows.push(`${x},${Math.exp(-x / 2)}`);
  return rows.join("\n") + "\n";
};

const rest: View[] = ["hemisphere", "lit", "scatter", "spectrum", "values", "energy", "take"];
const k = "correlation=k_correlation&sigma=0.08&ti=40&tr=50";
const two = "correlation=sum&sigma=0.1&tau=3&second=exponential&tau2=0.5&share=0.2&ti=40&tr=50";
const fractal = "correlation=fractal&sigma=0.08&c=2.4&ti=40&tr=50";
const unified = "model=he_unified&index=Ag&sigma=0.1&tau=0.8&ti=40&tr=50";
const numbers: [string, string, string, View[]][] = [
  ["b", "9", k, ["polar", ...rest]],
  ["c", "3.5", k, ["polar", ...rest]],
  ["across", "2", k, ["hemisphere", "lit", "values", "take"]],
  ["shortest", "0.6", k, ["polar", ...rest]],
  ["longest", "4", `${k}&shortest=0.6`, ["polar", ...rest]],
  ["nu", "2.5", "correlation=matern&ti=40&tr=50", ["polar", ...rest]],
  ["axis", "40", "across=0.8&ti=40&tr=50", ["hemisphere", "lit", "values", "take"]],
  ["thickness", "0.3", "film=SiO2&ti=40&tr=50", ["polar", ...rest]],
  ["tau", "5", two, ["polar", ...rest]],
  ["tau2", "1", two, ["polar", ...rest]],
  ["share", "0.4", two, ["polar", ...rest]],
  ["nu", "2.5", `${two}&first=matern`, ["polar", ...rest]],
  ["nu2", "2.5", two.replace("exponential", "matern"), ["polar", ...rest]],
  ["b2", "3", two.replace("exponential", "k_correlation"), ["polar", ...rest]],
  ["c2", "3.5", two.replace("exponential", "k_correlation"), ["polar", ...rest]],
  ["finest", "1", fractal, ["polar", ...rest]],
  ["coarsest", "30", fractal, ["polar", ...rest]],
];

test("each number of a correlation changes each view that depends on it", async ({ page }) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: "reduce" });
  for (const [id, text, address, views] of numbers) {
    await open(page, address);
    const before = await shown(page);
    await page.locator(`#${id}`).fill(text);
    await page.locator(`#${id}`).press("Enter");
    await drawn(page);
    await expect(page.locator("#problem")).toBeEmpty();
    const after = await shown(page);
    for (const view of views) expect(after[view], `${view} after ${id}`).not.toBe(before[view]);
  }
});

const selections: [string, string | boolean, string, View[]][] = [
  ["psd", "1d one-sided", k, ["polar", ...rest]],
  ["first", "exponential", two, ["polar", ...rest]],
  ["second", "matern", two, ["polar", ...rest]],
  ["psd2", "1d one-sided", two.replace("exponential", "k_correlation"), ["polar", ...rest]],
  ["mirror", "second_order", unified, ["values", "energy", "take"]],
  ["mixing", true, `${unified}&in=s`, ["polar", "hemisphere", "scatter", "spectrum", "mueller", "take"]],
  ["shortcut", true, unified, ["polar", ...rest]],
];
test("each choice of a correlation and of the successor changes each view that depends on it", async ({ page }) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: "reduce" });
  for (const [id, option, address, views] of selections) {
    await open(page, address);
    const before = await shown(page);
    if (typeof option === "string") await page.locator(`#${id}`).selectOption(option);
    else await page.locator(`#${id}`).check();
    await drawn(page);
    await expect(page.locator("#problem")).toBeEmpty();
    const after = await shown(page);
    for (const view of views) expect(after[view], `${view} after ${id}`).not.toBe(before[view]);
    expect(page.url()).toContain(`${id}=${String(option).replace(" ", "+")}`);
  }
});

test("controls that mean nothing are not shown", async ({ page }) => {
  test.slow();
  for (const [address, shownOnes, hidden] of [
    ["", ["tau", "across"], ["mirror", "mixing", "shortcut", "first", "second", "share", "tau2", "finest", "b", "nu"]],
    ["beside=he_unified", ["mirror", "mixing", "shortcut"], []],
    ["model=he_unified", ["mirror", "mixing", "shortcut"], ["first"]],
    ["model=he_unified&correlation=exponential", ["shortcut", "tau"], ["mirror", "mixing"]],
    ["model=he_unified&film=SiO2", [], ["mirror", "mixing", "shortcut"]],
    ["correlation=sum&first=k_correlation&second=matern", ["first", "second", "share", "b", "c", "psd", "tau2", "nu2"], ["tau", "nu", "b2", "c2", "psd2", "across", "axis"]],
    ["correlation=fractal", ["finest", "coarsest", "c", "psd"], ["tau", "across", "b", "share"]],
  ] as [string, string[], string[]][]) {
    await open(page, address);
    for (const id of shownOnes) await expect(page.locator(`#${id}`), `${id} of ${address}`).toBeVisible();
    for (const id of hidden) await expect(page.locator(`#${id}`), `${id} of ${address}`).toBeHidden();
  }
  // what one cannot have is said until it is no longer asked for
  await open(page, "model=he_unified&index=BK7");
  await page.locator("#shortcut").check();
  await expect(page.locator("#problem")).toContainText("conductor_shortcut at 0.5 um");
  await page.locator("#shortcut").uncheck();
  await expect(page.locator("#problem")).toBeEmpty();
});

// What the command prints for the material file and the command line of the page.
function printed(text: string, files: Record<string, string>): (key: string) => number {
  const folder = mkdtempSync(join(tmpdir(), "hts-page-"));
  for (const [name, content] of Object.entries(files)) writeFileSync(join(folder, name), content);
  const lines = execFileSync("bash", ["-e", "-c", text.replace("hts eval", `${command} eval --mueller`)], { cwd: folder, encoding: "utf8" })
    .trim().split("\n").map((line) => line.split(","));
  return (key) => Number(lines[1][lines[0].indexOf(key)]);
}

// Bounds: twice that of the model; correlations are made by the same steps here and there.
const table = 1e-12;
const kinds: [string, string, string, number][] = [
  ["two numbers", "sigma=0.12&tau=1.2&index=Au&lambda=0.6&ti=50&tr=47&phi=175&tolerance=1e-12", "", 8e-12],
  ["two lengths", "sigma=0.15&tau=8&across=1&axis=60&index=Fe&ti=20&tr=40&phi=150&tolerance=1e-12", "", 8e-12],
  ["a film, by the successor", "model=he_unified&sigma=0.05&tau=1&film=SiO2&thickness=0.3&tr=40&tolerance=1e-12", "", 8e-12],
  ["a K-correlation in a band", "model=he_unified&sigma=0.003&correlation=k_correlation&b=5.02655&c=3&shortest=0.6328&tr=40", "", table],
  ["a profile's K-correlation of two lengths", "sigma=0.05&correlation=k_correlation&c=2.5&psd=1d+one-sided&across=2&axis=30&shortest=0.5&longest=80&tr=40", "", table],
  ["a power spectrum", "ti=20&tr=35", "spectrum.csv", table],
  ["a sum of two scales", "model=he_unified&sigma=0.12&correlation=sum&tau=8&second=exponential&tau2=0.7&share=0.15&tr=45", "", table],
  ["a sum of K-correlation and Matérn", "sigma=0.05&correlation=sum&first=k_correlation&b=9&c=3&second=matern&tau2=0.4&nu2=2&share=0.3&tr=45&phi=170", "", table],
  ["a fractal", "sigma=0.05&correlation=fractal&c=2.4&finest=0.4&coarsest=60&tr=40", "", table],
  ["the second-order mirror and mixing", `${unified}&mirror=second_order&mixing=true&tolerance=1e-12`, "", 8e-12],
  ["the shortcut of metals", `${unified}&shortcut=true&phi=160&tolerance=1e-12`, "", 8e-12],
  ["a correlation function", "sigma=0.02&ti=20&tr=35&model=he_unified", "acf.csv", table],
];
const tables: Record<string, string> = { "spectrum.csv": spectrum(), "acf.csv": correlationFunction() };

test("what the page shows is what the command prints, of each kind of surface", async ({ page }) => {
  test.skip(!existsSync(command), `no command ${command} to compare with: ./run build makes it`);
  test.slow();
  for (const [kind, address, file, bound] of kinds) {
    await open(page, address);
    if (file) {
      await drop(page, file, tables[file]);
      await expect(page.locator("#status")).toContainText(file);
      await drawn(page);
      await expect(page.locator("#take-note")).toContainText(file);
    }
    await expect(page.locator("#problem")).toBeEmpty();
    const of = printed((await page.locator("#command").textContent())!, file ? { [file]: tables[file] } : {});
    let worst = 0;
    for (const key of ["brdf", "directional_diffuse", "uniform_diffuse", "specular_reflectance"]) {
      const expected = of(key), seen = await value(page, key);
      worst = Math.max(worst, expected > 0 ? Math.abs(seen / expected - 1) : seen);
    }
    const matrix = (await page.locator("#mueller-maps").getAttribute("data-here"))!.split(" ").map(Number);
    matrix.forEach((seen, i) => (worst = Math.max(worst, Math.abs(seen - of(`m${Math.floor(i / 4)}${i % 4}`)) / matrix[0])));
    console.log(`${kind}: worst relative difference from the command ${worst.toExponential(2)}`);
    expect(worst, kind).toBeLessThanOrEqual(bound);
  }
});

test("an address restores a correlation, and asks for the file that it cannot hold", async ({ page, context }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  await open(page);
  await page.locator("#preset").selectOption({ label: "Polished optic: K-correlation, 3 nm from 633 nm on" });
  await drawn(page);
  await expect(page.locator('[data-key="rms_roughness_um"]')).toContainText("0.003"); // 0.0032, of all frequencies
  expect(await value(page, "rms_roughness_um")).toBeGreaterThan(0.003);
  const before = await shown(page);
  const other = await context.newPage();
  await other.emulateMedia({ reducedMotion: "reduce" });
  await other.goto(page.url());
  await drawn(other);
  expect(await shown(other)).toEqual(before);

  await drop(page, "spectrum.csv", spectrum());
  await expect(page.locator("#status")).toContainText("power spectrum");
  await drawn(page);
  await expect(page.locator("#sigma-field")).toBeHidden();
  await open(other, page.url().split("#")[1]);
  await expect(other.locator("#problem")).toContainText("spectrum.csv: is not here; drop the file onto the page");
});

test("a material file comes back as it was taken away", async ({ page }) => {
  for (const [name, address] of Object.entries({
    "one.json": `${k}&across=2&axis=30&shortest=0.5&longest=80`,
    "two.json": "model=he_unified&correlation=matern&nu=2&film=SiO2&thickness=0.2&index=nk&n=1.4&k=0.1&albedo=0.2",
    "three.json": `${two}&first=matern&nu=2&shortest=0.5`,
    "four.json": "correlation=sum&first=k_correlation&b=7&c=3&psd=1d+one-sided&second=k_correlation&b2=2&c2=2.2&psd2=1d+one-sided&share=0.7",
    "five.json": `${unified}&mirror=second_order&mixing=true&shortcut=true`,
    "six.json": `${fractal}&finest=0.3&coarsest=70&psd=1d+one-sided`,
  })) {
    await open(page, address);
    await expect(page.locator("#problem"), name).toBeEmpty();
    const state = await page.evaluate(() => window.hts.state());
    const material = (await page.locator("#command").textContent())!.match(/<<'END'\n([^]*?)END\n/)![1];
    await open(page, "index=Cu&sigma=0.3"); // something else
    await drop(page, name, material);
    await expect(page.locator("#status")).toContainText(name);
    await drawn(page);
    const back = await page.evaluate(() => window.hts.state());
    for (const [key, wanted] of new URLSearchParams(address))
      if (!["ti", "tr"].includes(key)) expect(String(back[key]), `${key} of ${name}`).toBe(wanted);
    for (const key of ["model", "sigma", "correlation", "across", "axis", "shortest", "longest", "film", "albedo", "index", "mirror", "mixing", "shortcut"])
      expect(back[key], `${key} of ${name}`).toBe(state[key]);
    expect((await page.locator("#command").textContent())!, name).toContain(material);
  }
});

test("bad files of heights are refused, and lose nothing", async ({ page }) => {
  await open(page);
  await drop(page, "spectrum.csv", spectrum());
  await expect(page.locator("#status")).toContainText("power spectrum");
  await drawn(page);
  const state = await page.evaluate(() => window.hts.state()), brdf = await value(page, "brdf");
  for (const [name, text, message] of [
    ["spectrum.csv", "frequency_per_um,psd_um4\n0.1,1\n0.05,2\n", "spectrum.csv:3"],
    ["profile.csv", "frequency_per_um,psd_um3\n0.1,-1\n", "profile.csv:2"],
    ["acf.csv", "distance_um,autocorrelation\n0,0.5\n1,0.1\n", "must be 1 at the distance 0"],
    ["sum.json", JSON.stringify({ model: "he", rms_roughness_um: 0.1, correlation: { type: "sum", of: [] }, index: "Al" }), 'sum.json: key "correlation.of"'],
    ["three.json", JSON.stringify({ model: "he", rms_roughness_um: 0.1, correlation: { type: "sum", of: [1, 2, 3].map((um) => [1, { type: "gaussian", length_um: um }]) }, index: "Al" }),
      'three.json: key "correlation": a sum of 3 has no control here'],
    ["power.json", JSON.stringify({ model: "he", correlation: { type: "psd", file: "away.csv" }, index: "Al" }), "away.csv: is not here"],
  ]) {
    await drop(page, name, text);
    await expect(page.locator("#problem"), name).toContainText(message);
  }
  // the name is still that of the good file
  await page.locator("#ti").fill("31");
  await page.locator("#ti").press("Enter");
  await drawn(page);
  await page.locator("#ti").fill("30");
  await page.locator("#ti").press("Enter");
  await drawn(page);
  expect(await page.evaluate(() => window.hts.state())).toEqual(state);
  expect(await value(page, "brdf")).toBe(brdf);
});

test("the successor is judged by its own distance from exact scattering, as hts info says", async ({ page }) => {
  test.skip(!existsSync(command), `no command ${command} to compare with: ./run build makes it`);
  for (const [model, sigma] of [["he", 0.28], ["he_unified", 0.28], ["he_unified", 0.02]] as const) {
    await open(page, `model=${model}&sigma=${sigma}`);
    const folder = mkdtempSync(join(tmpdir(), "hts-page-"));
    const material = (await page.locator("#command").textContent())!.match(/<<'END'\n([^]*?)END\n/)![1];
    writeFileSync(join(folder, "m.json"), material);
    const info = JSON.parse(execFileSync(command, ["info", join(folder, "m.json"), "--wavelengths", "0.5", "--theta", "30", "--json"], { encoding: "utf8" }));
    const expected = info.expected_distance_db.by_angle[0];
    await expect(page.locator("#verdict")).toHaveAttribute("data-severity", info.validity);
    if (!expected.studied) {
      // said once, by the verdict of the successor or beside the criteria of the published model
      const said = (await page.locator("#validity").textContent())!.match(/Nothing like (it|this surface) was solved exactly/g);
      expect(said).toHaveLength(1);
      continue;
    }
    for (const of of ["he", "he_unified"])
      for (const light of ["te", "tm", "unpolarised"]) {
        const shownValue = await value(page, `${of}_${light}`);
        expect(Math.abs(shownValue / expected[of][light] - 1), `${of} ${light}`).toBeLessThan(1e-9);
      }
  }
});

test("what the engine tells the lit object of a pixel is the model's", async ({ page }) => {
  await open(page);
  const { worst, mean, albedo } = await page.evaluate(async () => {
    const engine = window.hts.engine, rad = Math.PI / 180;
    const vector = (theta: number, phi: number) => [Math.sin(theta * rad) * Math.cos(phi * rad), Math.sin(theta * rad) * Math.sin(phi * rad), Math.cos(theta * rad)];
    const material = { model: "he_unified", rms_roughness_um: 0.1, correlation_length_um: [1, 3], azimuth_deg: 20, index: "Cu", diffuse_albedo: 0.1 };
    const setting = { material, wavelengths: [0.45, 0.55, 0.65], tolerance: 1e-6 };
    const weights = [1, 0, 0, 0, 1, 0, 0, 0, 1]; // a colour is a wavelength
    const pixels: number[] = [], triples: number[] = [];
    for (let i = 0; i < 40; ++i) {
      const ti = 2 * i, tr = (13 * i) % 80, phi = (37 * i) % 360;
      pixels.push(...vector(tr, phi), ...vector(ti, 0), 0.5, 0.5, 0.5);
      triples.push(ti, tr, phi);
    }
    const seen = await engine.picture(setting, weights, Float64Array.from(pixels));
    const expected = await engine.evaluate(setting, "brdf", Float64Array.from(triples));
    let worst = 0;
    for (let i = 0; i < 40; ++i)
      for (let c = 0; c < 3; ++c) worst = Math.max(worst, Math.abs(seen[12 * i + c] / expected[3 * i + c] - 1));
    // f cos/pdf of directions drawn from the sky: its mean is the albedo of the diffuse terms
    const count = 30000, rows = new Float64Array(9 * count), view = vector(30, 0);
    for (let i = 0; i < count; ++i) rows.set([...view, 0, 0, -1, (i + 0.5) / count, (i * 0.7548776662466927) % 1, (i * 0.5698402909980532) % 1], 9 * i);
    const drawn = await engine.picture(setting, weights, rows);
    let mean = 0;
    for (let i = 0; i < count; ++i) mean += drawn[12 * i + 7] / count;
    const energy = await engine.energy({ ...setting, wavelengths: [0.55] }, 30);
    return { worst, mean, albedo: energy.directional_diffuse + energy.uniform_diffuse };
  });
  console.log(`pixels of the engine: BRDF within ${worst.toExponential(2)}, albedo by drawing ${mean.toFixed(4)}, by integration ${albedo.toFixed(4)}`);
  expect(worst).toBeLessThan(1e-9);
  expect(Math.abs(mean / albedo - 1)).toBeLessThan(0.01);
});

test("the engine draws the lit object as the shader of the model does", async ({ page }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  // two lengths that differ by 1e-6 are a surface that the shader does not know, and nearly the same one
  const pictures: number[][] = [];
  for (const across of [0, 1.770002]) {
    await open(page, `across=${across}&index=Cu&sigma=0.2`);
    await expect(page.locator("#lit-note")).toContainText(across ? "by the engine" : "by the shader");
    pictures.push(await page.evaluate(() => {
      const from = document.getElementById("lit-picture") as HTMLCanvasElement, cells = 16;
      const side = from.width / cells, read = new OffscreenCanvas(from.width, from.height).getContext("2d")!;
      read.drawImage(from, 0, 0);
      const data = read.getImageData(0, 0, from.width, from.height).data;
      const means = new Array(3 * cells * cells).fill(0);
      for (let y = 0; y < from.height; ++y)
        for (let x = 0; x < from.width; ++x)
          for (let c = 0; c < 3; ++c) means[3 * (Math.floor(y / side) * cells + Math.floor(x / side)) + c] += data[4 * (y * from.width + x) + c] / side ** 2;
      return means;
    }));
  }
  const [byShader, byEngine] = pictures;
  const apart = byShader.map((v, i) => Math.abs(v - byEngine[i]));
  const worst = Math.max(...apart), mean = apart.reduce((a, b) => a + b) / apart.length;
  console.log(`lit object by engine and by shader, cells of 20 pixels, of 255: mean ${mean.toFixed(2)}, worst ${worst.toFixed(2)}`);
  expect(Math.max(...byShader)).toBeGreaterThan(150); // there is a highlight
  expect(mean).toBeLessThan(2);
  expect(worst).toBeLessThan(12);
});
