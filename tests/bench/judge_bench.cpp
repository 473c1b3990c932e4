// Verdicts on a frame in which two texels differ, as on a driver that rounds window coordinates by itself: the scene
// lattice, there drawn by a matrix slightly off. The label says what was judged.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "tests/uneven_roots.hpp"

namespace {

using namespace lockstep;

Profile windows_not_followed() {
    Profile profile = test::profile_with_roots();
    profile.raster.viewport = ViewportRounding::separate;
    profile.not_followed = {"points: viewport", "triangles: viewport"};
    profile.point_window_accurate = profile.corner_window_accurate = true;
    return profile;
}

void verdicts(benchmark::State& state, const std::string& step) {
    SceneOptions options;
    options.particles = static_cast<std::size_t>(state.range(0));
    options.set = {"step=" + step};
    const Scene scene = load_scene("data/scenes/lattice.json", options);
    const Profile profile = windows_not_followed();
    const KnownOperations known = measured_operations(profile);
    ReferenceSimulation reference(scene, profile);
    const FrameParams params = frame_params(scene, 0);
    FrameParams off = params;
    off.collision_proj_view[0][0] *= 1.0F + 0x1p-21F;
    const CollisionImage cdt = empty_cdt(scene);
    reference.step_from(scene.start, cdt, params);
    const Particles& after = reference.particles();
    CollisionImage drawn_off = cdt, gpu = reference.cdt();
    reference.draw(scene.start, after, off, drawn_off);
    int differing = 0;
    for (std::size_t t = 0; t < gpu.texels.size() && differing < 2; ++t)
        if (glm::distance(gpu.texels[t], drawn_off.texels[t]) > 1e-4F) { // more than an obstacle's rounding
            gpu.texels[t] = drawn_off.texels[t];
            ++differing;
        }
    const JudgedFrame frame{scene.obstacles, params, profile, known,
                            scene.start,     cdt,    after,   reference.cdt(),
                            after,           gpu,    false,   reference.texels_of_points()};
    FrameVerdicts found;
    for (auto _ : state)
        found = judge(frame);
    const auto ties = std::count_if(found.texels.begin(), found.texels.end(),
                                    [](const ItemVerdict& v) { return v.kind == DifferenceClass::tie; });
    state.SetLabel(fmt::format("{} texels, {} ties", found.texels.size(), ties));
}

} // namespace

int main(int argc, char** argv) {
    for (const std::string step : {"transform_feedback", "compute"})
        benchmark::RegisterBenchmark(step.c_str(), verdicts, step)
            ->ArgName("particles")
            ->Arg(50'000)
            ->Arg(1'000'000)
            ->Arg(4'000'000)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
