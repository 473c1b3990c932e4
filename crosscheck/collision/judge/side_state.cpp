#include "crosscheck/collision/judge/side_state.hpp"

#include <utility>

#include <fmt/format.h>

#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

void expect_none(const std::string& problem, const GpuSide& gpu) {
    if (!problem.empty())
        throw Error(fmt::format("{}: gives back {}", gpu.describe().name, problem));
}

} // namespace

std::string size_problem(const Particles& particles, std::size_t expected) {
    const std::pair<const char*, std::size_t> fields[] = {{"position", particles.position.size()},
                                                          {"direction", particles.direction.size()},
                                                          {"speed", particles.speed.size()},
                                                          {"collide_time", particles.collide_time.size()}};
    for (const auto& [name, size] : fields)
        if (size != expected)
            return fmt::format("{} of {} particles; the scene has {}", name, size, expected);
    return "";
}

std::string size_problem(const CollisionImage& cdt, int width, int height) {
    const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (cdt.width == width && cdt.height == height && cdt.texels.size() == texels)
        return "";
    return fmt::format("a CDT of {} x {}, {} texels; the scene's has {} x {}, {} texels", cdt.width, cdt.height,
                       cdt.texels.size(), width, height, texels);
}

void read_side(const GpuSide& gpu, const Scene& scene, Particles& particles) {
    gpu.read(particles);
    expect_none(size_problem(particles, scene.start.size()), gpu);
}

void read_side(const GpuSide& gpu, const Scene& scene, CollisionImage& cdt) {
    if (!gpu.has_cdt())
        return;
    gpu.read(cdt);
    expect_none(size_problem(cdt, scene.width, cdt_height(scene)), gpu);
}

void read_side(const GpuSide& gpu, const Scene& scene, Particles& particles, CollisionImage& cdt) {
    read_side(gpu, scene, particles);
    read_side(gpu, scene, cdt);
}

} // namespace lockstep
