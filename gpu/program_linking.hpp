#pragma once
#include <span>
#include <string>
#include <vector>

#include "gpu/program.hpp"

namespace lockstep {

// What a program of GLSL texts and one of SPIR-V modules share when they are linked.

/// Takes up what the driver warns of in a program that links.
void note_link_warnings(GLuint program, std::span<const ShaderSource> stages);

/// False where it does not link. `captured` is what transform feedback captures; modules say it themselves.
bool link(GLuint program, std::span<const Capture> captured);

/// The names of which the driver takes one each for the outputs: its own, or one with the block that it lies in
/// (spellings). Empty where it takes none for one of them; the program is then linked as before.
std::vector<Capture> accepted_spellings(GLuint program, std::span<const ShaderSource> stages,
                                        std::span<const Capture> captured);

/// Why a program that failed to link did: a driver's own message need not name the output that is missing, so each is
/// tried by itself.
std::string link_failure(GLuint program, std::span<const ShaderSource> stages, std::span<const Capture> captured);

/// "a, b, c"
std::string joined_names(std::span<const Capture> captured);

/// Under the name that bindings give it.
void add_attribute(ProgramVariable variable, const Bindings* bindings, ProgramInterface& attributes);

/// Points are drawn, one a particle, and one is captured of each: a geometry stage takes points and makes points.
void check_geometry_stage(GLuint program, std::span<const ShaderSource> stages);

/// check_nothing_lost of modules; `fragment` null: none.
void check_nothing_lost(const SpirvModule& last, const SpirvModule* fragment, std::span<const Capture> captured);

} // namespace lockstep
