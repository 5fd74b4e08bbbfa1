// The page as tests use it.

import { expect, test as base, type Page } from "@playwright/test";

export interface Setting {
  material: Record<string, unknown>;
  wavelengths: number[];
  tolerance?: number;
}
export interface Hts {
  engine: {
    picture(setting: Setting, weights: number[], pixels: Float64Array): Promise<Float64Array>;
    energy(setting: Setting, theta_i_deg: number): Promise<{ directional_diffuse: number; uniform_diffuse: number }>;
    evaluate(setting: Setting, of: string, triples: Float64Array): Promise<Float64Array>;
    shader(setting: Setting, language: "glsl" | "wgsl"): Promise<string>;
  };
  state(): Record<string, unknown>;
  measured(): { name: string; points: Record<string, number>[] } | null;
}
declare global {
  interface Window {
    hts: Hts;
  }
}

// A page without an error in its console.
export const test = base.extend<{ errors: string[] }>({
  errors: [
    async ({ page }, use) => {
      const errors: string[] = [];
      page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
      page.on("pageerror", (error) => errors.push(String(error)));
      await use(errors);
      expect(errors).toEqual([]);
    },
    { auto: true },
  ],
});

export { expect };

// Waits until all views show the state.
export async function drawn(page: Page): Promise<void> {
  await page.waitForFunction(() => {
    const shown = document.body.dataset.drawn;
    return shown !== undefined && window.hts !== undefined && shown === JSON.stringify(window.hts.state());
  });
}

export async function open(page: Page, address = ""): Promise<void> {
  await page.goto(address ? `/#${address}` : "/");
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 50))); // a change of the address alone reaches the page then
  await drawn(page);
}

export const value = async (page: Page, key: string): Promise<number> =>
  Number(await page.locator(`[data-key="${key}"]`).getAttribute("data-value"));

export const drop = (page: Page, name: string, text: string): Promise<void> =>
  page.locator("#file").setInputFiles({ name, mimeType: "text/plain", buffer: Buffer.from(text) });

// What each view shows, text or pixels, as a hash.
export const shown = (page: Page) =>
  page.evaluate(() => {
    const hash = (s: string) => [...s].reduce((h, c) => (Math.imul(h, 31) + c.charCodeAt(0)) | 0, s.length);
    const pixels = (id: string) => hash((document.getElementById(id) as HTMLCanvasElement).toDataURL());
    const text = (id: string) => hash(document.getElementById(id)!.innerHTML);
    return {
      polar: hash(document.getElementById("polar-curve")!.getAttribute("points")!), hemisphere: pixels("hemisphere-map"), lit: pixels("lit-picture"),
      scatter: text("scatter"), spectrum: text("spectrum"), values: text("values"), validity: text("validity"), energy: text("energy"),
      mueller: pixels("mueller-maps"), phi: pixels("phi-map"), take: text("take"),
    };
  });
export type View = keyof Awaited<ReturnType<typeof shown>>;
