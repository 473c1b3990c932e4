// A graph's file as the editor's boxes and links, and back. The file's form is docs/graphs.md; a node may keep its
// `place` on the page, which the program does not read.
import { catalogue, checked, Problem, stageNamed, typeNamed } from "./check.js";

export const outputsId = "outputs:"; // no node's id has a colon
const column = 240, row = 150;

// How many nodes are behind each: its column.
function depths(nodes) {
  const depth = new Map();
  const byId = new Map(nodes.map((node) => [node.id, node]));
  const of = (id, open) => {
    if (depth.has(id) || open.has(id)) return depth.get(id) ?? 0;
    open.add(id);
    const links = Object.values(byId.get(id)?.inputs ?? {}).filter((value) => typeof value === "string");
    const deepest = Math.max(-1, ...links.map((link) => of(link.split(".")[0], open)).filter((d) => d !== undefined));
    depth.set(id, deepest + 1);
    return deepest + 1;
  };
  for (const node of nodes) of(node.id, new Set());
  return depth;
}

// Boxes for the nodes and one for the outputs; links between their ports. `inputs` that are no links stay in the box.
export function toBoxes(graph) {
  const depth = depths(graph.nodes ?? []);
  const filled = [];
  const boxes = [], links = [];
  const link = (value, box, port) => {
    const [source, part] = value.split(".");
    links.push({ id: `${box}.${port}`, source, sourceHandle: part ?? "out", target: box, targetHandle: port });
  };
  for (const node of graph.nodes ?? []) {
    const at = depth.get(node.id);
    filled[at] = (filled[at] ?? -1) + 1;
    const { id, type, inputs = {}, place, ...options } = node;
    const given = {};
    for (const [port, value] of Object.entries(inputs))
      if (typeof value === "string") link(value, id, port);
      else given[port] = value;
    const [x, y] = place ?? [at * column, filled[at] * row];
    boxes.push({ id, type: "graphNode", position: { x, y }, data: { type, given, options } });
  }
  const given = {};
  for (const [name, value] of Object.entries(graph.outputs ?? {}))
    if (typeof value === "string") link(value, outputsId, name);
    else given[name] = value;
  const last = 1 + Math.max(-1, ...depth.values());
  boxes.push({ id: outputsId, type: "graphOutputs", position: { x: last * column, y: 0 }, data: { given }, deletable: false });
  return { boxes, links };
}

export function toGraph({ stage, description }, boxes, links) {
  const linksTo = new Map();
  for (const { source, sourceHandle, target, targetHandle } of links)
    linksTo.set(`${target}.${targetHandle}`, sourceHandle === "out" ? source : `${source}.${sourceHandle}`);
  const withLinks = (id, given, ports) => {
    const all = {};
    for (const port of ports) {
      const value = linksTo.get(`${id}.${port}`) ?? given[port];
      if (value !== undefined) all[port] = value;
    }
    return all;
  };
  const nodes = boxes
    .filter((box) => box.id !== outputsId)
    .map(({ id, position, data }) => {
      const ports = typeNamed(data.type).ports.map((port) => port.name);
      return {
        id,
        type: data.type,
        ...(ports.length > 0 && { inputs: withLinks(id, data.given, ports) }),
        ...data.options,
        place: [Math.round(position.x), Math.round(position.y)],
      };
    });
  const outputs = boxes.find((box) => box.id === outputsId);
  return {
    ...(description && { description }),
    stage,
    nodes,
    outputs: withLinks(outputsId, outputs.data.given, stageNamed(stage).outputs.map((output) => output.name)),
  };
}

// A line a node, as a person would write it.
export function fileText({ nodes, ...rest }) {
  const lines = Object.entries(rest).map(([key, value]) => `  ${JSON.stringify(key)}: ${JSON.stringify(value)}`);
  const all = nodes.map((node) => `    ${JSON.stringify(node)}`).join(",\n");
  lines.splice(-1, 0, `  "nodes": [\n${all}\n  ]`);
  return `{\n${lines.join(",\n")}\n}\n`;
}

// The first problem: its words, and the node it is at. Nothing: there is none.
export function firstProblem(graph) {
  try {
    checked(graph, graph.stage ?? "");
    return null;
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    const node = /^\/nodes\/(\d+)/.exec(error.path);
    return { text: error.message, id: node ? graph.nodes[Number(node[1])]?.id : outputsId };
  }
}

// What a new node of a type starts with.
export function standardOptions(type, stage) {
  const start = {
    constant: { value: 1 },
    parameter: { value: 1, range: [0, 4] },
    input: { value: stageNamed(stage).inputs[0].name },
    curve: { keys: [[0, 0], [1, 1]] },
    cone: { direction: [0, 1, 0], angle: 20 },
  };
  return start[type] ?? {};
}

export function freeId(type, boxes) {
  const taken = new Set(boxes.map((box) => box.id));
  for (let k = 1; ; ++k) if (!taken.has(`${type}_${k}`)) return `${type}_${k}`;
}

export const typesOf = (stage) => catalogue.nodes.filter((type) => !type.stage || type.stage === stage);
