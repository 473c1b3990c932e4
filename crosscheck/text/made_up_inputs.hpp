#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "crosscheck/text/examination.hpp"
#include "crosscheck/text/made_up_world.hpp"
#include "reference/text/program.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {

/// The block in which GLSL for Vulkan has what are plain uniforms in GL.
inline constexpr std::string_view block_of_uniforms = "gl_DefaultUniformBlock";

/// Some seconds of a watched run.
inline constexpr std::uint32_t most_branches = 10'000'000;

/// Invocations of a stage other than compute; fragments come in whole quads.
std::uint32_t invocations_of(const Examination& of, const text::Program& program);

/// Throws Error where more invocations would run than are run.
void check_invocations(const Examination& of, const text::Program& program);

/// What a program's names are bound to: numbers that are given, and made-up ones for the rest.
MadeUpWorld made_up_world(const Examination& of, const text::Program& program);

/// The words of each plain uniform that is given; none of the others.
std::vector<std::vector<std::uint32_t>> given_uniforms(const Examination& of, const text::Program& program);
/// Sets the members of a block that are given.
void give_members(const Examination& of, const text::Block& block, std::vector<std::uint32_t>& words);

/// Inputs that are given, and made-up ones for the rest: floats from 0 to 1, integers 0. Fragments lie in quads.
text::StageRun made_up_run(const Examination& of, const text::Program& program);

} // namespace lockstep
