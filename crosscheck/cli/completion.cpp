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

constexpr const char* bash_frame = R"(# Completion of lockstep for bash, made by `lockstep completion bash`.
_lockstep() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} verb=${{COMP_WORDS[1]}} words=
    COMPREPLY=()
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
            [[ $word == -* ]] || [ "$verb" = completion ] || words=
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
    for (const Verb& verb : verbs) {
        std::string words = option_names(verb);
        for (const Option& option : all_options(verb)) {
            const std::string given = fmt::format("{}", fmt::join(choices(option), " "));
            if (is_argument(option))
                words += given.empty() ? "" : " " + given;
            else
                for (const std::string& name : names(option)) {
                    if (!given.empty())
                        few += fmt::format("        \"{} {}\") words=\"{}\" ;;\n", verb.name, name, given);
                    else if (!option.value.empty())
                        with_value += fmt::format("{}\"{} {}\"", with_value.empty() ? "" : " | ", verb.name, name);
                }
        }
        options += fmt::format("            {}) words=\"{}\" ;;\n", verb.name, words);
    }
    return fmt::format(bash_frame, fmt::arg("verbs", verb_names(verbs)), fmt::arg("switches", switch_names()),
                       fmt::arg("values", values), fmt::arg("choices", few), fmt::arg("with_value", with_value),
                       fmt::arg("options", options));
}

std::string zsh_completion(const std::vector<Verb>& verbs) {
    return "autoload -Uz compinit bashcompinit\ncompinit\nbashcompinit\n" + bash_completion(verbs);
}

std::string fish_completion(const std::vector<Verb>& verbs) {
    std::string text = "# Completion of lockstep for fish, made by `lockstep completion fish`.\n";
    for (const Verb& verb : verbs) {
        text += fmt::format("complete -c lockstep -n __fish_use_subcommand -f -a {} -d {}\n", verb.name,
                            shell_word(verb.description));
        for (const Option& option : all_options(verb)) {
            const std::string given = fmt::format("{}", fmt::join(choices(option), " "));
            if (is_argument(option) && given.empty())
                continue;
            text += fmt::format("complete -c lockstep -n '__fish_seen_subcommand_from {}'", verb.name);
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
