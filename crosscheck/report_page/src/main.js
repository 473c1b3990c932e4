import "./style.css";
import { causeSection, pageHeader, powerSection, verdictSection } from "./verdict_section.js";
import { chartSection } from "./chart_section.js";
import { commandsSection } from "./commands_section.js";
import { jsonBlob, readHead } from "./data.js";
import { readDetail } from "./detail.js";
import { h } from "./dom.js";
import { Frames } from "./frames_section.js";
import { Inspector } from "./inspector.js";
import { itemAt } from "./items.js";
import { liveSection } from "./live/live_section.js";
import { renderedSection } from "./rendered_section.js";
import { Selection } from "./selection.js";
import { stepsSection } from "./steps_section.js";
import { studySection } from "./study_section.js";
import { showSystem } from "./system_sections.js";

// A click on a texel shows the steps of the item there, if they are on the page.
function openClickedItems(head, frames, selection) {
  selection.addEventListener("texel", async () => {
    const { texel } = selection;
    if (!texel?.asked || !frames.kept) return;
    const detail = await readDetail(frames.kept);
    const owners = detail?.texel(texel.y * head.width + texel.x)?.owners ?? {};
    const item = itemAt(head, frames.kept.frame, texel, Object.values(owners));
    if (item >= 0) selection.setItem(item);
  });
}

function showRun(head, series, add) {
  const selection = new Selection(head);
  const frames = new Frames(head, series, selection);
  const pictures = frames.section(new Inspector(head, frames, selection).part());
  add(chartSection(head, series, selection));
  add(pictures);
  add(renderedSection(head));
  openClickedItems(head, frames, selection);
  add(stepsSection(head, selection));
  return frames;
}

async function start() {
  const head = readHead();
  document.title = `${head.report.verdict}: ${head.report.scene} – lockstep report`;
  document.getElementById("top").append(...pageHeader(head));
  const content = document.getElementById("content");
  const add = (part) => part && content.append(part);
  add(verdictSection(head));
  add(causeSection(head));
  if (head.system) {
    add(powerSection(head));
    await showSystem(head, add);
    add(commandsSection(head));
    document.getElementById("foot").append(h("p", {}, "Written by lockstep."));
    document.documentElement.dataset.ready = "true";
    return;
  }

  const series = await jsonBlob("series");
  // A run that did not repeat itself ends before anything is compared.
  const frames = series.frame.length > 0 ? showRun(head, series, add) : null;
  add(studySection(head));
  add(commandsSection(head));
  document.getElementById("foot").append(h("p", {}, "Written by lockstep. Charts by uPlot."));
  await frames?.show();
  document.getElementById("repeat").before(await liveSection());
  document.documentElement.dataset.ready = "true";
}

start().catch((error) => {
  document.getElementById("content").append(h("p", { class: "warning", role: "alert" }, `This page cannot show its data: ${error.message}`));
  throw error;
});
