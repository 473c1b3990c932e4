#include "crosscheck/dust/system.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "crosscheck/dust/mistakes.hpp"
#include "reference/dust/passes.hpp"
#include "reference/model/dust/schema.hpp"

namespace lockstep::dust {

System system(const HostPtr& host) {
    const Settings& settings = host->settings();
    System dust{.name = "dust",
                .schema = schema(),
                .passes = twins(host),
                .mistakes = {},
                .start = {schema(), {{settings.count}, {1}}},
                .settings = fmt::format("{} grains, seed {}", settings.count, settings.seed)};
    dust.start.set(field::alive_number, 0, static_cast<std::uint32_t>(settings.count));
    for (const NamedMistake& mistake : mistakes())
        if (std::any_of(dust.passes.begin(), dust.passes.end(),
                        [&](const auto& pass) { return pass->name() == mistake.pass; }))
            dust.mistakes.push_back(mistake);
    return dust;
}

} // namespace lockstep::dust
