#include "crosscheck/scene/decimate.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "crosscheck/files/atomic_file.hpp"

namespace lockstep {
namespace {

std::vector<std::uint32_t> collapse(const Surface& surface, const std::vector<glm::vec3>& positions,
                                    std::size_t faces) {
    constexpr float any_error = 1.0F;
    std::vector<std::uint32_t> indices(surface.indices.size());
    indices.resize(meshopt_simplify(indices.data(), surface.indices.data(), surface.indices.size(), &positions[0].x,
                                    positions.size(), sizeof(glm::vec3), 3 * faces, any_error));
    return indices;
}

Surface without_unused_vertices(const Surface& surface) {
    std::vector<unsigned> remap(surface.positions.size());
    Surface used;
    used.positions.resize(meshopt_optimizeVertexFetchRemap(remap.data(), surface.indices.data(), surface.indices.size(),
                                                           surface.positions.size()));
    used.indices.resize(surface.indices.size());
    meshopt_remapIndexBuffer(used.indices.data(), surface.indices.data(), surface.indices.size(), remap.data());
    meshopt_remapVertexBuffer(used.positions.data(), surface.positions.data(), surface.positions.size(),
                              sizeof(glm::dvec3), remap.data());
    return used;
}

} // namespace

Surface decimate(const Surface& surface, std::size_t faces) {
    constexpr int most_tries = 32;
    const std::vector<glm::vec3> positions(surface.positions.begin(), surface.positions.end());
    const auto missing = [&](const std::vector<std::uint32_t>& indices) {
        return static_cast<std::ptrdiff_t>(faces) - static_cast<std::ptrdiff_t>(indices.size() / 3);
    };
    if (missing(surface.indices) >= 0)
        return without_unused_vertices(surface);
    // A pass of collapses can go below the target. While it does, the next try aims higher by what was missing.
    Surface nearest{surface.positions, collapse(surface, positions, faces)};
    std::size_t target = faces;
    for (int tries = 1; tries < most_tries && missing(nearest.indices) > 0; ++tries) {
        target = std::min(target + static_cast<std::size_t>(missing(nearest.indices)), surface.indices.size() / 3);
        auto indices = collapse(surface, positions, target);
        if (std::abs(missing(indices)) < missing(nearest.indices))
            nearest.indices = std::move(indices);
    }
    return without_unused_vertices(nearest);
}

void write_obj(const Surface& surface, const std::filesystem::path& file) {
    std::string text;
    for (const glm::dvec3& p : surface.positions)
        fmt::format_to(std::back_inserter(text), "v {} {} {}\n", static_cast<float>(p.x), static_cast<float>(p.y),
                       static_cast<float>(p.z));
    for (std::size_t i = 0; i < surface.indices.size(); i += 3)
        fmt::format_to(std::back_inserter(text), "f {} {} {}\n", surface.indices[i] + 1, surface.indices[i + 1] + 1,
                       surface.indices[i + 2] + 1);
    write_text_file(file, text);
}

} // namespace lockstep
