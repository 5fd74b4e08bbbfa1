// The page under a reader's hands.

import AxeBuilder from "@axe-core/playwright";
import { statSync } from "node:fs";
import { drawn, drop, expect, open, shown, test, value, type View } from "./page";

const built = new URL("../../build/page/", import.meta.url);

const surface: View[] = ["polar", "hemisphere", "lit", "scatter", "spectrum", "values", "validity", "energy", "mueller", "phi", "take"];
const cases: [string, string, View[]][] = [
  ["sigma", "0.1", surface],
  ["tau", "3", surface],
  ["ti", "55", surface],
  ["lambda", "0.7", ["polar", "hemisphere", "scatter", "values", "validity", "energy", "mueller", "phi", "take"]],
  ["tr", "20", ["hemisphere", "spectrum", "values", "validity", "phi", "take"]],
  ["phi", "120", ["hemisphere", "spectrum", "values", "phi", "take"]],
  // in the plane of x the shape of the lobe knows the length along x alone
  ["across", "0.5", ["hemisphere", "lit", "scatter", "spectrum", "values", "energy", "mueller", "take"]],
  ["albedo", "0.4", ["polar", "hemisphere", "lit", "scatter", "spectrum", "values", "energy", "take"]],
];

test("each number changes each view that depends on it", async ({ page }) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: "reduce" }); // the lit object is then the same picture each time
  for (const [id, text, views] of cases) {
    await open(page, `tr=50&phi=170&across=${id === "across" ? 2 : 0}`);
    const before = await shown(page);
    await page.locator(`#${id}`).fill(text);
    await page.locator(`#${id}`).press("Enter");
    await drawn(page);
    const after = await shown(page);
    for (const view of views) expect(after[view], `${view} after ${id}`).not.toBe(before[view]);
  }
});

const selections: [string, string, View[]][] = [
  ["index", "Cu", ["polar", "lit", "spectrum", "values", "energy", "take"]],
  ["index", "nk", ["polar", "lit", "spectrum", "values", "energy", "mueller", "take"]],
  ["correlation", "exponential", ["polar", "hemisphere", "lit", "scatter", "spectrum", "values", "energy", "take"]],
  ["film", "SiO2", ["polar", "hemisphere", "lit", "scatter", "spectrum", "values", "energy", "take"]],
  ["in", "s", ["polar", "hemisphere", "scatter", "spectrum"]],
  ["out", "p", ["polar", "hemisphere", "scatter", "spectrum"]],
  ["model", "he_unified", ["polar", "hemisphere", "lit", "scatter", "spectrum", "values", "validity", "energy", "take"]],
  ["radius", "log", ["polar"]],
  ["shape", "cylinder", ["lit"]],
  ["light", "one", ["lit"]],
  ["tolerance", "1e-12", ["take"]],
];
test("each choice changes each view that depends on it", async ({ page }) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: "reduce" });
  for (const [id, option, views] of selections) {
    await open(page, "ti=60&tr=50");
    const before = await shown(page);
    await page.locator(`#${id}`).selectOption(option);
    await drawn(page);
    const after = await shown(page);
    for (const view of views) expect(after[view], `${view} after ${id} ${option}`).not.toBe(before[view]);
  }
});

test("models beside are drawn, with the width that fits best", async ({ page }) => {
  await open(page);
  for (const beside of ["ggx", "beckmann", "phong", "ward", "ward_duer", "cook_torrance", "kurt", "blinn_phong", "ashikhmin_shirley", "ashikhmin"]) {
    await page.locator("#beside").selectOption(beside);
    await drawn(page);
    await expect(page.locator("#polar-beside")).toHaveCount(1);
    await expect(page.locator("#beside-key")).toContainText(/best (width|exponent)/);
  }
  // the geometric limit of the model is Beckmann's lobe of width 2 sigma0/tau
  await open(page, "sigma=5&tau=40&index=nk&n=1.5&k=0&ti=20&tr=20&beside=beckmann");
  const width = Number((await page.locator("#beside-key").textContent())!.match(/best width ([\d.]+)/)![1]);
  expect(width).toBeGreaterThan(0.245);
  expect(width).toBeLessThan(0.255);
});

test("an address restores what was shown, and names what it cannot", async ({ page, context }) => {
  await open(page);
  await page.locator("#preset").selectOption({ label: "Copper at grazing incidence" });
  await drawn(page);
  await page.locator("#out").selectOption("plus");
  await drawn(page);
  const before = await shown(page);
  const address = page.url();
  expect(address).toContain("index=Cu");
  const other = await context.newPage();
  await other.goto(address);
  await drawn(other);
  const after = await shown(other);
  for (const view of ["polar", "hemisphere", "scatter", "spectrum", "values", "energy", "mueller", "take"] as View[])
    expect(after[view], view).toBe(before[view]);
  await open(other, "sigma=-1&colour=blue&model=phong");
  for (const part of ["sigma -1: must be from 0 to 100", "colour: not known", "model phong: must be one of he, he_unified"])
    await expect(other.locator("#problem")).toContainText(part);
});

test("the arrow is dragged, and moved by keys", async ({ page }) => {
  await open(page);
  const grip = (await page.locator("#arrow .grip").boundingBox())!;
  const picture = (await page.locator("#polar-picture").boundingBox())!;
  await page.mouse.move(grip.x + grip.width / 2, grip.y + grip.height / 2);
  await page.mouse.down();
  await page.mouse.move(picture.x + picture.width * 0.16, picture.y + picture.height * 0.55, { steps: 5 });
  await page.mouse.up();
  await expect.poll(async () => Number(await page.locator("#ti").inputValue())).toBeGreaterThan(45);
  await drawn(page);
  const dragged = Number(await page.locator("#ti").inputValue());
  expect(dragged).toBeLessThan(75);
  await page.locator("#arrow").focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Shift+ArrowRight");
  await drawn(page);
  expect(Number(await page.locator("#ti").inputValue())).toBeCloseTo(dragged - 11, 6);
  await expect(page.locator("#arrow")).toHaveAttribute("aria-valuenow", String(dragged - 11));
});

test("the view is chosen in the map of the hemisphere", async ({ page }) => {
  await open(page);
  const box = (await page.locator("#hemisphere-map").boundingBox())!;
  await page.mouse.click(box.x + box.width * 0.75, box.y + box.height * 0.5);
  await drawn(page);
  expect(Number(await page.locator("#tr").inputValue())).toBeCloseTo(30, 0);
  expect(Number(await page.locator("#phi").inputValue())).toBeCloseTo(180, 0);
});

const yaml = `REFERENCES: "test"
DATA:
  - type: tabulated nk
    data: |
        0.2 0.5 2.0
        0.5 0.8 5.0
        1.5 1.4 9.0
`;


test("files of optical constants are read, and a bad one gives a message and loses nothing", async ({ page }) => {
  await open(page);
  await drop(page, "mine.yml", yaml);
  await drawn(page);
  await expect(page.locator("#index")).toHaveValue("mine.yml");
  await expect.poll(() => value(page, "n")).toBeCloseTo(0.8, 12);
  expect(await value(page, "k")).toBeCloseTo(5, 12);
  const before = await page.evaluate(() => window.hts.state());
  for (const [name, text, message] of [
    ["bad.yml", yaml.replace("0.5 0.8 5.0", "0.5 0.8"), "bad.yml:6: 2 numbers in a row of a table of nk: must be 3"],
    ["worse.yml", "DATA:\n  - {type: [", "worse.yml:"],
    ["empty.csv", "", "empty.csv"],
    ["curve.csv", "theta_i_deg,theta_r_deg,brdf\n30,95,1\n", "curve.csv:2: theta_r_deg"],
    ["gold.json", JSON.stringify({ model: "walter", distribution: "ggx", alpha: 0.3, index: "Au" }), 'gold.json: key "model": must be "he" or "he_unified"'],
    ["keys.json", '{"model": "walter"}', "keys.json: key"],
    ["bad.json", "{", "JSON"],
  ]) {
    await drop(page, name, text);
    await expect(page.locator("#problem"), name).toContainText(message);
  }
  expect(await page.evaluate(() => window.hts.state())).toEqual(before);
});

test("measured points are shown and fitted", async ({ page }) => {
  await open(page, "sigma=0.15&tau=1.3&index=Au&lambda=0.6&tolerance=1e-12");
  const points: [number, number, number][] = [];
  for (const ti of [20, 45]) for (let tr = 5; tr <= 80; tr += 5) points.push([ti, tr, 180]);
  const values = await page.evaluate(async (points) => {
    const setting = { material: { model: "he", rms_roughness_um: 0.15, correlation_length_um: 1.3, index: "Au" }, wavelengths: [0.6], tolerance: 1e-12 };
    return [...(await window.hts.engine.evaluate(setting, "brdf", Float64Array.from(points.flat())))];
  }, points);
  await page.locator("#sigma").fill("0.5");
  await page.locator("#sigma").press("Enter");
  await drop(page, "gold.csv", ["wavelength_um,theta_i_deg,theta_r_deg,phi_r_deg,brdf", ...points.map((p, i) => [0.6, ...p, values[i]].join(",")), ""].join("\n"));
  await drawn(page);
  await expect(page.locator("#polar-picture circle.measured").first()).toBeVisible();
  await page.locator("#fit").click();
  await expect(page.locator("#fit-result")).toContainText("rms distance");
  await drawn(page);
  expect(Number(await page.locator("#sigma").inputValue())).toBeCloseTo(0.15, 4);
  expect(Number(await page.locator("#tau").inputValue())).toBeCloseTo(1.3, 3);
});

test("files are taken away", async ({ page }) => {
  await open(page);
  for (const [id, name, part] of [
    ["save-material", "material.json", '"rms_roughness_um": 0.28'],
    ["save-points", "points.csv", "wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf\n0.5,30,0,90,0,"],
    ["save-svg", "plane-of-incidence.svg", "<svg"],
    ["save-png", "plane-of-incidence.png", "PNG"],
    ["save-glsl", "surface.glsl", "vec3 hts_brdf_rgb(vec3 wi, vec3 wo)"],
    ["save-wgsl", "surface.wgsl", "fn hts_brdf_rgb(wi : vec3<f32>, wo : vec3<f32>) -> vec3<f32>"],
  ]) {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`#${id}`).click()]);
    expect(download.suggestedFilename()).toBe(name);
    const chunks: Buffer[] = [];
    for await (const chunk of await download.createReadStream()) chunks.push(chunk as Buffer);
    expect(Buffer.concat(chunks).toString("latin1")).toContain(part);
  }
});

test("bad numbers are refused where they are typed", async ({ page }) => {
  await open(page);
  await page.locator("#tau").fill("-3");
  await page.locator("#tau").press("Enter");
  expect(await page.locator("#tau").evaluate((e: HTMLInputElement) => e.validationMessage)).toContain("must be from 0.01 to 1000");
  expect(await page.evaluate(() => window.hts.state().tau)).toBe(1.77);
});

test("the single file opens from disk, without a network", async ({ page, context }) => {
  await context.setOffline(true);
  const begin = Date.now();
  await page.goto(new URL("hts.html", built).href);
  await page.locator("#polar-curve").waitFor({ state: "attached" });
  console.log(`single file: plot drawn after ${Date.now() - begin} ms; ${statSync(new URL("hts.html", built)).size} bytes`);
  await drawn(page);
  expect(await value(page, "brdf")).toBeGreaterThan(0);
  expect(statSync(new URL("hts.html", built)).size).toBeLessThan(3_000_000);
});

for (const scheme of ["light", "dark"] as const)
  for (const width of [400, 1400])
    test(`nothing stands in the way of reading it: ${width} px, ${scheme}`, async ({ page }) => {
      await page.emulateMedia({ colorScheme: scheme });
      await page.setViewportSize({ width, height: 900 });
      await open(page, "beside=ggx");
      await page.waitForTimeout(1500);
      await page.screenshot({ path: new URL(`screenshots/${width}-${scheme}.png`, built).pathname, fullPage: true });
      expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
      const { violations, passes } = await new AxeBuilder({ page }).analyze();
      console.log(`axe: ${passes.length} rules passed, ${violations.length} violated`);
      expect(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`)).toEqual([]);
    });
