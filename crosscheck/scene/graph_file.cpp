#include "crosscheck/scene/graph_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/scene/graph_constants.hpp"
#include "reference/model/near_name.hpp"
#include "reference/readings/site.hpp"

namespace lockstep {
namespace {

using Wants = GraphWants;

constexpr std::string_view parts = "xyzw";

std::string short_line(std::string_view text) { return plain_line(std::string(text.substr(0, 40))); }

/// "'speed' is no node; there are ..."
[[noreturn]] void fail_unknown(const JsonValue& at, std::string_view name, std::string_view what,
                               const std::vector<std::string>& known) {
    const std::string near = did_you_mean(std::string(name), known);
    if (known.size() > 40 || known.empty())
        at.fail(fmt::format("'{}' is no {}{}", short_line(name), what, near));
    at.fail(fmt::format("'{}' is no {}; there are {}{}", short_line(name), what, fmt::join(known, ", "), near));
}

template <class Values> std::vector<std::string> names_of(const Values& values) {
    std::vector<std::string> names;
    for (const auto& value : values)
        names.emplace_back(value.name);
    return names;
}

template <class Values> std::size_t named(const JsonValue& at, const Values& values, std::string_view what) {
    const std::string name = at.text();
    const auto found = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.name == name; });
    if (found == values.end())
        fail_unknown(at, name, what, names_of(values));
    return static_cast<std::size_t>(found - values.begin());
}

bool is_number(GraphType type) { return type <= GraphType::vec4; }

/// A number, several, or a truth. `or_else`: what else may stand there.
GraphSource literal(const JsonValue& json, std::string_view or_else = " or a truth") {
    GraphSource source;
    if (json.is_truth()) {
        source.type = GraphType::boolean;
        source.whole = json.truth() ? 1 : 0;
        return source;
    }
    if (!json.is_array()) {
        const std::string right = fmt::format("a finite number, an array of two to four{}", or_else);
        source.numbers.fill(json.number({number::finite.min, number::finite.max, right}));
        return source;
    }
    const std::vector<JsonValue> all = json.items();
    if (all.size() < 2 || all.size() > 4)
        json.fail(fmt::format("{} numbers; right is two to four", all.size()));
    for (std::size_t i = 0; i < all.size(); ++i)
        source.numbers[i] = all[i].number();
    source.type = static_cast<GraphType>(all.size() - 1);
    return source;
}

class Reader {
  public:
    /// `stage`: the one it is for; empty: as it says.
    Reader(const JsonValue& json, std::string_view stage) : json_(json), asked_(stage) {}

    Graph read() {
        json_.check_keys({"stage", "description", "nodes", "outputs"});
        if (const auto description = json_.find("description"))
            static_cast<void>(description->label());
        read_ids();
        find_stage();
        constants_.emplace(graph_);
        for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
            read_values(n);
        for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
            resolve(n, 0);
        read_outputs();
        return std::move(graph_);
    }

  private:
    struct Read {
        JsonValue json;
        const GraphNodeType* type;
        bool resolved = false;
        std::size_t depth = 0; ///< of what it needs
    };

    void read_ids() {
        const std::vector<JsonValue> all = json_.at("nodes").items();
        if (all.size() > most_graph_nodes)
            json_.at("nodes").fail(fmt::format("{} nodes; right is at most {}", all.size(), most_graph_nodes));
        for (const JsonValue& node : all) {
            const JsonValue id = node.at("id");
            const std::string name = id.text();
            const auto fits = [](char c) {
                return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
            };
            if (name.empty() || name.size() > 40 || !std::all_of(name.begin(), name.end(), fits))
                id.fail(
                    fmt::format("'{}' is no name of a node; right is 1 to 40 letters, digits and _", short_line(name)));
            if (!places_.emplace(name, graph_.nodes.size()).second)
                id.fail(fmt::format("there is a node '{}' already", name));
            const GraphNodeType& type =
                graph_node_types()[named(node.at("type"), graph_node_types(), "type of a node")];
            node.check_keys({"id", "type", "inputs", "place", "value", "range", "keys", "channel", "values", "seed",
                             "potential", "falloff", "law", "direction", "angle"});
            read_.push_back({node, &type});
            graph_.nodes.push_back({.id = name, .kind = type.kind, .inputs = {}, .value = {}, .keys = {}});
        }
    }

    /// That of the file, or the first that has all that the graph names.
    void find_stage() {
        const auto stages = graph_stages();
        for (const GraphStage& stage : stages)
            if (stage.name == asked_)
                graph_.stage = &stage;
        if (const auto stage = json_.find("stage")) {
            const GraphStage& own = stages[named(*stage, stages, "stage")];
            if (graph_.stage != nullptr && graph_.stage != &own)
                stage->fail(fmt::format("is {}; right is {}", own.name, asked_));
            graph_.stage = &own;
        }
        if (graph_.stage != nullptr)
            return;
        const std::vector<std::string> outputs = json_.at("outputs").keys();
        const auto has = [](const auto& values, const std::string& name) {
            return std::any_of(values.begin(), values.end(), [&](const auto& v) { return v.name == name; });
        };
        for (const GraphStage& stage : stages)
            if (graph_.stage == nullptr &&
                std::all_of(outputs.begin(), outputs.end(),
                            [&](const auto& name) { return has(stage.outputs, name); }) &&
                std::all_of(read_.begin(), read_.end(), [&](const Read& node) {
                    const auto value = node.json.find("value");
                    return node.type->kind != GraphKind::input || !value || !value->is_text() ||
                           has(stage.inputs, value->text());
                }))
                graph_.stage = &stage;
        if (graph_.stage == nullptr)
            json_.at("outputs").fail("no stage has these outputs, with these inputs; right is one of emission, "
                                     "simulation and rendering");
    }

    /// Properties are its type's; and those that only some have no others'.
    void check_properties(const Read& read) const {
        const auto& own = read.type->options;
        for (const std::string& key : read.json.keys()) {
            const bool is_common = key == "id" || key == "type" || key == "place" ||
                                   (key == "inputs" && read.type->kind > GraphKind::input);
            if (!is_common && std::find(own.begin(), own.end(), key) == own.end())
                read.json.at(key).fail(fmt::format("is no property of a node of type {}", read.type->name));
        }
        if (!read.type->stage.empty() && read.type->stage != graph_.stage->name)
            read.json.at("type").fail(fmt::format("a node of type {} belongs to the stage {}, not to {}",
                                                  read.type->name, read.type->stage, graph_.stage->name));
    }

    void read_values(std::size_t n) {
        const Read& read = read_[n];
        GraphNode& node = graph_.nodes[n];
        check_properties(read);
        if (node.kind == GraphKind::input) {
            node.of_stage = named(read.json.at("value"), graph_.stage->inputs,
                                  fmt::format("input of the stage {}", graph_.stage->name));
            node.makes = graph_.stage->inputs[node.of_stage].type;
        } else if (node.kind < GraphKind::input) {
            node.value = literal(read.json.at("value"));
            node.makes = node.value.type;
        }
        if (node.kind == GraphKind::parameter)
            read_range(read, node);
        if (node.kind == GraphKind::curve)
            read_keys(read, node);
        read_options(read, node);
    }

    void read_options(const Read& read, GraphNode& node) {
        GraphOptions& options = node.options;
        const auto whole = [&](std::string_view key, std::int64_t least, std::int64_t most, std::int64_t standard) {
            const auto given = read.json.find(key);
            return given ? given->integer(least, most) : standard;
        };
        options.seed = static_cast<std::uint32_t>(whole("seed", 0, (1 << 24) - 1, 1));
        options.potential = static_cast<int>(whole("potential", 1, 3, 1));
        options.falloff = static_cast<int>(whole("falloff", 0, 2, 1));
        if (const auto law = read.json.find("law"))
            options.inverse_square = law->choice({"linear", "inverse_square"}) == 1;
        if (node.kind == GraphKind::random)
            read_random(read, node, static_cast<std::uint32_t>(whole("channel", 0, 0xffffffff, name_id(node.id))),
                        static_cast<int>(whole("values", 1, 3, 1)));
        if (node.kind == GraphKind::cone)
            read_cone(read, options);
    }

    void read_random(const Read& read, GraphNode& node, std::uint32_t channel, int values) {
        node.options.channel = channel;
        node.makes = static_cast<GraphType>(values - 1);
        const auto [other, is_new] = channels_.emplace(channel, node.id);
        if (!is_new)
            read.json.fail(fmt::format("'{}' has the numbers of '{}': channel {} is that of both", node.id,
                                       other->second, channel));
    }

    static void read_cone(const Read& read, GraphOptions& options) {
        const JsonValue direction = read.json.at("direction"), angle = read.json.at("angle");
        const glm::vec3 ahead = direction.vector();
        if (const float length = glm::length(ahead); !(length > 0.0F && std::isfinite(length)))
            direction.fail("has no length");
        options.basis = basis_of(ahead);
        options.cone_depth = depth_of_cone(angle.number({0.0, 180.0, "a number of degrees from 0 to 180"}));
    }

    static void read_range(const Read& read, const GraphNode& node) {
        if (node.makes != GraphType::real)
            read.json.at("value").fail(fmt::format("is a {}; a parameter is a float", graph_type_name(node.makes)));
        const auto range = read.json.find("range");
        if (!range)
            return;
        const std::vector<JsonValue> two = range->items();
        if (two.size() != 2)
            range->fail(fmt::format("{} numbers; right is the least and the greatest", two.size()));
        const float low = two[0].number(), high = two[1].number(), value = node.value.numbers[0];
        if (!(low <= high))
            range->fail(fmt::format("from {} to {}; right is the least first", low, high));
        if (value < low || value > high)
            read.json.at("value").fail(fmt::format("{} is not within {} to {}", value, low, high));
    }

    static void read_keys(const Read& read, GraphNode& node) {
        const JsonValue keys = read.json.at("keys");
        const std::vector<JsonValue> all = keys.items();
        if (all.empty() || all.size() > most_curve_keys)
            keys.fail(fmt::format("{} keys; right is 1 to {}", all.size(), most_curve_keys));
        for (const JsonValue& key : all) {
            const std::vector<JsonValue> two = key.items();
            if (two.size() != 2)
                key.fail(fmt::format("{} numbers; right is a place and a value", two.size()));
            const float t = two[0].number();
            if (!node.keys.empty() && !(t > node.keys.back()[0]))
                two[0].fail(fmt::format("{} after {}; right is rising", t, node.keys.back()[0]));
            node.keys.push_back({t, two[1].number()});
        }
    }

    /// The node and, before it, what it needs.
    void resolve(std::size_t n, std::size_t depth) {
        if (read_[n].resolved)
            return;
        if (const auto open = std::find(open_.begin(), open_.end(), n); open != open_.end()) {
            std::vector<std::string> cycle;
            for (auto at = open; at != open_.end(); ++at)
                cycle.push_back(graph_.nodes[*at].id);
            cycle.push_back(graph_.nodes[n].id);
            read_[open_.back()].json.fail(
                fmt::format("the nodes wait for each other: {}", fmt::join(cycle, " needs ")));
        }
        if (depth >= deepest_graph)
            read_[n].json.fail(fmt::format("more than {} nodes behind each other", deepest_graph));
        open_.push_back(n);
        if (const auto inputs = read_[n].json.find("inputs")) {
            const std::vector<std::string> known = names_of(read_[n].type->inputs);
            for (const std::string& port : inputs->keys())
                if (std::find(known.begin(), known.end(), port) == known.end())
                    fail_unknown(
                        *inputs, port,
                        fmt::format("port of '{}', a node of type {}", graph_.nodes[n].id, read_[n].type->name), known);
        }
        std::size_t behind = 0;
        for (const GraphPort& port : read_[n].type->inputs)
            graph_.nodes[n].inputs.push_back(source_at(n, port, depth, behind));
        if (behind >= deepest_graph)
            read_[n].json.fail(fmt::format("more than {} nodes behind each other", deepest_graph));
        if (read_[n].type->kind > GraphKind::input && read_[n].type->kind != GraphKind::random)
            fit(n);
        if (const std::string undefined = constants_->add(n); !undefined.empty())
            fail_undefined(n, undefined);
        read_[n].depth = behind + 1;
        read_[n].resolved = true;
        open_.pop_back();
    }

    /// As it is given; `fit` sets its type right.
    GraphSource source_at(std::size_t n, const GraphPort& port, std::size_t depth, std::size_t& behind) {
        const auto inputs = read_[n].json.find("inputs");
        const auto given = inputs ? inputs->find(port.name) : std::nullopt;
        if (!given) {
            GraphSource standard;
            if (port.wants == Wants::part) {
                standard.part = missing_part;
                return standard;
            }
            if (!port.standard)
                read_[n].json.fail(fmt::format("'{}' has nothing at its port {}", graph_.nodes[n].id, port.name));
            standard.numbers.fill(*port.standard);
            return standard;
        }
        const GraphSource source = link(*given, depth);
        if (source.node)
            behind = std::max(behind, read_[*source.node].depth);
        return source;
    }

    GraphSource link(const JsonValue& json, std::size_t depth) {
        if (!json.is_text())
            return literal(json, ", a truth or a node's id");
        const std::string text = json.text();
        const std::size_t dot = text.find('.');
        const auto found = places_.find(text.substr(0, dot));
        if (found == places_.end()) {
            std::vector<std::string> ids;
            for (const auto& [id, place] : places_)
                ids.push_back(id);
            const bool is_of_split = dot + 2 == text.size() && parts.find(text.back()) != std::string_view::npos;
            fail_unknown(json, is_of_split ? text.substr(0, dot) : text, "node", ids); // else perhaps a number
        }
        resolve(found->second, depth + 1);
        const GraphNode& from = graph_.nodes[found->second];
        GraphSource source{.node = found->second, .type = from.makes, .numbers = {}};
        if (dot == std::string::npos) {
            if (from.kind == GraphKind::split)
                json.fail(fmt::format("'{}' is split; right is one of its ports, {}.x", from.id, from.id));
            return source;
        }
        const std::string port = text.substr(dot + 1);
        const std::size_t part = port.size() == 1 ? parts.find(port[0]) : std::string_view::npos;
        if (from.kind != GraphKind::split)
            json.fail(fmt::format("'{}' has no port '{}'; right is '{}', or a split of it", from.id, short_line(port),
                                  from.id));
        if (part == std::string_view::npos || part >= graph_components(from.makes))
            json.fail(fmt::format("'{}' has no port '{}'; it is split into {}", from.id, short_line(port),
                                  parts.substr(0, graph_components(from.makes))));
        source.part = static_cast<int>(part);
        source.type = GraphType::real;
        return source;
    }

    [[noreturn]] void fail_type(std::size_t n, std::size_t port, std::string_view right) const {
        const GraphNodeType& type = *read_[n].type;
        const auto inputs = read_[n].json.find("inputs");
        const auto given = inputs ? inputs->find(type.inputs[port].name) : std::nullopt;
        (given ? *given : read_[n].json)
            .fail(fmt::format("port {} of '{}' gets a {}; right is {}", type.inputs[port].name, graph_.nodes[n].id,
                              graph_type_name(graph_.nodes[n].inputs[port].type), right));
    }

    static void widen(GraphSource& source, GraphType to) {
        if (source.node || source.type != GraphType::real)
            return; // a link is widened where it is read
        source.numbers.fill(source.numbers[0]);
        source.type = to;
    }

    /// Holds the types of a node's ports against each other, and finds what it makes.
    void fit(std::size_t n) {
        GraphNode& node = graph_.nodes[n];
        const GraphNodeType& type = *read_[n].type;
        // The widest at the ports that have to be alike.
        GraphType shared = GraphType::real;
        bool first = true;
        for (std::size_t p = 0; p < type.inputs.size(); ++p) {
            const Wants wants = type.inputs[p].wants;
            if (wants != Wants::shared && wants != Wants::any)
                continue;
            const GraphType given = node.inputs[p].type;
            if (wants == Wants::shared && !is_number(given))
                fail_type(n, p, "a float or a vector");
            if (wants == Wants::any && given == GraphType::boolean)
                fail_type(n, p, "a float, a vector or a uint");
            if (first || shared == GraphType::real)
                if (first || is_number(given))
                    shared = given;
            first = false;
            if (given != shared && !(given == GraphType::real && is_number(shared)))
                fail_type(n, p, fmt::format("a {}, as at the ports before", graph_type_name(shared)));
        }
        for (std::size_t p = 0; p < type.inputs.size(); ++p) {
            GraphSource& source = node.inputs[p];
            switch (type.inputs[p].wants) {
            case Wants::shared:
            case Wants::any:
                widen(source, shared);
                break;
            case Wants::real:
            case Wants::part:
                if (source.part != missing_part && source.type != GraphType::real)
                    fail_type(n, p, "a float");
                break;
            case Wants::vec3:
                if (source.type != GraphType::vec3 && source.type != GraphType::real)
                    fail_type(n, p, "a vec3");
                widen(source, GraphType::vec3);
                break;
            case Wants::boolean:
                if (source.type != GraphType::boolean)
                    fail_type(n, p, "a bool");
                break;
            case Wants::vector:
                if (!is_number(source.type) || source.type == GraphType::real)
                    fail_type(n, p, "a vector");
                break;
            }
        }
        node.takes = shared;
        node.makes = type.makes == Wants::real       ? GraphType::real
                     : type.makes == Wants::vec3     ? GraphType::vec3
                     : type.makes == Wants::boolean  ? GraphType::boolean
                     : node.kind == GraphKind::split ? node.inputs[0].type
                                                     : shared;
        if (node.kind == GraphKind::compose)
            compose(n);
    }

    /// Compilers fold what GLSL leaves undefined to what they like, llvmpipe's a quotient by 0 to 0.
    [[noreturn]] void fail_undefined(std::size_t n, const std::string& what) const {
        const GraphNode& node = graph_.nodes[n];
        if (node.kind == GraphKind::divide)
            read_[n].json.fail(fmt::format("'{}' divides by 0: its port b", node.id));
        for (std::size_t c = 0; c < graph_components(node.takes) && node.kind == GraphKind::smoothstep; ++c)
            if (const Interval low = constants_->at(node.inputs[0], c), high = constants_->at(node.inputs[1], c);
                low.is_point() && high.is_point() && low.low == high.low)
                read_[n].json.fail(fmt::format("'{}' rises from {} to {}: right are a low and a high that differ",
                                               node.id, low.as_float(), low.as_float()));
        read_[n].json.fail(
            fmt::format("'{}' {} at every input that it comes to, which GLSL leaves open", node.id, what));
    }

    void compose(std::size_t n) {
        GraphNode& node = graph_.nodes[n];
        const bool z = node.inputs[2].part != missing_part, w = node.inputs[3].part != missing_part;
        if (w && !z)
            read_[n].json.fail(fmt::format("'{}' has nothing at its port z, and something at w", node.id));
        node.inputs.resize(w ? 4 : z ? 3 : 2);
        node.makes = static_cast<GraphType>(node.inputs.size() - 1);
    }

    void read_outputs() {
        const JsonValue outputs = json_.at("outputs");
        const auto known = names_of(graph_.stage->outputs);
        for (const std::string& name : outputs.keys())
            if (std::find(known.begin(), known.end(), name) == known.end()) {
                for (const GraphStage& other : graph_stages())
                    for (const auto& value : other.outputs)
                        if (value.name == name)
                            outputs.at(name).fail(fmt::format("'{}' is an output of the stage {}, not of {}", name,
                                                              other.name, graph_.stage->name));
                fail_unknown(outputs, name, fmt::format("output of the stage {}", graph_.stage->name), known);
            }
        for (std::size_t o = 0; o < known.size(); ++o) {
            const auto given = outputs.find(known[o]);
            if (!given)
                continue;
            GraphSource source = link(*given, 0);
            const GraphType right = graph_.stage->outputs[o].type;
            if (source.type != right && !(source.type == GraphType::real && is_number(right)))
                given->fail(fmt::format("output {} gets a {}; right is a {}", known[o], graph_type_name(source.type),
                                        graph_type_name(right)));
            widen(source, right);
            graph_.outputs.push_back({o, source});
            if (source.node)
                put_in_order(*source.node);
        }
        if (graph_.outputs.empty())
            outputs.fail("there is no output");
    }

    void put_in_order(std::size_t n) {
        if (std::find(graph_.order.begin(), graph_.order.end(), n) != graph_.order.end())
            return;
        for (const GraphSource& source : graph_.nodes[n].inputs)
            if (source.node)
                put_in_order(*source.node);
        graph_.order.push_back(n);
    }

    static constexpr int missing_part = -2; ///< of a port of compose that is left out

    const JsonValue& json_;
    std::string_view asked_;
    Graph graph_;
    std::vector<Read> read_;
    std::map<std::string, std::size_t> places_;
    std::map<std::uint32_t, std::string> channels_; ///< of the random nodes
    std::optional<GraphConstants> constants_;       ///< of the nodes that are resolved
    std::vector<std::size_t> open_;                 ///< being resolved, each for the one before
};

} // namespace

Graph read_graph(const JsonValue& json) { return read_graph(json, ""); }
Graph read_graph(const JsonValue& json, std::string_view stage) { return Reader(json, stage).read(); }

Graph load_graph(const std::filesystem::path& file) {
    const nlohmann::json document = read_json(file);
    return read_graph(JsonValue(document, file.string()));
}

} // namespace lockstep
