import { stages } from "./shader_source.js";

function compiled(gl, type, name, text) {
  const shader = gl.createShader(type);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`${name}: ${gl.getShaderInfoLog(shader)}`);
  return shader;
}

// A pass's shaders, translated and linked, with what it captures.
export class Program {
  constructor(gl, files, name, definitions, captured = []) {
    this.gl = gl;
    this.name = name;
    const { vertex, fragment, corners, maxVertices } = stages(files, name, definitions);
    this.corners = corners;
    this.maxVertices = maxVertices;
    this.id = gl.createProgram();
    gl.attachShader(this.id, compiled(gl, gl.VERTEX_SHADER, `${name}, vertex stage`, vertex));
    gl.attachShader(this.id, compiled(gl, gl.FRAGMENT_SHADER, `${name}, fragment stage`, fragment));
    if (captured.length > 0) gl.transformFeedbackVaryings(this.id, captured, gl.INTERLEAVED_ATTRIBS);
    gl.linkProgram(this.id);
    if (!gl.getProgramParameter(this.id, gl.LINK_STATUS))
      throw new Error(`${name} does not link: ${gl.getProgramInfoLog(this.id)}`);
    this.uniforms = new Map();
    for (let i = 0; i < gl.getProgramParameter(this.id, gl.ACTIVE_UNIFORMS); ++i) {
      const { name: uniform, type } = gl.getActiveUniform(this.id, i);
      this.uniforms.set(uniform, { type, location: gl.getUniformLocation(this.id, uniform) });
    }
  }

  // Sets every active uniform from `values`, by name.
  use(values) {
    const { gl } = this;
    gl.useProgram(this.id);
    for (const [name, { type, location }] of this.uniforms) {
      const value = values[name];
      if (value === undefined) throw new Error(`${this.name}: nothing is given for uniform ${name}`);
      if (type === gl.FLOAT) gl.uniform1f(location, value);
      else if (type === gl.FLOAT_VEC3) gl.uniform3fv(location, value);
      else if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(location, false, value);
      else gl.uniform1i(location, value);
    }
  }

  attribute(name) {
    return this.gl.getAttribLocation(this.id, name);
  }
}
