#include <memory>
#include <string>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/report/progress.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/profile.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

struct HashRequest {
    RunOptions run;
    std::string profile = "strict";
    bool every = false;
};

int run(const HashRequest& options) {
    if (const RegisteredSystem* system = system_of(options.run))
        return hash_system(*system, options.run, options.profile, options.every);
    const Scene scene = load(options.run);
    ReferenceSimulation reference(scene, named_profile(options.profile));
    Progress progress("hash", options.run.frames, true);
    for (int frame = 0; frame < options.run.frames; ++frame) {
        reference.step(frame_params(scene, frame));
        progress.show(frame + 1);
        if (options.every || frame + 1 == options.run.frames)
            fmt::print("{} {}\n", frame, hash_text(state_hash(reference.particles(), reference.cdt())));
    }
    return status_agree;
}

} // namespace

Verb hash_command() {
    auto options = std::make_shared<HashRequest>();
    Verb verb{"hash", "run the reference alone and print its state hash; needs no GL"};
    add_scene_options(verb, options->run);
    verb.add(integer_option("--frames", "N", {1, most_frames}, options->run.frames, "frames to run"));
    verb.add(text_option("--profile", "strict|llvmpipe|nvidia", options->profile,
                         "strict, llvmpipe or nvidia: the order of sums"));
    verb.add(flag("--every", options->every, "print every frame's hash, not only the last"));
    verb.footer = "Example: lockstep hash data/scenes/lattice.json --frames 1000 --preset exact";
    verb.run = [options](const Call&) { return run(*options); };
    return verb;
}

} // namespace lockstep
