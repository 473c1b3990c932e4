// Difference over time, resync and free in one chart.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { h, scrolling, section } from "./dom.js";
import { grouped } from "./numbers.js";

const MEASURES = [
  ["particles", "particles that differ"],
  ["texels", "texels that differ"],
  ["ulp", "worst ULP"],
];
const NAN_ULP = 2 ** 33; // above every distance of two floats

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const at = (series, side, measure, i) => {
  const value = series[side][measure][i];
  return measure === "ulp" && value === null ? NAN_ULP : value;
};
const shown = (measure, value) =>
  value === null || value === undefined ? "" : measure === "ulp" && value >= NAN_ULP ? "NaN" : grouped(value);

function shortNumber(value) {
  if (value >= NAN_ULP) return "NaN";
  for (const [unit, sign] of [[1e9, "G"], [1e6, "M"], [1e3, "k"]]) if (value >= unit) return `${value / unit}${sign}`;
  return String(value);
}

// Every number that is drawn, for those who cannot see it: where something changes, at most 200 rows.
function table(series) {
  const key = (i) => JSON.stringify(MEASURES.flatMap(([m]) => [series.resync[m][i], series.free[m][i]]));
  const rows = [];
  let more = 0;
  series.frame.forEach((frame, i) => {
    if (i > 0 && i + 1 < series.frame.length && key(i) === key(i - 1)) return;
    if (rows.length >= 200) return ++more;
    const cells = MEASURES.flatMap(([m]) => ["resync", "free"].map((side) => shown(m, at(series, side, m, i))));
    rows.push(h("tr", {}, h("th", { scope: "row" }, grouped(frame)), cells.map((text) => h("td", { class: "number" }, text))));
  });
  const columns = ["frame", ...MEASURES.flatMap(([, words]) => [`${words}, resync`, `${words}, free`])];
  return h(
    "details",
    {},
    h("summary", {}, "The numbers as a table"),
    scrolling(
      "difference over time as a table",
      h("table", {}, h("thead", {}, h("tr", {}, columns.map((c) => h("th", { scope: "col" }, c)))), h("tbody", {}, rows)),
    ),
    more > 0 ? h("p", { class: "muted" }, `and ${grouped(more)} rows more`) : null,
  );
}

function options(series, measure, width, selection) {
  const axis = { stroke: css("--text"), grid: { stroke: css("--line"), width: 1 }, ticks: { stroke: css("--line") }, font: "12px system-ui" };
  const line = (label, colour, dash) => ({
    label,
    stroke: css(colour),
    width: 2,
    dash,
    value: (_, value) => shown(measure, value),
    points: { show: series.frame.length < 80, size: 5, fill: css(colour) },
  });
  return {
    width,
    height: 280,
    scales: {
      x: { time: false },
      y: { distr: 4, asinh: 1, range: (_, low, high) => [0, Math.max(1, high) * 1.3] },
    },
    axes: [
      { ...axis, label: "frame", labelSize: 22, labelFont: "12px system-ui", incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 1e4, 1e5, 1e6] },
      {
        ...axis,
        size: 64,
        splits: (_, __, low, high) => {
          const marks = [0];
          for (let mark = 1; mark <= high; mark *= 10) marks.push(mark);
          return marks;
        },
        values: (_, marks) => marks.map(shortNumber),
      },
    ],
    series: [{ label: "frame", value: (_, value) => (value === null ? "" : grouped(value)) }, line("resync", "--resync"), line("free", "--free", [8, 5])],
    cursor: { drag: { x: true, y: false }, points: { size: 8 } },
    hooks: {
      ready: [
        (plot) =>
          plot.over.addEventListener("click", () => {
            if (plot.cursor.idx !== null) selection.setFrame(series.frame[plot.cursor.idx]);
          }),
      ],
      draw: [
        (plot) => {
          const x = plot.valToPos(selection.frame, "x", true);
          if (!Number.isFinite(x)) return;
          const { ctx, bbox } = plot;
          ctx.save();
          ctx.fillStyle = css("--accent");
          ctx.globalAlpha = 0.7;
          ctx.fillRect(x - 1, bbox.top, 2, bbox.height);
          ctx.restore();
        },
      ],
    },
  };
}

export function chartSection(head, series, selection) {
  const holder = h("div", { class: "chart", role: "img", "aria-label": "Differences in each frame, resync and free; the table below has the numbers" });
  let measure = "particles";
  let plot = null;
  const draw = () => {
    const width = Math.max(280, holder.clientWidth);
    plot?.destroy();
    const column = (side) => series.frame.map((_, i) => at(series, side, measure, i));
    plot = new uPlot(options(series, measure, width, selection), [series.frame, column("resync"), column("free")], holder);
  };
  const choices = MEASURES.map(([name, words]) =>
    h(
      "label",
      {},
      h("input", {
        type: "radio",
        name: "measure",
        value: name,
        checked: name === measure,
        change: () => {
          measure = name;
          draw();
        },
      }),
      ` ${words}`,
    ),
  );
  selection.addEventListener("frame", () => plot?.redraw(false));
  document.addEventListener("themechange", draw);
  new ResizeObserver(() => {
    if (!plot || Math.abs(plot.width - holder.clientWidth) > 1) draw();
  }).observe(holder);
  // The chart is drawn after the first picture: what is read first is shown first.
  const agrees = [...series.resync.particles, ...series.resync.texels, ...series.free.particles, ...series.free.texels].every((n) => n === 0);
  return section(
    "chart",
    "Difference over time",
    h(
      "p",
      {},
      h("strong", {}, "Resync"),
      " judges each step alone: the reference restarts from the GPU's state after every frame. ",
      h("strong", {}, "Free"),
      " lets both sides run on by themselves and shows how a difference grows.",
      agrees ? " Here both stay at 0 in every frame." : "",
      series.stride > 1 ? ` One point stands for ${series.stride} frames and has their largest numbers.` : "",
    ),
    h("fieldset", { class: "choices" }, h("legend", { class: "unseen" }, "what is shown"), choices),
    holder,
    h("p", { class: "muted screen" }, "A click goes to that frame; dragging enlarges, a double click shows all."),
    table(series),
  );
}
