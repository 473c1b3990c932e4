#include "crosscheck/text/covered_text.hpp"

#include "crosscheck/text/stage_text.hpp"
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace lockstep {
namespace {

namespace fs = std::filesystem;

/// Messages name a shipped file by its place among the shaders, also where the user's folder is such a one.
bool is_in(const fs::path& folder, const std::string& file) {
    std::error_code status;
    const fs::path inside = fs::path(file).lexically_relative(folder.empty() ? "." : folder);
    const bool is_below = !inside.empty() && *inside.begin() != ".." && fs::exists(file, status);
    return is_below || fs::exists(folder / fs::path(file).filename(), status);
}

} // namespace

TextCoverage covered_text(const ShaderSource& stage, const text::Program& program, const text::Coverage& coverage,
                          const fs::path& folder) {
    TextCoverage made;
    made.stage = fs::path(stage.files.front()).filename().string();
    std::vector<bool> is_users;
    for (const std::string& file : stage.files)
        is_users.push_back(is_in(folder, file));
    const auto place = [&](std::uint32_t line) -> std::optional<FileLine> {
        if (line == 0 || line > stage.origins.size() || !is_users[stage.origins[line - 1].file])
            return std::nullopt;
        const ShaderSource::Origin& origin = stage.origins[line - 1];
        return FileLine{fs::path(stage.files[origin.file]).filename().string(),
                        static_cast<std::uint32_t>(origin.line)};
    };
    // Newer glslang gives the return at a function's end the line of its brace.
    const auto is_brace = [&](std::uint32_t line) {
        return line_text(stage, line).find_first_not_of("{}; ") == std::string::npos;
    };
    for (const auto& [line, is_reached] : text::covered_lines(program, coverage))
        if (const std::optional<FileLine> at = place(line); at && !is_brace(line)) {
            TextCoverage::Line& to = made.lines[*at];
            to.has_statement = true;
            to.is_reached = to.is_reached || is_reached;
        }
    for (const text::Decision& decision : program.decisions)
        if (const std::optional<FileLine> at = place(decision.line)) {
            std::vector<TextCoverage::Side>& sides = made.lines[*at].decisions.emplace_back();
            for (text::DecisionSide& side : text::sides_of(program, decision, coverage))
                sides.push_back({std::move(side.never), side.is_taken});
        }
    return made;
}

} // namespace lockstep
