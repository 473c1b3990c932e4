#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reference/model/basis.hpp"

namespace lockstep {

/// What a value of a graph is. Only a float widens by itself, to a vector of the same number.
enum class GraphType : std::uint8_t { real, vec2, vec3, vec4, uint, boolean };

std::string_view graph_type_name(GraphType type); ///< as GLSL has it
/// Floats of a type; 0 of one that has none.
constexpr std::size_t graph_components(GraphType type) {
    return type <= GraphType::vec4 ? static_cast<std::size_t>(type) + 1 : 0;
}

/// What a node does.
enum class GraphKind : std::uint8_t {
    constant,
    parameter,
    input,
    add,
    subtract,
    multiply,
    divide,
    negate,
    abs,
    floor,
    fract,
    min,
    max,
    clamp,
    mix,
    step,
    smoothstep,
    sqrt,
    dot,
    cross,
    length,
    normalize,
    compose,
    split,
    less,
    equal,
    logical_and,
    logical_or,
    logical_not,
    select,
    curve,
    sin_turns,
    cos_turns,
    random,
    noise,
    noise_gradient,
    curl_noise,
    drag,
    vortex,
    point_attraction,
    point,
    box,
    sphere,
    cone,
};

/// What a port takes, or a node makes.
enum class GraphWants : std::uint8_t {
    shared, ///< a float or a vector, the same at all such ports of a node
    any,    ///< the same, or a uint
    real,
    vec3,
    boolean,
    vector, ///< of any size
    part,   ///< a float or nothing: of compose
};

struct GraphPort {
    std::string_view name;
    GraphWants wants = GraphWants::shared;
    std::optional<float> standard = {}; ///< where nothing is given; none: it has to be
};

struct GraphNodeType {
    GraphKind kind;
    std::string_view name;
    std::vector<GraphPort> inputs;
    GraphWants makes = GraphWants::shared;
    std::vector<std::string_view> options = {}; ///< its properties besides those of every node
    std::string_view stage = {};                ///< the one that has it; empty: all
};

/// All there are.
std::span<const GraphNodeType> graph_node_types();

/// What a stage of a particle's life hands a graph, and asks of it.
struct GraphStage {
    struct Value {
        std::string_view name;
        GraphType type;
    };
    std::string_view name;
    std::vector<Value> inputs, outputs;
};
std::span<const GraphStage> graph_stages();

/// Where a port's value comes from: another node, a part of it, or a number.
struct GraphSource {
    std::optional<std::size_t> node = {};
    int part = -1; ///< of a vector; -1: all
    GraphType type = GraphType::real;
    std::array<float, 4> numbers{};
    std::uint32_t whole = 0; ///< of a uint; of a boolean 0 or 1
};

/// What nodes are told besides their ports, each as its type has it.
struct GraphOptions {
    std::uint32_t channel = 0;   ///< of random
    std::uint32_t seed = 1;      ///< of noise, below 2^24
    int falloff = 1;             ///< of a force: 0, 1 or 2
    bool inverse_square = false; ///< of an attraction; else linear
    int potential = 1;           ///< of a gradient: 1, 2 or 3
    Basis basis = {};            ///< of a cone
    float cone_depth = 0.0F;     ///< 1 - cos of its angle
};

struct GraphNode {
    std::string id;
    GraphKind kind = GraphKind::constant;
    GraphType makes = GraphType::real;
    GraphType takes = GraphType::real;      ///< at the ports that have to be alike
    std::vector<GraphSource> inputs;        ///< one a port
    GraphSource value;                      ///< of a constant or a parameter
    std::size_t of_stage = 0;               ///< which of the stage's inputs
    std::vector<std::array<float, 2>> keys; ///< of a curve: t rising, value
    GraphOptions options = {};
};

/// Nodes that compute what a stage asks for: checked, so that every source is there, of its type, and no node waits for
/// itself.
struct Graph {
    const GraphStage* stage = nullptr;
    std::vector<GraphNode> nodes;
    struct Output {
        std::size_t of_stage = 0;
        GraphSource source;
    };
    std::vector<Output> outputs;    ///< in the stage's order
    std::vector<std::size_t> order; ///< of those that the outputs need: depth first, ports in their order
};
using GraphPtr = std::shared_ptr<const Graph>;

/// Whether what it makes depends on an input of its stage.
bool reads_input(const Graph& graph, std::string_view name);

/// The output of that name; null: the graph has none.
const Graph::Output* output_named(const Graph& graph, std::string_view name);

/// A number that the shader's compiler knows as well: one at a port, or of a constant node.
std::optional<float> graph_constant(const Graph& graph, const GraphSource& source, std::size_t component);

inline constexpr std::size_t most_graph_nodes = 256, deepest_graph = 64, most_curve_keys = 16;

} // namespace lockstep
