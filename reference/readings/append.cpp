#include "reference/readings/append.hpp"

#include <cstddef>

namespace lockstep {
namespace {

constexpr std::uint32_t nobody = 0xffffffffU;

/// Matches the left side to the right, one by one, by augmenting paths (Kuhn); the first that is left alone.
std::optional<std::size_t> first_alone(const std::vector<std::vector<std::uint32_t>>& left, std::size_t right_count) {
    std::vector<std::uint32_t> partner(right_count, nobody), reached_by(right_count, nobody);
    std::vector<std::uint32_t> seen(right_count, nobody);
    for (std::uint32_t start = 0; start < left.size(); ++start) {
        std::vector<std::uint32_t> open{start};
        std::uint32_t free = nobody;
        while (!open.empty() && free == nobody) {
            const std::uint32_t l = open.back();
            open.pop_back();
            for (const std::uint32_t r : left[l]) {
                if (seen[r] == start)
                    continue;
                seen[r] = start;
                reached_by[r] = l;
                if (partner[r] == nobody) {
                    free = r;
                    break;
                }
                open.push_back(partner[r]);
            }
        }
        if (free == nobody)
            return start;
        // Back along the path: each gives up the one it had.
        for (std::uint32_t r = free; r != nobody;) {
            const std::uint32_t l = reached_by[r];
            std::uint32_t before = nobody;
            if (l != start)
                for (const std::uint32_t candidate : left[l])
                    if (partner[candidate] == l) {
                        before = candidate;
                        break;
                    }
            partner[r] = l;
            r = before;
        }
    }
    return {};
}

} // namespace

std::optional<WrongAppend> wrong_append(const Appended& appended) {
    if (const auto item = first_alone(appended.may, appended.invocations))
        return WrongAppend{.item = item, .missing = {}};
    std::vector<std::vector<std::uint32_t>> items_of(appended.invocations);
    for (std::uint32_t item = 0; item < appended.may.size(); ++item)
        for (const std::uint32_t invocation : appended.may[item])
            items_of[invocation].push_back(item);
    std::vector<std::vector<std::uint32_t>> wanted;
    for (const std::uint32_t invocation : appended.must)
        wanted.push_back(items_of[invocation]);
    if (const auto alone = first_alone(wanted, appended.may.size()))
        return WrongAppend{.item = {}, .missing = appended.must[*alone]};
    return {};
}

} // namespace lockstep
