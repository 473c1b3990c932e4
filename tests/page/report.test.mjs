import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { axePath, cleanUp, lockstep, open, plantedShader, report, reportInto, temporaryFolder, writeScene } from "./browser.mjs";

const lastFound = [[" && len < particle_min_length", ""]];
const pages = {};
let divergentJson;

before(() => {
  const scene = writeScene(temporaryFolder());
  const shaders = plantedShader(temporaryFolder(), ...lastFound);
  const json = join(temporaryFolder(), "check.json");
  pages.agreeing = report(scene, "--frames", "20");
  pages.divergent = report(scene, "--frames", "20", "--shaders", shaders, "--json", json);
  pages.free = report(scene, "--frames", "20", "--shaders", shaders, "--mode", "free");
  pages.octree = report(scene, "--frames", "4", "--set", "search=octree");
  pages.layered = report(scene, "--frames", "4", "--set", "cdt_layers=2");
  const studied = temporaryFolder();
  lockstep("study", scene, "--frames", "6", "--json", join(studied, "study.json"));
  pages.studied = reportInto(studied, scene, "--frames", "2");
  pages.short = report(scene, "--frames", "1");
  divergentJson = JSON.parse(readFileSync(json, "utf8"));
});
after(cleanUp);

const text = (page, selector) => page.locator(selector).innerText();

// Runs `body` on an open page, which must not complain.
async function on(name, body, options) {
  const { page, complaints } = await open(pages[name], options);
  try {
    await body(page);
    assert.deepEqual(complaints, []);
  } finally {
    await page.close();
  }
}

const pixels = (page, side) =>
  page.evaluate((which) => document.querySelector(`[data-side=${which}] canvas`).toDataURL(), side);

// The pixel of a texel, in coordinates of its picture.
async function pointOf(page, side, x, y) {
  const canvas = page.locator(`[data-side=${side}] canvas`);
  const box = await canvas.boundingBox();
  const [width, height] = await canvas.evaluate((element) => [element.width, element.height]);
  return { position: { x: ((x + 0.5) / width) * box.width, y: ((height - y - 0.5) / height) * box.height } };
}

test("an agreeing run: verdict, pictures and examples", () =>
  on("agreeing", async (page) => {
    assert.match(await page.title(), /^AGREE: /);
    assert.match(await text(page, "#verdict"), /AGREE[\s\S]*Every bit of every particle[\s\S]*Renderer[\s\S]*llvmpipe[\s\S]*Profile/);
    assert.match(await text(page, ".statistics"), /Frame 19: resync: every bit agrees; free: every bit agrees/);
    assert.match(await text(page, "#picture-words"), /Pictures of this frame, with all exact values/);
    assert.equal(await page.locator("#cause").count(), 0);
    assert.match(await text(page, "#steps"), /examples/);
    assert.match(await text(page, "#told"), /same/);
    assert.equal(await pixels(page, "reference"), await pixels(page, "gpu"));
  }));

test("a divergent run: cause and its share, first divergence, command lines", () =>
  on("divergent", async (page) => {
    assert.match(await text(page, "#verdict"), /DIVERGENT/);
    assert.match(await text(page, "#cause"), /last_found_instead_of_nearest the last in range, not the nearest[\s\S]*100 %/);
    assert.match(await text(page, "#cause"), /step “nearest”[\s\S]*lockstep explain .* --frame \d+ --particle \d+/);
    assert.match(await text(page, "#repeat"), /lockstep check .* --frames 20[\s\S]*lockstep debug/);
    assert.notEqual(await pixels(page, "reference"), await pixels(page, "gpu"));
  }));

for (const name of ["free", "octree", "layered", "short"])
  test(`a page of another kind of run, ${name}, opens without a complaint`, () =>
    on(name, async (page) => {
      assert.match(await text(page, "#verdict"), name === "free" ? /DIFFER/ : /AGREE/);
      await page.locator(".picture").first().click();
    }));

test("the study that lies beside the page is told: recall, and what is missed why", () =>
  on("studied", async (page) => {
    assert.match(await text(page, "#study"), /Of the particles in contact, \d+\.\d % find a neighbour[\s\S]*Missed pairs, by cause[\s\S]*lockstep study /);
  }));

test("a run that does not repeat itself has a verdict, and nothing to look into", async (context) => {
  const shaders = plantedShader(
    temporaryFolder(),
    ["#version 330 core\n", "#version 330 core\n#extension GL_ARB_shader_clock : require\n"],
    ["v_Speed = ls_length(temp);", "v_Speed = ls_length(temp) + float(clock2x32ARB().x & 0xffffu);"],
  );
  try {
    pages.nondeterministic = report(writeScene(temporaryFolder()), "--frames", "4", "--shaders", shaders);
  } catch (error) {
    if (!error.message.includes("shader_clock")) throw error;
    return context.skip("this driver has no clock in shaders");
  }
  await on("nondeterministic", async (page) => {
    assert.match(await text(page, "#verdict"), /NONDETERMINISTIC/);
    assert.equal(await page.locator("#frames").count(), 0);
  });
});

test("the slider moves through all frames, by pointer, by keyboard, by number and to what differs", () =>
  on("divergent", async (page) => {
    const first = divergentJson.first_frame;
    const slider = page.locator("#frame");
    assert.equal(await slider.inputValue(), String(first));
    const before = await pixels(page, "reference");
    await slider.press("End");
    assert.match(await text(page, ".statistics"), /^Frame 19: /);
    assert.equal(await page.locator("#frame-number").inputValue(), "19");
    await page.waitForFunction(() => document.querySelector("#picture-words").textContent.startsWith("Pictures of this frame"));
    let after = before; // the picture follows the words
    for (let tries = 0; tries < 50 && after === before; ++tries) {
      await page.waitForTimeout(100);
      after = await pixels(page, "reference");
    }
    assert.notEqual(after, before);
    await slider.press("ArrowLeft");
    assert.match(await text(page, ".statistics"), /^Frame 18: /);
    await slider.fill("0");
    assert.match(await text(page, ".statistics"), /^Frame 0: resync: every bit agrees/);
    await page.getByRole("button", { name: "The next frame that differs" }).click();
    assert.match(await text(page, ".statistics"), new RegExp(`^Frame ${first}: resync: [\\d,]+ particles? `));
    await page.locator("#frame-number").fill("7");
    await page.locator("#frame-number").press("Enter");
    assert.equal(await slider.inputValue(), "7");
    await page.getByRole("button", { name: "One frame on" }).click();
    assert.equal(await slider.inputValue(), "8");
  }));

test("the numbers of a frame are the program's", () =>
  on("divergent", async (page) => {
    for (const [frame, particles, texels] of divergentJson.counts.rows.slice(0, 5)) {
      await page.locator("#frame").fill(String(frame));
      assert.match(await text(page, ".statistics"), new RegExp(`resync: ${particles} particles? and ${texels} texels? differ`));
    }
  }));

test("the pointer shows a texel, its owner, and both sides' values bit for bit", () =>
  on("divergent", async (page) => {
    const { place, field, component, reference_hex, gpu_hex } = divergentJson.verdicts.first;
    // The particle of the first divergence, where its texel is.
    const found = await page.evaluate(async (index) => {
      for (const row of document.querySelectorAll("[data-item]")) if (row.textContent === `particle ${index}`) return true;
      return false;
    }, place.particle);
    assert.ok(found);
    const gpu = page.locator("[data-side=gpu]");
    await gpu.focus();
    const seen = new Map();
    for (let i = 0; i < 200; ++i) {
      const title = await text(page, "#told h3");
      if (seen.has(title)) break;
      seen.set(title, await text(page, "#told"));
      await page.keyboard.press("n");
      await page.waitForTimeout(15);
    }
    const told = [...seen.values()].find((words) => words.includes(`Particle ${place.particle} after the frame`));
    assert.ok(told, "the differing texels lead to the particle that differs first");
    const row = field === "collide_time" ? "collide time" : field === "speed" ? field : `${field}.${"xyzw"[component]}`;
    const after = told.slice(told.indexOf(`Particle ${place.particle} after`));
    const [, values] = after.match(new RegExp(`${row}\\s+([\\s\\S]*?)(?=position|direction|speed|collide|$)`));
    assert.ok(values.includes(reference_hex) && values.includes(gpu_hex), `${values} has ${reference_hex} and ${gpu_hex}`);

    // What the GPU stores in a texel of its own is its owner's position.
    const own = [...seen.values()].find((words) => /Owner on both sides: particle/.test(words));
    const component_x = (from) => own.slice(own.indexOf(from)).match(/x\s+(\S+)\s+\S+\s+(\S+)/).slice(1);
    assert.deepEqual(component_x("Stored in the texel"), component_x("position."));

    const [, x, y] = (await text(page, "#told h3")).match(/\((\d+), (\d+)\)/).map(Number);
    await page.keyboard.press("Escape");
    await gpu.hover(await pointOf(page, "gpu", x, y));
    await page.waitForTimeout(50);
    assert.match(await text(page, "#told h3"), new RegExp(`Texel \\(${x}, ${y}\\) in frame ${place.frame}`));
    assert.match(await text(page, "#told"), /Owner/);
  }));

test("a click on a texel that differs shows its step table, with the wrong row and both sides' neighbourhood", () =>
  on("divergent", async (page) => {
    const [x, y] = await page.evaluate(() => {
      const label = [...document.querySelectorAll("[data-item]")].find((button) => button.textContent.startsWith("texel")).textContent;
      return label.match(/\d+/g).map(Number);
    });
    await page.locator("[data-side=difference]").click(await pointOf(page, "difference", x, y));
    await page.locator("#steps-of").waitFor();
    assert.match(await text(page, "#steps-of"), new RegExp(`Texel \\(${x}, ${y}\\) in frame ${divergentJson.first_frame}`));
    assert.match(await text(page, ".steps-shown"), /Who wanted this texel[\s\S]*Why this verdict/);
    assert.equal(await page.locator("[data-item][aria-pressed=true]").count(), 1);
  }));

test("an item of the list opens by keyboard; its first wrong row is marked and hexadecimal is at hand", () =>
  on("divergent", async (page) => {
    await page.locator("[data-item='0']").focus();
    await page.keyboard.press("Enter");
    await page.locator("#steps-of").waitFor();
    assert.equal(await page.evaluate(() => document.activeElement.id), "steps-of");
    const wrong = page.locator(".steps tr.wrong");
    assert.equal(await wrong.count(), 1);
    assert.match(await wrong.innerText(), /DIVERGENT/);
    assert.match(await wrong.innerText(), /texel \(\d+, \d+\)/);
    const marks = await page.locator(".neighbourhood td.nearest").allInnerTexts();
    assert.deepEqual(marks.sort(), ["G", "R"]);
    assert.ok(!/0x1\./.test(await text(page, ".steps")));
    await page.getByLabel("hexadecimal floats").check();
    assert.match(await text(page, ".steps"), /0x1\./);
  }));

test("what the shader changes stands there line by line, with date and version; pictures grow; both sides' frame is drawn", () =>
  on("divergent", async (page) => {
    assert.match(await text(page, "#verdict"), /Written\s+\d{4}-\d\d-\d\d \d\d:\d\d UTC, by lockstep \d/);
    assert.match(await text(page, "#cause .changes"), /collision_pass\.vert:\d+\n- .*&& len < particle_min_length\) \{\n\+ .*u_CollisionRange > len\) \{/);
    const width = async () => (await page.locator("[data-side=gpu]").boundingBox()).width;
    const whole = await width();
    await page.getByLabel("Zoom").selectOption("4");
    assert.ok(Math.abs((await width()) / whole - 4) < 0.05);
    const drawn = await page.locator("#rendered img").evaluateAll((images) => images.map((image) => image.naturalWidth));
    assert.equal(drawn.length, 3);
    assert.ok(drawn.every((pixels) => pixels > 0));
  }));

test("the chart shows what was asked for, and a click on it goes to that frame", () =>
  on("divergent", async (page) => {
    const chart = page.locator(".chart canvas");
    const before = await chart.evaluate((canvas) => canvas.toDataURL());
    await page.getByLabel("worst ULP").check();
    assert.notEqual(await page.locator(".chart canvas").evaluate((canvas) => canvas.toDataURL()), before);
    const over = page.locator(".chart .u-over");
    const box = await over.boundingBox();
    await over.click({ position: { x: box.width - 2, y: box.height / 2 } });
    assert.match(await text(page, ".statistics"), /^Frame 19: /);
    await page.getByText("The numbers as a table").click();
    assert.match(await text(page, "#chart table:not(.u-legend)"), /particles that differ, free/);
  }));

test("both themes: the system's, and the other at a press of the button", async () => {
  const ground = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const seen = {};
  for (const colorScheme of ["light", "dark"])
    await on(
      "divergent",
      async (page) => {
        seen[colorScheme] = await ground(page);
        for (const width of process.env.LOCKSTEP_SCREENSHOTS ? [1280, 420] : []) {
          await page.setViewportSize({ width, height: 900 });
          await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
          // Chromium's software compositor draws no more than 8,192 rows.
          const height = await page.evaluate(() => Math.min(8192, document.documentElement.scrollHeight));
          await page.setViewportSize({ width, height });
          await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
          await page.screenshot({ path: join(process.env.LOCKSTEP_SCREENSHOTS, `report_${colorScheme}_${width}.png`) });
        }
        await page.locator("#theme").click();
        seen[`${colorScheme} changed`] = await ground(page);
      },
      { colorScheme },
    );
  assert.notEqual(seen.light, seen.dark);
  assert.equal(seen["light changed"], seen.dark);
  assert.equal(seen["dark changed"], seen.light);
});

test("on paper: light, whole tables, nothing to press", () =>
  on(
    "divergent",
    async (page) => {
      await page.locator("[data-item='0']").click();
      await page.locator("#steps-of").waitFor();
      await page.emulateMedia({ media: "print", colorScheme: "dark" });
      assert.equal(await page.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue("--card").trim()), "#ffffff");
      assert.equal(await page.locator(".slider").isVisible(), false);
      assert.equal(await page.locator("#theme").isVisible(), false);
      assert.equal(await page.locator(".steps").first().isVisible(), true);
      assert.ok(await page.evaluate(() => document.querySelector(".scrolling:has(.items)").scrollHeight <= document.querySelector(".scrolling:has(.items)").clientHeight + 1));
      assert.ok((await page.pdf({ format: "A4" })).length > 10000);
    },
    { colorScheme: "dark" },
  ));

for (const name of ["agreeing", "divergent"])
  for (const [colorScheme, width] of [["light", 1280], ["dark", 1280], ["light", 420], ["dark", 420]])
    test(`axe finds nothing: ${name}, ${colorScheme}, ${width} pixels wide`, () =>
      on(
        name,
        async (page) => {
          await page.locator("[data-item='0']").click();
          await page.locator("#steps-of").waitFor();
          for (const summary of await page.locator("summary").all()) await summary.click();
          await page.addScriptTag({ path: axePath });
          const { violations } = await page.evaluate(() => window.axe.run());
          assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`), []);
        },
        { colorScheme, viewport: { width, height: 900 } },
      ));

test("the page has one heading of the first level, which names the scene", () =>
  on("divergent", async (page) => {
    assert.equal(await page.locator("h1").count(), 1);
    assert.match(await text(page, "h1"), /lockstep report/);
    assert.match(await text(page, "h1 .scene"), /\S/);
  }));

test("every control is reached and named by keyboard alone", () =>
  on("divergent", async (page) => {
    const reached = new Set();
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.side || document.activeElement.className || document.activeElement.tagName));
    }
    for (const wanted of ["theme", "frame", "frame-number", "reference", "gpu", "difference", "link"]) assert.ok(reached.has(wanted), `${wanted} in ${[...reached]}`);
  }));

test("a narrow window does not scroll sideways", () =>
  on("divergent", async (page) => {
    await page.locator("[data-item='0']").click();
    await page.locator("#steps-of").waitFor();
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  }, { viewport: { width: 400, height: 800 } }));

test("text of the scene is text, whatever it looks like", async () => {
  const folder = temporaryFolder();
  pages.strange = report(writeScene(folder, {}, "<img src=x onerror=alert(1)>.json"), "--frames", "2");
  await on("strange", async (page) => {
    assert.match(await text(page, ".scene"), /<img src=x onerror=alert\(1\)>/);
    assert.equal(await page.locator('img[onerror], img[src="x"], img:not([src^="data:image/png"])').count(), 0);
  });
});

test("of a page of some MB the first picture is there within 1.5 s, or on a busy machine within four times a small page's", async () => {
  pages.large = report("data/scenes/lattice.json", "--particles", "50000", "--frames", "25");
  assert.ok(statSync(pages.large).size > 2e6);
  const times = { short: [], large: [] };
  for (let i = 0; i < 3; ++i)
    for (const name of Object.keys(times))
      await on(name, async (page) => {
        times[name].push(await page.evaluate(() => performance.getEntriesByName("first-picture")[0].startTime));
      });
  assert.ok(Math.min(...times.large) < Math.max(1500, 4 * Math.min(...times.short)), JSON.stringify(times));
});

test("a page is one file of at most 5 MB", () => {
  for (const page of Object.values(pages)) assert.ok(statSync(page).size <= 5e6);
});
