// The states of a run as a file: one line of JSON, then the start's records, then records and CDT of each frame, all
// little-endian floats; gzip. scripts/trace_of_states.py makes a trace of it.
export async function savedStates(check, renderer, onFrame) {
  const { scene, run, simulation } = check;
  const { particles, checked_frames: frames, width, height } = scene;
  const head = { lockstep: "states 1", scene: scene.scene, run: run.name, renderer, particles, frames, width, height };
  const parts = [`${JSON.stringify(head)}\n`, scene.start];
  simulation.restart();
  for (let frame = 0; frame < frames; ++frame) {
    simulation.step();
    parts.push(simulation.particles(), simulation.cdt());
    await onFrame(frame);
  }
  const packed = new Blob(parts).stream().pipeThrough(new CompressionStream("gzip"));
  return new Response(packed).blob();
}
