#pragma once
#include <string>

#include "gpu/shader_source.hpp"
#include "reference/model/graph.hpp"

namespace lockstep {

/// A graph as GLSL: one variable a node, n0, n1, ..., in their order. Names what a stage hands it u_... by `input`.
/// Twin: reference/system/graph_twin.hpp. `indent` begins every line. Needs shaders/rounding.glsl and
/// shaders/graph/nodes.glsl.
std::string graph_statements(const Graph& graph, const std::string& indent = "    ");

/// What an output is, after the statements: an expression of its type.
std::string graph_output(const Graph& graph, const Graph::Output& output);

/// What shaders/graph/graph.comp includes, by name: the words of an item of `inputs`, the stage's, and of `outputs`;
/// and the statements that make the one from the other.
ShaderTexts graph_texts(const Graph& graph);

} // namespace lockstep
