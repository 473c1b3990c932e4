#include "gpu/declaration.hpp"

#include <fmt/format.h>

#include "gpu/shader_words.hpp"

namespace lockstep {
namespace {

/// What follows a variable's name: `[2] = ...` is an initialiser.
bool initialiser_follows(ShaderWords after) {
    if (after.next() && after.token() == "[")
        while (after.token() != "]" && after.next()) {
        }
    if (after.token() == "]")
        after.next();
    return after.token() == "=";
}

} // namespace

Declaration find_declaration(std::span<const ShaderSource> stages, std::string_view qualifier, std::string_view name) {
    for (const ShaderSource& stage : stages) {
        int depth = 0; // of parentheses
        int declares_at = -1;
        for (ShaderWords words(stage.text); words.next();) {
            const std::string_view token = words.token();
            if (token == "(") {
                ++depth;
            } else if (token == ")") {
                --depth;
            } else if (token == qualifier) {
                declares_at = depth;
            } else if (declares_at == depth && token == name && words.line() <= stage.origins.size()) {
                const ShaderSource::Origin& origin = stage.origins[words.line() - 1];
                return {fmt::format("{}:{}", stage.files[origin.file], origin.line), initialiser_follows(words)};
            }
            if (token == ";" || depth < declares_at)
                declares_at = -1;
        }
    }
    return {stages.empty() ? std::string() : stages.front().files.front()};
}

} // namespace lockstep
