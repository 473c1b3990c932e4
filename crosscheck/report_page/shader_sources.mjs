// esbuild: `import shaders from "lockstep:shaders"` is the text of every file in shaders/ that WebGL2 can run, by name.
import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

export const shaderFolder = fileURLToPath(new URL("../../shaders", import.meta.url));

export async function shaderSources(folder = shaderFolder) {
  const names = (await readdir(folder)).filter((name) => /\.(vert|geom|frag|glsl)$/.test(name));
  const texts = await Promise.all(names.map((name) => readFile(join(folder, name), "utf8")));
  return Object.fromEntries(names.map((name, i) => [name, texts[i]]));
}

export const shaderPlugin = (folder) => ({
  name: "shaders",
  setup(build) {
    build.onResolve({ filter: /^lockstep:shaders$/ }, ({ path }) => ({ path, namespace: "shaders" }));
    build.onLoad({ filter: /.*/, namespace: "shaders" }, async () => ({
      contents: JSON.stringify(await shaderSources(folder)),
      loader: "json",
    }));
  },
});
