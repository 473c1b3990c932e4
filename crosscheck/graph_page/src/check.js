// What is wrong with a graph: the first thing, as `lockstep graph check` says it, by the same order and words.
// Compared with it by tests/page/graph.test.mjs.
import catalogue from "./catalogue.json" with { type: "json" };

export class Problem extends Error {
  constructor(path, what) {
    super(`${path || "/"}: ${what}`);
    this.path = path || "/";
    this.what = what;
  }
}

export const typeNamed = (name) => catalogue.nodes.find((one) => one.type === name);
export const stageNamed = (name) => catalogue.stages.find((one) => one.name === name);
export const sizes = { float: 1, vec2: 2, vec3: 3, vec4: 4 };
const vectorOf = (size) => ["float", "vec2", "vec3", "vec4"][size - 1];
const isNumber = (type) => type in sizes;
const floats = { least: -3.4e38, most: 3.4e38 };

function shown(value) {
  // Characters beyond ASCII are told as escapes, as in the program's messages.
  const text = (JSON.stringify(value) ?? String(value)).replace(/[\u007f-\uffff]/g, (c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, "0")}`);
  return text.length > 40 ? `${text.slice(0, 37)}...` : text;
}
const isObject = (value) => value !== null && typeof value === "object" && !Array.isArray(value);

const fail = (path, what) => {
  throw new Problem(path, what);
};
const failNot = (value, path, right) => fail(path, `${shown(value)} is not ${right}`);

// Keys in the order in which the program has them.
const keysOf = (value, path) => (isObject(value) ? Object.keys(value).sort() : failNot(value, path, "an object"));
const find = (value, key, path) => (isObject(value) ? (Object.hasOwn(value, key) ? value[key] : undefined) : failNot(value, path, "an object"));
function at(value, key, path) {
  const found = find(value, key, path);
  return found === undefined ? fail(path, `the key "${key}" is missing`) : found;
}
const text = (value, path) => (typeof value === "string" ? value : failNot(value, path, "a text"));
const items = (value, path) => (Array.isArray(value) ? value : failNot(value, path, "an array"));
function number(value, path, { least = floats.least, most = floats.most, words = "a finite number" } = {}) {
  if (typeof value !== "number") failNot(value, path, words);
  if (Math.abs(value) > floats.most && most === floats.most && (value > 0 || least < 0))
    fail(path, `${shown(value)} is beyond what a float holds, 3.4e38`);
  return value >= least && value <= most ? Math.fround(value) : failNot(value, path, words);
}
const integer = (value, path, least, most) =>
  Number.isInteger(value) && value >= least && value <= most ? value : failNot(value, path, `an integer from ${least} to ${most}`);
const float = (x) => Number(x.toPrecision(7));

function unknown(path, name, what, known) {
  fail(path, known.length > 40 || known.length === 0 ? `'${name.slice(0, 40)}' is no ${what}` : `'${name.slice(0, 40)}' is no ${what}; there are ${known.join(", ")}`);
}
function named(value, path, all, what, key = "name") {
  const name = text(value, path);
  return all.find((one) => one[key] === name) ?? unknown(path, name, what, all.map((one) => one[key]));
}

// A number, several, or a truth: its type. `orElse`: what else may stand there.
function literal(value, path, orElse = " or a truth") {
  if (typeof value === "boolean") return "bool";
  if (!Array.isArray(value)) return number(value, path, { words: `a finite number, an array of two to four${orElse}` }), "float";
  if (value.length < 2 || value.length > 4) fail(path, `${value.length} numbers; right is two to four`);
  value.forEach((one, i) => number(one, `${path}/${i}`));
  return vectorOf(value.length);
}

export function fnv1a(name) {
  let id = 2166136261;
  for (const c of new TextEncoder().encode(name)) id = Math.imul(id ^ c, 16777619) >>> 0;
  return id;
}

const graphKeys = ["stage", "description", "nodes", "outputs"];
const nodeKeys = ["id", "type", "inputs", "place", "value", "range", "keys", "channel", "values", "seed", "potential", "falloff", "law", "direction", "angle"];
const valued = ["constant", "parameter", "input"];

class Checker {
  constructor(graph, stage) {
    this.graph = graph;
    this.asked = stage;
    this.nodes = [];
    this.places = new Map();
    this.channels = new Map();
    this.open = [];
  }

  run() {
    this.knownKeys(this.graph, "", graphKeys);
    const description = find(this.graph, "description", "");
    if (description !== undefined) text(description, "/description");
    this.readIds();
    this.findStage();
    this.nodes.forEach((node) => this.readValues(node));
    this.nodes.forEach((_, n) => this.resolve(n, 0));
    this.readOutputs();
    return { stage: this.stage, types: new Map(this.nodes.map((node) => [node.id, node.makes])) };
  }

  knownKeys(value, path, allowed) {
    for (const key of keysOf(value, path))
      if (!allowed.includes(key)) fail(path, `unknown key ${shown(key)}; the keys here are ${allowed.join(", ")}`);
  }

  readIds() {
    const all = items(at(this.graph, "nodes", ""), "/nodes");
    if (all.length > catalogue.limits.nodes) fail("/nodes", `${all.length} nodes; right is at most ${catalogue.limits.nodes}`);
    all.forEach((json, n) => {
      const path = `/nodes/${n}`;
      this.knownKeys(json, path, nodeKeys);
      const id = text(at(json, "id", path), `${path}/id`);
      if (!/^[A-Za-z0-9_]{1,40}$/.test(id)) fail(`${path}/id`, `'${id.slice(0, 40)}' is no name of a node; right is 1 to 40 letters, digits and _`);
      if (this.places.has(id)) fail(`${path}/id`, `there is a node '${id}' already`);
      this.places.set(id, n);
      const type = named(at(json, "type", path), `${path}/type`, catalogue.nodes, "type of a node", "type");
      this.nodes.push({ json, path, id, type, inputs: [], makes: "float", depth: 0, resolved: false });
    });
  }

  findStage() {
    this.stage = stageNamed(this.asked);
    const stage = find(this.graph, "stage", "");
    if (stage !== undefined) {
      const own = named(stage, "/stage", catalogue.stages, "stage");
      if (this.stage && this.stage !== own) fail("/stage", `is ${own.name}; right is ${this.asked}`);
      this.stage = own;
    }
    if (this.stage) return;
    const outputs = keysOf(at(this.graph, "outputs", ""), "/outputs");
    const has = (values, name) => values.some((value) => value.name === name);
    this.stage = catalogue.stages.find(
      (one) =>
        outputs.every((name) => has(one.outputs, name)) &&
        this.nodes.every(({ type, json }) => type.type !== "input" || typeof json.value !== "string" || has(one.inputs, json.value)),
    );
    if (!this.stage) fail("/outputs", "no stage has these outputs, with these inputs; right is one of emission, simulation and rendering");
  }

  readValues(node) {
    const { json, path, type } = node;
    for (const key of keysOf(json, path)) {
      const common = ["id", "type", "place"].includes(key) || (key === "inputs" && !valued.includes(type.type));
      if (!common && !type.options.includes(key)) fail(`${path}/${key}`, `is no property of a node of type ${type.type}`);
    }
    if (type.stage && type.stage !== this.stage.name)
      fail(`${path}/type`, `a node of type ${type.type} belongs to the stage ${type.stage}, not to ${this.stage.name}`);
    if (type.type === "input")
      node.makes = named(at(json, "value", path), `${path}/value`, this.stage.inputs, `input of the stage ${this.stage.name}`).type;
    else if (valued.includes(type.type)) node.makes = literal(at(json, "value", path), `${path}/value`);
    if (type.type === "parameter") this.readRange(node);
    if (type.type === "curve") this.readKeys(node);
    this.readOptions(node);
  }

  readRange({ json, path, makes }) {
    if (makes !== "float") fail(`${path}/value`, `is a ${makes}; a parameter is a float`);
    if (json.range === undefined) return;
    const two = items(json.range, `${path}/range`);
    if (two.length !== 2) fail(`${path}/range`, `${two.length} numbers; right is the least and the greatest`);
    const [low, high] = two.map((one, i) => number(one, `${path}/range/${i}`));
    const value = Math.fround(json.value);
    if (!(low <= high)) fail(`${path}/range`, `from ${float(low)} to ${float(high)}; right is the least first`);
    if (value < low || value > high) fail(`${path}/value`, `${float(value)} is not within ${float(low)} to ${float(high)}`);
  }

  readKeys({ json, path }) {
    const all = items(at(json, "keys", path), `${path}/keys`);
    if (all.length < 1 || all.length > catalogue.limits.keys) fail(`${path}/keys`, `${all.length} keys; right is 1 to ${catalogue.limits.keys}`);
    let before = null;
    all.forEach((key, k) => {
      const place = `${path}/keys/${k}`;
      const two = items(key, place);
      if (two.length !== 2) fail(place, `${two.length} numbers; right is a place and a value`);
      const t = number(two[0], `${place}/0`);
      if (before !== null && !(t > before)) fail(`${place}/0`, `${float(t)} after ${float(before)}; right is rising`);
      number(two[1], `${place}/1`);
      before = t;
    });
  }

  readOptions(node) {
    const { json, path, type, id } = node;
    const whole = (key, least, most, standard) => (json[key] === undefined ? standard : integer(json[key], `${path}/${key}`, least, most));
    whole("seed", 0, 2 ** 24 - 1, 1);
    whole("potential", 1, 3, 1);
    whole("falloff", 0, 2, 1);
    if (json.law !== undefined && !["linear", "inverse_square"].includes(json.law)) failNot(json.law, `${path}/law`, "one of linear, inverse_square");
    if (type.type === "random") {
      // The program reads both before it looks at either.
      const values = whole("values", 1, 3, 1), channel = whole("channel", 0, 2 ** 32 - 1, fnv1a(id));
      node.makes = vectorOf(values);
      if (this.channels.has(channel)) fail(path, `'${id}' has the numbers of '${this.channels.get(channel)}': channel ${channel} is that of both`);
      this.channels.set(channel, id);
    }
    if (type.type === "cone") this.readCone(node);
  }

  readCone({ json, path }) {
    const direction = at(json, "direction", path), angle = at(json, "angle", path);
    if (!Array.isArray(direction) || direction.length !== 3) failNot(direction, `${path}/direction`, "a vector of three finite numbers, [x, y, z]");
    const length = Math.hypot(...direction.map((one, i) => number(one, `${path}/direction/${i}`)));
    if (!(length > 0 && length < floats.most)) fail(`${path}/direction`, "has no length");
    number(angle, `${path}/angle`, { least: 0, most: 180, words: "a number of degrees from 0 to 180" });
  }

  resolve(n, depth) {
    const node = this.nodes[n];
    if (node.resolved) return;
    const first = this.open.indexOf(n);
    if (first >= 0) {
      const cycle = [...this.open.slice(first), n].map((one) => this.nodes[one].id);
      fail(this.nodes[this.open.at(-1)].path, `the nodes wait for each other: ${cycle.join(" needs ")}`);
    }
    const deepest = catalogue.limits.depth;
    if (depth >= deepest) fail(node.path, `more than ${deepest} nodes behind each other`);
    this.open.push(n);
    const { json, path, type, id } = node;
    const known = type.ports.map((port) => port.name);
    if (json.inputs !== undefined)
      for (const port of keysOf(json.inputs, `${path}/inputs`))
        if (!known.includes(port)) unknown(`${path}/inputs`, port, `port of '${id}', a node of type ${type.type}`, known);
    let behind = 0;
    for (const port of type.ports) {
      const source = this.sourceAt(node, port, depth);
      if (source.node !== undefined) behind = Math.max(behind, this.nodes[source.node].depth);
      node.inputs.push(source);
    }
    if (behind >= deepest) fail(path, `more than ${deepest} nodes behind each other`);
    if (!valued.includes(type.type) && type.type !== "random") this.fit(node);
    node.depth = behind + 1;
    node.resolved = true;
    this.open.pop();
  }

  sourceAt({ json, path, id }, port, depth) {
    const given = json.inputs === undefined ? undefined : find(json.inputs, port.name, `${path}/inputs`);
    if (given !== undefined) return this.link(given, `${path}/inputs/${port.name}`, depth);
    if (port.wants === "part") return { missing: true, type: "float" };
    if (port.standard === undefined) fail(path, `'${id}' has nothing at its port ${port.name}`);
    return { type: "float", numbers: [port.standard] };
  }

  link(value, path, depth) {
    if (typeof value !== "string") return { type: literal(value, path, ", a truth or a node's id"), numbers: [value].flat() };
    const dot = value.indexOf(".");
    const name = dot < 0 ? value : value.slice(0, dot);
    const isOfSplit = dot >= 0 && value.length === dot + 2 && "xyzw".includes(value[dot + 1]);
    if (!this.places.has(name)) unknown(path, isOfSplit ? name : value, "node", [...this.places.keys()].sort()); // else perhaps a number
    const n = this.places.get(name);
    this.resolve(n, depth + 1);
    const from = this.nodes[n], splits = from.type.type === "split";
    if (dot < 0) {
      if (splits) fail(path, `'${name}' is split; right is one of its ports, ${name}.x`);
      return { node: n, type: from.makes };
    }
    const port = value.slice(dot + 1);
    if (!splits) fail(path, `'${name}' has no port '${port.slice(0, 40)}'; right is '${name}', or a split of it`);
    const parts = "xyzw".slice(0, sizes[from.makes]);
    if (port.length !== 1 || !parts.includes(port)) fail(path, `'${name}' has no port '${port.slice(0, 40)}'; it is split into ${parts}`);
    return { node: n, part: parts.indexOf(port), type: "float" };
  }

  // A number that the shader's compiler knows as well.
  constant({ node, part, numbers }, component) {
    const from = node === undefined ? undefined : this.nodes[node];
    if (from !== undefined && from.type.type !== "constant") return undefined;
    const known = from === undefined ? numbers : [from.json.value].flat();
    return known === undefined ? undefined : Math.fround(known.length === 1 ? known[0] : known[part ?? component]);
  }

  // Compilers fold a quotient by a constant 0 to what they like.
  checkDivisor({ id, path, type, inputs }, components) {
    for (let c = 0; c < components; ++c) {
      if (type.type === "divide" && this.constant(inputs[1], c) === 0) fail(path, `'${id}' divides by 0: its port b`);
      const low = this.constant(inputs[0], c);
      if (type.type === "smoothstep" && low !== undefined && low === this.constant(inputs[1], c))
        fail(path, `'${id}' rises from ${low} to ${low}: right are a low and a high that differ`);
    }
  }

  failType({ json, path, id, inputs, type }, p, right) {
    const port = type.ports[p].name;
    const given = json.inputs !== undefined && json.inputs[port] !== undefined;
    fail(given ? `${path}/inputs/${port}` : path, `port ${port} of '${id}' gets a ${inputs[p].type}; right is ${right}`);
  }

  // Holds the types of a node's ports against each other, and finds what it makes.
  fit(node) {
    const { type, inputs } = node;
    let shared = "float", first = true;
    type.ports.forEach(({ wants }, p) => {
      if (wants !== "shared" && wants !== "any") return;
      const given = inputs[p].type;
      if (wants === "shared" && !isNumber(given)) this.failType(node, p, "a float or a vector");
      if (wants === "any" && given === "bool") this.failType(node, p, "a float, a vector or a uint");
      if (first || (shared === "float" && isNumber(given))) shared = given;
      first = false;
      if (given !== shared && !(given === "float" && isNumber(shared))) this.failType(node, p, `a ${shared}, as at the ports before`);
    });
    type.ports.forEach(({ wants }, p) => {
      const { type: given, missing } = inputs[p];
      if ((wants === "float" || wants === "part") && !missing && given !== "float") this.failType(node, p, "a float");
      if (wants === "vec3" && given !== "vec3" && given !== "float") this.failType(node, p, "a vec3");
      if (wants === "bool" && given !== "bool") this.failType(node, p, "a bool");
      if (wants === "vector" && (!isNumber(given) || given === "float")) this.failType(node, p, "a vector");
    });
    node.makes = ["float", "vec3", "bool"].includes(type.makes) ? type.makes : type.type === "split" ? inputs[0].type : shared;
    if (["divide", "smoothstep"].includes(type.type)) this.checkDivisor(node, sizes[shared]);
    if (type.type === "compose") {
      const [z, w] = [!inputs[2].missing, !inputs[3].missing];
      if (w && !z) fail(node.path, `'${node.id}' has nothing at its port z, and something at w`);
      node.makes = vectorOf(w ? 4 : z ? 3 : 2);
    }
  }

  readOutputs() {
    const outputs = at(this.graph, "outputs", "");
    const known = this.stage.outputs.map((output) => output.name);
    for (const name of keysOf(outputs, "/outputs")) {
      if (known.includes(name)) continue;
      for (const other of catalogue.stages)
        if (other.outputs.some((output) => output.name === name))
          fail(`/outputs/${name}`, `'${name}' is an output of the stage ${other.name}, not of ${this.stage.name}`);
      unknown("/outputs", name, `output of the stage ${this.stage.name}`, known);
    }
    let any = false;
    for (const { name, type: right } of this.stage.outputs) {
      const given = find(outputs, name, "/outputs");
      if (given === undefined) continue;
      any = true;
      const { type } = this.link(given, `/outputs/${name}`, 0);
      if (type !== right && !(type === "float" && isNumber(right))) fail(`/outputs/${name}`, `output ${name} gets a ${type}; right is a ${right}`);
    }
    if (!any) fail("/outputs", "there is no output");
  }
}

// The stage and each node's type; throws Problem. `stage`: the one that is asked for; empty: as the graph says.
export const checked = (graph, stage = "") => new Checker(graph, stage).run();

// The first problem as text; empty: none.
export function problemOf(graph, stage = "") {
  try {
    checked(graph, stage);
    return "";
  } catch (error) {
    if (error instanceof Problem) return error.message;
    throw error;
  }
}

export { catalogue };
