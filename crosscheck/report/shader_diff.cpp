#include "crosscheck/report/shader_diff.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <numeric>

#include <dtl/dtl.hpp>
#include <fmt/format.h>

namespace lockstep {
namespace {

using Lines = std::vector<std::string>;

Lines text_lines(const std::filesystem::path& file) {
    Lines lines;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        line.erase(line.find_last_not_of(" \t\r") + 1);
        lines.push_back(line);
    }
    return lines;
}

std::string without_indent(const std::string& line) {
    const std::size_t start = line.find_first_not_of(" \t");
    return start == std::string::npos ? "" : line.substr(start);
}

std::size_t changed_lines(const std::vector<ShaderChange>& changes) {
    return std::accumulate(changes.begin(), changes.end(), std::size_t{0}, [](std::size_t sum, const ShaderChange& c) {
        return sum + std::max(c.before.size(), c.now.size());
    });
}

} // namespace

std::vector<ShaderChange> shader_changes(const UsedShader& used) {
    if (used.foreign.empty() || used.shipped.empty() || used.same_as_shipped || used.leaves_out ||
        used.foreign.extension() == ".spv")
        return {};
    const Lines before = text_lines(used.shipped), now = text_lines(used.foreign);
    dtl::Diff<std::string, Lines> diff(before, now);
    diff.onHuge();
    diff.compose();
    std::vector<ShaderChange> changes;
    int line = 1;
    bool is_open = false;
    for (const auto& [text, info] : diff.getSes().getSequence()) {
        if (info.type == dtl::SES_COMMON) {
            ++line;
            is_open = false;
            continue;
        }
        if (!is_open)
            changes.push_back({line, {}, {}});
        is_open = true;
        if (info.type == dtl::SES_ADD) {
            changes.back().now.push_back(text);
            ++line;
        } else {
            changes.back().before.push_back(text);
        }
    }
    return changes;
}

std::string shader_diff_text(const ShaderUse& use) {
    constexpr std::size_t most_shown = 12; // more are a shader of its own, not a changed one
    std::string text;
    for (const UsedShader& used : use.files) {
        const std::vector<ShaderChange> changes = shader_changes(used);
        if (changes.empty())
            continue;
        const std::size_t count = changed_lines(changes);
        const std::string key = text.empty() ? "source" : "";
        if (count > most_shown) {
            text += fmt::format("{:<10}{}: {} lines are not those of the shipped {}\n", key, used.foreign.string(),
                                count, used.file);
            continue;
        }
        text += fmt::format("{:<10}{} differs from the shipped {} in {} line{}:\n", key, used.foreign.string(),
                            used.file, count, count == 1 ? "" : "s");
        for (const ShaderChange& change : changes) {
            text += fmt::format("{:<10}{}:{}\n", "", used.foreign.string(), change.line);
            for (const std::string& line : change.before)
                text += fmt::format("{:<10}- {}\n", "", without_indent(line));
            for (const std::string& line : change.now)
                text += fmt::format("{:<10}+ {}\n", "", without_indent(line));
        }
    }
    return text;
}

} // namespace lockstep
