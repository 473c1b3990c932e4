// The top of the page: the verdict, what ran where, and where a difference first shows.
import { commandLine, h, scrolling, section } from "./dom.js";
import { counted, decimalOfHex, grouped } from "./numbers.js";
import { counts, everyItem, placeName } from "./schema.js";
import { themeButton } from "./theme.js";
import { VERDICTS } from "./words.js";

export function pageHeader(head) {
  const { report } = head;
  return [
    h("h1", {}, h("span", { class: "brand" }, "lockstep", h("span", { class: "muted" }, " report")), h("span", { class: "scene" }, report.scene)),
    themeButton(),
  ];
}

// What of the run is counted: of a system's own all values, of the listing's what happened besides.
function compared({ report, system }) {
  const values = Object.values(report.fields).reduce((sum, field) => sum + field.compared, 0);
  return system ? counted(values, "value") : `${counted(values, "float")}; ${counted(report.hits, "hit")}, ${counted(report.drawn_texels, "texel")} drawn`;
}

function facts(head) {
  const { report, schema, system } = head;
  const hash =
    report.hash.reference === report.hash.gpu
      ? `${report.hash.gpu} on both sides`
      : `reference ${report.hash.reference}, GPU ${report.hash.gpu}`;
  const picture = system ? system.drawn : report.render.text;
  const rows = [
    ["Renderer", report.context],
    ["Shaders", report.shaders.text],
    ["Rendered frame", picture],
    ["Profile", report.profile],
    ["Switches", report.switches],
    ["Run", `${counted(report.particles, schema.resources[0].item)}, ${report.partial ? `${report.frames} of ${counted(report.frames_asked, "frame")}` : counted(report.frames, "frame")}, ${report.mode}`],
    ["Compared", compared(head)],
    ["State hash", hash],
    ["Written", [head.written, head.version && `by lockstep ${head.version}`].filter(Boolean).join(", ")],
  ];
  return h("dl", { class: "facts" }, rows.filter(([, value]) => value).map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
}

const anyDiffers = ({ report, schema }) => counts(schema).some(({ differing }) => report[differing] > 0);

function differences(head) {
  const { report, schema } = head;
  const frames = counted(report.frames, "frame");
  const [first, ...others] = counts(schema);
  if (!anyDiffers(head)) return `${[counted(report.particles, first.item), ...others.map(({ title }) => title)].join(" and ")}, in ${frames}.`;
  const differ = counts(schema).filter(({ differing }) => !head.system || report[differing] > 0);
  return `${differ.map((of) => counted(report[of.differing], of.state)).join(" and ")} differ in ${frames}, the first in frame ${report.first_frame}.`;
}

// What the verdict does not say: it is not to be read without.
function limits(head) {
  const { report } = head;
  const told = [];
  for (const what of report.failures ?? []) told.push(`Failed: ${what}.`);
  if (report.part) told.push(`A part of the run: ${report.part}.`);
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
      h("div", {}, h("p", { class: "says" }, typeof verdict.says === "function" ? verdict.says(everyItem(head.schema)) : verdict.says), h("p", { class: "muted" }, differences(head))),
    ),
    limited.map((text) => h("p", { class: "warning note" }, text)),
    facts(head),
    (head.report.coverage ?? []).map(({ text }) => h("p", { class: "muted" }, `Coverage of ${text}.`)),
    (head.report.notes ?? []).map((note) => h("p", { class: "warning note" }, note)),
  );
}

function classCounts(head) {
  const { verdicts } = head.report;
  const all = counts(head.schema);
  const columns = head.system ? all.filter(({ differing }) => head.report[differing] > 0) : all;
  const rows = Object.keys(verdicts[all[0].classes])
    .filter((name) => columns.some(({ classes }) => verdicts[classes][name] > 0))
    .map((name) =>
      h(
        "tr",
        {},
        h("th", { scope: "row" }, h("span", { class: `class ${name}` }, name)),
        columns.map(({ classes }) => h("td", { class: "number" }, grouped(verdicts[classes][name]))),
      ),
    );
  return h(
    "table",
    { class: "plain" },
    h("caption", {}, "All that differs, by class"),
    h("thead", {}, h("tr", {}, ["class", ...columns.map(({ states }) => states)].map((text) => h("th", { scope: "col" }, text)))),
    h("tbody", {}, rows),
  );
}

function firstPlace(head) {
  const { first } = head.report.verdicts;
  if (!first) return null;
  const at = first.place;
  const where = placeName(head.schema, at);
  const rows = [
    ["Where", `frame ${at.frame}, ${where}, step “${first.step}”`],
    ["Reference", first.operation],
    ["GPU", first.gpu_did],
    ["Shows in", `${first.field}: reference ${decimalOfHex(first.reference)}, GPU ${decimalOfHex(first.gpu)}${first.margin ? `; ${first.margin}` : ""}`],
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

// What a user's shader changes of the shipped one; of one that is mostly its own, how many lines.
function changesCard({ file, foreign, changes }) {
  const most = 12;
  const count = changes.reduce((sum, { before, now }) => sum + Math.max(before.length, now.length), 0);
  const lines = ({ line, before, now }) => [
    h("span", { class: "where" }, `${foreign}:${line}\n`),
    before.map((text) => h("del", {}, `- ${text}\n`)),
    now.map((text) => h("ins", {}, `+ ${text}\n`)),
  ];
  return h(
    "div",
    { class: "card" },
    h("h3", {}, `What ${foreign} changes`),
    count > most
      ? h("p", {}, `${counted(count, "line")} are not those of the shipped ${file}.`)
      : h("pre", { class: "changes", tabindex: "0", "aria-label": `Lines of ${foreign} that differ from the shipped ${file}` }, changes.flatMap(lines).flat()),
  );
}

function changeCards(head) {
  return (head.report.shaders.files ?? []).filter(({ changes }) => changes?.length > 0).map(changesCard);
}

// Nothing for a run without differences.
export function causeSection(head) {
  const { verdicts } = head.report;
  if (!verdicts || !anyDiffers(head)) return null;
  return section(
    "cause",
    "What differs, and why",
    h(
      "div",
      { class: "cards" },
      h("div", { class: "stack" }, counts(head.schema).map(({ cause, many }) => causeCard(verdicts[cause], many)), h("div", { class: "card" }, classCounts(head))),
      h("div", { class: "stack" }, firstPlace(head), changeCards(head)),
    ),
  );
}

// Which mistakes with names the run would have shown, and why not the others.
export function powerSection({ report }) {
  const { power } = report;
  if (power.list.length === 0) return null;
  const rows = power.list.map((mistake) =>
    h("tr", {}, h("th", { scope: "row" }, mistake.name), h("td", {}, mistake.frame === undefined ? "not" : `frame ${grouped(mistake.frame)}`), h("td", {}, mistake.why_not ?? mistake.meaning)),
  );
  const listed = h("table", { class: "plain" }, h("thead", {}, h("tr", {}, ["mistake", "shows first", ""].map((text) => (text ? h("th", { scope: "col" }, text) : h("td", {}))))), h("tbody", {}, rows));
  return section(
    "power",
    "What the run would have shown",
    h("p", {}, `${power.seen} of ${counted(power.mistakes, "mistake")} with names would have shown in the states that this run had.`),
    power.unseen.length > 0 ? h("p", { class: "warning note" }, `Not: ${power.unseen.join(", ")}.`) : null,
    h("details", {}, h("summary", {}, "Each of them"), scrolling("mistakes", listed)),
  );
}
