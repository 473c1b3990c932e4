#include "crosscheck/collision/judge/neighbourhood.hpp"

#include <cstdlib>

#include <glm/common.hpp>

namespace lockstep {

std::optional<SearchedTexels> neighbourhood(const StepTable& table, int reach) {
    const StepTrace& reference = table.reference;
    const glm::ivec2 base(reference.base.x, reference.base.y);
    const glm::ivec2 gpu_base = table.gpu.vertex.integers("trace_base_texel").value_or(base);
    if (base.x < 0 && gpu_base.x < 0)
        return {};
    glm::ivec2 pick(-1), gpu_pick(-1);
    if (reference.nearest) {
        const BaseTexelIndex texel = reference.neighbours[*reference.nearest].texel;
        pick = {texel.x, texel.y};
    }
    if (table.gpu.vertex.integer("trace_hit").value_or(0) != 0)
        for (const CapturedVertex& neighbour : table.gpu.neighbours)
            if (neighbour.integer("trace_neighbour_reached") == 4)
                gpu_pick = neighbour.integers("trace_neighbour_texel").value_or(gpu_pick);
    const glm::ivec2 a = base.x < 0 ? gpu_base : base;
    const glm::ivec2 b = gpu_base.x < 0 ? base : gpu_base;
    constexpr int widest = 40;
    const bool both = std::abs(a.x - b.x) <= widest && std::abs(a.y - b.y) <= widest;
    const glm::ivec2 low = both ? glm::min(a, b) - reach : a - reach;
    const glm::ivec2 high = both ? glm::max(a, b) + reach : a + reach;
    return SearchedTexels{low, high, base, gpu_base, pick, gpu_pick};
}

} // namespace lockstep
