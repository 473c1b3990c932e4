#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "reference/window.hpp"

namespace lockstep {

/// Some pixels of an image, to be gone through rectangle by rectangle without a look at the others.
class PixelSet {
  public:
    /// `pixels`: indices into an image of width x height, rows from the bottom; in any order.
    PixelSet(int width, int height, std::span<const std::size_t> pixels)
        : rows_(static_cast<std::size_t>(height) + 1, 0), places_(pixels.size()) {
        std::iota(places_.begin(), places_.end(), 0);
        std::stable_sort(places_.begin(), places_.end(), [&](int a, int b) {
            return pixels[static_cast<std::size_t>(a)] < pixels[static_cast<std::size_t>(b)];
        });
        for (const int place : places_) {
            const std::size_t pixel = pixels[static_cast<std::size_t>(place)];
            columns_.push_back(static_cast<int>(pixel % static_cast<std::size_t>(width)));
            ++rows_[pixel / static_cast<std::size_t>(width) + 1];
        }
        std::partial_sum(rows_.begin(), rows_.end(), rows_.begin());
        if (!places_.empty()) {
            const auto row_of = [&](int place) {
                return static_cast<int>(pixels[static_cast<std::size_t>(place)] / static_cast<std::size_t>(width));
            };
            first_row_ = row_of(places_.front());
            end_row_ = row_of(places_.back()) + 1;
        }
    }

    /// Calls visit(x, y) once for each of them in `rect`, rows upwards, each from its left.
    template <class Visit> void for_each(const PixelRect& rect, const Visit& visit) const {
        const int y1 = std::min(rect.y1, end_row_);
        for (int y = std::max(rect.y0, first_row_); y < y1; ++y) {
            const auto [first, last] = row(y);
            int before = -1;
            for (auto x = std::lower_bound(first, last, rect.x0); x != last && *x < rect.x1; ++x)
                if (*x != std::exchange(before, *x))
                    visit(*x, y);
        }
    }

    /// Where the first of `pixels` that is this one stands among them; -1: none is.
    [[nodiscard]] int place(int x, int y) const {
        if (y < 0 || y + 1 >= static_cast<int>(rows_.size()))
            return -1;
        const auto [first, last] = row(y);
        const auto found = std::lower_bound(first, last, x);
        return found == last || *found != x ? -1 : places_[static_cast<std::size_t>(found - columns_.begin())];
    }

  private:
    [[nodiscard]] std::pair<std::vector<int>::const_iterator, std::vector<int>::const_iterator> row(int y) const {
        const auto at = static_cast<std::size_t>(y);
        return {columns_.begin() + rows_[at], columns_.begin() + rows_[at + 1]};
    }

    std::vector<std::ptrdiff_t> rows_; ///< where each row's columns begin, and the end
    std::vector<int> columns_, places_;
    int first_row_ = 0, end_row_ = 0; ///< rows that have any
};

} // namespace lockstep
