// What the reader looks at: a frame, a texel under the pointer, an item whose steps are shown. The parts of the page
// listen for "frame", "texel" and "item".
export class Selection extends EventTarget {
  constructor(head) {
    super();
    this.last = head.report.frames - 1;
    this.frame = Math.min(Math.max(head.report.first_frame ?? this.last, 0), this.last);
    this.texel = null; // {x, y, pinned}
    this.item = null; // index into head.items
  }
  setFrame(frame) {
    const next = Math.min(Math.max(Math.round(frame), 0), this.last);
    if (next === this.frame) return;
    this.frame = next;
    this.dispatchEvent(new Event("frame"));
  }
  setTexel(texel) {
    this.texel = texel;
    this.dispatchEvent(new Event("texel"));
  }
  setItem(item, { scroll = true } = {}) {
    this.item = item;
    this.dispatchEvent(new CustomEvent("item", { detail: { scroll } }));
  }
}
