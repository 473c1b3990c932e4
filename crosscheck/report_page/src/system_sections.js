// What a page shows of a system's run, pass by pass (crosscheck/report/page/system_page.hpp): how much differs in each
// frame, which texels of an image, both sides' values, and the steps of the first items.
import { jsonBlob } from "./data.js";
import { commandLine, h, scrolling, section } from "./dom.js";
import { frameSlider } from "./frame_slider.js";
import { CLASS_COLOURS } from "./frames_section.js";
import { classChip } from "./inspector.js";
import { counted, grouped } from "./numbers.js";
import { CLASS_NAMES, SAME } from "./picture.js";
import { fieldName } from "./schema.js";
import { Selection } from "./selection.js";
import { rowsTable, valueText } from "./steps_section.js";

const ulpText = (ulp) => (ulp === null ? "NaN" : grouped(ulp));
const chips = (classes) => classes.flatMap((count, kind) => (count > 0 ? [h("span", { class: "chip" }, `${grouped(count)} `, classChip(kind))] : []));

function headRow(names) {
  return h("thead", {}, h("tr", {}, names.map((text) => h("th", { scope: "col" }, text))));
}

// Of each pass over the whole run.
function totals({ system, schema }) {
  const rows = system.passes.map((pass) =>
    h(
      "tr",
      { class: pass.differing > 0 ? "differs" : "" },
      h("th", { scope: "row" }, pass.name),
      h("td", {}, schema.resources[pass.resource].title),
      h("td", { class: "number" }, grouped(pass.frames)),
      h("td", { class: "number" }, grouped(pass.compared)),
      h("td", { class: "number" }, grouped(pass.differing)),
      h("td", {}, h("div", { class: "legend" }, chips(pass.classes))),
      h("td", { class: "number" }, ulpText(pass.ulp)),
      h("td", { class: "number" }, pass.first_frame === null ? "" : grouped(pass.first_frame)),
    ),
  );
  return scrolling(
    "passes of the run",
    h("table", { class: "plain", id: "totals" }, h("caption", {}, "The whole run"), headRow(["pass", "writes", "frames", "items compared", "differ", "of class", "worst ULP", "first frame"]), h("tbody", {}, rows)),
  );
}

// The same of one frame: the passes in which something differs.
function frameTable({ system }, rows, frame) {
  const here = rows.filter((row) => row[0] === frame);
  if (system.left_out_from !== null && frame >= system.left_out_from && here.length === 0)
    return h("p", { class: "statistics" }, `Frame ${grouped(frame)}: the numbers from frame ${grouped(system.left_out_from)} on had no room on this page.`);
  if (here.length === 0) return h("p", { class: "statistics" }, `Frame ${grouped(frame)}: every bit agrees, in every pass.`);
  return scrolling(
    "passes of the frame",
    h(
      "table",
      { class: "plain" },
      h("caption", {}, `Frame ${grouped(frame)}`),
      headRow(["pass", "items that differ", "of class", "worst ULP"]),
      h(
        "tbody",
        {},
        here.map(([, pass, differing, classes, ulp]) =>
          h("tr", { class: "differs" }, h("th", { scope: "row" }, system.passes[pass].name), h("td", { class: "number" }, grouped(differing)), h("td", {}, h("div", { class: "legend" }, chips(classes))), h("td", { class: "number" }, ulpText(ulp))),
        ),
      ),
    ),
  );
}

function valuesTable(item) {
  const cell = (value) => h("td", { class: "number" }, value.value, h("span", { class: "hex" }, value.hex));
  return h(
    "table",
    { class: "values" },
    h("caption", {}, `${item.name} `, classChip(item.class)),
    h("thead", {}, h("tr", {}, h("td", {}), ["reference", "GPU"].map((text) => h("th", { scope: "col" }, text)))),
    h("tbody", {}, item.values.map((value) => h("tr", { class: value.same ? "" : "differs" }, h("th", { scope: "row" }, fieldName(value.name)), cell(value.reference), cell(value.gpu)))),
  );
}

// An image's texels that differ, one pixel each; its layers lie above each other, the first at the bottom.
function differencePicture(detail, [width, height, depth], title) {
  const canvas = h("canvas", { width: String(width), height: String(height * depth), role: "img", "aria-label": `texels of ${title} that differ, ${width} by ${height}` });
  const context = canvas.getContext("2d");
  context.fillStyle = "rgb(18, 20, 26)";
  context.fillRect(0, 0, canvas.width, canvas.height);
  detail.texels.forEach((texel, i) => {
    context.fillStyle = `rgb(${CLASS_COLOURS[CLASS_NAMES[detail.classes[i]]]})`;
    context.fillRect(texel % width, height * depth - 1 - Math.floor(texel / width), 1, 1);
  });
  return h("figure", { class: "differing-texels" }, h("figcaption", {}, `Texels of ${title} that differ`), h("div", { class: "picture" }, canvas));
}

function detailPart({ system, schema }, detail) {
  const pass = system.passes[detail.pass];
  const extent = system.extents[pass.resource];
  return h(
    "div",
    { class: "detail", "data-pass": pass.name },
    h("h3", {}, `Pass ${pass.name}, frame ${grouped(detail.frame)}`),
    detail.texels && extent[0] * extent[1] * extent[2] <= 4e6 ? differencePicture(detail, extent, schema.resources[pass.resource].title) : null,
    h("p", {}, `${detail.items.map((item) => item.name).join(", ")}${detail.more > 0 ? ` and ${grouped(detail.more)} more` : ""}.`),
    h("div", { class: "told" }, detail.items.slice(0, 4).map(valuesTable)),
    detail.items.length > 4 ? h("details", {}, h("summary", {}, `Both sides of ${counted(detail.items.length - 4, "more item")}`), h("div", { class: "told" }, detail.items.slice(4).map(valuesTable))) : null,
  );
}

function passesSection(head, { rows, details }, selection) {
  const shown = h("div", { id: "frame-passes", "aria-live": "polite" });
  const differing = [...new Set(rows.map(([frame]) => frame))];
  const show = () =>
    shown.replaceChildren(frameTable(head, rows, selection.frame), ...details.filter(({ frame }) => frame === selection.frame).map((detail) => detailPart(head, detail)));
  selection.addEventListener("frame", show);
  show();
  return section("passes", "Pass by pass", totals(head), h("h3", {}, "Frame by frame"), frameSlider(selection, differing.map((frame) => ({ frame, differs: true })), differing), shown);
}

function stepsOf(head, item, table) {
  const title = h("h3", { tabindex: "-1", id: "steps-of" }, `${item.name[0].toUpperCase()}${item.name.slice(1)} in frame ${grouped(item.frame)}, pass ${head.system.passes[item.pass].name} `, classChip(item.class));
  const parts = [title, commandLine(item.command)];
  if (!table) return [...parts, h("p", {}, "Its step table is not on this page; the command makes it.")];
  const profile = head.report.profile.split(":")[0];
  return [
    ...parts,
    h("p", {}, `Before: ${table.before.map(({ name, values }) => `${fieldName(name)} ${valueText(values)}`).join(", ")}.`),
    scrolling(`steps of ${item.name}`, rowsTable(`${item.name}, step by step`, table.rows, profile)),
    h("details", {}, h("summary", {}, "Why this verdict: every legal outcome"), h("pre", { tabindex: "0" }, table.why)),
  ];
}

function stepsSection(head, selection) {
  if (head.items.length === 0) return null;
  const shown = h("div", { class: "steps-shown" });
  const rows = head.items.map((item, i) =>
    h(
      "tr",
      {},
      h("td", { class: "number" }, grouped(item.frame)),
      h("td", {}, head.system.passes[item.pass].name),
      h("td", {}, h("button", { type: "button", class: "link", "data-item": String(i), click: () => selection.setItem(i) }, item.name)),
      h("td", {}, item.class === SAME ? "example that agrees" : classChip(item.class)),
      h("td", {}, item.step ?? ""),
    ),
  );
  const hex = h("input", { type: "checkbox", change: () => shown.classList.toggle("hexadecimal", hex.checked) });
  const differing = head.items.some((item) => item.class !== SAME);
  const part = section(
    "steps",
    "Step by step",
    h("p", {}, differing ? "The first items of each pass and class. The first row that is DIVERGENT is the operation that is wrong." : "Nothing differs; these items changed, as examples of what a step computes."),
    scrolling("items", h("table", { class: "items" }, headRow(["frame", "pass", "what", "class", "first wrong step"]), h("tbody", {}, rows))),
    h("label", { class: "screen" }, hex, " hexadecimal floats"),
    shown,
  );
  selection.addEventListener("item", async (event) => {
    for (const button of part.querySelectorAll("[data-item]")) button.setAttribute("aria-pressed", String(Number(button.dataset.item) === selection.item));
    const tables = await jsonBlob("tables");
    shown.replaceChildren(...stepsOf(head, head.items[selection.item], tables[selection.item]).filter(Boolean));
    if (!event.detail.scroll) return;
    selection.setFrame(head.items[selection.item].frame);
    shown.querySelector("#steps-of").focus({ preventScroll: true });
    shown.scrollIntoView({ block: "start", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
  });
  return part;
}

export async function showSystem(head, add) {
  const passes = await jsonBlob("passes");
  const selection = new Selection(head);
  add(passesSection(head, passes, selection));
  add(stepsSection(head, selection));
  if (head.items.length > 0) selection.setItem(0, { scroll: false });
}
