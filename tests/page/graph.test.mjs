// The editor of node graphs: its messages against the program's, and the page in Chromium.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import catalogue from "../../crosscheck/graph_page/src/catalogue.json" with { type: "json" };
import { problemOf } from "../../crosscheck/graph_page/src/check.js";
import { fileText, toBoxes, toGraph } from "../../crosscheck/graph_page/src/graph.js";
import { axePath, cleanUp, lockstep, open, temporaryFolder } from "./browser.mjs";

after(cleanUp);

const page = "build/graph_page/graph.html";
const shippedNames = ["fire", "fade", "spray", "emission", "simulation", "rendering"];
const read = (name) => JSON.parse(readFileSync(`data/graphs/${name}.json`, "utf8"));
const copy = (value) => structuredClone(value);

// What the program says of a graph, without the file's name; without what it lists or guesses behind a semicolon.
const folder = temporaryFolder();
function programSays(graph) {
  const file = join(folder, "graph.json");
  writeFileSync(file, JSON.stringify(graph));
  const { status, stderr } = lockstep("graph", "glsl", file);
  if (status === 0) return "";
  const at = stderr.indexOf(`${file}: `);
  assert.ok(at >= 0, stderr);
  return stderr.slice(at + file.length + 2).trim();
}
const essence = (words) => words.replace(/; there are\b.*$/s, "").replace(/(is no [a-z ]+), did you mean.*$/s, "$1").replace(/ \(?did you mean.*$/s, "");

// Graphs changed in one place in every way that is tried.
function* changed(graph) {
  const set = (change) => {
    const made = copy(graph);
    change(made);
    return made;
  };
  for (const key of Object.keys(graph)) yield set((g) => delete g[key]);
  for (const value of [3, null, [], {}, "x", true]) {
    yield set((g) => (g.nodes = value));
    yield set((g) => (g.outputs = value));
    yield set((g) => (g.stage = value));
  }
  yield set((g) => (g.more = 1));
  for (const [n, node] of graph.nodes.entries()) {
    for (const key of Object.keys(node)) {
      yield set((g) => delete g.nodes[n][key]);
      for (const value of ["x", 7, null, [1], [1, 2], [3, 2, 1], true, {}]) yield set((g) => (g.nodes[n][key] = value));
    }
    for (const key of ["seed", "value", "falloff", "colour", "inputs"]) yield set((g) => (g.nodes[n][key] ??= 1));
    for (const port of Object.keys(node.inputs ?? {}))
      for (const value of ["nobody", "-0.8", "nobody.x", `${node.id}`, graph.nodes.at(-1).id, graph.nodes[0].id, `${graph.nodes[0].id}.x`, true, [1, 2], [1, 2, 3], 5, null, {}, [[1]]])
        yield set((g) => (g.nodes[n].inputs[port] = value));
    for (const port of Object.keys(node.inputs ?? {})) {
      yield set((g) => delete g.nodes[n].inputs[port]);
      yield set((g) => (g.nodes[n].inputs[`${port}s`] = 1));
    }
  }
  for (const name of ["size", "kill", "velocity", "lifetime", "nothing"])
    for (const value of [graph.nodes.at(-1).id, true, 1, "nobody"]) yield set((g) => (g.outputs[name] = value));
  for (const node of [
    { id: "r", type: "random", values: 4 }, { id: "r", type: "random", channel: -1 }, { id: "r", type: "random", channel: 1 },
    { id: "c", type: "cone", inputs: { u: 1 }, direction: [0, 0, 0], angle: 3 }, { id: "c", type: "cone", inputs: { u: 1 }, direction: [0, 1, 0], angle: 300 },
    { id: "k", type: "curve", inputs: { t: 0 }, keys: [[0, 1], [0, 2]] }, { id: "k", type: "curve", inputs: { t: 0 }, keys: [] },
    { id: "k", type: "parameter", value: 5, range: [0, 4] }, { id: "k", type: "parameter", value: [1, 2] }, { id: "k k", type: "add" },
    { id: "n", type: "noise", inputs: { at: 1 }, seed: 1e9 }, { id: "a", type: "point_attraction", inputs: { position: 1 }, law: "cubic" },
    { id: "d", type: "divide", inputs: { a: 1, b: 0 } }, { id: "d", type: "divide", inputs: { a: 1, b: [1, 0, 2] } },
    { id: "d", type: "smoothstep", inputs: { a: 2, low: 1 } }, { id: "d", type: "add", inputs: { a: 1e39, b: 0 } },
    { id: "a", type: "compose", inputs: { x: 1, y: 1, w: 1 } }, { id: "a", type: "split", inputs: { a: 1 } }, { id: "a", type: "equal", inputs: { a: true, b: 1 } },
  ])
    yield set((g) => g.nodes.push(node));
  for (const length of [63, 64, 65, 200, 300])
    yield set((g) => {
      for (let i = 0; i < length; ++i) g.nodes.push({ id: `chain${i}`, type: "negate", inputs: { a: i === 0 ? 1 : `chain${i - 1}` } });
    });
}

test("the page knows what the program knows of graphs", () => {
  assert.deepEqual(catalogue, JSON.parse(lockstep("graph", "nodes").stdout));
});

test("of whole and of broken graphs the page says what the program says", () => {
  let wrong = 0, tried = 0;
  for (const name of shippedNames) assert.equal(problemOf(read(name)), "");
  let k = 0;
  for (const name of ["fire", "fade", "spray"]) {
    for (const graph of changed(read(name))) {
      if (++k % (name === "fire" ? 4 : 13) !== 0) continue; // each is a run of the program
      ++tried;
      const said = programSays(graph);
      wrong += said === "" ? 0 : 1;
      assert.equal(essence(problemOf(graph)), essence(said), JSON.stringify(graph).slice(0, 3000));
    }
  }
  assert.ok(tried >= 250 && wrong >= 150, `${wrong} of ${tried} were wrong`);
});

test("a graph that goes through the editor's boxes is the same but for its places", () => {
  for (const name of shippedNames) {
    const graph = read(name);
    const { boxes, links } = toBoxes(graph);
    const back = JSON.parse(fileText(toGraph({ stage: graph.stage, description: graph.description }, boxes, links)));
    for (const node of back.nodes) delete node.place;
    assert.deepEqual(back, graph);
  }
});

async function onPage(body, options) {
  const { page: opened, complaints } = await open(page, options);
  try {
    await body(opened);
    assert.deepEqual(complaints, []);
  } finally {
    await opened.close();
  }
}
const load = (opened, file) => opened.setInputFiles("#file", file);
const verdict = (opened) => opened.locator("#verdict").innerText();
/** Waits until the verdict is like `words`: the page draws when it has time. */
const says = (opened, words) =>
  opened.waitForFunction((source) => new RegExp(source).test(document.querySelector("#verdict").innerText), words.source)
    .catch(async () => assert.match(await verdict(opened), words));
async function saved(opened) {
  const [download] = await Promise.all([opened.waitForEvent("download"), opened.getByRole("button", { name: /^Save/ }).click()]);
  const file = join(temporaryFolder(), download.suggestedFilename());
  await download.saveAs(file);
  return file;
}

test("a file is loaded, checked, saved, and the program takes it", () =>
  onPage(async (opened) => {
    await load(opened, "data/graphs/fire.json");
    await opened.waitForSelector('.react-flow__node[data-id="drag"]');
    await says(opened, /^right: 17 nodes$/);
    const { nodes, outputs } = read("fire");
    const links = [...nodes.flatMap((node) => Object.values(node.inputs ?? {})), ...Object.values(outputs)].filter((value) => typeof value === "string");
    await opened.waitForFunction((all) => document.querySelectorAll(".react-flow__edge").length === all, links.length);
    const file = await saved(opened);
    assert.equal(lockstep("graph", "check", file, "--items", "64", "--quiet").status, 0);
    const back = JSON.parse(readFileSync(file, "utf8"));
    for (const node of back.nodes) {
      assert.equal(node.place.length, 2);
      delete node.place;
    }
    assert.deepEqual(back, read("fire"));
  }));

test("what is edited is in the file: a value, a name, a new node, a link, a node that is deleted", () =>
  onPage(async (opened) => {
    await load(opened, "data/graphs/fire.json");
    const k = opened.getByLabel("k value");
    await k.fill("1.5");
    await k.press("Enter");
    const name = opened.getByLabel("name of lift");
    await name.fill("buoyancy");
    await name.press("Enter");
    await opened.selectOption("#add", "negate");
    await says(opened, /'negate_1' has nothing at its port a/);
    assert.equal(await opened.getByRole("button", { name: /^Save/ }).isDisabled(), true);
    assert.equal(await opened.locator('.react-flow__node[data-id="negate_1"] .box.wrong').count(), 1);
    // A link, drawn with the mouse: from the drag's side to the new node's port.
    await opened.locator(".react-flow__controls-fitview").click();
    await opened.waitForTimeout(300);
    await opened.locator('.react-flow__node[data-id="drag"] .react-flow__handle.source').dragTo(opened.locator('.react-flow__node[data-id="negate_1"] .react-flow__handle.target'), { force: true });
    await says(opened, /^right: 18 nodes$/);
    let graph = JSON.parse(readFileSync(await saved(opened), "utf8"));
    assert.equal(graph.nodes.find((node) => node.id === "k").value, 1.5);
    assert.equal(graph.nodes.find((node) => node.id === "negate_1").inputs.a, "drag");
    assert.equal(graph.nodes.find((node) => node.id === "upwards").inputs.b, "buoyancy");
    await opened.locator('.react-flow__node[data-id="negate_1"] .type').click();
    await opened.keyboard.press("Delete");
    await says(opened, /^right: 17 nodes$/);
    graph = JSON.parse(readFileSync(await saved(opened), "utf8"));
    assert.equal(graph.nodes.length, 17);
  }));

test("what is wrong is told with its place, and marked; what is no graph is refused and changes nothing", () =>
  onPage(async (opened) => {
    const graph = read("fire");
    graph.nodes.find((node) => node.id === "sum").inputs.a = "force";
    const file = join(temporaryFolder(), "cycle.json");
    writeFileSync(file, JSON.stringify(graph));
    await load(opened, file);
    await opened.waitForSelector(".box.wrong");
    await says(opened, /wait for each other/);
    assert.equal(essence(await verdict(opened)), essence(programSays(graph)));
    for (const [text, words] of [["{", /malformed JSON/], ["[]", /is not an object/], ['{"nodes": [{"id": 3}], "outputs": {}}', /3 is not a text/],
      ['{"nodes": [{"id": "<img src=x onerror=alert(1)>", "type": "add"}], "outputs": {}}', /is no name of a node/]]) {
      const bad = join(temporaryFolder(), "bad.json");
      writeFileSync(bad, text);
      await load(opened, bad);
      await opened.waitForFunction((source) => new RegExp(source).test(document.querySelector("#refused")?.innerText ?? ""), words.source);
      assert.equal(await opened.locator('.react-flow__node[data-id="force"]').count(), 1);
    }
  }));

test("one finds every control by its name, in light and dark", async () => {
  for (const colorScheme of ["light", "dark"])
    await onPage(async (opened) => {
      await load(opened, "data/graphs/fade.json");
      await opened.waitForSelector('.react-flow__node[data-id="color"]');
      await opened.addScriptTag({ path: axePath }).catch(() => opened.evaluate(readFileSync(axePath, "utf8")));
      const { violations } = await opened.evaluate(() => window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa"] }));
      assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)}`), []);
    }, { colorScheme, bypassCSP: true });
});
