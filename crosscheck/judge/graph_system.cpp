#include "crosscheck/judge/graph_system.hpp"

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "gpu/graph_glsl.hpp"
#include "reference/model/random.hpp"
#include "reference/system/graph_twin.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"

namespace lockstep {
namespace {

constexpr std::uint8_t input_buffer = 0, output_buffer = 1;

struct Compiled {
    GraphPtr graph;
    GraphSites sites;
    Schema schema;
};

Field field(const GraphStage::Value& value, const char* block, const char* before) {
    const std::size_t components = graph_components(value.type);
    return {.name = before + std::string(value.name),
            .scalar = components == 0 ? Scalar::uint32 : Scalar::float32,
            .components = components == 0 ? 1 : static_cast<int>(components),
            .block = block};
}

Schema schema_of(const Graph& graph) {
    std::vector<Field> inputs, outputs;
    for (const GraphStage::Value& value : graph.stage->inputs)
        inputs.push_back(field(value, "InputWords", "in_"));
    for (const Graph::Output& output : graph.outputs)
        outputs.push_back(field(graph.stage->outputs[output.of_stage], "OutputWords", ""));
    return checked({"graph",
                    {{.name = "inputs", .item = "input", .title = "the inputs", .fields = std::move(inputs)},
                     {.name = "outputs", .item = "output", .title = "the outputs", .fields = std::move(outputs)}}});
}

/// What the graph makes of an item's inputs. Twin of the shader that gpu/graph_glsl.hpp writes.
struct GraphTwin {
    std::shared_ptr<const Compiled> compiled;
    const std::vector<Site>* input_sites;

    template <class R> ItemWords<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        return words(run(r, in, item));
    }

    template <class R> GraphRun<R> run(R& r, const PassInput& in, std::size_t item) const {
        const Graph& graph = *compiled->graph;
        GraphRun<R> run(r, graph, compiled->sites, {});
        run.run([&](std::size_t i) {
            GraphNumber<R> value;
            const FieldId id{input_buffer, static_cast<std::uint8_t>(i)};
            const std::size_t count = graph_components(graph.stage->inputs[i].type);
            if (count == 0)
                value.whole = in.before.word(id, item);
            for (std::size_t c = 0; c < count; ++c)
                value.x[c] = r.read((*input_sites)[i], in.before.real(id, item, static_cast<int>(c)));
            return value;
        });
        return run;
    }

    template <class R> ItemWords<R> words(const GraphRun<R>& run) const {
        ItemWords<R> words;
        for (const Graph::Output& output : compiled->graph->outputs) {
            const GraphNumber<R> made = run.output(output);
            const std::size_t count = graph_components(compiled->graph->stage->outputs[output.of_stage].type);
            if (count == 0)
                words.add(made.whole);
            for (std::size_t c = 0; c < count; ++c)
                words.add(made.x[c]);
        }
        return words;
    }
};

/// The sites of the stages' inputs, for the whole run of the program.
const std::vector<Site>& input_sites(const GraphStage& stage) {
    static std::deque<std::string> names;
    static std::map<std::string_view, std::vector<Site>> all;
    const auto [found, is_new] = all.try_emplace(stage.name);
    if (is_new)
        for (const GraphStage::Value& value : stage.inputs)
            found->second.push_back(site_named(names.emplace_back("input " + std::string(value.name))));
    return found->second;
}

/// Rare values first; then about half below 1, and the rest up to 16.
float input_value(std::size_t item, std::uint64_t random) {
    static constexpr std::array<float, 8> rare{0.0F, 1.0F, -1.0F, 0.5F, 2.0F, 1e-20F, 1e18F, -0.25F};
    if (item < rare.size())
        return rare[(item + random % 3) % rare.size()];
    const float share = static_cast<float>((random >> 8U) & 0xffffffU) * 0x1p-24F;
    const float reach = (random & 1U) != 0 ? 1.0F : 16.0F;
    return (random & 2U) != 0 ? share * reach : -share * reach;
}

} // namespace

namespace {

std::shared_ptr<const Compiled> compiled_of(const GraphPtr& graph) {
    return std::shared_ptr<const Compiled>(new Compiled{graph, GraphSites(*graph), schema_of(*graph)});
}

SystemState made_up(const Schema& schema, std::size_t items, std::uint64_t seed) {
    SystemState made(schema, {{items}, {items}});
    std::uint64_t state = seed;
    const std::vector<Field>& fields = schema.resources[input_buffer].fields;
    for (std::size_t item = 0; item < items; ++item)
        for (std::size_t f = 0; f < fields.size(); ++f)
            for (int c = 0; c < fields[f].components; ++c) {
                const std::uint64_t random = splitmix64(++state);
                const FieldId id{input_buffer, static_cast<std::uint8_t>(f)};
                if (fields[f].scalar == Scalar::uint32)
                    made.set(id, item, static_cast<std::uint32_t>(random % 100'000));
                else
                    made.set(id, item, input_value(item, random), c);
            }
    return made;
}

template <class R> std::string hexadecimal(const GraphNumber<R>& value, GraphType type) {
    if (graph_components(type) == 0)
        return type == GraphType::boolean ? (value.whole != 0 ? "true" : "false") : fmt::format("{}", value.whole);
    std::string text;
    for (std::size_t c = 0; c < graph_components(type); ++c)
        text += fmt::format("{}{:a}", c == 0 ? "" : " ", static_cast<float>(value.x[c]));
    return text;
}

} // namespace

SystemScene graph_system(const GraphPtr& graph, const std::string& name, std::size_t items, std::uint64_t seed,
                         ArithmeticSwitch arithmetic) {
    const auto compiled = compiled_of(graph);
    System system{.name = name,
                  .schema = compiled->schema,
                  .passes = {},
                  .mistakes = {},
                  .start = made_up(compiled->schema, items, seed),
                  .settings = fmt::format("stage {}, {} of {} nodes compiled", graph->stage->name, graph->order.size(),
                                          graph->nodes.size())};
    system.passes.push_back(
        item_pass({.name = "graph", .resource = output_buffer, .stage = PassStage::compute, .arithmetic = arithmetic},
                  GraphTwin{compiled, &input_sites(*graph->stage)}));
    GlPass pass{.name = "graph", .stage = Stage::compute, .resource = output_buffer};
    pass.texts = graph_texts(*graph);
    pass.uniforms = [graph](int) {
        Uniforms all{{"u_Seed", GraphSurroundings{}.seed}};
        for (const auto& [uniform, value] : graph_parameters(*graph))
            all[uniform] = value;
        return all;
    };
    pass.defines = choice_defines("curl_derivative", std::array<std::string_view, 2>{"analytic", "difference"}, 0);
    return {std::move(system), {std::move(pass)}, arithmetic};
}

std::string graph_values(const GraphPtr& graph, std::size_t item, std::uint64_t seed) {
    const auto compiled = compiled_of(graph);
    const SystemState state = made_up(compiled->schema, item + 1, seed);
    const SystemView view = state.view();
    Values<Portable> reading{Portable{}};
    const auto run = GraphTwin{compiled, &input_sites(*graph->stage)}.run(reading, {view, 0}, item);
    std::string text;
    for (const std::size_t n : graph->order)
        text += fmt::format("{:24} {:5} {}\n", graph->nodes[n].id, graph_type_name(graph->nodes[n].makes),
                            hexadecimal(run.node(n), graph->nodes[n].makes));
    for (const Graph::Output& output : graph->outputs) {
        const GraphStage::Value& of = graph->stage->outputs[output.of_stage];
        text += fmt::format("-> {:21} {:5} {}\n", of.name, graph_type_name(of.type),
                            hexadecimal(run.output(output), of.type));
    }
    return text;
}

} // namespace lockstep
