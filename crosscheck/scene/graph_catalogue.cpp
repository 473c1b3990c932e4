#include "crosscheck/scene/graph_catalogue.hpp"

#include <array>
#include <string_view>

#include <nlohmann/json.hpp>

#include "reference/model/graph.hpp"

namespace lockstep {
namespace {

using nlohmann::ordered_json;

std::string_view wants_name(GraphWants wants) {
    static constexpr std::array<std::string_view, 7> names{"shared", "any", "float", "vec3", "bool", "vector", "part"};
    return names[static_cast<std::size_t>(wants)];
}

ordered_json values_of(const std::vector<GraphStage::Value>& values) {
    ordered_json all = ordered_json::array();
    for (const GraphStage::Value& value : values)
        all.push_back({{"name", value.name}, {"type", graph_type_name(value.type)}});
    return all;
}

ordered_json ports_of(const GraphNodeType& type) {
    ordered_json all = ordered_json::array();
    for (const GraphPort& port : type.inputs) {
        ordered_json one{{"name", port.name}, {"wants", wants_name(port.wants)}};
        if (port.standard)
            one["standard"] = *port.standard;
        all.push_back(std::move(one));
    }
    return all;
}

} // namespace

std::string graph_catalogue() {
    ordered_json stages = ordered_json::array(), nodes = ordered_json::array();
    for (const GraphStage& stage : graph_stages())
        stages.push_back(
            {{"name", stage.name}, {"inputs", values_of(stage.inputs)}, {"outputs", values_of(stage.outputs)}});
    for (const GraphNodeType& type : graph_node_types())
        nodes.push_back({{"type", type.name},
                         {"ports", ports_of(type)},
                         {"makes", wants_name(type.makes)},
                         {"options", type.options},
                         {"stage", type.stage}});
    const ordered_json limits{{"nodes", most_graph_nodes}, {"depth", deepest_graph}, {"keys", most_curve_keys}};
    return ordered_json{{"limits", limits}, {"stages", stages}, {"nodes", nodes}}.dump(1) + "\n";
}

} // namespace lockstep
