// Files that are dropped onto the page: scatter files of other programs, material files and what they name.

import { readFileSync } from "node:fs";
import { drawn, drop, expect, open, test, value } from "./page";

const odd = (name: string) => readFileSync(new URL(`../../tables/formats/tests/odd/${name}`, import.meta.url), "utf8");

test("scatter files of other programs are shown beside the model, and bad ones refused", async ({ page }) => {
  test.slow();
  // Their values on the mirror's side at 40 degrees for light at 50, or at 30 for light along the normal.
  for (const [name, ti, tr, phi, um, brdf] of [
    ["scatter/plain.fred.txt", 50, 40, 180, 0.6, 0.18],
    ["scatter/viavi.fred.txt", 50, 40, 180, 0.6, 0.18],
    ["scatter/radians.fred.txt", 50, 40, 180, 0.6, 0.18],
    ["scatter/plain.astm", 0, 30, 180, 0.55, 0.15],
    ["scatter/semicolons.astm", 0, 30, 180, 0.55, 0.15],
    ["matrices/lighttools.bsdf", 40, 40, 180, 0.55, NaN],
  ] as [string, number, number, number, number, number][]) {
    await open(page, "lambda=0.6&radius=absolute");
    const file = name.replace(/.*\//, "");
    await drop(page, file, odd(name));
    await expect(page.locator("#status"), name).toHaveText(new RegExp(`^${file}: \\d+ measured points are shown`));
    await drawn(page);
    const points = await page.evaluate(() => window.hts.measured()!.points);
    const near = (p: Record<string, number>) =>
      Math.abs(p.ti - ti) < 1e-3 && Math.abs(p.tr - tr) < 1e-3 && Math.abs(Math.abs(p.phi) - phi) < 1e-3 && Math.abs(p.um - um) < 1e-9;
    const found = points.filter(near);
    expect(found.length, name).toBeGreaterThan(0);
    if (!Number.isNaN(brdf)) for (const p of found) expect(Math.abs(p.brdf / brdf - 1), name).toBeLessThan(1e-4);
    await page.locator("#ti").fill(String(ti));
    await page.locator("#ti").press("Enter");
    await drawn(page);
    await expect(page.locator("#polar-picture circle.measured").first(), name).toBeVisible();
  }
  const before = await page.evaluate(() => window.hts.state());
  for (const [name, message] of [
    ["scatter/other-side.fred.txt", "more light at azimuth 180 deg than at 0"],
    ["scatter/no-light.fred.txt", "no-light.fred.txt:3"],
    ["scatter/wrong-count.astm", "wrong-count.astm: 39 points: NUM_POINTS says 7"],
    ["scatter/misspelt.astm", "misspelt.astm"],
    ["scatter/xyz.astm", "must be wavelengths, which colours are not"],
    ["matrices/lighttools-twice.bsdf", "lighttools-twice.bsdf"],
  ]) {
    await drop(page, name.replace(/.*\//, ""), odd(name));
    await expect(page.locator("#problem"), name).toContainText(message);
  }
  expect(await page.evaluate(() => window.hts.state())).toEqual(before);
  // the other way to count azimuths
  await page.locator("#mirror-azimuth").selectOption("180");
  await drop(page, "other-side.fred.txt", odd("scatter/other-side.fred.txt"));
  await expect(page.locator("#status")).toContainText(/^other-side.fred.txt: \d+ measured points are shown/);
  await expect(page.locator("#problem")).toBeEmpty();
});

const bird = (variables: Record<string, unknown>) => JSON.stringify({
  metadata: { note: '"wavelength_of_the_lamp"' },
  data: {
    theta_i: { unit: "deg", values: [30, 30, 30, 30] },
    phi_i: { unit: "deg", values: [0, 0, 0, 0] },
    theta_r: { unit: "deg", values: [20, 20, 60, 60] },
    phi_r: { unit: "deg", values: [180, 180, 180, 180] },
    BRDF: { unit: "sr-1", values: [0.5, 0.4, 0.2, 0.1] },
    ...variables,
  },
});
const wavelengths = { unit: "nm", values: [550, 650, 550, 650] };

test("BiRD files are shown beside the model, and bad ones refused", async ({ page }) => {
  await open(page, "lambda=0.7&radius=absolute");
  for (const [name, key] of [["bird.json", "wavelength"], ["light.json", "wavelength_i"]]) {
    await drop(page, name, bird({ [key]: wavelengths }));
    await expect(page.locator("#status")).toContainText(`${name}: 4 measured points are shown`);
    await drawn(page);
    const points = await page.evaluate(() => window.hts.measured()!.points);
    expect(points.map((p) => [p.ti, p.tr, Math.abs(p.phi), p.um, p.brdf]).sort()).toEqual(
      [[30, 20, 180, 0.55, 0.5], [30, 20, 180, 0.65, 0.4], [30, 60, 180, 0.55, 0.2], [30, 60, 180, 0.65, 0.1]]);
    await expect(page.locator("#polar-picture circle.measured")).toHaveCount(4);
    await expect(page.locator("#fit-result")).not.toContainText("names no wavelength");
    expect(await page.evaluate(() => window.hts.state().lambda)).toBe(0.55);
  }
  await drop(page, "dark.json", bird({ theta_r: { unit: "deg", values: [10, 20, 40, 60] } })); // at the page's wavelength
  await expect(page.locator("#fit-result")).toContainText("names no wavelength");
  expect(await page.evaluate(() => window.hts.measured()!.points.map((p) => p.um))).toEqual([0.55, 0.55, 0.55, 0.55]);
  await drawn(page);
  const before = await page.evaluate(() => [window.hts.state(), window.hts.measured()]);
  for (const [name, text, message] of [
    ["short.json", bird({ wavelength: wavelengths, theta_r: { unit: "deg", values: [20] } }), 'short.json: key "data.theta_r.values": 1 values: must be as many as BRDF has, 4'],
    ["unit.json", bird({ wavelength: { ...wavelengths, unit: "inch" } }), "unit.json: key \"data.wavelength.unit\""],
    ["broken.json", bird({}).slice(0, -1), "broken.json"],
  ]) {
    await drop(page, name, text);
    await expect(page.locator("#problem"), name).toContainText(message);
  }
  expect(await page.evaluate(() => [window.hts.state(), window.hts.measured()])).toEqual(before);
});

const aluminium = { model: "he", rms_roughness_um: 0.2, correlation_length_um: 1.5, index: "Al" };

test("a material file with uncertainties is shown, and said not to use them", async ({ page }) => {
  await open(page);
  await drop(page, "uncertain.json", JSON.stringify({ ...aluminium, uncertainty: { rms_roughness_um: 0.01, correlation_length_um: 0.06 } }));
  await expect(page.locator("#status")).toContainText("uncertain.json: the material is shown. Its uncertainty is not used here");
  await drawn(page);
  expect(await page.evaluate(() => window.hts.state().sigma)).toBe(0.2);
  await drop(page, "certain.json", JSON.stringify({ ...aluminium, rms_roughness_um: 0.3 }));
  await expect(page.locator("#status")).toHaveText("certain.json: the material is shown.");
});

test("choices of the successor are read, and taken away as Python has them", async ({ page }) => {
  await open(page);
  const choices = { mirror: "second_order", polarisation_mixing: true, conductor_shortcut: true };
  await drop(page, "unified.json", JSON.stringify({ ...aluminium, model: "he_unified", ...choices }));
  await expect(page.locator("#status")).toContainText("unified.json: the material is shown");
  await drawn(page);
  await expect(page.locator("#mirror")).toHaveValue("second_order");
  await expect(page.locator("#mixing")).toBeChecked();
  await expect(page.locator("#shortcut")).toBeChecked();
  expect(page.url()).toContain("mirror=second_order&mixing=true&shortcut=true");
  await expect(page.locator("#python")).toContainText('"mirror": "second_order", "polarisation_mixing": True, "conductor_shortcut": True})');
  for (const part of ['"mirror": "second_order"', '"polarisation_mixing": true', '"conductor_shortcut": true'])
    await expect(page.locator("#command")).toContainText(part);
  // what the engine does not know is refused, of a file whole
  const before = await page.evaluate(() => window.hts.state());
  for (const [name, keys, message] of [
    ["film.json", { films: [{ index: "SiO2", thickness_um: 0.1 }] }, "film.json: mirror second_order: must be closed where there are films"],
    ["glass.json", { index: "BK7" }, "conductor_shortcut at 0.5 um"],
    ["odd.json", { mirror: "third_order" }, 'odd.json: key "mirror": "third_order" is not known; must be closed or second_order'],
    ["yes.json", { polarisation_mixing: "yes" }, 'yes.json: key "polarisation_mixing"'],
  ] as [string, object, string][]) {
    await drop(page, name, JSON.stringify({ ...aluminium, model: "he_unified", ...choices, ...keys }));
    await expect(page.locator("#problem"), name).toContainText(message);
  }
  expect(await page.evaluate(() => window.hts.state())).toEqual(before);
  await open(page, "mixing=maybe");
  await expect(page.locator("#problem")).toContainText("mixing maybe: must be one of true, false");
});

const constants = (n: number) => `REFERENCES: "test"\nDATA:\n  - type: tabulated nk\n    data: |\n        0.2 ${n} 2.0\n        1.5 ${n} 2.0\n`;

test("a material finds the dropped files that it names, whatever their names and order", async ({ page }) => {
  await open(page);
  const material = (file: string) => JSON.stringify({ ...aluminium, index: { file } });
  await drop(page, "early.json", material("constants/Zinn & Blei (π).yml"));
  await expect(page.locator("#problem")).toContainText("Zinn & Blei (π).yml: is not here; drop the file onto the page");
  await page.locator("#file").setInputFiles([
    { name: "late.json", mimeType: "application/json", buffer: Buffer.from(material("constants/Zinn & Blei (π).yml")) },
    { name: "Zinn & Blei (π).yml", mimeType: "text/plain", buffer: Buffer.from(constants(1.25)) },
  ]);
  await expect(page.locator("#status")).toContainText("late.json: the material is shown");
  await drawn(page);
  await expect(page.locator("#problem")).toBeEmpty();
  await expect(page.locator("#index")).toHaveValue("Zinn & Blei (π).yml");
  expect(await value(page, "n")).toBe(1.25);
  await expect(page.locator("#take-note")).toHaveText("Beside the material file must stand Zinn & Blei (π).yml.");
  await expect(page.locator("#command")).toContainText('"file": "Zinn & Blei (π).yml"');
  await drop(page, "nameless", constants(2));
  await expect(page.locator("#problem")).toContainText("nameless: must have an ending, such as .yml");
});

test("files are dropped by hand", async ({ page }) => {
  await open(page);
  const files = await page.evaluateHandle((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], "dropped.json"));
    return data;
  }, JSON.stringify(aluminium));
  await page.dispatchEvent("main", "drop", { dataTransfer: files });
  await expect(page.locator("#status")).toContainText("dropped.json: the material is shown");
});
