#include "gpu/taken_branches.hpp"

#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "gpu/preprocessor.hpp"
#include "gpu/shader_words.hpp"

namespace lockstep {
namespace {

/// Whether conditions may ask for what only the driver knows: its extensions, and lines as it counts them. GL_ES is not
/// of it: shaders are GLSL's.
bool asks_driver(std::string_view text) {
    std::string_view before;
    for (ShaderWords words(text); words.next(); before = words.token()) {
        const std::string_view word = words.token();
        if ((word.starts_with("GL_") && word != "GL_ES" && before != "extension") || word == "__LINE__" ||
            word == "__FILE__")
            return true;
    }
    return false;
}

std::string mark_of(std::size_t file) { return fmt::format("lockstep_file_{}_begins", file); }

/// The stage's text with a word of its own where a file begins.
std::string with_marks(const ShaderSource& stage, std::vector<bool>& has_lines) {
    std::istringstream lines(stage.text);
    std::string text;
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line); ++number) {
        if (number < stage.origins.size())
            if (const auto file = static_cast<std::size_t>(stage.origins[number].file); !has_lines[file]) {
                has_lines[file] = true;
                text += file == 0 ? "" : mark_of(file) + '\n';
            }
        text += line + '\n';
    }
    return text;
}

} // namespace

std::vector<bool> taken_files(const ShaderSource& stage) {
    std::vector<bool> all(stage.files.size(), true);
    if (stage.files.size() < 2 || stage.module != nullptr || asks_driver(stage.text))
        return all;
    std::vector<bool> has_lines(stage.files.size());
    const std::string text = with_marks(stage, has_lines);
    const std::optional<std::string> plain = preprocessed(text);
    const auto traced =
        plain && says(text, "LOCKSTEP_TRACE") ? preprocessed(text, "#define LOCKSTEP_TRACE 1\n") : plain;
    if (!traced)
        return all;
    for (std::size_t file = 1; file < all.size(); ++file)
        all[file] = !has_lines[file] || plain->find(mark_of(file)) != std::string::npos ||
                    traced->find(mark_of(file)) != std::string::npos;
    return all;
}

} // namespace lockstep
