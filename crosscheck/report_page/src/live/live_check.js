import { RenderPass } from "./render_pass.js";
import { context, Simulation } from "./simulation.js";
import { cdtHash, hashText, particleHash, stateHash } from "./state_hash.js";

// One run of a scene on this browser's GPU; the state hash of the first frames is held against the references'.
export class LiveCheck {
  constructor(canvas, shaders, scene, run) {
    this.gl = context(canvas);
    this.scene = scene;
    this.run = run;
    this.simulation = new Simulation(this.gl, shaders, scene, run);
    // The picture is not compared, so plain arithmetic will do for it, which is faster.
    const plain = scene.runs.find(({ exact }) => !exact) ?? run;
    this.render = new RenderPass(this.gl, shaders, scene, plain.definitions, this.simulation.buffers);
    this.hashes = [];
  }

  // Frames done, and how many of them were checked.
  get frames() {
    return this.simulation.frame;
  }

  get checked() {
    return this.hashes.length;
  }

  get done() {
    return this.frames === this.scene.frames;
  }

  step() {
    this.simulation.step();
    if (this.frames > this.scene.checked_frames) return;
    const particles = hashText(particleHash(this.simulation.particles(), this.scene.record));
    this.hashes.push({ particles, cdt: hashText(cdtHash(this.simulation.cdt(), this.scene.record)) });
  }

  // Of the last frame's state, as `lockstep hash` prints it.
  stateHash() {
    return hashText(stateHash(particleHash(this.simulation.particles(), this.scene.record), cdtHash(this.simulation.cdt(), this.scene.record)));
  }

  draw() {
    this.render.run(this.simulation.buffer, Math.max(0, this.frames - 1));
  }

  // The reference that most frames agree with, and of each frame whether particles and CDT do.
  closest() {
    return this.run.references
      .map((reference) => {
        const frames = this.hashes.map(({ particles, cdt }, frame) => ({
          particles: particles === reference.particle_hashes[frame],
          cdt: cdt === reference.cdt_hashes[frame],
        }));
        return { profile: reference.profile, frames, agreeing: frames.filter((f) => f.particles && f.cdt).length };
      })
      .reduce((a, b) => (b.agreeing > a.agreeing ? b : a));
  }

  release() {
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }
}
