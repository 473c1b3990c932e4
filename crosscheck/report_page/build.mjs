// Bundles src/ into one HTML file without data: node build.mjs OUT
import { build } from "esbuild";
import { mkdir, readFile, rename, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { shaderPlugin } from "./shader_sources.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
if (!out) {
  console.error("usage: node build.mjs OUT.html");
  process.exit(2);
}

const { outputFiles } = await build({
  entryPoints: [join(here, "src/main.js")],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  legalComments: "inline",
  plugins: [shaderPlugin()],
  outdir: "out",
  write: false,
});
const bundled = (extension) => outputFiles.find((file) => file.path.endsWith(extension)).text;
const licence = await readFile(join(here, "node_modules/uplot/LICENSE"), "utf8");

const skeleton = await readFile(join(here, "src/page.html"), "utf8");
const page = skeleton
  .replace("<!-- style -->", () => `<style>${bundled(".css")}</style>`)
  .replace("<!-- script -->", () => `<script>/*! With uPlot. ${licence.trim()} */\n${bundled(".js")}</script>`);
await mkdir(dirname(out), { recursive: true });
await writeFile(`${out}.new`, page);
await rename(`${out}.new`, out);
