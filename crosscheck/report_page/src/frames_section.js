// The frame slider, and the CDT of both sides with their difference in the frame it stands on.
import { h, section } from "./dom.js";
import { frameSlider } from "./frame_slider.js";
import { counted, grouped, worstUlp } from "./numbers.js";
import { CLASS_NAMES, readPicture, SAME } from "./picture.js";

const SIDES = [
  ["reference", "Reference"],
  ["gpu", "GPU"],
  ["difference", "Difference"],
];
const EMPTY = [18, 20, 26];
const NOT_FINITE = [255, 0, 255];
export const CLASS_COLOURS = {
  rounding: [92, 160, 255],
  tie: [176, 120, 255],
  undefined: [255, 190, 60],
  divergent: [255, 72, 66],
  "not judged": [255, 140, 60],
  same: [104, 110, 122],
};

function colourOf(picture, side, index) {
  const image = side === "gpu" ? picture.gpu : picture.reference;
  const drawn = image[index * 4 + 3];
  if (side === "difference") {
    if (picture.classes[index] !== SAME) return CLASS_COLOURS[CLASS_NAMES[picture.classes[index]]];
    return drawn ? CLASS_COLOURS.same : EMPTY;
  }
  if (!drawn) return EMPTY;
  const [x, y, z] = image.subarray(index * 4, index * 4 + 3);
  return x && y && z ? [60 + x * 3, 60 + y * 3, 60 + z * 3] : NOT_FINITE;
}

function put(image, at, colour) {
  for (let c = 0; c < 3; ++c) image.data[at * 4 + c] = colour[c];
  image.data[at * 4 + 3] = 255;
}

// A part of a picture, one pixel a texel. Row 0 of a CDT is its bottom one.
export function paint(canvas, picture, side, head, left = 0, bottom = 0) {
  const context = canvas.getContext("2d");
  const image = context.createImageData(canvas.width, canvas.height);
  for (let row = 0; row < canvas.height; ++row)
    for (let column = 0; column < canvas.width; ++column) {
      const x = left + column;
      const y = bottom + row;
      if (x >= 0 && x < head.width && y >= 0 && y < head.height)
        put(image, (canvas.height - 1 - row) * canvas.width + column, colourOf(picture, side, y * head.width + x));
    }
  context.putImageData(image, 0, 0);
}

// A single texel is hardly seen in a large image: those that differ get a ring.
function ring(canvas, picture, { width, height }) {
  if (width * height < 200 * 200 || picture.differing > 5000) return;
  const context = canvas.getContext("2d");
  context.lineWidth = 1;
  for (let index = 0; index < picture.classes.length; ++index)
    if (picture.classes[index] !== SAME) {
      context.strokeStyle = `rgb(${CLASS_COLOURS[CLASS_NAMES[picture.classes[index]]]})`;
      context.strokeRect((index % width) - 1.5, height - 1 - Math.floor(index / width) - 1.5, 4, 4);
    }
}

export class Frames {
  constructor(head, series, selection) {
    this.head = head;
    this.series = series;
    this.selection = selection;
    this.picture = null; // of this.kept
    this.kept = null;
    this.canvases = {};
    this.views = [];
    this.untold = head.report.fields.texel.compared === 0;
    this.differing = series.frame.filter(
      (_, i) => series.resync.particles[i] + series.resync.texels[i] + series.free.particles[i] + series.free.texels[i] > 0,
    );
  }

  // The kept frame nearest to one.
  nearest(frame) {
    return this.head.frames.reduce((best, kept) => (Math.abs(kept.frame - frame) < Math.abs(best.frame - frame) ? kept : best));
  }

  async show() {
    if (this.head.frames.length === 0) return;
    const wanted = this.nearest(this.selection.frame);
    if (wanted === this.kept) return;
    this.kept = wanted;
    const picture = await readPicture(wanted.frame, this.head);
    if (this.kept !== wanted) return; // moved on meanwhile
    this.picture = picture;
    for (const [side] of SIDES) paint(this.canvases[side], picture, side, this.head);
    ring(this.canvases.difference, picture, this.head);
    if (performance.getEntriesByName("first-picture").length === 0) await this.firstShown();
    this.selection.dispatchEvent(new Event("picture"));
  }

  // What takes longer waits until there is something to see.
  async firstShown() {
    await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    performance.mark("first-picture");
    if (!this.selection.texel) this.selection.setTexel(this.telling());
  }

  // A texel worth a look: the first that differs, else one drawn near the middle.
  telling() {
    const { width, height } = this.head;
    const { classes, reference } = this.picture;
    const texel = (index) => ({ x: index % width, y: Math.floor(index / width) });
    const differing = classes.findIndex((kind) => kind !== SAME);
    if (differing >= 0) return texel(differing);
    const middle = (width * height + width) >> 1;
    for (let away = 0; away <= middle; ++away)
      for (const index of [middle + away, middle - away]) if (reference[index * 4 + 3]) return texel(index);
    return null;
  }

  statistics() {
    const { series, selection } = this;
    let i = series.frame.findIndex((frame) => frame > selection.frame) - 1;
    if (i < 0) i = series.frame.length - 1;
    const say = (side) => {
      const of = series[side];
      return of.particles[i] + of.texels[i] === 0
        ? `${side}: every bit agrees`
        : `${side}: ${counted(of.particles[i], "particle")} and ${counted(of.texels[i], "texel")} differ, ${worstUlp(of.ulp[i])}`;
    };
    return `Frame ${grouped(selection.frame)}: ${say("resync")}; ${say("free")}.`;
  }

  pictureWords() {
    if (!this.kept) return "No picture found room on this page.";
    const of = this.kept.frame === this.selection.frame ? "this frame" : `frame ${grouped(this.kept.frame)}, the nearest that is kept`;
    const values = { whole: "with all exact values", differing: "with the exact values of what differs", none: "without exact values" };
    const untold = this.untold ? " The GPU's CDT was not recorded: here the reference drew it of the GPU's particles." : "";
    return `Pictures of ${of}, ${values[this.kept.detail]}.${untold}`;
  }

  // One of the three pictures; the pointer and the arrow keys choose a texel, a click or Enter asks for its steps.
  figure(side, title) {
    const { width, height } = this.head;
    const canvas = h("canvas", { width: String(width), height: String(height) });
    this.canvases[side] = canvas;
    const cross = h("span", { class: "cross", hidden: true });
    const pointed = (event) => {
      const box = canvas.getBoundingClientRect();
      const x = Math.floor(((event.clientX - box.left) / box.width) * width);
      const y = height - 1 - Math.floor(((event.clientY - box.top) / box.height) * height);
      return { x: Math.min(Math.max(x, 0), width - 1), y: Math.min(Math.max(y, 0), height - 1) };
    };
    const button = h(
      "button",
      {
        type: "button",
        class: "picture",
        "data-side": side,
        "aria-describedby": "keys",
        "aria-label": `${title}: CDT, ${width} by ${height} texels`,
        mousemove: (event) => !this.selection.texel?.pinned && this.selection.setTexel(pointed(event)),
        click: (event) => {
          // A key's click has no place of its own.
          const texel = event.detail === 0 ? this.selection.texel : pointed(event);
          if (texel) this.selection.setTexel({ ...texel, pinned: true, asked: true });
        },
        keydown: (event) => this.key(event),
      },
      canvas,
      cross,
    );
    this.selection.addEventListener("texel", () => {
      const { texel } = this.selection;
      cross.hidden = !texel;
      if (texel) {
        cross.style.left = `${(100 * (texel.x + 0.5)) / width}%`;
        cross.style.top = `${(100 * (height - texel.y - 0.5)) / height}%`;
      }
    });
    const view = h("div", { class: "view" }, button);
    this.views.push({ view, button });
    return h("figure", {}, h("figcaption", {}, title), view);
  }

  // All three pictures alike, the chosen texel in the middle.
  zoom(times) {
    const { width, height } = this.head;
    const { x, y } = this.selection.texel ?? { x: width / 2, y: height / 2 };
    for (const { view, button } of this.views) {
      view.style.aspectRatio = `${width} / ${height}`;
      button.style.width = `${100 * times}%`;
      view.scrollLeft = (button.offsetWidth * (x + 0.5)) / width - view.clientWidth / 2;
      view.scrollTop = (button.offsetHeight * (height - y - 0.5)) / height - view.clientHeight / 2;
    }
  }

  zoomChoice() {
    const choice = h("select", { id: "zoom", change: () => this.zoom(Number(choice.value)) }, [1, 2, 4, 8].map((times) => h("option", { value: String(times) }, times === 1 ? "whole" : `${times} times`)));
    for (const { view } of this.views)
      view.addEventListener("scroll", () => {
        for (const other of this.views) if (other.view !== view) Object.assign(other.view, { scrollLeft: view.scrollLeft, scrollTop: view.scrollTop });
      });
    return h("p", { class: "choices" }, h("label", { for: "zoom" }, "Zoom "), choice);
  }

  key(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const { width, height } = this.head;
    if (event.key === "Escape") return this.selection.setTexel(null);
    if (event.key === "n" || event.key === "p") return this.nextDifference(event.key === "n" ? 1 : -1);
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    const by = event.shiftKey ? 10 : 1;
    const from = this.selection.texel ?? { x: width >> 1, y: height >> 1 };
    const within = (value, limit) => Math.min(Math.max(value, 0), limit - 1);
    this.selection.setTexel({ x: within(from.x + by * step[0], width), y: within(from.y + by * step[1], height), pinned: true });
  }

  nextDifference(direction) {
    if (!this.picture) return;
    const { width } = this.head;
    const { classes } = this.picture;
    const { texel } = this.selection;
    let index = texel ? texel.y * width + texel.x : direction > 0 ? -1 : classes.length;
    do index += direction;
    while (index >= 0 && index < classes.length && classes[index] === SAME);
    if (index >= 0 && index < classes.length) this.selection.setTexel({ x: index % width, y: Math.floor(index / width), pinned: true });
  }

  legend() {
    const used = new Set(["divergent", "same"]);
    const { verdicts } = this.head.report;
    if (verdicts) for (const name of CLASS_NAMES.slice(0, 4)) if (verdicts.texels[name] > 0) used.add(name);
    if (this.untold) used.add("not judged").delete("divergent");
    if (!verdicts) used.add("not judged").delete("divergent");
    const chip = (name) => h("span", { class: "chip" }, h("span", { class: "swatch", style: `background: rgb(${CLASS_COLOURS[name]})` }), name);
    return h("p", { class: "legend" }, "Position as colour: x red, y green, z blue. Difference: ", [...used].map(chip));
  }

  section(inspector) {
    const statistics = h("p", { class: "statistics", "aria-live": "polite" });
    const words = h("p", { class: "muted", id: "picture-words" });
    const tell = () => {
      statistics.textContent = this.statistics();
      words.textContent = this.pictureWords();
    };
    this.selection.addEventListener("frame", () => {
      this.show();
      tell();
    });
    this.selection.addEventListener("picture", tell);
    const part = section(
      "frames",
      "Frame by frame",
      frameSlider(this.selection, this.head.frames, this.differing),
      statistics,
      h("div", { class: "pictures" }, SIDES.map(([side, title]) => this.figure(side, title))),
      this.zoomChoice(),
      words,
      this.legend(),
      h(
        "p",
        { class: "muted screen", id: "keys" },
        "Point at a texel to see what both sides have there; click for its steps. By keyboard: arrow keys move by one texel, with Shift by ten, n and p go to the next and previous difference, Enter shows the steps, Escape lets go.",
      ),
      inspector,
    );
    tell();
    return part;
  }
}
