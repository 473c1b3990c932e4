// The slider over a run's frames, with marks where something is kept of one, and buttons to those that differ.
import { h } from "./dom.js";

// `marks`: {frame, differs} each; `differing`: frames, in order.
export function frameSlider(selection, marks, differing) {
  const range = h("input", { type: "range", id: "frame", min: "0", max: String(selection.last), step: "1", value: String(selection.frame), input: () => selection.setFrame(Number(range.value)) });
  const number = h("input", { type: "number", id: "frame-number", "aria-label": "frame number", min: "0", max: String(selection.last), value: String(selection.frame), change: () => selection.setFrame(Number(number.value)) });
  const go = (text, words, frame) => h("button", { type: "button", title: words, "aria-label": words, click: () => frame() !== undefined && selection.setFrame(frame()) }, text);
  const along = (frame) => `left: ${selection.last ? (100 * frame) / selection.last : 0}%`;
  const track = h("div", { class: "marks", "aria-hidden": "true" });
  for (const mark of marks) track.append(h("span", { class: mark.differs ? "differs" : "", style: along(mark.frame) }));
  selection.addEventListener("frame", () => {
    range.value = number.value = String(selection.frame);
  });
  return h(
    "div",
    { class: "slider" },
    h("label", { for: "frame" }, "Frame"),
    h("div", { class: "track" }, range, track),
    number,
    h(
      "div",
      { class: "buttons" },
      go("‹", "One frame back", () => selection.frame - 1),
      go("›", "One frame on", () => selection.frame + 1),
      go("‹ ≠", "The frame before that differs", () => differing.findLast((f) => f < selection.frame)),
      go("≠ ›", "The next frame that differs", () => differing.find((f) => f > selection.frame)),
    ),
  );
}
