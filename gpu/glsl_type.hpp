#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gpu/gl.hpp"
#include "reference/model/schema.hpp"

namespace lockstep {

/// "vec3" for GL_FLOAT_VEC3; types that shaders here have no use for as "GL type 0x...".
std::string type_name(GLenum type);

/// The type of a name in GLSL; 0 where type_name knows none.
GLenum type_named(std::string_view name);

/// An array of `size`, or for 1 the type alone: "vec3[4]", "vec3".
std::string declared_type(GLenum type, GLint size);

/// 32-bit components that transform feedback writes of an output of this type: 3 of GL_FLOAT_VEC3; 0 for a type that
/// is no output.
int output_components(GLenum type);

/// Whether its components are floats; integers otherwise.
bool is_float_type(GLenum type);

/// What its components are: integers with or without sign, truths and units among the first, or floats.
Scalar scalar_of(GLenum type);

/// A number as a component of the type; nothing for one that it does not hold.
std::optional<std::uint32_t> word_of(double number, GLenum type);

} // namespace lockstep
