#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lockstep/function.hpp"

namespace lockstep::function_twin {

struct Parameter {
    std::string type, name; ///< as the shader has them; an array's brackets are part of the name
};

/// A function as its file defines it.
struct Signature {
    std::string result;
    std::vector<Parameter> parameters;
    std::size_t line = 1;
};

/// Of the one definition of that name. Throws Error naming those there are.
Signature signature_of(const GlslFunction& function, const std::string& text);

/// "vec3 bounce(vec3, float)"
std::string shown(const std::string& name, const Signature& signature);

/// What a column can be, in words.
inline constexpr std::string_view column_types = "float, int, uint, bool, or a vector of float, int or uint";

/// "vec3"
std::string type_of(const Column& column);
/// Nothing for a type that no column has.
std::optional<Column> column_of(const std::string& type);

/// The type of a uniform that the text declares outside of blocks; empty: it declares none of that name.
std::string uniform_type(const std::string& text, const std::string& name);
/// The names of all of them.
std::vector<std::string> uniform_names(const std::string& text);

/// Throws Error: "shader FILE:LINE: vec3 bounce(vec3, float): what".
[[noreturn]] void fail(const GlslFunction& function, const Signature& signature, const std::string& what);

} // namespace lockstep::function_twin
