import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { cleanUp, open, plantedShader, report, temporaryFolder, writeScene } from "./browser.mjs";

const lastFound = [" && len < particle_min_length", ""];
let agreeing, divergent;

before(() => {
  const scene = writeScene(temporaryFolder());
  agreeing = report(scene, "--frames", "20");
  divergent = report(scene, "--frames", "20", "--shaders", plantedShader(temporaryFolder(), ...lastFound));
});
after(cleanUp);

const text = (page, selector) => page.locator(selector).innerText();

test("an agreeing run: verdict, pictures and examples, without a complaint", async () => {
  const { page, complaints } = await open(agreeing);
  assert.match(await text(page, "#verdict"), /AGREE[\s\S]*Every bit of every particle/);
  assert.match(await text(page, ".statistics"), /Frame 19: resync: every bit agrees; free: every bit agrees/);
  assert.match(await text(page, "#picture-words"), /Pictures of this frame, with all exact values/);
  assert.equal(await page.locator("#cause").count(), 0);
  assert.match(await text(page, "#steps"), /examples/);
  assert.deepEqual(complaints, []);
  await page.close();
});

test("a divergent run: cause, first divergence, command lines", async () => {
  const { page, complaints } = await open(divergent);
  assert.match(await text(page, "#verdict"), /DIVERGENT/);
  assert.match(await text(page, "#cause"), /last_found_instead_of_nearest[\s\S]*100 %/);
  assert.match(await text(page, "#cause"), /lockstep explain .* --frame \d+ --particle \d+/);
  assert.match(await text(page, "#repeat"), /lockstep check .* --frames 20/);
  assert.deepEqual(complaints, []);
  await page.close();
});
