import assert from "node:assert/strict";
import { test } from "node:test";
import { shaderSources } from "../../crosscheck/report_page/shader_sources.mjs";
import { stages } from "../../crosscheck/report_page/src/live/shader_source.js";

const shaders = await shaderSources();
const passes = ["collision_pass", "obstacle_pass", "obstacle_vertices", "render_pass", "render_obstacles", "render_background"];

const small = {
  "p.vert": `#version 330 core
#extension GL_ARB_gpu_shader5 : require
#include "a.glsl"
in vec3 a_Position;
precise out vec3 v_Position;
precise gl_Position;
void main() {
    precise float x = one();
    v_Position = a_Position * x;
}`,
  "p.geom": `#version 330 core
#include "a.glsl"
layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;
in vec3 v_Position[];
flat out vec3 g_Position[3];
void main() {
    g_Position[0] = v_Position[0];
    gl_Position = gl_in[2].gl_Position;
    EmitVertex();
    EndPrimitive();
}`,
  "p.frag": `#version 330 core
flat in vec3 g_Position[3];
out vec4 o_Color;
void main() { o_Color = vec4(g_Position[0], 1.0); }`,
  "a.glsl": "float one() { return 1.0; }",
};

test("shader source: every pass becomes ES 3.00, with nothing left that it does not know", () => {
  for (const pass of passes) {
    const { vertex, fragment } = stages(shaders, pass, [["ARITHMETIC", "0"]]);
    for (const text of [vertex, fragment]) {
      assert.match(text, /^#version 300 es\nprecision highp float;\n/);
      assert.doesNotMatch(text.replace(/\/\/.*/g, ""), /\bprecise\b|#extension|#include|gl_in\b|EndPrimitive|max_vertices/, pass);
    }
  }
});

test("shader source: definitions stand at the top, and a file is taken in once a stage", () => {
  const { vertex } = stages(small, "p", [["SEARCH", "SEARCH_CDT"]]);
  assert.ok(vertex.indexOf("#define SEARCH SEARCH_CDT") < vertex.indexOf("float one()"));
  assert.equal(vertex.split("float one()").length, 2);
});

test("shader source: outputs are invariant, since there is no precise", () => {
  const { vertex, fragment } = stages(small, "p", []);
  assert.match(vertex, /^invariant gl_Position;$/m);
  assert.match(vertex, /^invariant flat out vec3 g_Position\[3\];$/m);
  assert.match(fragment, /^invariant out vec4 o_Color;$/m);
});

test("shader source: a geometry stage over triangles runs the vertex stage on three sets of attributes", () => {
  const { vertex, corners, maxVertices } = stages(small, "p", []);
  assert.deepEqual([corners, maxVertices], [3, 4]);
  assert.match(vertex, /in vec3 a_Position_0; in vec3 a_Position_1; in vec3 a_Position_2; vec3 a_Position;/);
  assert.match(vertex, /g_Position\[0\] = v_Position_in\[0\];/);
  assert.match(vertex, /a_Position = a_Position_2;\n {4}vertex_stage\(\);\n {4}position_in\[2\] = gl_Position;/);
});

test("shader source: points keep their attributes, and what is captured is an output", () => {
  const { vertex, corners, maxVertices } = stages(shaders, "collision_pass", []);
  assert.deepEqual([corners, maxVertices], [1, 1]);
  assert.match(vertex, /^in vec3 a_Position;$/m);
  for (const output of ["flat out vec3 out_Position", "out vec3 out_Dir", "out float out_Speed", "out float out_CollideTime"])
    assert.ok(vertex.includes(`invariant ${output};`), output);
});

test("shader source: a file that is missing is named", () => {
  const { "a.glsl": _, ...rest } = small;
  assert.throws(() => stages(rest, "p", []), /no shader file a\.glsl/);
});
