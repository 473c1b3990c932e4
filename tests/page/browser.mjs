// Headless Chromium, and pages that lockstep wrote.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const packages = createRequire(new URL("../../crosscheck/report_page/package.json", import.meta.url));
const { chromium } = packages("playwright-core");
export const axePath = packages.resolve("axe-core/axe.min.js");

const program = process.env.LOCKSTEP_PROGRAM;

const folders = [];

// A folder that is gone after cleanUp().
export function temporaryFolder() {
  folders.push(mkdtempSync(join(tmpdir(), "lockstep-page-")));
  return folders.at(-1);
}

export function lockstep(...args) {
  const { status, stdout, stderr } = spawnSync(program, args, { encoding: "utf8" });
  return { status, stdout, stderr };
}

// EGL where the release has no OSMesa.
const gl = process.env.LOCKSTEP_REQUIRE_OSMESA === "1" || lockstep("probe", "--gl", "osmesa").status === 0 ? "osmesa" : "egl";

// 300 particles that meet, over a plane.
const smallScene = {
  constants: { collision_range: 0.1 },
  image: [64, 48],
  render: [40, 30],
  emitters: [{ count: 300, min: [-0.4, -0.4, -0.4], max: [0.4, 0.4, 0.4], speed: 0.5 }],
  obstacles: [{ shape: "plane", size: [1, 1], position: [0, -0.6, 0] }],
};

export function writeScene(folder, changes = {}, name = "scene.json") {
  const path = join(folder, name);
  writeFileSync(path, JSON.stringify({ ...smallScene, ...changes }));
  return path;
}

// A folder of shaders with the collision pass changed: pairs of what stands there and what is to.
export function plantedShader(folder, ...changes) {
  let text = readFileSync("shaders/collision/collision_pass.vert", "utf8");
  for (const [from, to] of changes) {
    if (!text.includes(from)) throw new Error(`collision_pass.vert has no '${from}'`);
    text = text.replace(from, to);
  }
  writeFileSync(join(folder, "collision_pass.vert"), text);
  return folder;
}

// Writes a report and gives its path.
export const report = (...args) => reportInto(temporaryFolder(), ...args);

export function reportInto(folder, ...args) {
  const outcome = lockstep("check", ...args, "--gl", gl, "--report", folder, "--quiet");
  if (outcome.status === 2) throw new Error(outcome.stderr);
  return join(folder, "report.html");
}

let browser = null;

export async function cleanUp() {
  await browser?.close();
  browser = null;
  for (const folder of folders.splice(0)) rmSync(folder, { recursive: true, force: true });
}

// The page, opened from disk; `complaints` gathers errors, warnings and whatever it asks of a network.
export async function open(path, options = {}) {
  browser ??= await chromium.launch({
    executablePath: "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, reducedMotion: "reduce", ...options });
  const complaints = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("request", (request) => !/^(file|data|blob):/.test(request.url()) && complaints.push(`asks for ${request.url()}`));
  await page.goto(pathToFileURL(path).href);
  await page.waitForSelector("html[data-ready]", { timeout: 20000 });
  return { page, complaints };
}
