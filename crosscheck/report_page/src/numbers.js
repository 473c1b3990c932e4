// Floats by their bits, and numbers as people read them.

const view = new DataView(new ArrayBuffer(4));

export function asFloat(bits) {
  view.setUint32(0, bits);
  return view.getFloat32(0);
}

const isNan = (bits) => (bits & 0x7fffffff) > 0x7f800000;
const ordered = (bits) => (bits >>> 31 ? -(bits & 0x7fffffff) : bits);

// Two NaNs are equal.
export const sameBits = (a, b) => a === b || (isNan(a) && isNan(b));

export function ulpText(a, b) {
  if (sameBits(a, b)) return "0";
  if (isNan(a) || isNan(b)) return "NaN";
  const distance = Math.abs(ordered(a) - ordered(b));
  if (distance === 0) return "sign of 0";
  return (a ^ b) < 0 && asFloat(a) !== 0 && asFloat(b) !== 0 ? "other sign" : grouped(distance);
}

// The worst distance that a run counted; more than floats of one sign can have is of two signs.
export const worstUlp = (ulp) => (ulp === null ? "NaN on one side" : ulp > 0x7f800000 ? "other signs among them" : `at most ${grouped(ulp)} ULP`);

// A float as C's %a wrote it, in decimals; another text as it is.
export function decimalOfHex(text) {
  const [, sign, whole, fraction = "", power] = /^(-?)0x([01])\.?([0-9a-f]*)p([+-]\d+)$/.exec(text) ?? [];
  if (power === undefined) return text;
  view.setFloat32(0, (sign ? -1 : 1) * parseInt(`${whole}${fraction}`, 16) * 16 ** -fraction.length * 2 ** Number(power));
  return decimal(view.getUint32(0));
}

// The shortest of up to 9 digits that gives the float back.
export function decimal(bits) {
  const value = asFloat(bits);
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "NaN" : value > 0 ? "inf" : "-inf";
  for (let digits = 1; digits < 9; ++digits)
    if (Math.fround(Number(value.toPrecision(digits))) === value) return tidy(value, digits);
  return tidy(value, 9);
}

function tidy(value, digits) {
  if (Object.is(value, -0)) return "-0";
  return String(Number(value.toPrecision(digits)));
}

// As C's %a writes it.
export function hexFloat(bits) {
  const value = asFloat(bits);
  if (!Number.isFinite(value)) return decimal(bits);
  const sign = bits >>> 31 ? "-" : "";
  const exponent = (bits >>> 23) & 0xff;
  const fraction = bits & 0x7fffff;
  if (exponent === 0 && fraction === 0) return `${sign}0x0p+0`;
  let power = exponent - 127;
  let mantissa = fraction;
  if (exponent === 0) {
    power = -126;
    while (!(mantissa & 0x800000)) {
      mantissa <<= 1;
      --power;
    }
    mantissa &= 0x7fffff;
  }
  const digits = (mantissa << 1).toString(16).padStart(6, "0").replace(/0+$/, "");
  return `${sign}0x1${digits && `.${digits}`}p${power < 0 ? "" : "+"}${power}`;
}

export const grouped = (value) => value.toLocaleString("en-US");

export function counted(count, one, many = `${one}s`) {
  return `${grouped(count)} ${count === 1 ? one : many}`;
}
