// What the program put into the page: a JSON head, and binary blobs as base64 of zlib streams (crosscheck/report/page/).

export function readHead() {
  return JSON.parse(document.getElementById("lockstep-head").textContent);
}

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const kept = new Map();

// The bytes of a blob, unpacked once.
export function blob(name) {
  if (!kept.has(name)) kept.set(name, inflate(fromBase64(document.getElementById(`lockstep-${name}`).textContent)));
  return kept.get(name);
}

export async function jsonBlob(name) {
  return JSON.parse(new TextDecoder().decode(await blob(name)));
}

// Reads bytes as crosscheck/report/page/blob.hpp writes them.
export class Reader {
  constructor(bytes) {
    this.data = bytes;
    this.at = 0;
  }
  word() {
    const b = this.bytes(4);
    return (b[0] | (b[1] << 8) | (b[2] << 16) | (b[3] << 24)) >>> 0;
  }
  bytes(count) {
    this.at += count;
    return this.data.subarray(this.at - count, this.at);
  }
  bits(count) {
    const packed = this.bytes(Math.ceil(count / 8));
    return (i) => (packed[i >> 3] >> (i & 7)) & 1;
  }
  words(count) {
    const planes = this.bytes(4 * count);
    const words = new Uint32Array(count);
    for (let i = 0; i < count; ++i)
      words[i] =
        planes[i] | (planes[count + i] << 8) | (planes[2 * count + i] << 16) | (planes[3 * count + i] << 24);
    return words;
  }
}
