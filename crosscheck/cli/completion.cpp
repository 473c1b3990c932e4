#include "crosscheck/cli/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/shell_words.hpp"
#include "reference/model/collision/switches.hpp"

namespace lockstep {
namespace {

std::string verb_names(const std::vector<Verb>& verbs) {
    std::vector<std::string> names;
    for (const Verb& verb : verbs)
        names.push_back(verb.name);
    return fmt::format("{}", fmt::join(names, " "));
}

std::string option_names(const Verb& verb) {
    std::string text;
    for (const Option& option : all_options(verb))
        if (!is_argument(option))
            text += fmt::format("{}{}", text.empty() ? "" : " ", fmt::join(names(option), " "));
    return text;
}

/// --set NAME=VALUE: what stands before the sign, what stands after.
std::string switch_names() {
    std::string names;
    for (const SwitchInfo& info : switch_table())
        names += fmt::format("{}{}=", names.empty() ? "" : " ", info.name);
    return names;
}

/// A verb, or a verb's part, and the words that call it: "capsule cut".
struct Callable {
    std::string words;
    const Verb* verb;
};

std::vector<Callable> callables(const std::vector<Verb>& verbs) {
    std::vector<Callable> all;
    for (const Verb& verb : verbs) {
        all.push_back({verb.name, &verb});
        for (const Verb& part : verb.verbs)
            all.push_back({verb.name + " " + part.name, &part});
    }
    return all;
}

constexpr const char* bash_frame = R"(# Completion of lockstep for bash, made by `lockstep completion bash`.
_lockstep() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} verb=${{COMP_WORDS[1]}} words=
    COMPREPLY=()
    case "$verb ${{COMP_WORDS[2]}}" in
{parts}    esac
    if [ "$COMP_CWORD" = 1 ]; then
        words="{verbs} --help --version"
    elif [ "$before" = --set ]; then
        words="{switches}"
        compopt -o nospace
    elif [ "$before" = = ] || [ "$word" = = ]; then
        [ "$before" != = ] || before=${{COMP_WORDS[COMP_CWORD - 2]}}
        case $before in
{values}        esac
        [ "$word" != = ] || word=
    else
        case "$verb $before" in
{choices}        {with_value}) return ;;
        *)
            case $verb in
{options}            esac
            case $verb in
            {with_words}) [ "$verb" = completion ] || [ "$COMP_CWORD" = 2 ] || [[ $word == -* ]] || words= ;;
            *) [[ $word == -* ]] || words= ;;
            esac
            ;;
        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o bashdefault -o default -F _lockstep lockstep
)";

} // namespace

std::string bash_completion(const std::vector<Verb>& verbs) {
    std::string values;
    for (const SwitchInfo& info : switch_table())
        if (!info.values.empty())
            values += fmt::format("        {}) words=\"{}\" ;;\n", info.name, fmt::join(info.values, " "));
    std::string few;
    std::string with_value;
    std::string options;
    std::string parts;
    std::vector<std::string> with_words{"completion"};
    for (const Verb& verb : verbs)
        if (!verb.verbs.empty())
            with_words.push_back(verb.name);
    for (const Callable& called : callables(verbs)) {
        const Verb& verb = *called.verb;
        if (called.words != verb.name)
            parts += fmt::format("        \"{0}\") [ \"$COMP_CWORD\" = 2 ] || verb=\"{0}\" ;;\n", called.words);
        std::string words = option_names(verb);
        if (!verb.verbs.empty())
            words += " " + verb_names(verb.verbs);
        for (const Option& option : all_options(verb)) {
            const std::string given = fmt::format("{}", fmt::join(choices(option), " "));
            if (is_argument(option))
                words += given.empty() ? "" : " " + given;
            else
                for (const std::string& name : names(option)) {
                    if (!given.empty())
                        few += fmt::format("        \"{} {}\") words=\"{}\" ;;\n", called.words, name, given);
                    else if (!option.value.empty())
                        with_value += fmt::format("{}\"{} {}\"", with_value.empty() ? "" : " | ", called.words, name);
                }
        }
        options += fmt::format("            \"{}\") words=\"{}\" ;;\n", called.words, words);
    }
    return fmt::format(bash_frame, fmt::arg("verbs", verb_names(verbs)), fmt::arg("switches", switch_names()),
                       fmt::arg("values", values), fmt::arg("choices", few), fmt::arg("with_value", with_value),
                       fmt::arg("options", options), fmt::arg("parts", parts),
                       fmt::arg("with_words", fmt::join(with_words, "|")));
}

std::string zsh_completion(const std::vector<Verb>& verbs) {
    return "autoload -Uz compinit bashcompinit\ncompinit\nbashcompinit\n" + bash_completion(verbs);
}

std::string fish_completion(const std::vector<Verb>& verbs) {
    std::string text = "# Completion of lockstep for fish, made by `lockstep completion fish`.\n";
    for (const Callable& called : callables(verbs)) {
        const Verb& verb = *called.verb;
        const bool is_part = called.words != verb.name;
        const std::string parent = called.words.substr(0, called.words.find(' '));
        text += fmt::format("complete -c lockstep -n {} -f -a {} -d {}\n",
                            is_part ? fmt::format("'__fish_seen_subcommand_from {}'", parent) : "__fish_use_subcommand",
                            verb.name, shell_word(verb.description));
        const std::string seen =
            is_part
                ? fmt::format("'__fish_seen_subcommand_from {}; and __fish_seen_subcommand_from {}'", parent, verb.name)
                : fmt::format("'__fish_seen_subcommand_from {}'", verb.name);
        for (const Option& option : all_options(verb)) {
            const std::string given = fmt::format("{}", fmt::join(choices(option), " "));
            if (is_argument(option) && given.empty())
                continue;
            text += fmt::format("complete -c lockstep -n {}", seen);
            if (!is_argument(option))
                for (const std::string& name : names(option))
                    text += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                                   : fmt::format(" -s {}", name.substr(1));
            if (!option.value.empty() && !is_argument(option))
                text += " -r";
            if (!given.empty())
                text += fmt::format(" -f -a '{}'", given);
            text += fmt::format(" -d {}\n", shell_word(option.description));
        }
    }
    return text;
}

} // namespace lockstep
