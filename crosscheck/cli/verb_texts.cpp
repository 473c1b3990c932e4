#include "crosscheck/cli/verb_texts.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace lockstep {
namespace {

OptionText option_text(const CLI::Option& option) {
    OptionText text;
    text.argument = option.get_positional();
    for (const std::string& name : option.get_snames())
        text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        text.names.push_back("--" + name);
    if (text.argument)
        text.names = {option.get_name()};
    if (option.get_items_expected_max() > 0)
        text.value = option.get_type_name();
    text.description = option.get_description();
    return text;
}

} // namespace

std::vector<std::string> OptionText::choices() const {
    std::vector<std::string> words;
    if (value.find('|') == std::string::npos)
        return words;
    std::istringstream stream(value);
    for (std::string word; std::getline(stream, word, '|');)
        if (std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::isupper(c) != 0; }))
            words.push_back(word);
    return words;
}

std::vector<VerbText> verb_texts(const CLI::App& app) {
    std::vector<VerbText> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) {
        VerbText text{verb->get_name(), verb->get_description(), {}, verb->get_footer()};
        for (const CLI::Option* option : verb->get_options())
            text.options.push_back(option_text(*option));
        verbs.push_back(std::move(text));
    }
    return verbs;
}

} // namespace lockstep
