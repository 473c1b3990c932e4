#include <catch2/catch.hpp>

#include <limits>

#include "gpu/collision/octree.hpp"
#include "tests/random_positions.hpp"

namespace lockstep::test::octree_test {

namespace {

bool holds(const OctreeNode& node, glm::vec3 p) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(p[axis] >= node.min[axis] && p[axis] < node.max[axis]))
            return false;
    return true;
}

} // namespace

TEST_CASE("octree: 585 nodes, eight children to a node, halves of their parent") {
    const Octree octree(50.0F);
    const auto nodes = octree.nodes();
    REQUIRE(nodes.size() == 585);
    CHECK(nodes[0].min == glm::vec3(-25.0F));
    CHECK(nodes[0].max == glm::vec3(25.0F));
    CHECK(nodes[584].max - nodes[584].min == glm::vec3(6.25F));
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        CAPTURE(n);
        CHECK(nodes[n].leaf == (n < Octree::first_leaf ? 0U : 1U));
        CHECK(nodes[n].children == (n < Octree::first_leaf ? 8U : 0U));
        CHECK(nodes[n].depth == (n < 1 ? 0U : n < 9 ? 1U : n < 73 ? 2U : 3U));
        if (n > 0)
            CHECK(nodes[n].max - nodes[n].min == (nodes[(n - 1) / 8].max - nodes[(n - 1) / 8].min) * 0.5F);
    }
}

TEST_CASE("octree: each position lies once, in order, in the one leaf that holds it") {
    Octree octree(1.7F);
    std::vector<glm::vec3> particles = test::random_positions(2000, 0.9F, 9);
    particles[7].y = std::numeric_limits<float>::quiet_NaN();
    particles[8].y = std::numeric_limits<float>::infinity();
    const std::vector<glm::vec3> obstacles = test::random_positions(100, 0.5F, 9);
    for (int round = 0; round < 2; ++round) { // a refresh leaves nothing of the one before
        octree.refresh(particles, obstacles);
        std::vector<int> seen(particles.size() + obstacles.size());
        std::uint32_t next = 0;
        for (const OctreeNode& node : octree.nodes().subspan(Octree::first_leaf)) {
            CHECK(node.first == next);
            next += node.entries;
            for (std::uint32_t e = node.first; e < next; ++e) {
                const std::uint32_t i = octree.indices()[e];
                ++seen[i];
                CHECK(holds(node, i < particles.size() ? particles[i] : obstacles[i - particles.size()]));
                CHECK((e == node.first || octree.indices()[e - 1] < i));
            }
        }
        CHECK(next == octree.indices().size());
        CHECK(octree.nodes()[0].entries == next);
        for (std::size_t i = 0; i < seen.size(); ++i)
            CHECK(seen[i] ==
                  (holds(octree.nodes()[0], i < particles.size() ? particles[i] : obstacles[i - particles.size()])
                       ? 1
                       : 0));
    }
}

TEST_CASE("octree: a node's entries are those of its children") {
    Octree octree(2.0F);
    octree.refresh(test::random_positions(500, 0.9F, 9), {});
    const auto nodes = octree.nodes();
    for (std::size_t n = 0; n < Octree::first_leaf; ++n) {
        std::uint32_t sum = 0;
        for (std::size_t k = 1; k <= 8; ++k)
            sum += nodes[8 * n + k].entries;
        CHECK(nodes[n].entries == sum);
    }
    CHECK(nodes[0].entries == 500);
}

TEST_CASE("octree: the node texture leads from the root to every node") {
    const auto texture = Octree::node_texture();
    REQUIRE(texture.size() == 8U * Octree::node_texture_rows);
    std::vector<int> seen(Octree::node_count);
    std::vector<std::array<std::uint32_t, 4>> open{texture[0]};
    while (!open.empty()) {
        const auto [x, y, children, node] = open.back();
        open.pop_back();
        ++seen[node];
        CHECK(children == (node < Octree::first_leaf ? 8U : 0U));
        for (std::uint32_t k = 0; k < children; ++k) {
            open.push_back(texture[8 * y + x + k]);
            CHECK(open.back()[3] == 8 * node + 1 + k);
        }
    }
    CHECK(seen == std::vector<int>(Octree::node_count, 1));
}

} // namespace lockstep::test::octree_test
