#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/nothing_given.hpp"
#include "gpu/shader_source.hpp"
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

/// Of the one definition of that name in the function's file, as the preprocessor leaves it. Throws Error naming those
/// there are.
Signature signature_of(const GlslFunction& function);

/// "vec3 bounce(vec3, float)"
std::string shown(const std::string& name, const Signature& signature);

/// What a column can be, in words.
inline constexpr std::string_view column_types = "float, int, uint, bool, or a vector of float, int or uint";

/// "vec3"
std::string type_of(const Column& column);
/// Nothing for a type that no column has.
std::optional<Column> column_of(const std::string& type);

/// A uniform of the function's file or of what it includes, outside of blocks.
struct DeclaredUniform {
    std::string type, name;
    bool is_array = false;
    std::size_t elements = 0; ///< of an array whose size is a number
};
std::vector<DeclaredUniform> uniforms_of(const GlslFunction& function);

/// What the file's main is called in a stage that calls the function.
inline constexpr std::string_view main_of_the_file = "ls_main_of_the_file";

/// The function's file, of a whole stage without its main, its shared variables and what lays out its inputs, as
/// `layout(local_size_x = 64) in;`: the function is called in another. Lines stay.
std::string text_of_file(const GlslFunction& function);

/// The function's file with what it includes, compiled with the function's definitions.
ShaderSource whole_text(const GlslFunction& function);

/// Runs `run`, and says how a function's uniforms get values where one has none.
template <class Run> auto with_advice(const Run& run) {
    try {
        return run();
    } catch (const NothingGiven& missing) {
        throw Error("shader " + missing.names +
                    "; --uniform NAME=VALUE gives it, in a test the uniforms of GlslFunction (docs/functions.md)");
    }
}

/// Throws Error: "shader FILE:LINE: vec3 bounce(vec3, float): what".
[[noreturn]] void fail(const GlslFunction& function, const Signature& signature, const std::string& what);

} // namespace lockstep::function_twin
