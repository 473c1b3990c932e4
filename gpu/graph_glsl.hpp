#pragma once
#include <string>
#include <utility>
#include <vector>

#include "gpu/shader_source.hpp"
#include "reference/model/graph.hpp"

namespace lockstep {

/// A graph as GLSL: one variable a node, n0, n1, ..., in their order. Names what a stage hands it u_... by `input`.
/// Twin: reference/system/graph_twin.hpp. `indent` begins every line. Needs shaders/rounding.glsl and
/// shaders/graph_nodes.glsl.
std::string graph_statements(const Graph& graph, const std::string& indent = "    ",
                             const std::string& parameters = "p");

/// The declarations of its parameters, uniforms named by `parameters` and the node's number; and what they are.
std::string graph_uniforms(const Graph& graph, const std::string& parameters = "p");
std::vector<std::pair<std::string, float>> graph_parameters(const Graph& graph, const std::string& parameters = "p");

/// What an output is, after the statements: an expression of its type.
std::string graph_output(const Graph& graph, const Graph::Output& output);

/// What shaders/graph/graph.comp includes, by name: the words of an item of `inputs`, the stage's, and of `outputs`;
/// and the statements that make the one from the other.
ShaderTexts graph_texts(const Graph& graph);

} // namespace lockstep
