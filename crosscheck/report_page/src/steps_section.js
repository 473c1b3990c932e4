// The list of items with step tables, and the table of the one that was chosen.
import { jsonBlob } from "./data.js";
import { commandLine, h, scrolling, section } from "./dom.js";
import { classChip } from "./inspector.js";
import { grouped } from "./numbers.js";
import { CLASS_NAMES, SAME } from "./picture.js";
import { fieldName } from "./schema.js";
import { place, ROW_WORDS } from "./words.js";

function cell(value) {
  if (!value) return h("td", { class: "muted" }, "–");
  return h("td", { class: "number" }, value.value ?? "", value.hex ? h("span", { class: "hex" }, value.hex) : null, value.text ? h("span", { class: "word" }, value.value ? " " : "", value.text) : null);
}

export function rowsTable(caption, rows, profile) {
  let first = true;
  return h(
    "table",
    { class: "steps" },
    h("caption", {}, caption),
    h("thead", {}, h("tr", {}, ["step", "reference (strict)", `reference (${profile})`, "GPU", "ULP", "verdict"].map((text) => h("th", { scope: "col" }, text)))),
    h(
      "tbody",
      {},
      rows.map((row) => {
        const wrong = row.verdict === "DIVERGENT" && first;
        if (wrong) first = false;
        return h(
          "tr",
          { class: `${row.verdict === "same" || row.verdict === "" ? "" : "differs"} ${wrong ? "wrong" : ""}` },
          h("th", { scope: "row" }, row.label),
          cell(row.strict),
          cell(row.reference),
          cell(row.gpu),
          h("td", { class: "number" }, row.ulp === undefined ? "" : row.ulp === null ? "NaN" : grouped(row.ulp)),
          h("td", { class: `verdict-cell ${row.verdict}`, title: ROW_WORDS[row.verdict] }, row.verdict, row.reason ? h("span", { class: "reason" }, row.reason) : null),
        );
      }),
    ),
  );
}

const placeTitle = (item) => `${place(item)[0].toUpperCase()}${place(item).slice(1)}`;
const samePlace = (a, b) => a && b && a[0] === b[0] && a[1] === b[1];

// The texels both sides look at, with their base texels and picks.
function neighbourhood(round) {
  if (!round) return h("p", { class: "muted" }, "Neither side has a base texel, so nobody was looked for.");
  const [left, bottom] = round.low;
  const rows = round.cells.map((text, r) => {
    const y = bottom + r;
    return h(
      "tr",
      {},
      h("th", { scope: "row" }, String(y)),
      [...text].map((what, c) => {
        const at = [left + c, y];
        const nearest = ["reference", "gpu"].filter((side) => samePlace(round[side].nearest, at));
        const base = ["reference", "gpu"].filter((side) => samePlace(round[side].base, at));
        const words = [what === " " ? "outside" : what === "o" ? "holds a position" : "empty", base.length && `base texel of ${base.join(" and ")}`, nearest.length && `nearest of ${nearest.join(" and ")}`].filter(Boolean).join(", ");
        const letter = nearest.length === 2 ? "B" : nearest[0] === "reference" ? "R" : nearest[0] === "gpu" ? "G" : what === "o" ? "•" : "";
        return h("td", { class: [what === " " ? "outside" : what === "o" ? "drawn" : "", ...base.map((side) => `base-${side}`), nearest.length ? "nearest" : ""].join(" "), title: `(${at.join(", ")}): ${words}` }, letter);
      }),
    );
  });
  return h(
    "div",
    {},
    scrolling(
      "neighbourhood",
      h(
        "table",
        { class: "neighbourhood" },
        h("caption", {}, "What both sides look at"),
        h("tbody", {}, rows.reverse()),
        h("tfoot", {}, h("tr", {}, h("td", {}), [...round.cells[0]].map((_, c) => h("th", { scope: "col" }, String(left + c))))),
      ),
    ),
    h("p", { class: "muted" }, "• holds a position; R the reference's nearest, G the GPU's, B both sides'. Outlined: the base texels, the reference's solid, the GPU's dashed."),
  );
}

export const valueText = (values) => (values.length === 1 ? values[0].value : `(${values.map((v) => v.value).join(", ")})`);

const isWrong = ({ rows }) => rows.some(({ verdict }) => verdict === "DIVERGENT");

// Why an item is divergent though no step of this particle is.
function whyAllSame(item, particle, all) {
  if (CLASS_NAMES[item.class] !== "divergent" || !particle.rows.every(({ verdict }) => verdict === "same" || verdict === "")) return null;
  const wrong = all.filter(isWrong).map((other) => other.particle);
  const because = wrong.length > 0 ? `because particle ${wrong.join(" and particle ")} moved wrongly` : "in what was drawn";
  return h("p", { class: "muted" }, `Every step of particle ${particle.particle} is the same on both sides. ${placeTitle(item)} differs only ${because}.`);
}

function particlePart(item, particle, all, profile) {
  const { before } = particle;
  return [
    whyAllSame(item, particle, all),
    particle.warning ? h("p", { class: "warning" }, particle.warning) : null,
    h("p", {}, `Particle ${particle.particle} before: ${before.map(({ name, values }) => `${fieldName(name)} ${valueText(values)}`).join(", ")}.`),
    particle.untraced ? h("p", { class: "muted" }, "The GPU's intermediate values were not captured; only the reference's are shown.") : null,
    h("div", { class: "beside" }, scrolling(`steps of particle ${particle.particle}`, rowsTable(`Particle ${particle.particle}, step by step`, particle.rows, profile)), neighbourhood(particle.neighbourhood)),
    h("details", {}, h("summary", {}, "Why this verdict: every legal outcome"), h("pre", { tabindex: "0" }, particle.why)),
  ];
}

function told(head, item, table) {
  const profile = head.report.profile.split(":")[0];
  const title = h("h3", { tabindex: "-1", id: "steps-of" }, `${placeTitle(item)} in frame ${grouped(item.frame)} `, classChip(item.class));
  const parts = [title, commandLine(item.command)];
  if (!table) return [...parts, h("p", {}, "There is no step table of this run; the command makes one where it can be followed step by step.")];
  if (table.texel)
    parts.push(
      scrolling("who wanted this texel", rowsTable("Who wanted this texel, and what is stored", table.texel.rows, profile)),
      h("details", {}, h("summary", {}, "Why this verdict"), h("pre", { tabindex: "0" }, table.texel.why)),
    );
  return [...parts, ...table.particles.flatMap((particle) => particlePart(item, particle, table.particles, profile))];
}

export function stepsSection(head, selection) {
  if (head.items.length === 0) return null;
  const shown = h("div", { class: "steps-shown" });
  const rows = head.items.map((item, i) =>
    h(
      "tr",
      {},
      h("td", { class: "number" }, grouped(item.frame)),
      h("td", {}, h("button", { type: "button", class: "link", "data-item": String(i), click: () => selection.setItem(i) }, place(item))),
      h("td", {}, item.class === SAME ? "example that agrees" : classChip(item.class)),
      h("td", {}, item.step ?? ""),
    ),
  );
  const hex = h("input", { type: "checkbox", change: () => shown.classList.toggle("hexadecimal", hex.checked) });
  selection.addEventListener("item", async (event) => {
    const item = head.items[selection.item];
    for (const button of part.querySelectorAll("[data-item]")) button.setAttribute("aria-pressed", String(Number(button.dataset.item) === selection.item));
    const tables = await jsonBlob("tables");
    shown.replaceChildren(...told(head, item, tables[selection.item]).filter(Boolean));
    if (!event.detail.scroll) return;
    selection.setFrame(item.frame);
    if (item.texel) selection.setTexel({ x: item.texel[0], y: item.texel[1], pinned: true });
    shown.querySelector("#steps-of").focus({ preventScroll: true });
    shown.scrollIntoView({ block: "start", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
  });
  const differing = head.items.some((item) => item.class !== SAME);
  const part = section(
    "steps",
    "Step by step",
    h("p", {}, differing ? "The first items of each class. The first row that is DIVERGENT is the operation that is wrong." : "Nothing differs; these particles met others, as examples of what a step computes."),
    scrolling(
      "items",
      h("table", { class: "items" }, h("thead", {}, h("tr", {}, ["frame", "what", "class", "first wrong step"].map((text) => h("th", { scope: "col" }, text)))), h("tbody", {}, rows)),
    ),
    h("label", { class: "screen" }, hex, " hexadecimal floats"),
    shown,
  );
  return part;
}
