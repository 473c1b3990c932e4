#include "crosscheck/text/condition_lines.hpp"

#include <algorithm>
#include <iterator>
#include <regex>
#include <span>
#include <string>
#include <unordered_map>

#include <spirv.hpp>

namespace lockstep {
namespace {

constexpr std::size_t header_words = 5;

struct Instruction {
    spv::Op op = spv::OpNop;
    std::span<const std::uint32_t> words; ///< the first included
};

std::vector<Instruction> instructions_of(std::span<const std::uint32_t> words) {
    std::vector<Instruction> all;
    for (std::size_t at = header_words; at < words.size(); at += all.back().words.size())
        all.push_back({static_cast<spv::Op>(words[at] & 0xffffU), words.subspan(at, words[at] >> 16U)});
    return all;
}

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines(1);
    for (const char c : text)
        if (c == '\n')
            lines.emplace_back();
        else
            lines.back() += c;
    return lines;
}

/// The first line from `first` to `last` with the variable as a whole condition; 0: none.
std::uint32_t line_of_condition(const std::vector<std::string>& lines, const std::string& name, std::uint32_t first,
                                std::uint32_t last) {
    constexpr std::size_t longest = 500; // std::regex goes as deep as what it matches is long
    const std::regex condition(R"(\b(if|while|switch)\s*\(\s*)" + name + R"(\s*\)|;\s*)" + name + R"(\s*;|\b)" + name +
                               R"(\s*\?)");
    for (std::uint32_t line = std::max(first, 1U); line <= last && line <= lines.size(); ++line)
        if (lines[line - 1].size() <= longest && std::regex_search(lines[line - 1], condition))
            return line;
    return 0;
}

bool is_word(const std::string& name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
    });
}

} // namespace

std::vector<std::uint32_t> with_condition_lines(const std::vector<std::uint32_t>& words, std::string_view text) {
    constexpr std::uint32_t furthest = 100;
    const std::vector<Instruction> all = instructions_of(words);
    const std::vector<std::string> lines = lines_of(text);
    std::unordered_map<std::uint32_t, std::string> names;
    std::vector<std::uint32_t> made(words.begin(), words.begin() + header_words);
    made.reserve(words.size());
    const Instruction* line = nullptr;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Instruction& at = all[i];
        if (at.op == spv::OpName)
            names[at.words[1]] = reinterpret_cast<const char*>(at.words.data() + 2);
        if (at.op == spv::OpLine)
            line = &at;
        std::size_t end = i + 1;
        if (at.op == spv::OpLoad && line != nullptr && end < all.size()) {
            if (all[end].op == spv::OpSelectionMerge || all[end].op == spv::OpLoopMerge)
                ++end;
            const bool is_condition = end < all.size() &&
                                      (all[end].op == spv::OpBranchConditional || all[end].op == spv::OpSwitch) &&
                                      all[end].words[1] == at.words[2];
            const auto name = names.find(at.words[3]);
            if (is_condition && name != names.end() && is_word(name->second)) {
                const auto next = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(end), all.end(),
                                               [](const Instruction& one) { return one.op == spv::OpLine; });
                const std::uint32_t first = line->words[2], last = first + furthest;
                const std::uint32_t known = next == all.end() ? last : std::min(last, next->words[2]);
                if (const std::uint32_t own = line_of_condition(lines, name->second, first, std::max(first, known))) {
                    made.insert(made.end(), line->words.begin(), line->words.end());
                    made[made.size() - 2] = own;
                }
            }
        }
        made.insert(made.end(), at.words.begin(), at.words.end());
    }
    return made;
}

} // namespace lockstep
