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
    FrameRange frames;
    std::vector<std::string> lead_in;
    bool every = false;
};

HashedFrames frames_of(const HashRequest& options) {
    return {options.frames.first, options.frames.end, options.every, options.lead_in};
}

void hash_reference(const Scene& scene, const HashRequest& options) {
    ReferenceSimulation reference(scene, named_profile(options.profile));
    print_hash_lines(frames_of(options), [&](int frame, bool shown) {
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
    print_hash_lines(frames_of(options), [&](int frame, bool shown) -> std::uint64_t {
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
        return gpu ? hash_system_on_gpu(*system, options.run, frames_of(options))
                   : hash_system(*system, options.run, options.profile, frames_of(options));
    if (!options.lead_in.empty())
        throw Error(
            "hash: --lead-in goes with a scene that names its \"system\"; a collision frame needs all of the one "
            "before");
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
    verb.add(frames_option("--frames", options->frames, "frames to run; A..B: hashes of these only, counted from 0"));
    verb.add(choice_option<HashedSide>("--side", options->side, {{"cpu", HashedSide::cpu}, {"gpu", HashedSide::gpu}},
                                       "cpu: the reference; gpu: the shaders, none of whose frames is judged"));
    add_profile_option(verb, options->profile);
    verb.add(flag("--every", options->every, "print every frame's hash, not only the last"));
    verb.add(
        texts_option("--lead-in", "PASS", options->lead_in,
                     "with --side gpu and --frames A..B: before these frames run these passes alone; right where all "
                     "others are made anew"));
    verb.footer = "Example: lockstep hash data/scenes/lattice.json --frames 1000 --preset exact";
    verb.run = [options](const Call& call) {
        const bool cpu = options->side == HashedSide::cpu;
        for (const std::string_view name : {"--gl", "--shaders", "--allow-unused", "--profile"})
            if (call.has(name) && cpu != (name == "--profile"))
                throw Error(fmt::format("hash: {} goes with --side {}", name, cpu ? "gpu" : "cpu"));
        if (call.has("--lead-in") && (cpu || !options->frames.is_part))
            throw Error("hash: --lead-in goes with --side gpu and --frames A..B");
        return run(*options);
    };
    return verb;
}

} // namespace lockstep
