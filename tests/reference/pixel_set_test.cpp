#include <catch2/catch.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "reference/model/random.hpp"
#include "reference/pixel_set.hpp"

namespace lockstep::test::pixel_set_test {

TEST_CASE("pixel set: a rectangle's pixels are those that a look at each of them finds, row by row") {
    constexpr int width = 13, height = 7;
    Random random(5, 0);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<std::size_t> pixels;
        for (int i = 0; i < trial / 4; ++i)
            pixels.push_back(static_cast<std::size_t>(random.unit() * width * height));
        const PixelSet set(width, height, pixels);
        const auto some = [&] { return static_cast<int>(random.unit() * 20.0) - 4; };
        const PixelRect rect{some(), some(), some(), some()};
        std::vector<std::pair<int, int>> found, expected;
        set.for_each(rect, [&](int x, int y) { found.emplace_back(x, y); });
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto place = std::find(pixels.begin(), pixels.end(), static_cast<std::size_t>(y * width + x));
                const bool is_in = place != pixels.end();
                CHECK(set.place(x, y) == (is_in ? static_cast<int>(place - pixels.begin()) : -1));
                if (is_in && x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1)
                    expected.emplace_back(x, y);
            }
        CHECK(found == expected);
        CHECK(set.place(-1, 0) == -1);
        CHECK(set.place(width, 0) == -1);
        CHECK(set.place(0, height) == -1);
    }
}

} // namespace lockstep::test::pixel_set_test
