#include "crosscheck/command/command_line.hpp"

#include <algorithm>
#include <span>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/command/help_text.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

/// "5,": the library would leave the empty place out.
std::vector<std::string> elements(const std::string& list) {
    std::vector<std::string> all;
    std::size_t from = 0;
    for (std::size_t comma = list.find(','); comma != list.npos; comma = list.find(',', from)) {
        all.push_back(list.substr(from, comma - from));
        from = comma + 1;
    }
    all.push_back(list.substr(from));
    return all;
}

/// Returns what is wrong with the values.
std::string keep_lists(const Option& option, std::span<const std::string> lists) {
    std::vector<std::string> values;
    for (const std::string& list : lists)
        for (const std::string& value : elements(list)) {
            if (value.empty())
                return fmt::format("'{}' lacks a value; right is {}", list, option.value);
            values.push_back(value);
        }
    return option.keep(values);
}

void add_option(CLI::App& app, const Option& option) {
    const std::string name = names(option).back();
    if (option.value.empty()) {
        app.add_flag_callback(
            option.name, [keep = option.keep] { keep({}); }, option.description);
        return;
    }
    const auto keep = [name, option](const CLI::results_t& values) {
        const std::string problem =
            option.values == GivenValues::list ? keep_lists(option, values) : option.keep(values);
        if (!problem.empty())
            throw CLI::ValidationError(name, problem);
        return true;
    };
    CLI::Option* added = app.add_option(option.name, keep, option.description);
    added->type_name(option.value)->required(option.required);
    if (option.values != GivenValues::one)
        added->expected(CLI::detail::expected_max_vector_size)->allow_extra_args(is_argument(option));
}

void describe(CLI::App& app, const Verb& verb) {
    app.set_help_flag(help_option().name);
    for (const Option& option : verb.options)
        add_option(app, option);
    for (const Verb& part : verb.verbs)
        describe(*app.add_subcommand(part.name, part.description), part);
    if (!verb.verbs.empty())
        app.require_subcommand(verb.run ? 0 : 1, 1);
}

/// The verb that was called, as far as the command line went, and the library's part for it.
struct Called {
    const CLI::App& app;
    const Verb& verb;
    std::string words;  ///< as it was typed: "lockstep capsule cut"
    std::string strays; ///< what was given to the verb that it is a part of, which then does not run; empty: nothing
};

bool has_option(const Verb& verb, std::string_view name) {
    for (const Option& option : all_options(verb))
        for (const std::string& one : names(option))
            if (one == name)
                return true;
    return false;
}

/// What was given to `verb` before its `part`, and where it belongs.
std::string stray(const CLI::App& app, const Verb& verb, const Verb& part, const std::string& words) {
    for (const Option& option : verb.options) {
        const std::string name = names(option).back();
        if (app.count(name) == 0)
            continue;
        if (!has_option(part, name))
            return fmt::format("{} does not go with the verb {}", name, part.name);
        const std::string given = is_argument(option) ? app.get_option(name)->results().front() : name;
        return fmt::format("{}'{}' stands before the verb; right is {} {}{}", is_argument(option) ? "" : "option ",
                           given, words, given, is_argument(option) ? "" : " ...");
    }
    return {};
}

Called called(const CLI::App& app, const Verb& verb, const std::string& words, const std::string& strays = {}) {
    for (const CLI::App* part : app.get_subcommands())
        for (const Verb& candidate : verb.verbs)
            if (candidate.name == part->get_name()) {
                const std::string longer = words + " " + candidate.name;
                return called(*part, candidate, longer, strays.empty() ? stray(app, verb, candidate, longer) : strays);
            }
    return {app, verb, words, strays};
}

/// `unknown`: the word in its place, if any.
std::string verb_error(const Verb& program, const Verb& verb, const std::string& unknown) {
    std::vector<std::string> names;
    for (const Verb& part : verb.verbs)
        names.push_back(part.name);
    const std::string of = &verb == &program ? "" : fmt::format(" of {}", verb.name);
    const std::string there =
        fmt::format("the verb{} {}", names.size() == 1 ? of + " is" : "s" + of + " are", fmt::join(names, ", "));
    if (unknown.empty())
        return fmt::format("a verb is missing; {}", there);
    return fmt::format("unknown verb '{}'; {}{}", unknown, there, did_you_mean(unknown, names));
}

std::string option_error(const Called& call, const std::string& unknown) {
    for (const Verb& part : call.verb.verbs)
        if (unknown.starts_with("--" + part.name))
            return fmt::format("unknown option '{}'; {} is a verb: {} {}", unknown, part.name, call.words, part.name);
    std::vector<std::string> all;
    for (const Option& option : all_options(call.verb))
        for (const std::string& name : names(option))
            all.push_back(name);
    if (std::find(all.begin(), all.end(), unknown.substr(0, unknown.find('='))) != all.end())
        return fmt::format("option '{}' stands before the verb; right is {} {} ...", unknown, call.words, unknown);
    return fmt::format("unknown option '{}'{}", unknown, did_you_mean(unknown.substr(0, unknown.find('=')), all));
}

/// The words of a command line after the program's name.
using Words = std::span<const char* const>;

/// The "--" after which nothing is an option.
Words::iterator mark_in(Words words) { return std::find(words.begin(), words.end(), std::string_view("--")); }

/// Whether `word` stands behind the mark, and not before it.
bool is_behind_mark(Words words, std::string_view word) {
    const auto mark = mark_in(words);
    return mark != words.end() && std::find(words.begin(), mark, word) == mark;
}

/// `--quiet=no`, which the library takes for a flag given or not given.
std::string valued_flag(const Verb& verb, Words words) {
    for (const std::string_view word : words.first(static_cast<std::size_t>(mark_in(words) - words.begin())))
        for (const Option& option : verb.options)
            if (option.value.empty() && word.starts_with(names(option).back() + "="))
                return fmt::format("{} takes no value; '{}' gives it one", names(option).back(), word);
    return {};
}

/// What the library lets pass.
std::string misplaced(const Called& call, Words words) {
    return call.strays.empty() ? valued_flag(call.verb, words) : call.strays;
}

/// Of an argument too many: the option that took another one's name for its value, `--set --frames 3`; else nothing.
std::string robbing_error(const Called& call) {
    for (const Option& option : call.verb.options) {
        const std::string name = names(option).back();
        if (is_argument(option) || option.value.empty() || call.app.count(name) == 0)
            continue;
        for (const std::string& value : call.app.get_option(name)->results())
            if (has_option(call.verb, value))
                return fmt::format("{} needs a value, and '{}' is an option", name, value);
    }
    return {};
}

std::string too_many_error(const Called& call, const std::string& unknown) {
    const std::string robbed = robbing_error(call);
    return robbed.empty() ? fmt::format("'{}' is one argument too many", unknown) : robbed;
}

/// What is needed and was not given: "--frame F is missing: the frame, counted from 0".
std::string missing_error(const Called& call) {
    for (const Option& option : call.verb.options)
        if (option.required && call.app.count(names(option).back()) == 0)
            return fmt::format("{} is missing: {}",
                               is_argument(option) ? option.value : names(option).back() + " " + option.value,
                               option.description);
    return "something is missing";
}

/// "--set: 1 required NAME=VALUE missing", "--frames: At Most 1 required but received 2".
std::string mismatch_error(const std::string& text) {
    const bool twice = text.find("received") != text.npos;
    return fmt::format("{} {}", text.substr(0, text.find(':')), twice ? "is given more than once" : "needs a value");
}

/// The library's own words are for programmers.
std::string usage_error(const Verb& program, const Called& call, const CLI::App& app, const CLI::Error& error,
                        Words words) {
    const Verb& verb = call.verb;
    if (const std::string problem = misplaced(call, words); !problem.empty())
        return problem;
    std::vector<std::string> unknown = app.remaining(true);
    std::erase(unknown, "--");
    std::stable_partition(unknown.begin(), unknown.end(), [](const std::string& text) { return text[0] == '-'; });
    if (!unknown.empty() && unknown.front().starts_with('-'))
        return is_behind_mark(words, unknown.front())
                   ? fmt::format("'{}' is one argument too many; behind -- nothing is an option", unknown.front())
                   : option_error(call, unknown.front());
    if (!verb.verbs.empty() && !verb.run)
        return verb_error(program, verb, unknown.empty() ? "" : unknown.front());
    if (!unknown.empty())
        return too_many_error(call, unknown.front());
    if (error.get_name() == "RequiredError")
        return missing_error(call);
    if (error.get_name() == "ArgumentMismatch")
        return mismatch_error(error.what());
    return error.what();
}

/// With where more is said.
std::string error_line(const Verb& program, const Called& call, const std::string& problem) {
    return fmt::format("{}: {} ({} --help says more)\n", program.name, plain_line(problem), call.words);
}

} // namespace

int run_command_line(const Verb& program, int argc, char** argv, int misused) {
    CLI::App app(program.description);
    app.name(program.name);
    if (!program.version.empty())
        app.set_version_flag("--version", fmt::format("{} {}", program.name, program.version));
    describe(app, program);
    const Words words(argv + std::min(argc, 1), argv + argc);
    app.failure_message([&program, words](const CLI::App* root, const CLI::Error& error) {
        const Called call = called(*root, program, program.name);
        return error_line(program, call, usage_error(program, call, *root, error, words));
    });
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        const Called asked = called(app, program, program.name);
        fmt::print("{}", help_text(asked.verb, asked.words));
        return 0;
    } catch (const CLI::ParseError& error) {
        std::ostringstream out, err;
        const bool asked = app.exit(error, out, err) == 0;
        fmt::print("{}", out.str());
        fmt::print(stderr, "{}", err.str());
        return asked ? 0 : misused;
    }
    const Called last = called(app, program, program.name);
    if (const std::string problem = misplaced(last, words); !problem.empty()) {
        fmt::print(stderr, "{}", error_line(program, last, problem));
        return misused;
    }
    Call call{program, last.verb, {}};
    for (const Option& option : last.verb.options)
        if (const std::string name = names(option).back(); last.app.count(name) > 0)
            call.given.push_back(name);
    return call.verb.run(call);
}

} // namespace lockstep
