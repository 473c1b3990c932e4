#include "crosscheck/command/verb.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, separator);)
        words.push_back(word);
    return words;
}

bool is_placeholder(const std::string& word) {
    return std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c) != 0; });
}

} // namespace

std::vector<std::string> names(const Option& option) { return split(option.name, ','); }

bool is_argument(const Option& option) { return !option.name.starts_with('-'); }

std::vector<std::string> choices(const Option& option) {
    if (option.value.find('|') == std::string::npos)
        return {};
    std::vector<std::string> words = split(option.value, '|');
    std::erase_if(words, is_placeholder);
    return words;
}

Option help_option() { return {"-h,--help", {}, "print these lines", {}}; }

std::vector<Option> all_options(const Verb& verb) {
    std::vector<Option> options{help_option()};
    options.insert(options.end(), verb.options.begin(), verb.options.end());
    return options;
}

bool Call::has(std::string_view option) const { return std::find(given.begin(), given.end(), option) != given.end(); }

void check_options(const Call& call, std::string_view mode, std::span<const std::string_view> allowed) {
    for (const std::string& option : call.given)
        if (std::find(allowed.begin(), allowed.end(), option) == allowed.end())
            throw Error(fmt::format("{}: {} does not go with {}", call.verb.name, option, mode));
}

} // namespace lockstep
