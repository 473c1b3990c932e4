// What both sides have in the texel under the pointer, and in the particle that owns it.
import { NOBODY, OBSTACLE, particleFields, readDetail } from "./detail.js";
import { commandLine, h, scrolling } from "./dom.js";
import { paint } from "./frames_section.js";
import { itemAt } from "./items.js";
import { decimal, grouped, hexFloat, sameBits, ulpText } from "./numbers.js";
import { CLASS_NAMES, SAME } from "./picture.js";
import { CLASS_WORDS } from "./words.js";

const LENS = 15; // texels across

function ownerText(owner) {
  if (owner === NOBODY) return "nobody";
  if (owner === OBSTACLE) return "an obstacle";
  return owner >= 0 ? `particle ${owner}` : "none that is known";
}

export const classChip = (kind) => h("span", { class: `class ${CLASS_NAMES[kind].replace(" ", "-")}` }, CLASS_NAMES[kind]);

function valueRow(label, { reference, gpu }) {
  const same = sameBits(reference, gpu);
  const cell = (bits) => h("td", { class: "number" }, decimal(bits), h("span", { class: "hex" }, hexFloat(bits)));
  return h("tr", { class: same ? "" : "differs" }, h("th", { scope: "row" }, label), cell(reference), cell(gpu), h("td", { class: "number" }, ulpText(reference, gpu)));
}

function valueTable(label, caption, rows) {
  return scrolling(
    label,
    h(
      "table",
      { class: "values" },
      h("caption", {}, caption),
      h("thead", {}, h("tr", {}, ["", "reference", "GPU", "ULP"].map((text) => (text ? h("th", { scope: "col" }, text) : h("td", {}))))),
      h("tbody", {}, rows),
    ),
  );
}

function particleTable(index, particle) {
  return valueTable(
    `values of particle ${grouped(index)}`,
    [`Particle ${grouped(index)} after the frame `, classChip(particle.kind)],
    particleFields().map((field, c) => valueRow(field, particle.values[c])),
  );
}

// The command that shows the same, and exactly, in a terminal.
function explainCommand(head, frame, texel) {
  const { command } = head.items[0] ?? {};
  return command?.replace(/--frame \d+ (--texel \d+,\d+|--particle \d+)/, `--frame ${frame} --texel ${texel.x},${texel.y}`);
}

export class Inspector {
  constructor(head, frames, selection) {
    this.head = head;
    this.frames = frames;
    this.selection = selection;
    this.lenses = {};
    this.told = h("div", { class: "told", id: "told", "aria-live": "polite" });
    for (const name of ["texel", "picture"]) selection.addEventListener(name, () => this.tell());
  }

  lens(side, title) {
    const canvas = h("canvas", { width: String(LENS), height: String(LENS), role: "img", "aria-label": `${title}, ${LENS} by ${LENS} texels around the pointer` });
    this.lenses[side] = canvas;
    return h("figure", {}, h("figcaption", {}, title), canvas);
  }

  part() {
    this.element = h(
      "div",
      { class: "inspector", id: "inspector" },
      h("div", { class: "lenses", hidden: true }, this.lens("reference", "Reference"), this.lens("gpu", "GPU"), this.lens("difference", "Difference")),
      this.told,
    );
    this.tell();
    return this.element;
  }

  magnify(texel) {
    this.element.querySelector(".lenses").hidden = !texel;
    if (!texel) return;
    const half = LENS >> 1;
    for (const [side, lens] of Object.entries(this.lenses))
      paint(lens, this.frames.picture, side, this.head, texel.x - half, texel.y - half);
  }

  async tell() {
    const { texel } = this.selection;
    const { kept, picture } = this.frames;
    if (!this.element) return;
    this.magnify(picture ? texel : null);
    if (!texel || !picture) {
      this.told.replaceChildren(h("p", { class: "muted" }, picture ? "No texel chosen." : "No picture to look into."));
      return;
    }
    const detail = await readDetail(kept);
    if (this.selection.texel !== texel || this.frames.kept !== kept) return;
    this.told.replaceChildren(...this.words(texel, kept, picture, detail));
  }

  words(texel, kept, picture, detail) {
    const { width } = this.head;
    const index = texel.y * width + texel.x;
    const kind = picture.classes[index];
    const drawn = picture.reference[index * 4 + 3];
    const title = h("h3", {}, `Texel (${texel.x}, ${texel.y}) in frame ${grouped(kept.frame)} `, classChip(kind));
    const command = explainCommand(this.head, kept.frame, texel);
    const more = command ? commandLine(command) : null;
    const found = detail?.texel(index);
    if (!found) {
      if (kind === SAME && !drawn) return [title, h("p", {}, "Empty on both sides.")];
      return [
        title,
        h("p", {}, kind === SAME ? "Every bit agrees here. " : `${CLASS_WORDS[CLASS_NAMES[kind]]}. `, "The exact values found no room on this page; the command shows them."),
        more,
      ];
    }
    const { owners, values } = found;
    const item = itemAt(this.head, kept.frame, texel, Object.values(owners));
    const steps =
      item >= 0
        ? h("p", {}, h("button", { type: "button", class: "link", click: () => this.selection.setItem(item) }, "Show its steps"))
        : h("p", { class: "muted" }, "Its steps are not on this page; this command shows them:");
    const parts = [
      title,
      h("p", {}, owners.reference === owners.gpu ? `Owner on both sides: ${ownerText(owners.gpu)}.` : `Owner: ${ownerText(owners.reference)} by the reference, ${ownerText(owners.gpu)} on the GPU.`),
      valueTable("values of the texel", "Stored in the texel", ["x", "y", "z", "w"].map((name, c) => valueRow(name, values[c]))),
    ];
    for (const owner of new Set([owners.reference, owners.gpu])) {
      const particle = owner >= 0 ? detail.particle(owner) : null;
      if (particle) parts.push(particleTable(owner, particle));
      else if (owner >= 0) parts.push(h("p", { class: "muted" }, `Particle ${owner} agrees in every bit.`));
    }
    return [...parts, steps, more];
  }
}
