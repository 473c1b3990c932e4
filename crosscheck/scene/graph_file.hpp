#pragma once
#include <filesystem>

#include "crosscheck/files/json_reader.hpp"
#include "reference/model/graph.hpp"

namespace lockstep {

/// A graph of nodes:
///
///     {"stage": "simulation",
///      "nodes": [{"id": "drag", "type": "multiply", "inputs": {"a": "velocity", "b": -0.8}},
///                {"id": "velocity", "type": "input", "value": "velocity"}],
///      "outputs": {"acceleration": "drag"}}
///
/// A port's value is a number, an array of two to four, a truth, "id", or "id.x" of a split. `stage` may be left out
/// where the names say it. Throws Error, `FILE: /json/pointer: ...`, for the first thing that is wrong: a cycle with
/// its nodes, an unknown type, port or node, a missing input, types that do not fit, and what is more than a graph may
/// have.
Graph read_graph(const JsonValue& json);
Graph load_graph(const std::filesystem::path& file);

/// One of a certain stage, which the graph need not name, and may not name otherwise.
Graph read_graph(const JsonValue& json, std::string_view stage);

} // namespace lockstep
