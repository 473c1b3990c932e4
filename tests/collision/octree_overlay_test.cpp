#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <vector>

#include <glm/common.hpp>

#include "crosscheck/collision/report/octree_overlay.hpp"
#include "tests/random_positions.hpp"

namespace lockstep::test::octree_overlay_test {

namespace {

struct Box {
    glm::vec3 low, high;
};

/// Twelve lines each.
std::vector<Box> boxes(const std::vector<OverlayLine>& lines) {
    std::vector<Box> found;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i % 12 == 0)
            found.push_back({lines[i].from, lines[i].to});
        found.back().low = glm::min(found.back().low, glm::min(lines[i].from, lines[i].to));
        found.back().high = glm::max(found.back().high, glm::max(lines[i].from, lines[i].to));
    }
    return found;
}

bool holds(const Box& box, glm::vec3 p) {
    return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x < box.high.x && p.y < box.high.y &&
           p.z < box.high.z;
}

} // namespace

TEST_CASE("octree overlay: a particle shows its root, two nodes and its leaf") {
    const std::vector<glm::vec3> one{{1.0F, -1.0F, 3.9F}};
    const std::vector<Box> nodes = boxes(octree_overlay(one, 8.0F));
    REQUIRE(nodes.size() == 4);
    CHECK(nodes[0].low == glm::vec3(-4.0F));
    CHECK(nodes[1].low == glm::vec3(0.0F, -4.0F, 0.0F));
    CHECK(nodes[2].low == glm::vec3(0.0F, -2.0F, 2.0F));
    CHECK(nodes[3].low == glm::vec3(1.0F, -1.0F, 3.0F));
    CHECK(nodes[3].high == glm::vec3(2.0F, 0.0F, 4.0F));
}

TEST_CASE("octree overlay: every box holds a particle, and every particle in the root lies in one box of each depth") {
    std::vector<glm::vec3> positions = test::random_positions(60, 1.5F, 3);
    positions.push_back({std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F});
    const std::vector<Box> nodes = boxes(octree_overlay(positions, 2.0F));
    CHECK(nodes.size() > 20);
    for (const Box& box : nodes)
        CHECK(std::any_of(positions.begin(), positions.end(), [&](glm::vec3 p) { return holds(box, p); }));
    for (const glm::vec3 p : positions) {
        const auto in = std::count_if(nodes.begin(), nodes.end(), [&](const Box& box) { return holds(box, p); });
        CHECK(in == (holds({glm::vec3(-1.0F), glm::vec3(1.0F)}, p) ? 4 : 0));
    }
    CHECK(octree_overlay(positions, 1e-6F).empty());
}

} // namespace lockstep::test::octree_overlay_test
