#include "reference/model/near_name.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lockstep {

std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last, last, row(b.size() + 1); // of a's first i - 2, i - 1 and i letters
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = std::exchange(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
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
