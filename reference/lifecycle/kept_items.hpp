#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "reference/model/state_view.hpp"

namespace lockstep::lifecycle {

/// Items first to last, the last excluded, become those from `from` on, field by field from `field` on.
inline void copy_items(const View& before, std::size_t from, std::size_t first, std::size_t last,
                       const WritableView& after, std::size_t field = 0) {
    for (std::size_t f = field; f < before.columns.size(); ++f) {
        const std::size_t bytes = static_cast<std::size_t>(before.fields()[f].components) * sizeof(std::uint32_t);
        if (first < last && after.columns[f] + first * bytes != before.columns[f] + from * bytes)
            std::memcpy(after.columns[f] + first * bytes, before.columns[f] + from * bytes, (last - first) * bytes);
    }
}

/// Items first to last stay as they are, but for begin to end, which are put into `left`.
inline void keep_items_but(const View& before, std::size_t begin, std::size_t end, std::size_t first, std::size_t last,
                           const WritableView& after, std::vector<std::size_t>& left) {
    copy_items(before, first, first, last, after);
    for (std::size_t item = std::max(begin, first); item < std::min(end, last); ++item)
        left.push_back(item);
}

} // namespace lockstep::lifecycle
