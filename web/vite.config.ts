import { defineConfig } from "vite";

// One folder of static files that any host can serve, from any place: paths are relative.
export default defineConfig({
  base: "./",
  build: { outDir: "../build/page/site", emptyOutDir: true, assetsInlineLimit: 0, target: "es2022" },
  worker: { format: "iife" },
  resolve: { alias: { "@engine": new URL("../build/page/engine", import.meta.url).pathname } },
});
