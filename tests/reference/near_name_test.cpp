#include "reference/model/near_name.hpp"

#include <catch2/catch.hpp>

namespace lockstep::test::near_name_test {

TEST_CASE("near name: letters added, dropped, changed and swapped with the next are one slip each") {
    CHECK(edits("angle", "angle") == 0);
    CHECK(edits("angle", "angl") == 1);
    CHECK(edits("angle", "anngle") == 1);
    CHECK(edits("angle", "ankle") == 1);
    CHECK(edits("angle", "angel") == 1);
    CHECK(edits("angle", "nagel") == 2);
    CHECK(edits("", "ab") == 2);
}

TEST_CASE("near name: the nearest is meant, and none where none is near") {
    CHECK(nearest_name("angel", {"tool", "from", "range", "angle"}) == "angle");
    CHECK(nearest_name("vaccum", {"vacuum", "emit", "wind"}) == "vacuum");
    CHECK(did_you_mean("wind", {"vacuum", "emit"}).empty());
}

} // namespace lockstep::test::near_name_test
