// Bundles src/ into one HTML file: node build.mjs OUT.html
import { build } from "esbuild";
import { mkdir, readFile, rename, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
if (!out) {
  console.error("usage: node build.mjs OUT.html");
  process.exit(2);
}

const { outputFiles } = await build({
  entryPoints: [join(here, "src/main.jsx")],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  jsx: "automatic",
  define: { "process.env.NODE_ENV": '"production"' },
  legalComments: "none",
  outdir: "out",
  write: false,
});
const bundled = (extension) => outputFiles.find((file) => file.path.endsWith(extension)).text;
const libraries = ["@xyflow/react", "react", "react-dom"];
const licences = await Promise.all(libraries.map((name) => readFile(join(here, "node_modules", name, "LICENSE"), "utf8")));
const notice = libraries.map((name, i) => `With ${name}. ${licences[i].trim()}`).join("\n\n");

const skeleton = await readFile(join(here, "src/page.html"), "utf8");
const page = skeleton
  .replace("<!-- style -->", () => `<style>${bundled(".css")}</style>`)
  .replace("<!-- script -->", () => `<script>/*! ${notice} */\n${bundled(".js").replaceAll("</script", "<\\/script")}</script>`);
await mkdir(dirname(out), { recursive: true });
await writeFile(`${out}.new`, page);
await rename(`${out}.new`, out);
