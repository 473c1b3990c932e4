// Pages of runs of other systems than the one whose scenes name none: generic, from schema and passes alone.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { axePath, cleanUp, open, report, temporaryFolder } from "./browser.mjs";

const scene = "data/scenes/dust/physics.json";
const run = ["--particles", "300", "--frames", "6"];
const pages = {};

// The shipped update without gravity.
function planted() {
  const folder = temporaryFolder();
  const text = readFileSync("shaders/dust/update.comp", "utf8");
  assert.ok(text.includes("a = add(a, gravity);"));
  writeFileSync(join(folder, "update.comp"), text.replace("a = add(a, gravity);", "a = add(a, mul(gravity, 0.0));"));
  return folder;
}

before(() => {
  const shaders = planted();
  pages.agreeing = report(scene, ...run);
  pages.divergent = report(scene, ...run, "--shaders", shaders);
  pages.free = report(scene, ...run, "--shaders", shaders, "--mode", "free");
});
after(cleanUp);

const text = (page, selector) => page.locator(selector).innerText();

async function on(name, body, options) {
  const { page, complaints } = await open(pages[name], options);
  try {
    await body(page);
    if (process.env.LOCKSTEP_SCREENSHOTS)
      await page.screenshot({ path: join(process.env.LOCKSTEP_SCREENSHOTS, `system_${name}.png`), fullPage: true });
    assert.deepEqual(complaints, []);
  } finally {
    await page.close();
  }
}

test("a system's agreeing run: verdict, passes, power and examples", () =>
  on("agreeing", async (page) => {
    assert.match(await text(page, "#verdict"), /AGREE[\s\S]*Every bit of every grain and count is the same[\s\S]*300 grains and the counts, in 6 frames[\s\S]*every|Rendered frame/);
    assert.match(await text(page, "#verdict"), /300 grains, 6 frames, resync/);
    assert.match(await text(page, "#power"), /\d+ of \d+ mistakes with names would have shown/);
    assert.match(await text(page, "#frame-passes"), /Frame 5: every bit agrees, in every pass/);
    assert.match(await text(page, "#steps"), /examples/);
    assert.equal(await page.locator("#cause").count(), 0);
    for (const of_collision of ["#chart", "#frames", "#study", "#live"]) assert.equal(await page.locator(of_collision).count(), 0);
  }));

test("a system's divergent run: cause, numbers by pass and frame, both sides' values, commands", () =>
  on("divergent", async (page) => {
    assert.match(await text(page, "#verdict"), /DIVERGENT[\s\S]*1,800 grain states differ in 6 frames, the first in frame 0/);
    assert.match(await text(page, "#cause"), /gravity_missing gravity is not added[\s\S]*100 %: 1,800 of 1,800/);
    assert.match(await text(page, "#cause"), /frame 0, grain 0, step “update, velocity”/);
    assert.match(await text(page, "#totals"), /update\s+the grains\s+6\s+1,800\s+1,800/);
    await page.locator("#frame").fill("3");
    assert.match(await text(page, "#frame-passes"), /Frame 3[\s\S]*update\s+300\s+300\s+divergent[\s\S]*grain 0, grain 1[\s\S]*and 260 more/);
    assert.match(await text(page, "#frame-passes .values >> nth=0"), /velocity\.y/);
    assert.equal(await page.locator("#frame-passes table.plain tbody tr").count(), 1);
    assert.deepEqual(await page.locator("#frame-passes .detail h3").allInnerTexts(), ["Pass update, frame 3"]);
    assert.match(await text(page, "#repeat"), /lockstep check .*--frames 6[\s\S]*--frame 0 --pass update --item 0[\s\S]*capsule show/);
  }));

test("a system's item opens by keyboard, its first wrong row marked", () =>
  on("divergent", async (page) => {
    await page.locator("[data-item='1']").focus();
    await page.keyboard.press("Enter");
    await page.locator("#steps-of").waitFor();
    assert.match(await text(page, "#steps-of"), /Grain 1 in frame 0, pass update/);
    const wrong = page.locator(".steps tr.wrong");
    assert.equal(await wrong.count(), 1);
    assert.match(await wrong.innerText(), /velocity\.y[\s\S]*DIVERGENT/);
    assert.match(await text(page, ".steps-shown"), /explain .* --frame 0 --pass update --item 1/);
    assert.ok(!/0x1\./.test(await text(page, ".steps")));
    await page.getByLabel("hexadecimal floats").check();
    assert.match(await text(page, ".steps"), /0x1\./);
  }));

test("a system's free run is compared, not judged, and says so", () =>
  on("free", async (page) => {
    assert.match(await text(page, "#verdict"), /DIFFER[\s\S]*Compared, not judged/);
    assert.match(await text(page, "#totals"), /not judged/);
  }));

for (const name of ["agreeing", "divergent"])
  for (const colorScheme of ["light", "dark"])
    test(`axe finds nothing serious on a system's page: ${name}, ${colorScheme}`, () =>
      on(
        name,
        async (page) => {
          for (const summary of await page.locator("summary").all()) await summary.click();
          await page.addScriptTag({ path: axePath });
          const { violations } = await page.evaluate(() => window.axe.run());
          const grave = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
          assert.deepEqual(grave.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`), []);
        },
        { colorScheme },
      ));

test("a system's page does not scroll sideways in a narrow window, and is at most 5 MB", () =>
  on(
    "divergent",
    async (page) => {
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
      for (const path of Object.values(pages)) assert.ok(statSync(path).size <= 5e6);
    },
    { viewport: { width: 400, height: 800 } },
  ));
