#include "gpu/probe/root_tables.hpp"

#include <bit>
#include <cstdint>

#include "gpu/probe/vertex_stage.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t one = 0x3f800000U;
constexpr std::size_t chunk = std::size_t{1} << 22U;

/// `output` of the floats from 1 on, in order.
std::vector<float> tabulate(const probing::VertexStage& stage, const char* output, std::size_t count) {
    std::vector<float> table;
    table.reserve(count);
    std::vector<float> inputs(chunk);
    for (std::size_t first = 0; first < count; first += chunk) {
        for (std::size_t i = 0; i < chunk; ++i)
            inputs[i] = std::bit_cast<float>(one + static_cast<std::uint32_t>(first + i));
        const probing::Floats values = stage.run(chunk, {{"a_X", 1, inputs.data()}}, output);
        table.insert(table.end(), values.begin(), values.end());
    }
    return table;
}

} // namespace

RootTables measure_root_tables() {
    const probing::VertexStage stage("probe/roots", {}, {{"a_X", 1, nullptr}},
                                     {{"out_Reciprocal", GL_FLOAT}, {"out_InverseSqrt", GL_FLOAT}});
    return {tabulate(stage, "out_Reciprocal", std::size_t{1} << 23U),
            tabulate(stage, "out_InverseSqrt", std::size_t{1} << 24U)};
}

} // namespace lockstep
