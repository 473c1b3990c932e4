// A frame's CDT of both sides in 63 shades a component; layout: crosscheck/report/page/frame_blobs.hpp, picture_blob.
import { blob, Reader } from "./data.js";

export const CLASS_NAMES = ["rounding", "tie", "undefined", "divergent", "not judged", "same"];
export const UNJUDGED = 4;
export const SAME = 5;

function readShades(reader, count) {
  return [reader.bytes(count), reader.bytes(count), reader.bytes(count)];
}

function decode(bytes, texels) {
  const reader = new Reader(bytes);
  reader.bytes(24); // the box: what shade is what position
  const drawn = reader.bits(texels);
  const reference = new Uint8Array(texels * 4); // x, y, z shades; 1 where drawn
  const where = [];
  for (let i = 0; i < texels; ++i) if (drawn(i)) where.push(i);
  const put = (image, index, shades, k) => {
    for (let c = 0; c < 3; ++c) image[index * 4 + c] = shades[c][k];
    image[index * 4 + 3] = 1;
  };
  const shades = readShades(reader, where.length);
  where.forEach((index, k) => put(reference, index, shades, k));

  const gpu = reference.slice();
  const classes = new Uint8Array(texels).fill(SAME);
  const differing = reader.word();
  if (differing > 0) {
    const differs = reader.bits(texels);
    const kinds = reader.bytes(differing);
    const onGpu = reader.bits(differing);
    const items = [];
    for (let i = 0; i < texels; ++i) if (differs(i)) items.push(i);
    const shown = items.filter((_, k) => onGpu(k));
    const gpuShades = readShades(reader, shown.length);
    items.forEach((index, k) => {
      classes[index] = kinds[k];
      gpu.fill(0, index * 4, index * 4 + 4);
    });
    shown.forEach((index, k) => put(gpu, index, gpuShades, k));
  }
  return { reference, gpu, classes, differing };
}

// Of a frame that is kept.
export async function readPicture(frame, head) {
  return decode(await blob(`picture-${frame}`), head.width * head.height);
}
