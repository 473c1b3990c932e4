#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/system/pixel_boxes.hpp"

namespace lockstep::test::pixel_boxes_test {

/// Which boxes a tile is drawn with, held to a search of all boxes.

TEST_CASE("every tile has the boxes that touch it, by number, however many parts sort them", "[boxes]") {
    constexpr int width = 133, height = 90, tile_width = BoxesByTile::tile_width,
                  tile_height = BoxesByTile::tile_height; // the last tiles are cut
    const int count = GENERATE(0, 1, 100, 4'095, 20'000, 70'000);
    std::mt19937 random(7);
    std::vector<PixelRect> boxes;
    for (int i = 0; i < count; ++i) {
        const int x = static_cast<int>(random() % width), y = static_cast<int>(random() % height),
                  w = static_cast<int>(random() % 20), h = static_cast<int>(random() % 20); // some are empty
        boxes.push_back({x, y, std::min(x + w, width), std::min(y + h, height)});
    }
    const BoxesByTile sorted(boxes, width, height);
    REQUIRE(sorted.tiles() == std::size_t{17} * 6);
    for (int y = 0; y < height; y += tile_height)
        for (int x = 0; x < width; x += tile_width) {
            std::vector<std::uint32_t> touching;
            for (std::uint32_t i = 0; i < boxes.size(); ++i) {
                const PixelRect& b = boxes[i];
                if (b.x0 < b.x1 && b.y0 < b.y1 && b.x0 < x + tile_width && b.x1 > x && b.y0 < y + tile_height &&
                    b.y1 > y)
                    touching.push_back(i);
            }
            const auto found = sorted.near({x, y});
            INFO(count << " boxes, the tile of pixel " << x << ' ' << y);
            REQUIRE(std::vector<std::uint32_t>(found.begin(), found.end()) == touching);
        }
}

} // namespace lockstep::test::pixel_boxes_test
