// Makes of the built folder one HTML file that opens from disk: scripts, styles and the engine stand in it.
import { readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";

const folder = new URL("../build/page/site/", import.meta.url);
const assets = readdirSync(new URL("assets/", folder));
const asset = (ending) => assets.find((name) => name.endsWith(ending));
const text = (name) => readFileSync(new URL(`assets/${name}`, folder), "utf8");

let html = readFileSync(new URL("index.html", folder), "utf8");
const engine = readFileSync(new URL(`assets/${asset(".bin")}`, folder)).toString("base64");
const script = text(asset(".js")).replaceAll("</script", "<\\/script");
html = html.replace(/<script type="module"[^>]*><\/script>/, "");
html = html.replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${text(asset(".css"))}</style>`);
html = html.replace(
  "</body>",
  () => `<script type="text/plain" id="engine">${engine}</script><script type="module">${script}</script></body>`,
);
writeFileSync(new URL("../hts.html", folder), html);

const size = (url) => statSync(url).size;
const all = [new URL("index.html", folder), ...assets.map((name) => new URL(`assets/${name}`, folder))];
console.log(`build/page/site: ${all.map(size).reduce((a, b) => a + b)} bytes in ${all.length} files`);
console.log(`build/page/hts.html: ${size(new URL("../hts.html", folder))} bytes`);
