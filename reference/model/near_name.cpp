#include "reference/model/near_name.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {

std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j)
            diagonal = std::exchange(
                row[j], std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)}));
    }
    return row[b.size()];
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& names) {
    std::size_t fewest = std::min(std::max<std::size_t>(2, name.size() / 3) + 1, (name.size() + 1) / 2);
    std::string nearest;
    for (const std::string& known : names)
        if (const std::size_t distance = edits(known, name); distance < fewest) {
            fewest = distance;
            nearest = known;
        }
    return nearest;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& names) {
    const std::string nearest = nearest_name(name, names);
    return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

} // namespace lockstep
