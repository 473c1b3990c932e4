// The item at a texel, or of the particles that own it.
export function itemAt(head, frame, texel, owners) {
  const here = head.items.findIndex((item) => item.frame === frame && item.texel?.[0] === texel.x && item.texel?.[1] === texel.y);
  return here >= 0 ? here : head.items.findIndex((item) => item.frame === frame && owners.includes(item.particle));
}
