// esbuild: `import shaders from "lockstep:shaders"` is the text of every file in shaders/ and shaders/collision/ that WebGL2 can run, by name.
import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const shared = fileURLToPath(new URL("../../shaders", import.meta.url));

export const shaderFolders = [shared, join(shared, "collision")];

export async function shaderSources(folders = shaderFolders) {
  const sources = {};
  for (const folder of folders) {
    const names = (await readdir(folder)).filter((name) => /\.(vert|geom|frag|glsl)$/.test(name));
    const texts = await Promise.all(names.map((name) => readFile(join(folder, name), "utf8")));
    names.forEach((name, i) => (sources[name] = texts[i]));
  }
  return sources;
}

export const shaderPlugin = (folders) => ({
  name: "shaders",
  setup(build) {
    build.onResolve({ filter: /^lockstep:shaders$/ }, ({ path }) => ({ path, namespace: "shaders" }));
    build.onLoad({ filter: /.*/, namespace: "shaders" }, async () => ({
      contents: JSON.stringify(await shaderSources(folders)),
      loader: "json",
    }));
  },
});
