// Makes GLSL ES 3.00 of the shaders in shaders/, which are GLSL 3.30. The rules, and nothing else is changed:
//
// - `#version 330 core` becomes `#version 300 es` with highp as default precision; #extension lines go.
// - `#include` takes a file in once a stage; definitions stand at the top, as gpu/shader_source.cpp puts them.
// - `precise` goes: ES 3.00 has no such word. Every output becomes `invariant` instead, which makes drivers leave the
//   order of operations behind it alone (docs/live_view.md).
// - A geometry stage becomes a part of the vertex stage. Each of its output vertices is a vertex of its own, which runs
//   the vertex stage for every corner of the primitive (the corner's attributes are NAME_0, NAME_1, ...), then the
//   geometry stage, and keeps the vertex that EmitVertex() was called for as the gl_VertexID-th. Points in and out need
//   one attribute set and can be captured; triangles are drawn as instances of a strip of `max_vertices`.
//
// files: name to text.

const include = /^[ \t]*#[ \t]*include[ \t]+"([^"]+)"[ \t]*$/;

function expand(files, name, taken) {
  const text = files[name];
  if (text === undefined) throw new Error(`no shader file ${name}`);
  taken.add(name);
  return text
    .split("\n")
    .map((line) => {
      const included = line.match(include)?.[1];
      return included === undefined ? line : taken.has(included) ? "" : expand(files, included, taken);
    })
    .join("\n");
}

const without330 = (text) =>
  text
    .replace(/^[ \t]*#[ \t]*(version|extension).*$/gm, "")
    .replace(/^precise gl_(Position|FragDepth);$/gm, "")
    .replace(/\bprecise /g, "")
    .replace(/^((?:flat )?out )/gm, "invariant $1");

function header(definitions) {
  return [
    "#version 300 es",
    "precision highp float;",
    "precision highp int;",
    "precision highp sampler2D;",
    ...definitions.map(([name, value]) => `#define ${name} ${value}`),
    "",
  ].join("\n");
}

const vertexHeader = (definitions) => `${header(definitions)}invariant gl_Position;\n`;

const attribute = /^in (\w+) (\w+);/gm;
const output = /^invariant (?:flat )?out (\w+) (\w+)(\[\d+\])?;/gm;
const declarations = (text, pattern) =>
  [...text.matchAll(pattern)].map(([, type, name, array = ""]) => ({ type, name, array }));

const corners = { points: 1, triangles: 3 };

// One stage in place of two. Returns {text, corners, maxVertices}.
function mergedStages(vertex, geometry) {
  const count = corners[geometry.match(/^layout\((points|triangles)\) in;/m)[1]];
  const maxVertices = Number(geometry.match(/^layout\(\w+, max_vertices = (\d+)\) out;/m)[1]);
  const attributes = declarations(vertex, attribute);
  const passed = declarations(vertex, output);
  const outputs = declarations(geometry, output);

  if (count > 1)
    vertex = vertex.replace(
      attribute,
      (_, type, name) =>
        Array.from({ length: count }, (_, corner) => `in ${type} ${name}_${corner};`).join(" ") + ` ${type} ${name};`,
    );
  vertex = vertex.replace(output, "$1 $2$3;").replace(/\bvoid main\(\)/g, "void vertex_stage()");

  geometry = geometry
    .replace(/^layout\(.*$/gm, "")
    .replace(/^in (\w+) (\w+)\[\];/gm, "$1 $2_in[CORNERS];")
    .replace(/\bgl_in\[(\w+)\]\.gl_Position\b/g, "position_in[$1]")
    .replace(/\bEndPrimitive\(\);/g, "")
    .replace(/\bvoid main\(\)/g, "void geometry_stage()");
  for (const { name } of passed) geometry = geometry.replace(new RegExp(`\\b${name}\\[`, "g"), `${name}_in[`);
  const taken = passed.filter(({ name }) => geometry.includes(`${name}_in[`));

  const corner = (index) => [
    ...(count > 1 ? attributes.map(({ name }) => `    ${name} = ${name}_${index};`) : []),
    "    vertex_stage();",
    `    position_in[${index}] = gl_Position;`,
    ...taken.map(({ name }) => `    ${name}_in[${index}] = ${name};`),
  ];
  const text = [
    `const int CORNERS = ${count};`,
    vertex,
    "vec4 position_in[CORNERS];",
    "void EmitVertex();",
    geometry,
    "int emitted = 0;",
    "vec4 kept_gl_Position;",
    ...outputs.map(({ type, name, array }) => `${type} kept_${name}${array};`),
    "void EmitVertex() {",
    `    if (emitted++ > ${maxVertices > 1 ? "gl_VertexID" : "0"})`,
    "        return;",
    "    kept_gl_Position = gl_Position;",
    ...outputs.map(({ name }) => `    kept_${name} = ${name};`),
    "}",
    "void main() {",
    ...Array.from({ length: count }, (_, index) => corner(index)).flat(),
    "    kept_gl_Position = vec4(0.0, 0.0, 2.0, 1.0);",
    "    geometry_stage();",
    "    gl_Position = kept_gl_Position;",
    ...outputs.map(({ name }) => `    ${name} = kept_${name};`),
    "    gl_PointSize = 1.0;",
    "}",
    "",
  ].join("\n");
  return { text, corners: count, maxVertices };
}

// The stages of pass `name`: {vertex, fragment, corners, maxVertices}; corners is 0 without a geometry stage.
export function stages(files, name, definitions) {
  const top = vertexHeader(definitions);
  const taken = new Set();
  const vertex = without330(expand(files, `${name}.vert`, taken));
  const fragment = header(definitions) + without330(expand(files, `${name}.frag`, new Set()));
  if (files[`${name}.geom`] === undefined) return { vertex: top + vertex, fragment, corners: 0, maxVertices: 0 };
  const merged = mergedStages(vertex, without330(expand(files, `${name}.geom`, taken)));
  return { ...merged, vertex: top + merged.text, fragment };
}
