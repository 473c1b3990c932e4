// What crosscheck/report/page/live_scene.cpp put into the page, ready to run.
import { Reader } from "../data.js";

const floats = (words) => new Float32Array(words.buffer);

// Fields one after the other, in the order of their columns, to records.
function records(reader, { words, fields }, count) {
  const all = new Float32Array(words * count);
  for (const { components, offset } of [...fields].sort((a, b) => a.column - b.column)) {
    const values = floats(reader.words(components * count));
    for (let i = 0; i < count; ++i) all.set(values.subarray(components * i, components * (i + 1)), words * i + offset);
  }
  return all;
}

// head: the JSON; bytes: the arrays that go with it.
export function liveScene(head, bytes) {
  const reader = new Reader(bytes);
  return {
    ...head,
    start: records(reader, head.record, head.particles),
    obstacles: { positions: floats(reader.words(3 * head.corners)), indices: reader.words(3 * head.triangles) },
    projView: floats(reader.words(16 * head.frames)),
    renderView: floats(reader.words(16 * head.frames)),
    renderProjection: floats(reader.words(16 * head.frames)),
  };
}

export const matrix = (all, frame) => all.subarray(16 * frame, 16 * frame + 16);
