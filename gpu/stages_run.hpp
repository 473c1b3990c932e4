#pragma once
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "gpu/shader_use.hpp"

namespace lockstep {

// What became of a user's shader files: judged, compiled alone, or neither.

/// The files of every program that was drawn with or dispatched since forget_shaders_run, with what they include.
std::set<std::string>& shaders_run();
void forget_shaders_run();

/// A file of the user's that `whole` has and `use` does not is one that is compiled alone: ShaderUse::unused says so.
void add_compiled(ShaderUse& use, const ShaderUse& whole);

/// Links each pass that has a file of `user`, so that no stage goes unseen by the compiler. Throws Error like Program.
void compile_alone(std::string_view system, std::span<const PassStages> passes, const std::filesystem::path& user);

/// After a run: a file of the user's that no draw or dispatch was made with was compiled alone.
void note_what_ran(ShaderUse& use);

} // namespace lockstep
