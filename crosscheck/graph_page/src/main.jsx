// The editor: load a file, change it, see what is wrong, save it. Nothing leaves the page but by saving.
import { Background, Controls, ReactFlow, ReactFlowProvider, addEdge, applyEdgeChanges, applyNodeChanges, useReactFlow } from "@xyflow/react";
import { useCallback, useMemo, useRef, useState } from "react";
import { createRoot } from "react-dom/client";
import "@xyflow/react/dist/style.css";
import "./style.css";
import { Editor, NodeBox, OutputsBox, stages } from "./boxes.jsx";
import { checked, problemOf } from "./check.js";
import { fileText, firstProblem, freeId, outputsId, standardOptions, toBoxes, toGraph, typesOf } from "./graph.js";

const nodeTypes = { graphNode: NodeBox, graphOutputs: OutputsBox };
const empty = { stage: "simulation", nodes: [], outputs: {} };

function typesIn(graph) {
  try {
    return checked(graph, graph.stage).types;
  } catch {
    return null;
  }
}

function Page() {
  const start = useMemo(() => toBoxes(empty), []);
  const [about, setAbout] = useState({ stage: "simulation", description: "", name: "graph.json" });
  const [boxes, setBoxes] = useState(start.boxes);
  const [links, setLinks] = useState(start.links);
  const [refused, setRefused] = useState("");
  const [saved, setSaved] = useState(true);
  const picker = useRef(null);
  const flow = useReactFlow();

  const graph = useMemo(() => toGraph(about, boxes, links), [about, boxes, links]);
  const problem = useMemo(() => firstProblem(graph), [graph]);
  const types = useMemo(() => typesIn(graph), [graph]);

  const load = useCallback((text, name) => {
    let read;
    try {
      read = JSON.parse(text);
    } catch (error) {
      return setRefused(`${name}: malformed JSON: ${error.message}`);
    }
    // What has another shape than a graph's has no boxes; what is merely wrong has, and says so.
    const shape = /unknown|is not (a text|an array|an object)|is missing|is no (type|stage|name|property)|already|no stage has|right is at most/;
    const words = problemOf(read);
    if (words && shape.test(words)) return setRefused(`${name}: ${words}`);
    const stage = read.stage ?? checked(read).stage.name;
    const made = toBoxes(read);
    setRefused("");
    setAbout({ stage, description: read.description ?? "", name });
    setBoxes(made.boxes);
    setLinks(made.links);
    setSaved(true);
    setTimeout(() => flow.fitView({ padding: 0.1 }), 50);
  }, [flow]);

  const change = useCallback((id, data) => {
    setBoxes((all) => all.map((box) => (box.id === id ? { ...box, data } : box)));
    setSaved(false);
  }, []);
  const rename = useCallback((id, field) => {
    const to = field.value;
    if (to === id) return;
    if (!/^[A-Za-z0-9_]{1,40}$/.test(to) || boxes.some((box) => box.id === to)) {
      field.value = id;
      return setRefused(`'${to.slice(0, 40)}' is no new name of a node; right is 1 to 40 letters, digits and _, which no other has`);
    }
    setRefused("");
    setBoxes((all) => all.map((box) => (box.id === id ? { ...box, id: to } : box)));
    setLinks((all) => all.map((link) => ({ ...link, id: link.target === id ? `${to}.${link.targetHandle}` : link.id,
      source: link.source === id ? to : link.source, target: link.target === id ? to : link.target })));
    setSaved(false);
  }, [boxes]);
  const connect = useCallback((link) => {
    // A port has one link: the last.
    setLinks((all) => addEdge({ ...link, id: `${link.target}.${link.targetHandle}` },
      all.filter((other) => other.target !== link.target || other.targetHandle !== link.targetHandle)));
    setSaved(false);
  }, []);
  const add = useCallback((type) => {
    const place = flow.screenToFlowPosition({ x: window.innerWidth / 2, y: window.innerHeight / 2 });
    setBoxes((all) => [...all, { id: freeId(type, all), type: "graphNode", position: place,
      data: { type, given: {}, options: standardOptions(type, about.stage) } }]);
    setSaved(false);
  }, [about.stage, flow]);
  const save = useCallback(() => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([fileText(graph)], { type: "application/json" }));
    link.download = about.name;
    link.click();
    URL.revokeObjectURL(link.href);
    setSaved(true);
  }, [about.name, graph]);

  const editor = useMemo(() => ({ stage: about.stage, change, rename, problem, types }), [about.stage, change, rename, problem, types]);
  return (
    <Editor.Provider value={editor}>
      <nav>
        <button onClick={() => picker.current.click()}>Load</button>
        <input ref={picker} id="file" type="file" accept=".json" hidden onChange={async (event) => {
          const file = event.target.files[0];
          if (file) load(await file.text(), file.name);
          event.target.value = "";
        }} />
        <button onClick={save} disabled={problem !== null} title={problem ? "what is wrong cannot be saved" : about.name}>Save{saved ? "" : " *"}</button>
        <label>Stage <select id="stage" value={about.stage} onChange={(event) => { setAbout({ ...about, stage: event.target.value }); setSaved(false); }}>
          {stages.map((stage) => <option key={stage}>{stage}</option>)}
        </select></label>
        <label>Add <select id="add" value="" onChange={(event) => event.target.value && add(event.target.value)}>
          <option value="">a node</option>
          {typesOf(about.stage).map(({ type }) => <option key={type}>{type}</option>)}
        </select></label>
        <input id="description" aria-label="description" placeholder="what the graph does" value={about.description}
          onChange={(event) => { setAbout({ ...about, description: event.target.value }); setSaved(false); }} />
      </nav>
      <p id="verdict" role="status" className={problem ? "wrong" : "right"}>
        {problem ? problem.text : `right: ${boxes.length - 1} nodes`}
      </p>
      {refused && <p id="refused" role="alert" className="wrong">{refused}</p>}
      <main>
        <ReactFlow nodes={boxes} edges={links} nodeTypes={nodeTypes} onConnect={connect}
          onNodesChange={(changes) => { setBoxes((all) => applyNodeChanges(changes, all)); if (changes.some((one) => one.type === "remove" || one.dragging)) setSaved(false); }}
          onEdgesChange={(changes) => { setLinks((all) => applyEdgeChanges(changes, all)); if (changes.some((one) => one.type === "remove")) setSaved(false); }}
          deleteKeyCode={["Delete", "Backspace"]} minZoom={0.2} fitView>
          <Background />
          <Controls showInteractive={false} />
        </ReactFlow>
      </main>
    </Editor.Provider>
  );
}

createRoot(document.getElementById("page")).render(<ReactFlowProvider><Page /></ReactFlowProvider>);
requestAnimationFrame(() => requestAnimationFrame(() => { document.documentElement.dataset.ready = ""; }));
export { outputsId };
