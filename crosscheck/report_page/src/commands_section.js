// The command lines that show each part again, and the report as the terminal had it.
import { commandLine, h, section } from "./dom.js";

export function commandsSection(head) {
  return section(
    "repeat",
    "To see it again",
    head.commands.map(({ what, line }) => h("div", { class: "again" }, h("h3", {}, what), commandLine(line))),
    h("details", {}, h("summary", {}, "The report as the terminal had it"), h("pre", { tabindex: "0", "aria-label": "report" }, head.text)),
  );
}
