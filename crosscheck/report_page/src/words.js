// Verdicts and classes in plain words.

export const VERDICTS = {
  AGREE: { tone: "good", mark: "✓", says: (items) => `Every bit of every ${items} is the same on both sides.` },
  LEGAL: {
    tone: "good",
    mark: "≈",
    says: "What differs is rounding or a tie that GL's precision rules allow. Nothing is wrong.",
  },
  UNDEFINED: {
    tone: "warn",
    mark: "?",
    says: "Some results rest on what GL leaves open, such as normalize() of a zero vector. The shader should not rely on them.",
  },
  DIVERGENT: {
    tone: "bad",
    mark: "✕",
    says: "The GPU computed something that no legal run explains: a mistake in a shader, the host, or the driver.",
  },
  DIFFER: {
    tone: "bad",
    mark: "≠",
    says: "The two sides are not the same bit for bit. Such a run is not judged: resync says which differences are legal.",
  },
  NONDETERMINISTIC: {
    tone: "bad",
    mark: "↯",
    says: "The GPU gave two answers to one and the same frame, so there is nothing to compare with.",
  },
};

export const CLASS_WORDS = {
  rounding: "another value, within GL's precision rules",
  tie: "another decision, which rounding can take",
  undefined: "rests on what GL leaves open",
  divergent: "no legal run explains it",
  "not judged": "differs; such a run is not judged",
  same: "every bit agrees",
};

export const ROW_WORDS = {
  same: "the reference's bits",
  rounding: "another value, in the interval that GLSL's precision rules allow",
  tie: "another decision, which follows from values that were rounded otherwise",
  follows: "other than the reference's, as it has to be after what differs above",
  undefined: "GL leaves it open",
  DIVERGENT: "does not follow from the GPU's own values above: here the mistake is made",
};

export const place = (item) => (item.texel ? `texel (${item.texel.join(", ")})` : `particle ${item.particle}`);
