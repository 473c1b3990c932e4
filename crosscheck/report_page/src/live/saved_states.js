// The states of a run as a file: one line of JSON, the start's records, obstacles, then records and CDT of each frame;
// little endian, gzip. scripts/trace_of_states.py makes a trace of it.
export async function savedStates(check, renderer, onFrame) {
  const { scene, run, simulation } = check;
  const { particles, checked_frames: frames, width, height } = scene;
  const { scene: name, corners, triangles, obstacles } = scene;
  const size = { particles, frames, width, height, corners, triangles, record: scene.record };
  const head = { lockstep: "states 1", scene: name, run: run.name, settings: run.settings, renderer, ...size };
  const parts = [`${JSON.stringify(head)}\n`, scene.start, obstacles.positions, obstacles.indices];
  simulation.restart();
  for (let frame = 0; frame < frames; ++frame) {
    simulation.step();
    parts.push(simulation.particles(), simulation.cdt());
    await onFrame(frame);
  }
  const packed = new Blob(parts).stream().pipeThrough(new CompressionStream("gzip"));
  return new Response(packed).blob();
}
