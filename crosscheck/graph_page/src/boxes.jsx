// How a node looks: its ports on the left, what it makes on the right, values that are no links in fields.
import { Handle, Position, useEdges } from "@xyflow/react";
import { createContext, useContext, useState } from "react";
import { outputsId } from "./graph.js";
import { catalogue, stageNamed, typeNamed } from "./check.js";

export const Editor = createContext(null); // { stage, change(id, data), rename(id, to), problem }

// A field for JSON: a number, [x, y, z], true. Empty: nothing is given.
function Value({ value, label, onChange, placeholder = "" }) {
  const shown = value === undefined ? "" : typeof value === "string" ? value : JSON.stringify(value);
  const [text, setText] = useState(null);
  const [wrong, setWrong] = useState(false);
  const take = () => {
    if (text === null) return;
    try {
      onChange(text.trim() === "" ? undefined : JSON.parse(text));
      setText(null);
      setWrong(false);
    } catch {
      setWrong(true);
    }
  };
  return (
    <input className="nodrag" aria-label={label} aria-invalid={wrong} title={wrong ? "no JSON" : label} placeholder={placeholder}
      value={text ?? shown} onChange={(event) => setText(event.target.value)} onBlur={take}
      onKeyDown={(event) => event.key === "Enter" && take()} />
  );
}

function Choice({ value, label, all, onChange }) {
  return (
    <select className="nodrag" aria-label={label} value={value} onChange={(event) => onChange(event.target.value)}>
      {!all.includes(value) && <option>{value}</option>}
      {all.map((one) => <option key={one}>{one}</option>)}
    </select>
  );
}

function Port({ id, port, given, standard, onChange }) {
  const linked = useEdges().some((edge) => edge.target === id && edge.targetHandle === port);
  return (
    <div className="port">
      <Handle type="target" position={Position.Left} id={port} />
      <span>{port}</span>
      {!linked && <Value value={given} label={`${id.replace(":", "")} ${port}`} placeholder={standard} onChange={onChange} />}
    </div>
  );
}

const without = (all, key, value) => {
  const next = { ...all, [key]: value };
  if (value === undefined) delete next[key];
  return next;
};

export function NodeBox({ id, data }) {
  const { stage, change, rename, problem, types } = useContext(Editor);
  const type = typeNamed(data.type);
  const setOption = (key, value) => change(id, { ...data, options: without(data.options, key, value) });
  const made = types?.get(id);
  const parts = data.type === "split" ? [..."xyzw".slice(0, { vec2: 2, vec3: 3, vec4: 4 }[made] ?? 4)] : ["out"];
  return (
    <div className={problem?.id === id ? "box wrong" : "box"} data-type={data.type}>
      <header>
        <input className="nodrag id" aria-label={`name of ${id}`} defaultValue={id} key={id} onBlur={(event) => rename(id, event.target)}
          onKeyDown={(event) => event.key === "Enter" && event.target.blur()} />
        <span className="type">{data.type}</span>
      </header>
      {type.ports.map(({ name, standard, wants }) => (
        <Port key={name} id={id} port={name} given={data.given[name]} standard={standard === undefined ? (wants === "part" ? "none" : "") : String(standard)}
          onChange={(value) => change(id, { ...data, given: without(data.given, name, value) })} />
      ))}
      {type.options.map((key) => (
        <div className="option" key={key}>
          <span>{key}</span>
          {data.type === "input" ? (
            <Choice value={data.options.value} label={`${id} ${key}`} all={stageNamed(stage).inputs.map((input) => input.name)} onChange={(value) => setOption(key, value)} />
          ) : key === "law" ? (
            <Choice value={data.options.law ?? "linear"} label={`${id} ${key}`} all={["linear", "inverse_square"]} onChange={(value) => setOption(key, value)} />
          ) : (
            <Value value={data.options[key]} label={`${id} ${key}`} onChange={(value) => setOption(key, value)} />
          )}
        </div>
      ))}
      <footer>
        <span className="makes">{made ?? ""}</span>
        {parts.map((part, k) => (
          <span className="part" key={part}>
            {part === "out" ? "" : part}
            <Handle type="source" position={Position.Right} id={part} style={parts.length > 1 ? { top: "auto", bottom: 8 + 14 * (parts.length - 1 - k) } : { top: "auto", bottom: 8 }} />
          </span>
        ))}
      </footer>
    </div>
  );
}

export function OutputsBox({ data }) {
  const { stage, change, problem } = useContext(Editor);
  return (
    <div className={problem?.id === outputsId ? "box outputs wrong" : "box outputs"}>
      <header><span className="type">outputs of {stage}</span></header>
      {stageNamed(stage).outputs.map(({ name, type }) => (
        <Port key={name} id={outputsId} port={name} given={data.given[name]} standard={type}
          onChange={(value) => change(outputsId, { ...data, given: without(data.given, name, value) })} />
      ))}
    </div>
  );
}

export const stages = catalogue.stages.map((stage) => stage.name);
