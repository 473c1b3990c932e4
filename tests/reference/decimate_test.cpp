#include <catch2/catch.hpp>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "crosscheck/decimate.hpp"
#include "reference/model/error.hpp"
#include "tests/temporary_folder.hpp"

using namespace lockstep;
using lockstep::test::TemporaryFolder;

TEST_CASE("decimate: a torus keeps its shape and gets the faces asked for") {
    const Surface torus = decimate(torus_surface(1.0, 0.25, 64), 1000);
    CHECK(torus.indices.size() / 3 == 1000);
    CHECK(torus.positions.size() == 500);
    for (const glm::dvec3& p : torus.positions)
        REQUIRE(glm::length(glm::dvec2(glm::length(glm::dvec2(p.x, p.z)) - 1.0, p.y)) == Approx(0.25).margin(0.01));
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
