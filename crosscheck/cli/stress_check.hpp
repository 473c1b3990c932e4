#pragma once
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/command/shard.hpp"
#include "crosscheck/judge/legal.hpp"

namespace lockstep {

struct StressOptions {
    RunOptions run; ///< its scene is not looked at
    Legal legal = Legal::by_text;
    PassRules rules; ///< the power asked for is that of all scenes together
    Shard shard;     ///< of the scenes
    std::filesystem::path json;
    bool power = false; ///< list the mistakes
    bool quiet = false;
};

/// Checks the same shaders in every scene of data/scenes/stress, and says what they prove together. Returns the exit
/// status of `lockstep check`. Throws Error as a check does.
int check_stress(const StressOptions& options);

} // namespace lockstep
