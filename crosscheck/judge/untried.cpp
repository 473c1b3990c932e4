#include "crosscheck/judge/untried.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "crosscheck/judge/compare.hpp"

namespace lockstep {
namespace {

/// Whether all items have the same words.
bool are_alike(const View& items) {
    for (std::size_t f = 0; f < items.columns.size(); ++f) {
        const std::size_t bytes = static_cast<std::size_t>(items.fields()[f].components) * sizeof(std::uint32_t);
        if (items.count() > 1 &&
            std::memcmp(items.columns[f], items.columns[f] + bytes, (items.count() - 1) * bytes) != 0)
            return false;
    }
    return true;
}

/// "a, b and c"
std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? "" : i + 1 == words.size() ? " and " : ", ", words[i]);
    return text;
}

} // namespace

std::size_t UntriedParts::Step::changed() const {
    const std::size_t most = std::max(from.count(), made.count()), both = std::min(from.count(), made.count());
    return most - both + differing_items(from, made).size();
}

void UntriedParts::note(const ItemPass& pass, const Step& reference, const Step& gpu) {
    const View& made = reference.made;
    Effect& effect =
        effects_.try_emplace(std::string(pass.name()), Effect{.derived = pass.derived(), .item = made.about().item})
            .first->second;
    if (!effect.changes) {
        effect.changes = gpu.changed() > 0;
        effect.missed += effect.changes ? 0 : reference.changed();
    }
    if (made.about().dimensions < 2)
        return;
    const auto [known, is_first] = uniform_.emplace(pass.resource(), true);
    known->second = known->second && are_alike(made);
}

std::vector<std::string> UntriedParts::without_effect() const {
    std::vector<std::string> passes;
    for (const auto& [pass, effect] : effects_)
        if (!effect.changes)
            passes.push_back(pass);
    return passes;
}

std::vector<std::string> UntriedParts::texts(const CheckReport& report) const {
    std::vector<std::string> all;
    std::size_t passes = 0, in_vain = 0; // what is derived follows from another
    for (const auto& [pass, effect] : effects_) {
        passes += effect.derived ? 0 : 1;
        in_vain += effect.derived || effect.changes ? 0 : 1;
    }
    const bool changes = without_effect().size() < effects_.size();
    if (!changes)
        all.emplace_back("no pass changed anything");
    if (!idle_.empty())
        all.push_back(fmt::format("{} did not run", listed({idle_.begin(), idle_.end()})));
    for (const auto& [pass, stage] : empty_)
        all.push_back(fmt::format("{} ran over 0 {}", pass, stage == PassStage::compute ? "invocations" : "vertices"));
    for (const auto& [pass, effect] : effects_)
        if (!effect.changes && effect.missed > 0)
            all.push_back(fmt::format("{} changed nothing on the GPU, where the reference changed {} {}{}", pass,
                                      effect.missed, effect.item, effect.missed == 1 ? "" : "s"));
    if (changes && in_vain > 0 && 2 * in_vain >= passes)
        all.push_back(fmt::format("{} of {} passes changed nothing", in_vain, passes));
    std::map<std::string, std::vector<std::string>> uniform; // by what their items are
    std::size_t count = 0;
    for (const auto& [resource, is_uniform] : uniform_)
        if (const Resource& about = report.schema.resources[resource]; is_uniform) {
            uniform[about.item].push_back(about.title);
            ++count;
        }
    // Of a few among many a scene has nothing: a background without obstacles.
    if (changes && 3 * count >= uniform_.size())
        for (const auto& [item, titles] : uniform)
            all.push_back(fmt::format("all {}s are alike in {}", item, listed(titles)));
    std::uint64_t compared = 0, nan = 0;
    for (const ResourceCount& resource : report.total.resources)
        for (const FieldCount& field : resource.fields) {
            compared += field.compared;
            nan += field.nan;
        }
    if (nan > 0 && 2 * nan >= compared)
        all.emplace_back(fmt::format("{} of {} values are NaN, of which any equals any other", nan, compared));
    return all;
}

} // namespace lockstep
