#include "crosscheck/judge/pass_names.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

/// Of those of the name the first that runs in the frame, or else the first.
std::optional<std::size_t> first_of(const System& system, std::string_view name, int frame) {
    std::optional<std::size_t> first;
    for (std::size_t p = 0; p < system.passes.size(); ++p) {
        if (system.passes[p]->name() != name)
            continue;
        if (system.passes[p]->runs(frame))
            return p;
        if (!first)
            first = p;
    }
    return first;
}

} // namespace

std::string pass_argument(const System& system, std::size_t pass, int frame) {
    const std::string name(system.passes[pass]->name());
    return first_of(system, name, frame) == pass ? name : std::to_string(pass);
}

std::size_t pass_named(const std::string& name, const System& system, int frame, std::string_view where) {
    if (const auto found = first_of(system, name, frame))
        return *found;
    std::size_t number = 0;
    const char* end = name.data() + name.size();
    if (const auto [read, status] = std::from_chars(name.data(), end, number);
        status == std::errc{} && read == end && number < system.passes.size())
        return number;
    std::vector<std::string> names;
    for (const auto& pass : system.passes)
        if (std::ranges::find(names, pass->name()) == names.end())
            names.emplace_back(pass->name());
    throw Error(fmt::format("{}: there is no pass '{}'; there are {}{}", where, plain_line(name),
                            fmt::join(names, ", "), did_you_mean(name, names)));
}

} // namespace lockstep
