// What can be taken away: files, pictures, the command line and the Python lines that give the same numbers.

import type { Engine } from "./client";
import { html } from "./dom";
import { settingOf, type Frame } from "./frame";
import { filesOf, materialOf } from "./material";
import { toAddress, type State } from "./state";
import { shaderWavelengths } from "./views/lit";
import { angles, triplesOf } from "./views/polar";

function save(name: string, type: string, content: BlobPart): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = html("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

const materialText = (state: State) => JSON.stringify(materialOf(state), null, 2) + "\n";

export const command = (state: State): string =>
  `hts eval --material material.json --wavelength ${state.lambda} --theta-i ${state.ti} --theta-r ${state.tr} --phi ${state.phi} --tolerance ${state.tolerance}`;

// As Python writes it.
function literal(value: unknown): string {
  if (typeof value === "boolean") return value ? "True" : "False";
  if (Array.isArray(value)) return `[${value.map(literal).join(", ")}]`;
  if (typeof value !== "object") return JSON.stringify(value);
  return `{${Object.entries(value!).map(([key, of]) => `${JSON.stringify(key)}: ${literal(of)}`).join(", ")}}`;
}

export function python(state: State): string {
  const { name: _, ...keys } = materialOf(state);
  return [
    "import hts",
    `material = hts.Material(${literal(keys)})`,
    `brdf = material.brdf(${state.lambda}, ${state.ti}, ${state.tr}, ${state.phi}, tolerance=${state.tolerance}, degrees=True)`,
    `mirror = material.specular_reflectance(${state.lambda}, ${state.ti}, tolerance=${state.tolerance}, degrees=True)`,
  ].join("\n");
}

async function points(engine: Engine, state: State): Promise<string> {
  const setting = settingOf(state, [state.lambda]);
  const triples = triplesOf(state.ti);
  const values = await engine.evaluate(setting, "brdf", triples);
  const rows = angles.map((_, i) =>
    [state.lambda, state.ti, 0, triples[3 * i + 1], triples[3 * i + 2], values[i]].join(","));
  return ["wavelength_um,theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf", ...rows, ""].join("\n");
}

// The polar plot with its colours written into it, so that it looks the same elsewhere.
export function standalone(picture: SVGSVGElement): string {
  const copy = picture.cloneNode(true) as SVGSVGElement;
  const shown = picture.querySelectorAll<SVGElement>("*");
  const properties = ["fill", "stroke", "stroke-width", "stroke-dasharray", "font-size", "font-family", "opacity"];
  copy.querySelectorAll<SVGElement>("*").forEach((element, i) => {
    const style = getComputedStyle(shown[i]);
    for (const property of properties) {
      const value = style.getPropertyValue(property);
      if (value) element.setAttribute(property, value);
    }
    for (const name of ["class", "tabindex", "role", "id"]) element.removeAttribute(name);
  });
  const { width, height } = picture.viewBox.baseVal;
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", String(width));
  copy.setAttribute("height", String(height));
  const ground = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  ground.setAttribute("width", "100%");
  ground.setAttribute("height", "100%");
  ground.setAttribute("fill", getComputedStyle(picture.closest(".card")!).backgroundColor);
  copy.prepend(ground);
  return new XMLSerializer().serializeToString(copy);
}

async function png(picture: SVGSVGElement): Promise<Blob> {
  const image = new Image();
  const { width, height } = picture.viewBox.baseVal;
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(standalone(picture));
  await image.decode();
  const target = html("canvas", { width: 2 * width, height: 2 * height });
  target.getContext("2d")!.drawImage(image, 0, 0, 2 * width, 2 * height);
  return new Promise((resolve) => target.toBlob((blob) => resolve(blob!), "image/png"));
}

type Action = [id: string, text: string, act: (f: Frame) => Promise<void> | void];

export function takeAway(picture: SVGSVGElement, say: (text: string) => void) {
  const lines = html("pre", { id: "command", tabindex: 0, "aria-label": "Command line" });
  const code = html("pre", { id: "python", tabindex: 0, "aria-label": "Python" });
  const buttons = html("div", { class: "buttons" });
  const note = html("p", { class: "note", id: "take-note" });
  const section = html("section", { id: "take", class: "card", "aria-labelledby": "take-title" },
    html("h2", { id: "take-title" }, "Take away"), buttons, html("h3", {}, "The same numbers on the command line"), lines,
    html("h3", {}, "and in Python"), code, note);
  let frame: Frame | null = null;

  const actions: Action[] = [
    ["save-material", "Material file", ({ state }) => save("material.json", "application/json", materialText(state))],
    ["save-points", "Points, CSV", async ({ engine, state }) => save("points.csv", "text/csv", await points(engine, state))],
    ["save-svg", "Plot, SVG", () => save("plane-of-incidence.svg", "image/svg+xml", standalone(picture))],
    ["save-png", "Plot, PNG", async () => save("plane-of-incidence.png", "image/png", await png(picture))],
    ...(["glsl", "wgsl"] as const).map((language): Action =>
      [`save-${language}`, `Shader, ${language.toUpperCase()}`, async ({ engine, state }) => save(`surface.${language}`, "text/plain",
        await engine.shader(settingOf(state, state.light === "one" ? [state.lambda] : shaderWavelengths), language))]),
    ["copy-link", "Copy link", async ({ state }) => {
      const link = `${location.href.split("#")[0]}#${toAddress(state)}`;
      await navigator.clipboard.writeText(link);
      say("The link is copied.");
    }],
  ];
  for (const [id, text, act] of actions) {
    const button = html("button", { type: "button", id }, text);
    button.addEventListener("click", async () => {
      if (!frame) return;
      try {
        await act(frame);
      } catch (error) {
        say(`${text}: ${error instanceof Error ? error.message : String(error)}`);
      }
    });
    buttons.append(button);
  }

  function update(of: Frame): void {
    frame = of;
    const { state } = of;
    lines.textContent = `cat > material.json <<'END'\n${materialText(state)}END\n${command(state)}`;
    code.textContent = python(state);
    const files = filesOf(state);
    note.textContent = files.length ? `Beside the material file must stand ${files.join(" and ")}.` : "";
  }
  return { section, update };
}
