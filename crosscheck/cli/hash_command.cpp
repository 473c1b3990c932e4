#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/report/hash_lines.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

enum class HashedSide { cpu, gpu };

struct HashRequest {
    RunOptions run;
    HashedSide side = HashedSide::cpu;
    std::string profile = "strict";
    bool every = false;
};

void hash_reference(const Scene& scene, const HashRequest& options) {
    ReferenceSimulation reference(scene, named_profile(options.profile));
    print_hash_lines(options.run.frames, options.every, [&](int frame, bool shown) {
        reference.step(frame_params(scene, frame));
        return shown ? state_hash(reference.particles(), reference.cdt()) : 0;
    });
}

void hash_gpu(const Scene& scene, const HashRequest& options) {
    static_cast<void>(shaders_to_run(options.run, scene));
    const Context context(parse_context_request(options.run.gl));
    GpuSimulation gpu(scene, options.run.shaders);
    Particles particles;
    CollisionImage cdt;
    print_hash_lines(options.run.frames, options.every, [&](int frame, bool shown) -> std::uint64_t {
        gpu.step(frame_params(scene, frame));
        if (!shown)
            return 0;
        gpu.read(particles);
        gpu.read(cdt);
        return state_hash(particles, cdt);
    });
}

int run(const HashRequest& options) {
    const bool gpu = options.side == HashedSide::gpu;
    if (const RegisteredSystem* system = system_of(options.run))
        return gpu ? hash_system_on_gpu(*system, options.run, options.every)
                   : hash_system(*system, options.run, options.profile, options.every);
    const Scene scene = load(options.run);
    (gpu ? hash_gpu : hash_reference)(scene, options);
    return status_agree;
}

} // namespace

Verb hash_command() {
    auto options = std::make_shared<HashRequest>();
    Verb verb{"hash", "run one side alone and print its state hash; the reference needs no GL"};
    add_scene_options(verb, options->run);
    add_gl_options(verb, options->run);
    verb.add(integer_option("--frames", "N", {1, most_frames}, options->run.frames, "frames to run"));
    verb.add(choice_option<HashedSide>("--side", options->side, {{"cpu", HashedSide::cpu}, {"gpu", HashedSide::gpu}},
                                       "cpu: the reference; gpu: the shaders, none of whose frames is judged"));
    verb.add(text_option("--profile", "strict|llvmpipe|nvidia", options->profile,
                         "strict, llvmpipe or nvidia: the order of sums"));
    verb.add(flag("--every", options->every, "print every frame's hash, not only the last"));
    verb.footer = "Example: lockstep hash data/scenes/lattice.json --frames 1000 --preset exact";
    verb.run = [options](const Call& call) {
        const bool cpu = options->side == HashedSide::cpu;
        for (const std::string_view name : {"--gl", "--shaders", "--allow-unused", "--profile"})
            if (call.has(name) && cpu != (name == "--profile"))
                throw Error(fmt::format("hash: {} goes with --side {}", name, cpu ? "gpu" : "cpu"));
        return run(*options);
    };
    return verb;
}

} // namespace lockstep
