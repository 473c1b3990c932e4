// The top of the page: the verdict, what ran where, and where a difference first shows.
import { commandLine, h, section } from "./dom.js";
import { counted, grouped } from "./numbers.js";
import { themeButton } from "./theme.js";
import { VERDICTS } from "./words.js";

export function pageHeader(head) {
  const { report } = head;
  return [
    h("p", { class: "brand" }, "lockstep", h("span", { class: "muted" }, " report")),
    h("p", { class: "scene" }, report.scene),
    themeButton(),
  ];
}

function facts(head) {
  const { report } = head;
  const compared = Object.values(report.fields).reduce((sum, field) => sum + field.compared, 0);
  const hash =
    report.hash.reference === report.hash.gpu
      ? `${report.hash.gpu} on both sides`
      : `reference ${report.hash.reference}, GPU ${report.hash.gpu}`;
  const rows = [
    ["Renderer", report.context],
    ["Shaders", report.shaders.text],
    ["Rendered frame", report.render.text],
    ["Profile", report.profile],
    ["Switches", report.switches],
    ["Run", `${counted(report.particles, "particle")}, ${report.partial ? `${report.frames} of ${counted(report.frames_asked, "frame")}` : counted(report.frames, "frame")}, ${report.mode}`],
    ["Compared", `${counted(compared, "float")}; ${counted(report.hits, "hit")}, ${counted(report.drawn_texels, "texel")} drawn`],
    ["State hash", hash],
  ];
  return h("dl", { class: "facts" }, rows.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
}

function differences(head) {
  const { report } = head;
  if (report.differing_particles + report.differing_texels === 0)
    return `${counted(report.particles, "particle")} and the CDT, in ${counted(report.frames, "frame")}.`;
  return `${counted(report.differing_particles, "particle state")} and ${counted(report.differing_texels, "texel")} differ in ${counted(report.frames, "frame")}, the first in frame ${report.first_frame}.`;
}

// What the verdict does not say: it is not to be read without.
function limits(head) {
  const { report } = head;
  const told = [];
  if (report.partial) told.push(`Partial: the run was stopped after ${report.frames} of ${counted(report.frames_asked, "frame")}.`);
  for (const what of report.untried) told.push(`But ${what}.`);
  if (!report.judged && report.verdict !== "NONDETERMINISTIC") told.push("Compared, not judged.");
  return told;
}

export function verdictSection(head) {
  const verdict = VERDICTS[head.report.verdict];
  const limited = limits(head);
  const tone = limited.length > 0 && verdict.tone === "good" ? "warn" : verdict.tone;
  return section(
    "verdict",
    "Verdict",
    h(
      "div",
      { class: `verdict ${tone}` },
      h("p", { class: "word" }, h("span", { class: "mark", "aria-hidden": "true" }, verdict.mark), head.report.verdict, head.report.partial ? " (partial)" : ""),
      h("div", {}, h("p", { class: "says" }, verdict.says), h("p", { class: "muted" }, differences(head))),
    ),
    limited.map((text) => h("p", { class: "warning note" }, text)),
    facts(head),
    (head.report.notes ?? []).map((note) => h("p", { class: "warning note" }, note)),
  );
}

function classCounts(head) {
  const { particles, texels } = head.report.verdicts;
  const rows = Object.keys(particles)
    .filter((name) => particles[name] + texels[name] > 0)
    .map((name) =>
      h(
        "tr",
        {},
        h("th", { scope: "row" }, h("span", { class: `class ${name}` }, name)),
        h("td", { class: "number" }, grouped(particles[name])),
        h("td", { class: "number" }, grouped(texels[name])),
      ),
    );
  return h(
    "table",
    { class: "plain" },
    h("caption", {}, "All that differs, by class"),
    h("thead", {}, h("tr", {}, ["class", "particle states", "texels"].map((text) => h("th", { scope: "col" }, text)))),
    h("tbody", {}, rows),
  );
}

function firstPlace(head) {
  const { first } = head.report.verdicts;
  if (!first) return null;
  const at = first.place;
  const where = at.texel ? `texel (${at.texel.join(", ")})` : `particle ${at.particle}`;
  const rows = [
    ["Where", `frame ${at.frame}, ${where}, step “${first.step}”`],
    ["Reference", first.operation],
    ["GPU", first.gpu_did],
    ["Shows in", `${first.field}: reference ${first.reference_hex}, GPU ${first.gpu_hex}${first.margin ? `; ${first.margin}` : ""}`],
  ];
  return h(
    "div",
    { class: "card" },
    h("h3", {}, `The first ${first.class} item`),
    h("dl", { class: "facts narrow" }, rows.filter(([, value]) => value).map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value)))),
    head.report.explain && commandLine(head.report.explain),
  );
}

function causeCard(found, what) {
  if (!found || found.divergent === 0) return null;
  if (found.best.length === 0)
    return h("div", { class: "card" }, h("h3", {}, `Cause, by ${what}`), h("p", {}, `No named mistake explains any of ${grouped(found.divergent)} divergent ${what}.`));
  const share = (cause) => cause.explained / found.divergent;
  const most = 6;
  const bar = (cause) =>
    h(
      "li",
      {},
      h("p", { class: "cause" }, h("strong", {}, cause.deviations.join(" + ")), ` ${cause.meaning ?? ""}`),
      h(
        "div",
        { class: "share" },
        h("meter", {
          min: "0",
          max: "1",
          value: String(share(cause)),
          "aria-label": `share explained by ${cause.deviations.join(" + ")}`,
        }),
        h(
          "span",
          {},
          `${(100 * share(cause)).toFixed(share(cause) === 1 ? 0 : 1)} %: ${grouped(cause.explained)} of ${grouped(found.divergent)}`,
          cause.contradicted > 0 ? `; ${grouped(cause.contradicted)} that agree speak against it` : "",
        ),
      ),
    );
  return h(
    "div",
    { class: "card" },
    h("h3", {}, `Cause, by ${what}`),
    h("p", { class: "muted" }, "The reference that makes this mistake on purpose has the GPU's bits. Equals stand side by side."),
    h("ol", { class: "causes" }, found.best.slice(0, most).map(bar)),
    found.best.length > most ? h("p", { class: "muted" }, `and ${found.best.length - most} more that explain as much`) : null,
  );
}

// Nothing for a run without differences.
export function causeSection(head) {
  const verdicts = head.report.verdicts;
  if (!verdicts || head.report.differing_particles + head.report.differing_texels === 0) return null;
  return section(
    "cause",
    "What differs, and why",
    h(
      "div",
      { class: "cards" },
      h("div", { class: "stack" }, causeCard(verdicts.particle_cause, "particles"), causeCard(verdicts.texel_cause, "texels"), h("div", { class: "card" }, classCounts(head))),
      firstPlace(head),
    ),
  );
}
