#pragma once
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/gl.hpp"
#include "gpu/shader_source.hpp"

namespace lockstep {

// What GLSL stages say of their inputs, outputs and blocks, where drivers say nothing or nothing that helps. A check
// throws Error, naming file and line.

/// The last stage before rasterisation, whose outputs are captured; null if there is none.
const ShaderSource* last_vertex_stage(std::span<const ShaderSource> stages);
std::string last_vertex_stage_file(std::span<const ShaderSource> stages);

/// Words of `text` that start with `prefix`.
std::set<std::string> words_with(std::string_view prefix, std::string_view text);

/// Whether what goes between a GLSL stage and its neighbours does by location.
bool goes_by_location(const ShaderSource& stage);

/// The names that an output of a stage may go by. GL: its own; of a block that has an instance, BLOCK.NAME. Drivers
/// may ask for the block's name, or the instance's, where GL does not. The one that is asked for comes first.
std::vector<std::string> spellings(std::string_view text, const std::string& output);

/// Whether a driver's name of an output, with or without its block, is that of another spelling.
bool is_same_output(std::string_view one, std::string_view other);

/// The names of which a stage asks length(). An empty one: of any array, as a module or a macro may.
std::set<std::string> lengths_asked(const ShaderSource& stage);

/// An output that is interpolated, and read `flat`, in one sentence; empty: there is none. Before GLSL 4.40 both sides
/// of the border say `flat`, or neither.
std::string missing_flat(std::span<const ShaderSource> stages);

/// Throws the Error of a storage buffer that is not `given` outside a compute stage. `place`: its file, and line.
[[noreturn]] void fail_storage(const std::string& place, const std::string& name);

/// Only a compute stage has storage buffers that are not `given`.
void check_storage(GLuint program, std::span<const ShaderSource> stages, std::span<const std::string_view> given);

/// What a geometry stage reads has to be written: its inputs are arrays, and drivers leave what is missing undefined.
void check_geometry_inputs(std::span<const ShaderSource> stages);

/// What a fragment stage reads has to be written: by name, where no location stands beside it.
void check_fragment_inputs(std::span<const ShaderSource> stages);

/// A fragment stage writes what its target holds: output 0.
void check_fragment_output(GLuint program, std::span<const ShaderSource> stages);

} // namespace lockstep
