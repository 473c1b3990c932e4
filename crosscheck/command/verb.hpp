#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lockstep {

/// How often a value is given: once; several times, `--set a=1 --set b=2`, or of an argument `a b`; or as a list,
/// `--counts 1,2`.
enum class GivenValues { one, repeated, list };

/// An option, a flag or an argument of a verb, as data. option_values.hpp makes them.
struct Option {
    std::string name;        ///< "--frames", "-o,--output"; without a dash an argument, given by its place
    std::string value;       ///< what help calls its value: FILE, N, cpu|gpu; empty: a flag
    std::string description; ///< for help and the manual
    /// Keeps the values given, at least one, of a flag none. Returns what is wrong with them, or nothing.
    std::function<std::string(std::span<const std::string> values)> keep;
    GivenValues values = GivenValues::one;
    bool required = false;
    std::string initial = {}; ///< the value without it, as help says it; empty: none, or the description says it
};

/// "-o", "--output", the last of which messages use; of an argument its one name.
std::vector<std::string> names(const Option& option);
bool is_argument(const Option& option);

/// The values there are, where there are few ("cpu|gpu"); placeholders in capitals are left out.
std::vector<std::string> choices(const Option& option);

struct Call;

/// A verb, or the whole program with its verbs, as data: what it is called with, what help says, what it does.
struct Verb {
    Verb(std::string its_name, std::string its_description)
        : name(std::move(its_name)), description(std::move(its_description)) {}

    std::string name;
    std::string description;
    std::string footer;  ///< exit status and example
    std::string version; ///< of a program, which --version prints; empty: it has none
    std::vector<Option> options;
    std::vector<Verb> verbs;             ///< if any, one of them has to be given, unless the verb runs by itself
    std::function<int(const Call&)> run; ///< gives the exit status, or throws Error

    void add(Option option) { options.push_back(std::move(option)); }
};

/// One call of a verb, whose options have kept their values.
struct Call {
    const Verb& program;
    const Verb& verb;
    std::vector<std::string> given; ///< the last name of each option that was given, in the order of the verb's

    [[nodiscard]] bool has(std::string_view option) const;
};

/// For a verb of several modes: throws Error if an option was given that is not among `allowed`, which `mode` has.
/// "check: --hashes does not go with --stress".
void check_options(const Call& call, std::string_view mode, std::span<const std::string_view> allowed);

/// The one that every verb has by itself, and with it the verb's own, as help lists them.
Option help_option();
std::vector<Option> all_options(const Verb& verb);

} // namespace lockstep
