// What crosscheck/page/live_scene.cpp put into the page, ready to run.
import { Reader } from "../data.js";

const floats = (words) => new Float32Array(words.buffer);

// Fields one after the other to records of 8 floats: position, speed, direction, collide time.
function records(reader, count) {
  const [position, direction, speed, collideTime] = [3, 3, 1, 1].map((n) => floats(reader.words(n * count)));
  const all = new Float32Array(8 * count);
  for (let i = 0; i < count; ++i) {
    all.set(position.subarray(3 * i, 3 * i + 3), 8 * i);
    all[8 * i + 3] = speed[i];
    all.set(direction.subarray(3 * i, 3 * i + 3), 8 * i + 4);
    all[8 * i + 7] = collideTime[i];
  }
  return all;
}

// head: the JSON; bytes: the arrays that go with it.
export function liveScene(head, bytes) {
  const reader = new Reader(bytes);
  return {
    ...head,
    start: records(reader, head.particles),
    obstacles: { positions: floats(reader.words(3 * head.corners)), indices: reader.words(3 * head.triangles) },
    projView: floats(reader.words(16 * head.frames)),
    renderView: floats(reader.words(16 * head.frames)),
    renderProjection: floats(reader.words(16 * head.frames)),
  };
}

export const matrix = (all, frame) => all.subarray(16 * frame, 16 * frame + 16);
