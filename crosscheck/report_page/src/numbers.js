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
  return distance === 0 ? "sign of 0" : grouped(distance);
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
