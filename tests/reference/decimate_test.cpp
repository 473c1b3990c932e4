#include <catch2/catch.hpp>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "crosscheck/scene/decimate.hpp"
#include "reference/model/error.hpp"
#include "reference/model/random.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::decimate_test {

using lockstep::test::TemporaryFolder;

namespace {

/// Hills with holes, as a scan has them.
Surface torn_ground(std::uint32_t n) {
    Surface ground;
    Random random(1, 1);
    for (std::uint32_t z = 0; z < n; ++z)
        for (std::uint32_t x = 0; x < n; ++x)
            ground.positions.emplace_back(x, 4.0 * random.unit(), z);
    for (std::uint32_t a = 0; a + n < n * n; ++a)
        if (a % n + 1 < n && random.unit() < 0.9)
            ground.indices.insert(ground.indices.end(), {a, a + n, a + 1, a + 1, a + n, a + n + 1});
    return ground;
}

} // namespace

TEST_CASE("decimate: a torus keeps its shape and gets the faces asked for") {
    const Surface torus = decimate(torus_surface(1.0, 0.25, 64), 1000);
    CHECK(torus.indices.size() / 3 == 1000);
    CHECK(torus.positions.size() == 500);
    for (const glm::dvec3& p : torus.positions)
        REQUIRE(glm::length(glm::dvec2(glm::length(glm::dvec2(p.x, p.z)) - 1.0, p.y)) == Approx(0.25).margin(0.01));
}

TEST_CASE("decimate: where the collapses overshoot, it tries again with a higher aim") {
    const Surface ground = torn_ground(64);
    for (const std::size_t faces : {2500U, 3000U, 3500U, 4500U, 5000U})
        CHECK(static_cast<double>(decimate(ground, faces).indices.size() / 3) == Approx(faces).margin(8));
}

TEST_CASE("decimate: a surface with too few faces stays whole") {
    CHECK(decimate(box_surface({1.0, 1.0, 1.0}), 100).indices.size() == 36);
}

TEST_CASE("decimate: a written OBJ is read back but for the importer's rounding") {
    const TemporaryFolder folder;
    const Surface torus = decimate(torus_surface(1.0, 0.25, 16), 100);
    write_obj(torus, folder.path() / "torus.obj");
    CHECK_FALSE(std::filesystem::exists(folder.path() / "torus.obj.part"));
    const Surface read = load_surface(folder.path() / "torus.obj");
    REQUIRE(read.indices.size() == torus.indices.size());
    for (std::size_t i = 0; i < read.indices.size(); ++i)
        CHECK(glm::distance(read.positions[read.indices[i]], torus.positions[torus.indices[i]]) < 1e-6);
}

TEST_CASE("decimate: a file that cannot be written is told") {
    CHECK_THROWS_WITH(write_obj(box_surface({1.0, 1.0, 1.0}), "/nowhere/box.obj"),
                      "/nowhere/box.obj: cannot be written: No such file or directory");
}

} // namespace lockstep::test::decimate_test
