#include "crosscheck/judge/untried.hpp"

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

void UntriedParts::note(std::uint8_t resource, const View& from, const View& made) {
    changed_ = changed_ || !differing_items(from, made).empty();
    if (made.about().dimensions < 2 || made.count() < 2)
        return;
    const auto [known, is_first] = uniform_.emplace(resource, true);
    known->second = known->second && are_alike(made);
}

std::vector<std::string> UntriedParts::texts(const CheckReport& report) const {
    std::vector<std::string> all;
    if (!changed_)
        all.emplace_back("no pass changed anything");
    if (!idle_.empty())
        all.push_back(fmt::format("{} did not run", listed({idle_.begin(), idle_.end()})));
    std::map<std::string, std::vector<std::string>> uniform; // by what their items are
    std::size_t count = 0;
    for (const auto& [resource, is_uniform] : uniform_)
        if (const Resource& about = report.schema.resources[resource]; is_uniform) {
            uniform[about.item].push_back(about.title);
            ++count;
        }
    // Of a few among many a scene has nothing: a background without obstacles.
    if (changed_ && 3 * count >= uniform_.size())
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
