import { meshArray, particleArray } from "./attributes.js";
import { matrix } from "./live_scene.js";
import { Program } from "./program.js";

// The rendered frame (shaders/collision/render_*), drawn to the canvas, in the order of gpu/collision/render_pass.cpp.
export class RenderPass {
  constructor(gl, files, scene, definitions, buffers) {
    Object.assign(this, { gl, scene });
    const program = (name) => new Program(gl, files, name, definitions);
    this.background = program("render_background");
    this.particles = program("render_pass");
    this.arrays = new Map(buffers.map((buffer) => [buffer, particleArray(gl, this.particles, buffer, scene.record)]));
    if (scene.obstacles.indices.length > 0) {
      this.obstacles = program("render_obstacles");
      this.mesh = meshArray(gl, this.obstacles, scene.obstacles);
    }
    this.empty = gl.createVertexArray();
  }

  // Particles of `buffer`, seen as the render camera does in `frame`.
  run(buffer, frame) {
    const { gl, scene } = this;
    const { width, height } = gl.canvas;
    const uniforms = {
      u_View: matrix(scene.renderView, frame),
      u_Projection: matrix(scene.renderProjection, frame),
      u_ClientWidth: width,
      u_ClientHeight: height,
      u_BillboardRadius: scene.constants.billboard_radius,
      u_CollisionTime: scene.constants.collision_time,
    };
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.disable(gl.DEPTH_TEST);
    gl.bindVertexArray(this.empty);
    this.background.use(uniforms);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LESS);
    if (this.obstacles) {
      this.obstacles.use(uniforms);
      this.mesh.draw();
    }
    gl.bindVertexArray(this.arrays.get(buffer));
    this.particles.use(uniforms);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, this.particles.maxVertices, scene.particles);
    gl.bindVertexArray(null);
  }
}
