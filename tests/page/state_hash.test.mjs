import assert from "node:assert/strict";
import { test } from "node:test";
import { cdtHash, hashText, particleHash, stateHash } from "../../crosscheck/report_page/src/live/state_hash.js";

// As reference/model/state_hash.cpp reads, with 64-bit integers.
const mask = (1n << 64n) - 1n;

function splitmix64(x) {
  x = (x + 0x9e3779b97f4a7c15n) & mask;
  x = ((x ^ (x >> 30n)) * 0xbf58476d1ce4e5b9n) & mask;
  x = ((x ^ (x >> 27n)) * 0x94d049bb133111ebn) & mask;
  return x ^ (x >> 31n);
}

function hashWords(seed, words) {
  let sum = 0n;
  words.forEach((word, i) => {
    const canonical = (word & 0x7fffffff) > 0x7f800000 ? 0x7fc00000 : word;
    sum = (sum + splitmix64((seed << 60n) + ((BigInt(i) << 32n) | BigInt(canonical)))) & mask;
  });
  return splitmix64(sum ^ BigInt(words.length));
}

const text = (hash) => (hash & mask).toString(16).padStart(16, "0");

function particles(words) {
  const field = (offset, count) =>
    Array.from({ length: (words.length / 8) * count }, (_, i) => words[8 * Math.floor(i / count) + offset + (i % count)]);
  return hashWords(1n, field(0, 3)) + hashWords(2n, field(4, 3)) + hashWords(3n, field(3, 1)) + hashWords(4n, field(7, 1));
}

function randomWords(count) {
  let state = 1;
  return Uint32Array.from({ length: count }, () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0));
}

const record = {
  words: 8,
  fields: [
    { offset: 0, components: 3, column: 0 },
    { offset: 3, components: 1, column: 2 },
    { offset: 4, components: 3, column: 1 },
    { offset: 7, components: 1, column: 3 },
  ],
};

const floats = (words) => new Float32Array(words.buffer);

test("state hash: as with 64-bit integers, for any bits", () => {
  const state = randomWords(8 * 500);
  const image = randomWords(4 * 700);
  assert.equal(hashText(particleHash(floats(state), record)), text(particles(state)));
  assert.equal(hashText(cdtHash(floats(image), record)), text(hashWords(5n, [...image])));
  assert.equal(
    hashText(stateHash(particleHash(floats(state), record), cdtHash(floats(image), record))),
    text(splitmix64(particles(state) & mask) + hashWords(5n, [...image])),
  );
});

test("state hash: every NaN is one, and the zeros are two", () => {
  const hash = (...words) => hashText(cdtHash(floats(Uint32Array.from([...words, 0, 0])), record));
  assert.equal(hash(0x7fc00000, 0xffc00001), hash(0x7f800001, 0x7fc00000));
  assert.notEqual(hash(0x80000000, 0), hash(0, 0));
  assert.notEqual(hash(0, 1), hash(1, 0));
});

test("state hash: of nothing it is 0", () => {
  assert.equal(hashText(particleHash(new Float32Array(), record)), "0000000000000000");
  assert.equal(hashText(cdtHash(new Float32Array(), record)), "0000000000000000");
});
