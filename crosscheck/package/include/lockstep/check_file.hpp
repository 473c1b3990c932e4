#pragma once
/// A check file in a unit test (docs/check_files.md): compute shaders over a state, as JSON has them, against a text.
///
///     const lockstep::Gl gl;
///     CHECK(lockstep::match_check_file(gl, "flock/boids.json", {.frames = 60}).passed());
#include <string>

#include "lockstep/lockstep.hpp"

namespace lockstep {

/// As the options of `lockstep check` of the same names.
struct CheckFileOptions {
    int frames = 60;
    CheckMode mode = CheckMode::resync;
    Legal legal = Legal::by_text;
    bool allow_undefined = false; ///< pass what rests on what GL leaves open
    std::string repeat = {};      ///< the command that repeats it; empty: `lockstep check FILE`
    std::string shaders = {};     ///< a folder instead of the file's
    std::string reference = {};   ///< likewise
};

/// Runs the passes of `file` on GL, and its reference's texts beside them; what match_system finds. Throws Error:
/// `FILE: /json/pointer: what is wrong and what is expected`, and for what is wrong with a shader.
MatchResult match_check_file(const Gl& gl, const std::string& file, const CheckFileOptions& options = {});

} // namespace lockstep
