#include "gpu/shader_warnings.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::vector<ShaderWarnings*>& living() {
    static std::vector<ShaderWarnings*> all;
    return all;
}

} // namespace

ShaderWarnings::ShaderWarnings(std::vector<ShaderWarning>& into) : into_(into) { living().push_back(this); }

ShaderWarnings::~ShaderWarnings() { std::erase(living(), this); }

bool is_of_probe(std::string_view file) { return file.starts_with("shaders/probe/"); }

bool& shader_warnings_are_errors() {
    static bool are_errors = false;
    return are_errors;
}

void note_shader_warnings(const std::vector<ShaderWarning>& found) {
    for (const ShaderWarning& warning : found) {
        if (is_of_probe(warning.place))
            continue;
        if (shader_warnings_are_errors())
            throw Error(fmt::format("shader {}: {} (a warning; --werror-shaders)", warning.place, warning.message));
        for (const ShaderWarnings* const one : living())
            if (std::ranges::find(one->into_, warning) == one->into_.end())
                one->into_.push_back(warning);
    }
}

bool is_about_unset_variable(const ShaderWarning& warning) {
    constexpr std::array<std::string_view, 4> words{"uninitialized", "uninitialised", "before being initialized",
                                                    "not been initialized"};
    return std::ranges::any_of(words,
                               [&](std::string_view word) { return warning.message.find(word) != std::string::npos; });
}

} // namespace lockstep
