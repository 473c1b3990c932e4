// What the search through the image misses, as lockstep study found it.
import uPlot from "uplot";
import { commandLine, h, section } from "./dom.js";
import { grouped } from "./numbers.js";

const WORDS = {
  own_texel: "in the particle's own texel",
  occluded: "hidden behind another particle",
  hidden: "hidden by an obstacle",
  outside_window: "outside the window of texels",
  outside_image: "outside the image",
  coincident: "at the very same place",
  stale: "moved since the image was drawn",
  cooling_down: "still cooling down after a hit",
  rounded: "out of range by rounding",
};

const percent = (rate) => (rate === null || rate === undefined ? "–" : `${(100 * rate).toFixed(1)} %`);

function recallChart(frames) {
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const holder = h("div", { class: "chart small", role: "img", "aria-label": "Recall and precision of each studied frame" });
  const rate = (name) => frames.map((frame) => (frame[name] === null ? null : 100 * frame[name]));
  let plot = null;
  const draw = () => {
    plot?.destroy();
    const axis = { stroke: css("--text"), grid: { stroke: css("--line"), width: 1 }, ticks: { stroke: css("--line") }, font: "12px system-ui" };
    const line = (label, colour, dash) => ({ label, stroke: css(colour), width: 2, dash, value: (_, value) => (value === null ? "" : `${value.toFixed(1)} %`) });
    plot = new uPlot(
      {
        width: Math.max(280, holder.clientWidth),
        height: 200,
        scales: { x: { time: false }, y: { range: [0, 105] } },
        axes: [{ ...axis, label: "frame", labelSize: 20, labelFont: "12px system-ui" }, { ...axis, values: (_, marks) => marks.map((mark) => `${mark} %`) }],
        series: [{ label: "frame" }, line("recall", "--free"), line("precision", "--tie", [8, 5])],
      },
      [frames.map(({ frame }) => frame), rate("recall"), rate("precision")],
      holder,
    );
  };
  document.addEventListener("themechange", draw);
  new ResizeObserver(() => (!plot || Math.abs(plot.width - holder.clientWidth) > 1) && draw()).observe(holder);
  return holder;
}

export function studySection(head) {
  const { study } = head;
  if (!study) return null;
  const { total } = study;
  const causes = Object.keys(total)
    .filter((key) => key.startsWith("missed_pairs_") && total[key] > 0)
    .map((key) => ({ name: key.slice("missed_pairs_".length), pairs: total[key] }))
    .sort((a, b) => b.pairs - a.pairs);
  const missed = causes.reduce((sum, { pairs }) => sum + pairs, 0);
  return section(
    "study",
    "What the search misses",
    h(
      "p",
      {},
      `Of the particles in contact, ${percent(total.recall)} find a neighbour (recall); of what they find, ${percent(total.precision)} is one (precision). `,
      `Studied: ${study.scene}, ${grouped(study.frames.length)} frames, against exact neighbours.`,
    ),
    recallChart(study.frames),
    causes.length === 0
      ? h("p", {}, "No pair was missed.")
      : h(
          "table",
          { class: "plain" },
          h("caption", {}, "Missed pairs, by cause"),
          h("thead", {}, h("tr", {}, ["missed because the neighbour is", "pairs", "share"].map((text) => h("th", { scope: "col" }, text)))),
          h(
            "tbody",
            {},
            causes.map(({ name, pairs }) =>
              h(
                "tr",
                {},
                h("th", { scope: "row" }, WORDS[name] ?? name),
                h("td", { class: "number" }, grouped(pairs)),
                h("td", {}, h("div", { class: "share" }, h("meter", { min: "0", max: "1", value: String(pairs / missed), "aria-label": `share of pairs missed: ${WORDS[name] ?? name}` }), percent(pairs / missed))),
              ),
            ),
          ),
        ),
    commandLine(study.repeat),
  );
}
