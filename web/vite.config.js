// One HTML file with everything in it: code, style, worker and the core's WebAssembly. It opens from file:// without a network.
// GOUGH_CORE names the WebAssembly file (built by CMake), GOUGH_PAGE_OUTPUT the folder that report.html goes to.
import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

// import bytes from "virtual:core": the core's WebAssembly, compressed, as base64; or "" where it was not built.
function core() {
  const name = "virtual:core";
  const path = process.env.GOUGH_CORE;
  return {
    name: "core",
    resolveId: (id) => (id === name ? `\0${name}` : null),
    load: (id) =>
      id === `\0${name}`
        ? `export default ${JSON.stringify(path ? gzipSync(readFileSync(path), { level: 9 }).toString("base64") : "")};`
        : null,
  };
}

// The colours of lines, which the figures of `gough plot` have too: import { legs, axes, tables } from "virtual:palette" gives
// names of colours; `--palette: day` in a style becomes a property of each colour.
function palette() {
  const name = "virtual:palette";
  const text = readFileSync(process.env.GOUGH_PALETTE ?? "../src/figure/palette.def", "utf8");
  const colours = [...text.matchAll(/^COLOUR\((\w+), "(#\w+)", "(#\w+)"\)$/gm)];
  const names = (what) =>
    new RegExp(`^${what}\\((.*)\\)$`, "m").exec(text)[1].split(", ");
  const lists = ["legs", "axes", "tables"].map(
    (what) => `export const ${what} = ${JSON.stringify(names(what.toUpperCase()))};`,
  );
  const properties = (_, time) =>
    colours.map(([, colour, day, night]) => `--${colour}: ${time === "day" ? day : night};`).join("\n");
  return {
    name: "palette",
    enforce: "pre",
    resolveId: (id) => (id === name ? `\0${name}` : null),
    load: (id) => (id === `\0${name}` ? lists.join("\n") : null),
    transform: (code, id) =>
      id.endsWith(".css") ? code.replace(/--palette: (day|night);/g, properties) : null,
  };
}

// The notices that the licences of the bundled parts ask for, as a comment in the page.
function notices() {
  const licence = (part) => readFileSync(`node_modules/${part}/LICENSE`, "utf8");
  const holder = (part) => /^Copyright .*$/im.exec(licence(part))[0];
  const text = [
    "This page holds parts of others under the MIT License below:",
    `three.js: ${holder("three")}`,
    `uPlot: ${holder("uplot")}`,
    `fflate: ${holder("fflate")}`,
    "musl, by way of wasi-libc: Copyright © 2005-2020 Rich Felker, et al.",
    licence("three").slice(licence("three").indexOf("Permission is")).trim(),
  ].join("\n\n");
  return {
    name: "notices",
    transformIndexHtml: (html) =>
      html.replace("<body>", `<!--\n${text.replaceAll("--", "- -")}\n-->\n  <body>`),
  };
}

export default defineConfig({
  base: "./",
  plugins: [core(), palette(), notices(), viteSingleFile({ removeViteModuleLoader: true })],
  worker: { format: "iife", plugins: () => [core()] },
  build: {
    outDir: process.env.GOUGH_PAGE_OUTPUT || "dist",
    emptyOutDir: false,
    target: "es2022",
    modulePreload: false,
    chunkSizeWarningLimit: 2000,
    reportCompressedSize: false,
  },
});
