// The reference's collision pass, obvious against fast: 200,000 particles in a slab that fills the view of a 500 x 500
// CDT, all of them searching. `lattice` lies in memory as it lies on the image, `box` at random. The label holds the
// state hash after the step and the share of texels covered.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include <fmt/format.h>

#include "reference/collision/collision_pass.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/emitters.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/uneven_roots.hpp"

namespace {

using namespace lockstep;

struct Frame {
    Particles particles;
    CollisionImage cdt;
    DepthImage depth;
};

struct Pass {
    decltype(&update_particles) update;
    decltype(&rasterise_particles) rasterise;
};
constexpr Pass obvious{update_particles, rasterise_particles};
constexpr Pass fast{update_particles_fast, rasterise_particles_fast};

void step(const Pass& pass, const Frame& now, const FrameParams& params, const Profile& profile, Frame& next) {
    pass.update(now.particles, now.cdt, params, profile, next.particles);
    next.cdt.texels.assign(next.cdt.texels.size(), glm::vec4(0.0F));
    next.depth.texels.assign(next.depth.texels.size(), 1.0F);
    pass.rasterise(now.particles, next.particles, params, profile, next.cdt, next.depth);
}

/// The state after frame 0, which only fills the CDT.
Frame first_frame(EmitterShape shape, const FrameParams& params, const Profile& profile) {
    const std::array slab{Emitter{.shape = shape,
                                  .box = {{-1.05F, -1.05F, -0.002F}, {1.05F, 1.05F, 0.002F}},
                                  .count = 200'000,
                                  .direction_jitter = 0.3F,
                                  .speed = 0.03F,
                                  .speed_jitter = 0.5F}};
    const CollisionImage cdt(params.width, params.height);
    Frame next{{}, cdt, {params.width, params.height}};
    step(fast, {emit(slab, 1), cdt, {}}, params, profile, next);
    return next;
}

void collision_step(benchmark::State& state, const Pass& pass, EmitterShape shape, const std::string& arithmetic) {
    Scene scene;
    scene.camera = {.eye = {0.0F, 0.0F, 3.0F}, .fov_y = 40.0F};
    scene.constants.texel_collide_range = static_cast<int>(state.range(0));
    scene.switches = preset(arithmetic == "exact" ? "exact" : "corrected");
    const FrameParams params = frame_params(scene, 0);
    const Profile profile = arithmetic == "nvidia tables"
                                ? test::profile_with_roots()
                                : named_profile(arithmetic == "exact" ? "strict" : arithmetic);
    const Frame now = first_frame(shape, params, profile);
    Frame next = now;
    for (auto _ : state)
        step(pass, now, params, profile, next);
    std::size_t covered = 0;
    for (const glm::vec4& texel : now.cdt.texels)
        covered += texel.a != 0.0F;
    state.SetLabel(fmt::format("{} {:.0f} %", hash_text(state_hash(next.particles, next.cdt)),
                               100.0 * static_cast<double>(covered) / static_cast<double>(now.cdt.texels.size())));
}

} // namespace

int main(int argc, char** argv) {
    for (const auto& [shape, shape_name] : {std::pair{EmitterShape::lattice, "lattice"}, {EmitterShape::box, "box"}})
        for (const std::string arithmetic : {"llvmpipe", "nvidia", "nvidia tables", "exact"})
            for (const auto& [pass, pass_name] : {std::pair{obvious, "obvious"}, {fast, "fast"}})
                benchmark::RegisterBenchmark(fmt::format("{}/{}/{}", shape_name, arithmetic, pass_name).c_str(),
                                             collision_step, pass, shape, arithmetic)
                    ->ArgName("radius")
                    ->Arg(1)
                    ->Arg(4)
                    ->Unit(benchmark::kMillisecond)
                    ->UseRealTime();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
