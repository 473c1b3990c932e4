// Exact values of a frame's texels and particles; layout: crosscheck/report/page/frame_blobs.hpp, detail_blob.
import { blob, Reader, readHead } from "./data.js";
import { componentNames } from "./schema.js";

let names;

// Components of the first buffer's items.
export const particleFields = () => (names ??= componentNames(readHead().schema.resources[0]));
export const NOBODY = -1;
export const OBSTACLE = -2;

// Two sides of `count` items: bits of component c of item k.
function readValues(reader, count, components) {
  const reference = reader.words(count * components);
  const changes = reader.words(count * components);
  return (k) =>
    Array.from({ length: components }, (_, c) => {
      const at = c * count + k;
      return { reference: reference[at], gpu: (reference[at] ^ changes[at]) >>> 0 };
    });
}

// Where a value stands in a sorted array; -1: nowhere.
function find(sorted, value) {
  let low = 0;
  let high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < value) low = middle + 1;
    else high = middle;
  }
  return sorted[low] === value ? low : -1;
}

function decode(bytes) {
  const reader = new Reader(bytes);
  const texelCount = reader.word();
  const particleCount = reader.word();
  const particles = reader.words(particleCount);
  const particleClasses = reader.bytes(particleCount);
  const particleValues = readValues(reader, particleCount, particleFields().length);
  const texels = reader.words(texelCount);
  const texelClasses = reader.bytes(texelCount);
  const owners = readValues(reader, texelCount, 1);
  const texelValues = readValues(reader, texelCount, 4);
  // The first three components are stored as what is left of the owner's position.
  const stored = (k, owner) => {
    const values = texelValues(k);
    const listed = find(particles, owner);
    if (listed < 0) return values;
    const position = particleValues(listed);
    const restored = (bits, c) => (c < 3 ? (bits ^ position[c].reference) >>> 0 : bits);
    return values.map(({ reference, gpu }, c) => ({ reference: restored(reference, c), gpu: restored(gpu, c) }));
  };
  return {
    texel(index) {
      const k = find(texels, index);
      if (k < 0) return null;
      const [owner] = owners(k);
      return {
        owners: { reference: owner.reference | 0, gpu: owner.gpu | 0 },
        kind: texelClasses[k],
        values: stored(k, owner.reference),
      };
    },
    particle(index) {
      const k = find(particles, index);
      return k < 0 ? null : { kind: particleClasses[k], values: particleValues(k) };
    },
  };
}

const decoded = new Map();

// A promise of those of a kept frame; null where it has none.
export function readDetail({ detail, frame }) {
  if (detail === "none") return null;
  if (!decoded.has(frame)) decoded.set(frame, blob(`detail-${frame}`).then(decode));
  return decoded.get(frame);
}
