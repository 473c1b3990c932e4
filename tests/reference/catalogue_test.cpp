#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "crosscheck/collision/study/catalogue.hpp"
#include "crosscheck/collision/study/catalogue_pictures.hpp"
#include "crosscheck/collision/study/study_pictures.hpp"
#include "reference/model/error.hpp"

namespace lockstep::test::catalogue_test {

namespace {

const std::filesystem::path scenes = "data/scenes/catalogue";

void check_effect(std::string_view name) {
    for (const CatalogueRow& row : measure_catalogue(name, scenes)) {
        INFO(row.quantity << ": " << row.cause << " " << row.with_cause << ", " << row.control << " "
                          << row.without_cause);
        CHECK(row.name == name);
        CHECK(row.holds());
    }
}

} // namespace

TEST_CASE("catalogue: close_up") { check_effect("close_up"); }
TEST_CASE("catalogue: one_sided") { check_effect("one_sided"); }
TEST_CASE("catalogue: overlap_jitter") { check_effect("overlap_jitter"); }
TEST_CASE("catalogue: horn_growth") { check_effect("horn_growth"); }
TEST_CASE("catalogue: camera_drop") { check_effect("camera_drop"); }
TEST_CASE("catalogue: occluded_neighbour") { check_effect("occluded_neighbour"); }
TEST_CASE("catalogue: off_axis_spread") { check_effect("off_axis_spread"); }
TEST_CASE("catalogue: plane_hides") { check_effect("plane_hides"); }
TEST_CASE("catalogue: side_view") { check_effect("side_view"); }

TEST_CASE("catalogue: every scene has an effect, and every effect a scene and its rows in docs/catalogue.md") {
    std::ostringstream page;
    page << std::ifstream("docs/catalogue.md").rdbuf();
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
        const std::string name = entry.path().stem().string();
        INFO(name);
        CHECK(std::count(catalogue_names().begin(), catalogue_names().end(), name) == 1);
        CHECK(page.str().find("| " + name + " |") != std::string::npos);
        CHECK(page.str().find("../data/pictures/catalogue/" + name + ".png") != std::string::npos);
        CHECK(std::filesystem::exists("data/pictures/catalogue/" + name + ".png"));
        ++files;
    }
    CHECK(files == catalogue_names().size());
}

TEST_CASE("catalogue: an effect holds only when it is larger with its cause") {
    CatalogueRow row{"a", "1", "hits", "near", 3.0, "far", 1.0, 2.0};
    CHECK(row.holds());
    CHECK(catalogue_text(row) == "| a | 1 | hits | near | 3 | far | 1 | yes |\n");
    row.with_cause = 2.0;
    CHECK_FALSE(row.holds());
    CHECK(catalogue_text(row) == "| a | 1 | hits | near | 2 | far | 1 | no |\n");
    row.with_cause = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(row.holds());
}

TEST_CASE("catalogue: an unknown effect is told with those there are") {
    CHECK_THROWS_WITH(measure_catalogue("horn", scenes),
                      "catalogue: nothing is named horn; the effects are close_up, one_sided, overlap_jitter, "
                      "horn_growth, camera_drop, occluded_neighbour, off_axis_spread, plane_hides, side_view");
}

TEST_CASE("catalogue: a picture shows the viewer's frame and the searches beside it") {
    const ColorImage picture = catalogue_picture("occluded_neighbour", scenes);
    CHECK(picture.width == 808);
    CHECK(picture.height == 400);
    const auto count = [&](Rgba8 color) { return std::count(picture.texels.begin(), picture.texels.end(), color); };
    CHECK(count({255, 255, 255, 255}) == 8 * 400);
    CHECK(count(miss_color(Miss::occluded)) > 20000); // the rear sheet, behind the front one
    CHECK(count(miss_color(Miss::outside_image)) == 0);
    CHECK_THROWS_WITH(catalogue_picture("horn", scenes), Catch::StartsWith("catalogue: nothing is named horn"));
}

} // namespace lockstep::test::catalogue_test
