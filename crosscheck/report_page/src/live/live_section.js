// The scene, run by this browser's GPU and checked frame by frame while one watches.
import { blob, jsonBlob } from "../data.js";
import { h, section } from "../dom.js";
import { counted } from "../numbers.js";
import { cdtPicture } from "./cdt_picture.js";
import { LiveCheck } from "./live_check.js";
import { liveScene } from "./live_scene.js";
import { savedStates } from "./saved_states.js";
import { renderer } from "./simulation.js";
import shaders from "lockstep:shaders";
import "./live_section.css";

const nextPicture = () => new Promise((resolve) => requestAnimationFrame(resolve));

const option = (value, text, selected) => h("option", { value, selected }, text);

const labelled = (text, control) => h("label", {}, `${text} `, control);

const NOTHING = ["", "Nothing has run yet."];

// Tone and words of what is known so far.
function verdict(check) {
  const { profile, frames, agreeing } = check.closest();
  const scope = `${counted(check.scene.particles, "particle")} and of the CDT`;
  if (agreeing === frames.length)
    return ["good", `AGREE: every bit of ${scope} in ${counted(agreeing, "frame")}, as the ${profile} reference has them.`];
  const first = frames.findIndex(({ particles, cdt }) => !particles || !cdt);
  const what = frames[first].particles ? "the CDT" : frames[first].cdt ? "particles" : "particles and the CDT";
  const where = `${frames.length - agreeing} of ${counted(frames.length, "frame")} differ from the ${profile} reference, the first is frame ${first}, in ${what}.`;
  return check.run.exact
    ? ["bad", `DIFFERS: ${where} In exact arithmetic every driver that keeps to GL has the same bits; this one has not.`]
    : [
        "warn",
        `Other bits: ${where} Plain arithmetic and rasterisation are the driver's own, so this alone is no mistake. ` +
          "Preset exact says whether it keeps to GL, and saved states can be judged like any run.",
      ];
}

class LiveView {
  constructor(scene) {
    this.scene = scene;
    // The scene as it was checked shows what it is about: a preset may leave it no pile.
    const first = scene.runs.find(({ name }) => name === "as checked") ?? scene.runs.find(({ exact }) => exact);
    this.runs = h(
      "select",
      { id: "live-run", change: () => this.reset() },
      scene.runs.map((run) => option(run.name, run.name, run === first)),
    );
    this.views = h("select", { id: "live-shown", change: () => this.show() }, [option("rendered", "rendered frame"), option("cdt", "CDT")]);
    const button = (id, text, click) => h("button", { type: "button", id: `live-${id}`, click }, text);
    this.start = button("start", "Run", () => this.toggle());
    this.controls = h(
      "div",
      { class: "live-controls", role: "group", "aria-label": "live view" },
      labelled("Preset", this.runs),
      labelled("Show", this.views),
      this.start,
      button("step", "One frame", () => this.step()),
      button("again", "From the start", () => this.reset()),
      button("save", "Save states", () => this.saveStates()),
    );
    this.status = h("p", { id: "live-status", role: "status" });
    this.strip = h("div", { class: "live-strip", role: "img" });
    this.figure = h("div", { class: "live-picture" });
    this.about = h("p", { class: "muted" });
    this.reset();
  }

  elements() {
    return [this.controls, this.status, this.strip, this.figure, this.about];
  }

  // A new canvas each time: what an old context held goes with it.
  reset(said = NOTHING) {
    this.running = false;
    this.check?.release();
    this.check = null;
    const { render_width, render_height, width, height } = this.scene;
    const canvas = (name, columns, rows) => h("canvas", { width: columns, height: rows, role: "img", "aria-label": name });
    this.canvas = canvas("the rendered frame", render_width, render_height);
    this.cdt = canvas("the CDT", width, height);
    this.figure.replaceChildren(this.canvas, this.cdt);
    this.tell(said);
    this.show();
  }

  tell([tone, text]) {
    this.status.className = tone;
    this.status.textContent = text;
  }

  // The arrays are unpacked when they are first asked for: the page is there sooner.
  async prepare() {
    this.arrays ??= blob("live-arrays");
    const scene = liveScene(this.scene, await this.arrays);
    if (this.check) return;
    const run = scene.runs.find(({ name }) => name === this.runs.value);
    this.check = new LiveCheck(this.canvas, shaders, scene, run);
  }

  fail(error) {
    this.reset(["bad", `Could not run: ${error.message}`]);
  }

  // One frame; false if there was none.
  async step() {
    try {
      if (!this.check) await this.prepare();
      if (this.check.done) return false;
      this.check.step();
      this.tell(verdict(this.check));
      this.show();
      return true;
    } catch (error) {
      this.fail(error);
      return false;
    }
  }

  async toggle() {
    if (this.running) return (this.running = false);
    if (this.check?.done) this.reset();
    this.running = true;
    this.start.textContent = "Pause";
    while (this.running && (await this.step())) await nextPicture();
    this.running = false;
    this.start.textContent = "Run";
    this.showProgress();
  }

  show() {
    const { check } = this;
    const rendered = this.views.value === "rendered";
    this.canvas.hidden = !rendered;
    this.cdt.hidden = rendered;
    this.showStrip();
    this.showProgress();
    if (!check) return;
    if (rendered) check.draw();
    else cdtPicture(this.cdt, check.simulation.cdt(), this.scene.cdt_box, check.run.cdt_format);
  }

  showProgress() {
    const { check } = this;
    const done = check?.frames > 0;
    const hash = done && !this.running ? `, state hash ${check.stateHash()}` : "";
    this.about.textContent = done
      ? `${check.frames} of ${counted(this.scene.frames, "frame")}${hash}, ${check.checked} checked, on ${renderer(check.gl)}.`
      : "";
  }

  // A column a frame: particles above, CDT below.
  showStrip() {
    const frames = this.check?.closest().frames ?? [];
    const cell = (same) => h("span", { class: same ? "good" : "bad" });
    const words = ({ particles, cdt }, frame) =>
      `frame ${frame}: particles ${particles ? "agree" : "differ"}, CDT ${cdt ? "agrees" : "differs"}`;
    this.strip.hidden = frames.length === 0;
    this.strip.setAttribute("aria-label", frames.length > 0 ? words(frames.at(-1), frames.length - 1) : "no frame yet");
    this.strip.replaceChildren(
      ...frames.map((same, frame) => h("span", { class: "live-frame", title: words(same, frame) }, cell(same.particles), cell(same.cdt))),
    );
  }

  async saveStates() {
    this.reset();
    try {
      await this.prepare();
      const file = await savedStates(this.check, renderer(this.check.gl), (frame) => {
        this.tell(["", `Saving frame ${frame + 1} of ${this.scene.checked_frames}`]);
        return nextPicture();
      });
      const url = URL.createObjectURL(file);
      h("a", { href: url, download: `${this.scene.scene}_${this.runs.value}.states.gz` }).click();
      setTimeout(() => URL.revokeObjectURL(url), 60000);
      this.reset(["", "The states are saved; docs/live_view.md says how to judge them."]);
    } catch (error) {
      this.fail(error);
    }
  }
}

export async function liveSection() {
  const head = await jsonBlob("live");
  if (head.unavailable) return section("live", "Live view", h("p", { class: "muted" }, `Not for this run: ${head.unavailable}.`));
  const about = h(
    "p",
    {},
    "Here this browser's GPU runs the scene from lockstep's own shader sources, in WebGL2, and the state hash of each ",
    `of the first ${counted(head.checked_frames, "frame")} is held against the reference's.`,
  );
  const view = new LiveView(head);
  return section("live", "Live view", about, view.elements());
}
