import { meshArray, particleArray } from "./attributes.js";
import { matrix } from "./live_scene.js";
import { Program } from "./program.js";

const divided = (a, b) => a.map((x, i) => Math.fround(Math.fround(x) / Math.fround(b[i])));

export function context(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
  if (!gl) throw new Error("this browser has no WebGL2");
  if (!gl.getExtension("EXT_color_buffer_float"))
    throw new Error("this browser does not draw to float textures (EXT_color_buffer_float)");
  return gl;
}

export function renderer(gl) {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
}

// A CDT: what particles see of each other, and its depth.
class CollisionTexture {
  constructor(gl, width, height, format) {
    const [internal, type] = {
      rgba32f: [gl.RGBA32F, gl.FLOAT],
      rgba16f: [gl.RGBA16F, gl.HALF_FLOAT],
      rgba8: [gl.RGBA8, gl.UNSIGNED_BYTE],
    }[format];
    Object.assign(this, { gl, width, height, format });
    this.color = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.color);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, gl.RGBA, type, null);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    const depth = gl.createRenderbuffer();
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, width, height);
    this.framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.color, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE)
      throw new Error(`this browser cannot draw to a ${format} CDT of ${width} x ${height} texels`);
    this.clear();
  }

  bindTarget() {
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, this.framebuffer);
    this.gl.viewport(0, 0, this.width, this.height);
  }

  clear() {
    this.bindTarget();
    this.gl.clearBufferfv(this.gl.COLOR, 0, [0, 0, 0, 0]);
    this.gl.clearBufferfv(this.gl.DEPTH, 0, [1]);
  }

  // Stored codes, row 0 at the bottom.
  read() {
    const { gl, width, height } = this;
    this.bindTarget();
    const bytes = this.format === "rgba8";
    const texels = new (bytes ? Uint8Array : Float32Array)(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, bytes ? gl.UNSIGNED_BYTE : gl.FLOAT, texels);
    return bytes ? Float32Array.from(texels) : texels;
  }
}

// The frames of a scene (live_scene.js) under one of its runs, in the order of passes of gpu/collision/simulation.cpp.
export class Simulation {
  constructor(gl, files, scene, run) {
    Object.assign(this, { gl, scene, run });
    this.count = scene.particles;
    const captured = scene.record.fields.map(({ shader }) => `out_${shader}`);
    this.frame = 0;
    this.current = 0;
    this.collision = new Program(gl, files, "collision_pass", run.definitions, captured);
    const kind = { triangles: "obstacle_pass", vertices: "obstacle_vertices", off: null }[run.obstacles_in_cdt];
    this.obstacle = kind && scene.obstacles.indices.length > 0 ? new Program(gl, files, kind, run.definitions) : null;
    this.cdts = [0, 1].map(() => new CollisionTexture(gl, scene.width, scene.height, run.cdt_format));
    this.buffers = [0, 1].map(() => gl.createBuffer());
    this.arrays = this.buffers.map((buffer) => particleArray(gl, this.collision, buffer, scene.record));
    if (this.obstacle) this.mesh = meshArray(gl, this.obstacle, scene.obstacles);
    this.restart();
  }

  restart() {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[0]);
    gl.bufferData(gl.ARRAY_BUFFER, this.scene.start, gl.DYNAMIC_COPY);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[1]);
    gl.bufferData(gl.ARRAY_BUFFER, this.scene.start.byteLength, gl.DYNAMIC_COPY);
    this.cdts[0].clear();
    this.frame = 0;
    this.current = 0;
  }

  uniforms() {
    const {
      scene,
      scene: {
        constants,
        cdt_box: { min, max },
      },
    } = this;
    const size = max.map((x, i) => Math.fround(Math.fround(x) - Math.fround(min[i])));
    return {
      u_ProjView: matrix(scene.projView, this.frame),
      u_ClientWidth: scene.width,
      u_ClientHeight: scene.height,
      u_TexelCollideRange: constants.texel_collide_range,
      u_CollisionRange: constants.collision_range,
      u_CollisionTime: constants.collision_time,
      u_SpeedFactor: this.run.speed_factor,
      u_Tick: constants.tick,
      u_Gravity: constants.gravity,
      u_CdtBoxMin: min,
      u_CdtBoxStep: divided(size, [255, 255, 255]),
      u_CdtBoxScale: divided([255, 255, 255], size),
      u_CDTexture: 0,
    };
  }

  step() {
    const { gl } = this;
    const from = this.current,
      to = 1 - from;
    const uniforms = this.uniforms();
    gl.disable(gl.DITHER);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    this.cdts[to].clear();
    if (this.obstacle) {
      this.obstacle.use(uniforms);
      this.mesh.draw();
    }
    this.collision.use(uniforms);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.cdts[from].color);
    gl.bindVertexArray(this.arrays[from]);
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, this.buffers[to]);
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArrays(gl.POINTS, 0, this.count);
    gl.endTransformFeedback();
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
    gl.bindVertexArray(null);
    const error = gl.getError();
    if (error !== gl.NO_ERROR) throw new Error(`frame ${this.frame}: GL error 0x${error.toString(16)}`);
    this.current = to;
    ++this.frame;
  }

  get buffer() {
    return this.buffers[this.current];
  }

  // Records (scene.record).
  particles() {
    const { gl, scene } = this;
    const records = new Float32Array(scene.record.words * this.count);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.getBufferSubData(gl.ARRAY_BUFFER, 0, records);
    return records;
  }

  cdt() {
    return this.cdts[this.current].read();
  }
}
