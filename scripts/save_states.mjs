#!/usr/bin/env node
// Has the live view of a report run in headless Chromium, and saves the states of every frame as it offers them.
// Usage: scripts/save_states.mjs REPORT.html PRESET STATES.gz [ANGLE-BACKEND]
// Backends: swiftshader (the default), gl-egl for the machine's own GL. Needs scripts/build_report_page.sh.
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const packages = createRequire(new URL("../crosscheck/report_page/package.json", import.meta.url));
const { chromium } = packages("playwright-core");
const [report, preset, out, backend = "swiftshader"] = process.argv.slice(2);
if (!out) {
  console.error("usage: scripts/save_states.mjs REPORT.html PRESET STATES.gz [ANGLE-BACKEND]");
  process.exit(2);
}
const quiet = ["--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const graphics = ["--use-gl=angle", `--use-angle=${backend}`, "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", ...quiet, ...graphics] });
try {
  const page = await browser.newPage();
  await page.goto(pathToFileURL(report).href);
  await page.waitForSelector("html[data-ready]");
  await page.selectOption("#live-run", preset);
  const saved = page.waitForEvent("download", { timeout: 0 });
  const failed = page.waitForFunction(() => document.querySelector("#live-status.bad")?.textContent, null, { timeout: 0 });
  await page.click("#live-save");
  const outcome = await Promise.race([saved, failed.then((text) => text.jsonValue())]);
  if (typeof outcome === "string") throw new Error(outcome);
  await outcome.saveAs(out);
  console.log(`${browser.version()}, ${backend}: ${await page.locator("#live-status").innerText()}`);
} finally {
  await browser.close();
}
