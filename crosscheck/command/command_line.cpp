#include "crosscheck/command/command_line.hpp"

#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/command/help_text.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

void add_option(CLI::App& app, const Option& option) {
    const std::string name = names(option).back();
    if (option.value.empty()) {
        app.add_flag_callback(
            option.name, [keep = option.keep] { keep({}); }, option.description);
        return;
    }
    const auto keep = [name, keep = option.keep](const CLI::results_t& values) {
        if (const std::string problem = keep(values); !problem.empty())
            throw CLI::ValidationError(name, problem);
        return true;
    };
    CLI::Option* added = app.add_option(option.name, keep, option.description);
    added->type_name(option.value)->required(option.required);
    if (option.values != GivenValues::one)
        added->expected(CLI::detail::expected_max_vector_size)->allow_extra_args(is_argument(option));
    if (option.values == GivenValues::list)
        added->delimiter(',');
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
    std::string words; ///< as it was typed: "lockstep capsule cut"
};

Called called(const CLI::App& app, const Verb& verb, const std::string& words) {
    for (const CLI::App* part : app.get_subcommands())
        for (const Verb& candidate : verb.verbs)
            if (candidate.name == part->get_name())
                return called(*part, candidate, words + " " + candidate.name);
    return {app, verb, words};
}

/// `unknown`: the word in its place, if any.
std::string verb_error(const Verb& program, const Verb& verb, const std::string& unknown) {
    std::vector<std::string> names;
    for (const Verb& part : verb.verbs)
        names.push_back(part.name);
    const std::string there = fmt::format(
        "the verbs {}are {}", &verb == &program ? "" : fmt::format("of {} ", verb.name), fmt::join(names, ", "));
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

/// What is needed and was not given: "--frame F is missing: the frame, counted from 0".
std::string missing_error(const Called& call) {
    for (const Option& option : call.verb.options)
        if (option.required && call.app.count(names(option).back()) == 0)
            return fmt::format("{} is missing: {}",
                               is_argument(option) ? option.value : names(option).back() + " " + option.value,
                               option.description);
    return "something is missing";
}

/// The library's own words are for programmers.
std::string usage_error(const Verb& program, const Called& call, const CLI::App& app, const CLI::Error& error) {
    const Verb& verb = call.verb;
    std::vector<std::string> unknown = app.remaining(true);
    std::stable_partition(unknown.begin(), unknown.end(), [](const std::string& text) { return text[0] == '-'; });
    if (!unknown.empty() && unknown.front().starts_with('-'))
        return option_error(call, unknown.front());
    if (!verb.verbs.empty() && !verb.run)
        return verb_error(program, verb, unknown.empty() ? "" : unknown.front());
    if (!unknown.empty())
        return fmt::format("'{}' is one argument too many", unknown.front());
    const std::string text = error.what();
    if (error.get_name() == "RequiredError")
        return missing_error(call);
    if (error.get_name() == "ArgumentMismatch") {
        const std::string option = text.substr(0, text.find(':'));
        const bool twice = text.find("received") != std::string::npos;
        return fmt::format("{} {}", option, twice ? "is given more than once" : "needs a value");
    }
    return text;
}

} // namespace

int run_command_line(const Verb& program, int argc, char** argv, int misused) {
    CLI::App app(program.description);
    app.name(program.name);
    if (!program.version.empty())
        app.set_version_flag("--version", fmt::format("{} {}", program.name, program.version));
    describe(app, program);
    app.failure_message([&program](const CLI::App* root, const CLI::Error& error) {
        const Called call = called(*root, program, program.name);
        return fmt::format("{}: {} ({} --help says more)\n", program.name,
                           plain_line(usage_error(program, call, *root, error)), call.words);
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
    Call call{program, last.verb, {}};
    for (const Option& option : last.verb.options)
        if (const std::string name = names(option).back(); last.app.count(name) > 0)
            call.given.push_back(name);
    return call.verb.run(call);
}

} // namespace lockstep
