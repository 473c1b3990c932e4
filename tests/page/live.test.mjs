import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { gunzipSync, gzipSync } from "node:zlib";
import { axePath, cleanUp, lockstep, open, report, temporaryFolder, writeScene } from "./browser.mjs";

const frames = 12;
let plain;

const scene = (set = []) =>
  report(writeScene(temporaryFolder()), "--frames", String(frames), ...set.flatMap((value) => ["--set", value]));

before(() => (plain = scene()));
after(cleanUp);

const status = (page) => page.locator("#live-status").innerText();

// Waits for the status to say that; steps are taken one after the other, not at once.
const said = (page, words) => page.locator("#live-status", { hasText: words }).waitFor({ timeout: 20000 });

// Runs one of the page's presets to its end.
async function run(page, name) {
  await page.selectOption("#live-run", name);
  await page.click("#live-start");
  await page.waitForFunction(() => document.getElementById("live-start").textContent === "Run", null, { timeout: 60000 });
  return status(page);
}

// The same page with one line of a shader in it changed.
function planted(path, from, to) {
  const text = readFileSync(path, "utf8");
  assert.ok(text.includes(from), from);
  const changed = join(temporaryFolder(), "report.html");
  writeFileSync(changed, text.replaceAll(from, to));
  return changed;
}

for (const set of [[], ["cdt_format=rgba16f"], ["cdt_format=rgba8"], ["obstacles_in_cdt=vertices"], ["raster_position=before_step"]])
  test(`live view: preset exact has the reference's bits on SwiftShader ${set}`, async () => {
    const { page, complaints } = await open(set.length > 0 ? scene(set) : plain);
    assert.equal(
      await run(page, "exact"),
      `AGREE: every bit of 300 particles and of the CDT in ${frames} frames, as the strict reference has them.`,
    );
    assert.equal(await page.locator(".live-frame .good").count(), 2 * frames);
    assert.deepEqual(complaints, []);
    await page.close();
  });

test("live view: what comes first is the scene as it was checked", async () => {
  const chosen = async (path) => {
    const { page } = await open(path);
    const name = await page.locator("#live-run").inputValue();
    await page.close();
    return name;
  };
  assert.equal(await chosen(scene(["speed_factor=0.2"])), "as checked");
  const corrected = report(writeScene(temporaryFolder()), "--frames", "3", "--preset", "corrected");
  assert.equal(await chosen(corrected), "exact");
});

test("live view: a bug in a shader shows in its frame", async () => {
  const { page } = await open(planted(plain, " && len < particle_min_length", ""));
  assert.match(
    await run(page, "exact"),
    /^DIFFERS: \d+ of 12 frames differ from the strict reference, the first is frame [1-9]\d*, in particles/,
  );
  assert.ok((await page.locator(".live-frame .bad").count()) > 0);
  await page.close();
});

test("live view: a shader that does not compile is told", async () => {
  const { page } = await open(planted(plain, "bool particle_collision = false;", "bool particle_collision = 0;"));
  await page.click("#live-step");
  await said(page, /^Could not run: collision_pass, vertex stage: ERROR: .*bool/);
  await page.close();
});

test("live view: in plain arithmetic other bits are no mistake", async () => {
  const { page, complaints } = await open(plain);
  for (const preset of ["paper", "corrected"]) assert.match(await run(page, preset), /^(AGREE|Other bits): /);
  assert.deepEqual(complaints, []);
  await page.close();
});

test("live view: beyond the checked frames the state hash is that of lockstep hash", async () => {
  const file = writeScene(temporaryFolder());
  const { page } = await open(report(file, "--frames", "70"));
  assert.match(await run(page, "exact"), /^AGREE: .* in 60 frames/);
  const { stdout } = lockstep("hash", file, "--preset", "exact", "--frames", "70");
  const hash = stdout.match(/^69 ([0-9a-f]{16})$/m)[1];
  assert.match(await page.locator("#live").innerText(), new RegExp(`70 of 70 frames, state hash ${hash}, 60 checked, on `));
  await page.close();
});

test("live view: a frame at a time, and back to the start", async () => {
  const { page } = await open(plain);
  await page.click("#live-step");
  await page.click("#live-step");
  await said(page, /in 2 frames/);
  assert.match(await page.locator("#live").innerText(), /2 of 12 frames, state hash [0-9a-f]{16}, 2 checked, on .*SwiftShader/);
  await page.click("#live-again");
  assert.equal(await status(page), "Nothing has run yet.");
  await page.close();
});

// Colours on the canvas that is shown.
const colours = (page) =>
  page.evaluate(() => {
    const canvas = [...document.querySelectorAll(".live-picture canvas")].find((c) => !c.hidden);
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer)).size;
  });

test("live view: both pictures show something", async () => {
  const { page } = await open(scene(["billboard_radius=0.05"]));
  await page.click("#live-step");
  await said(page, /in 1 frame,/);
  assert.ok((await colours(page)) > 100);
  await page.selectOption("#live-shown", "cdt");
  assert.ok((await colours(page)) > 100);
  await page.close();
});

// A file that the page offers.
async function savedStates(path, preset) {
  const { page } = await open(path);
  await page.selectOption("#live-run", preset);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#live-save")]);
  const file = join(temporaryFolder(), download.suggestedFilename());
  await download.saveAs(file);
  assert.match(await status(page), /^The states are saved/);
  await page.close();
  return file;
}

test("live view: saved states hold the start and each frame's particles and CDT", async () => {
  const file = await savedStates(plain, "exact");
  assert.equal(basename(file), "scene_exact.states.gz");
  const bytes = gunzipSync(readFileSync(file));
  const line = bytes.indexOf("\n");
  const head = JSON.parse(bytes.subarray(0, line).toString());
  assert.deepEqual([head.lockstep, head.run, head.particles, head.frames], ["states 1", "exact", 300, frames]);
  const obstacles = 3 * (head.corners + head.triangles);
  assert.equal(bytes.length - line - 1, 4 * (8 * 300 + obstacles + frames * (8 * 300 + 4 * 64 * 48)));
});

const python = spawnSync("/usr/bin/python3", ["-c", "import h5py"]).status === 0;
const withPython = { skip: python || process.env.LOCKSTEP_REQUIRE_GL === "1" ? false : "no python3-h5py" };

function traceOf(states) {
  const trace = join(temporaryFolder(), "run.h5");
  const { status, stderr } = spawnSync("scripts/trace_of_states.py", [states, trace], { encoding: "utf8" });
  return { status, stderr, trace };
}

test("live view: saved states become a trace that is judged like any run", withPython, async () => {
  const { stderr, trace } = traceOf(await savedStates(plain, "exact"));
  assert.equal(stderr, "");
  const judged = lockstep("check", "--trace", trace);
  assert.match(judged.stdout, /verdict   AGREE: every bit of 300 particles and of the CDT in 12 frames/);
  assert.equal(judged.status, 0);
});

test("live view: a bug in a shader is named from its trace", withPython, async () => {
  const { trace } = traceOf(await savedStates(planted(plain, " && len < particle_min_length", ""), "exact"));
  const judged = lockstep("check", "--trace", trace);
  assert.match(judged.stdout, /verdict   DIVERGENT[\s\S]*cause .*last_found_instead_of_nearest/);
  assert.equal(judged.status, 1);
});

test("live view: states that are cut off make no trace", withPython, async () => {
  const states = await savedStates(plain, "exact");
  const whole = gunzipSync(readFileSync(states));
  for (const [damaged, said] of [
    [readFileSync(states).subarray(0, 5000), /^trace_of_states: .*: Compressed file ended/],
    [gzipSync(whole.subarray(0, -4)), /^trace_of_states: .*: cut off\n$/],
    [gzipSync(Buffer.concat([whole, whole])), /^trace_of_states: .*: more states than the first line says\n$/],
    [gzipSync("{}\n"), /^trace_of_states: .*: not states that a report page saved\n$/],
  ]) {
    writeFileSync(states, damaged);
    const { status, stderr, trace } = traceOf(states);
    assert.equal(status, 1);
    assert.match(stderr, said);
    assert.deepEqual(readdirSync(dirname(trace)), []);
  }
});

test("live view: without WebGL2 one line says so", async () => {
  const { page } = await open(plain);
  await page.evaluate(() => (HTMLCanvasElement.prototype.getContext = () => null));
  await page.click("#live-start");
  await said(page, /^Could not run: this browser has no WebGL2$/);
  await page.close();
});

test("live view: what WebGL2 cannot run is not offered", async () => {
  const { page } = await open(scene(["cdt_layers=2"]));
  assert.match(await page.locator("#live").innerText(), /Not for this run: the layered collision pass/);
  assert.equal(await page.locator("#live-start").count(), 0);
  await page.close();
});

test("live view: reached and run by keyboard, and nothing for an accessibility checker to find", async () => {
  const { page } = await open(plain);
  await page.locator("#live-run").focus();
  for (let i = 0; i < 3; ++i) await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await said(page, /in 1 frame,/);
  await page.addScriptTag({ path: axePath });
  const { violations } = await page.evaluate(() => axe.run("#live"));
  assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`), []);
  await page.close();
});
