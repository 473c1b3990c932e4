// The state hash of reference/model/state_hash.hpp, as two 32-bit halves [high, low] a number.

const add = ([ah, al], [bh, bl]) => {
  const low = (al >>> 0) + (bl >>> 0);
  return [(ah + bh + (low > 0xffffffff ? 1 : 0)) >>> 0, low >>> 0];
};

const xor = ([ah, al], [bh, bl]) => [(ah ^ bh) >>> 0, (al ^ bl) >>> 0];

// The high half of a 32-bit product.
function high(a, b) {
  const ah = a >>> 16,
    al = a & 0xffff,
    bh = b >>> 16,
    bl = b & 0xffff;
  const middle = ah * bl + ((al * bl) >>> 16);
  return (ah * bh + Math.floor(middle / 0x10000) + (((al * bh + (middle & 0xffff)) / 0x10000) >>> 0)) >>> 0;
}

// Sum of splitmix64(seed + (i << 32 | word i)) over words, one stride apart, modulo 2^64. The seed's low half is 0.
export class HashSum {
  constructor() {
    this.high = 0;
    this.low = 0;
  }

  // splitmix64 of (h, l), added to the sum.
  add(h, l) {
    let low = (l >>> 0) + 0x7f4a7c15;
    h = (h + 0x9e3779b9 + (low > 0xffffffff ? 1 : 0)) >>> 0;
    l = low >>> 0;

    l ^= (l >>> 30) | (h << 2);
    h ^= h >>> 30;
    h = (Math.imul(h, 0x1ce4e5b9) + Math.imul(l, 0xbf58476d) + high(l >>> 0, 0x1ce4e5b9)) >>> 0;
    l = Math.imul(l, 0x1ce4e5b9) >>> 0;

    l ^= (l >>> 27) | (h << 5);
    h ^= h >>> 27;
    h = (Math.imul(h, 0x133111eb) + Math.imul(l, 0x94d049bb) + high(l >>> 0, 0x133111eb)) >>> 0;
    l = Math.imul(l, 0x133111eb) >>> 0;

    l = (l ^ ((l >>> 31) | (h << 1))) >>> 0;
    h = (h ^ (h >>> 31)) >>> 0;
    low = this.low + l;
    this.high = (this.high + h + (low > 0xffffffff ? 1 : 0)) >>> 0;
    this.low = low >>> 0;
  }

  get value() {
    return [this.high, this.low];
  }
}

function mixed([h, l]) {
  const sum = new HashSum();
  sum.add(h, l);
  return sum.value;
}

const isNan = (word) => (word & 0x7fffffff) > 0x7f800000;

// Of the `components` words from `offset` on in each record of `stride` words.
function field(seed, words, stride, offset, components) {
  const sum = new HashSum();
  let i = 0;
  for (let record = offset; record < words.length; record += stride)
    for (let c = 0; c < components; ++c, ++i) {
      const word = words[record + c];
      sum.add((seed + i) >>> 0, isNan(word) ? 0x7fc00000 : word);
    }
  return mixed(xor(sum.value, [0, i]));
}

const words = (floats) => new Uint32Array(floats.buffer, floats.byteOffset, floats.length);

// High half of the seed of the k-th column of a state, counted from 0, of which there are at most 15.
const seed = (column) => ((column + 1) << 28) >>> 0;

// Of records that each hold `fields` at their offsets.
export function particleHash(records, { words: stride, fields }) {
  const all = words(records);
  if (all.length === 0) return [0, 0];
  return fields.map(({ column, offset, components }) => field(seed(column), all, stride, offset, components)).reduce(add);
}

// Of the stored codes of a CDT, whose column follows the particles' ones.
export function cdtHash(codes, { fields }) {
  return codes.length === 0 ? [0, 0] : field(seed(fields.length), words(codes), 4, 0, 4);
}

export const stateHash = (particles, cdt) => add(mixed(particles), cdt);

export const hashText = (halves) => halves.map((half) => half.toString(16).padStart(8, "0")).join("");

export function hashFromText(text) {
  return [parseInt(text.slice(0, 8), 16), parseInt(text.slice(8), 16)];
}
