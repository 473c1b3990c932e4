#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/collision/study/thesis_report.hpp"
#include "crosscheck/report/statistics.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::thesis_report_test {

namespace {

/// CDT: 1 ms per 10,000 particles; octree: six times that; depth: 0.4 times that.
ThesisRun linear_run(bool with_compute = true) {
    ThesisRun run;
    run.context = "made up";
    for (const std::string_view scene : thesis_scenes)
        for (const std::size_t count : {50'000U, 100'000U, 150'000U, 200'000U}) {
            const double n = static_cast<double>(count);
            ThesisCell cell{std::string(scene), count, {}, {}, {}};
            cell.cdt = {60, n * 1e-7, n * 0.5e-7, 0.0, 0.25, 0.5};
            if (with_compute) {
                cell.octree = SystemTimes{30, n * 6e-7, 0.0, 0.0, 0.9375, 0.75};
                cell.depth = SystemTimes{60, n * 0.4e-7, 0.0, 0.0, 0.0, 0.375};
            }
            run.cells.push_back(cell);
        }
    return run;
}

} // namespace

TEST_CASE("statistics: the median of an odd and an even number of values") {
    CHECK(median({3.0, 1.0, 2.0}) == 2.0);
    CHECK(median({4.0, 1.0, 3.0, 2.0}) == 3.0);
    CHECK(median({5.0}) == 5.0);
}

TEST_CASE("statistics: the exponent of powers") {
    const std::array<std::size_t, 3> counts{10, 100, 1000};
    CHECK(fitted_exponent(counts, std::array{3.0, 30.0, 300.0}) == Approx(1.0));
    CHECK(fitted_exponent(counts, std::array{1.0, 100.0, 10000.0}) == Approx(2.0));
    CHECK(fitted_exponent(counts, std::array{7.0, 7.0, 7.0}) == Approx(0.0).margin(1e-12));
}

TEST_CASE("statistics: how far times are off a straight line") {
    const std::array<std::size_t, 3> counts{10, 20, 30};
    CHECK(deviation_from_line(counts, std::array{7.0, 9.0, 11.0}) == Approx(0.0).margin(1e-12));
    CHECK(deviation_from_line(counts, std::array{1.0, 4.0, 1.0}) == Approx(1.0)); // the line is 2
}

TEST_CASE("thesis_report: tables, figures and ratios, the thesis's beside") {
    const std::string text = thesis_text(linear_run());
    CHECK_THAT(text, Catch::Contains("Table 4-1") && Catch::Contains("Table 5-1") && Catch::Contains("Figure 5-3") &&
                         Catch::Contains("Figure 5-5"));
    const auto has_row = [&](std::vector<std::string> words) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream split(line);
            if (std::vector<std::string>{std::istream_iterator<std::string>(split), {}} == words)
                return true;
        }
        return false;
    };
    CHECK(
        has_row({"bunny", "A", "5.00", "10.00", "15.00", "20.00", "1.00", "12.00", "27.00", "52.00", "65.00", "1.26"}));
    CHECK(has_row({"dragon", "B", "30.00", "60.00", "90.00", "120", "1.00", "104", "194", "284", "370", "0.92"}));
    CHECK(has_row({"octree", "30.00", "60.00", "90.00", "120", "1.00", "102", "194", "284", "392", "0.96"}));
    CHECK(has_row({"bunny", "B", "6.0", "6.0", "6.0", "6.0", "7.7", "6.3", "5.7", "5.9"}));
    CHECK(has_row({"x-streams", "6.0", "6.0", "6.0", "6.0", "-", "-", "-", "-"}));
    CHECK(has_row({"dragon", "A", "2.00", "4.00", "6.00", "8.00", "1.00"}));
    CHECK(has_row({"dragon", "A", "0.4", "0.4", "0.4", "0.4"}));
    CHECK_THAT(text, Catch::Contains("25.0 / 93.8 / 0.0") && Catch::Contains("50.0 / 75.0 / 37.5") &&
                         Catch::Contains("x 1.00 to 1.00 (CDT), 1.00 to 1.00 (octree), 1.00 to 1.00 (depth)") &&
                         Catch::Contains("0.0 to 0.0 % (CDT), 0.0 to 0.0 % (octree), 0.0 to 0.0 % (depth) at most") &&
                         Catch::Contains("octree / CDT: 6.0 to 6.0 (thesis 4.5 to 7.7); octree slower in every cell: "
                                         "yes\ndepth / CDT: 0.40 to 0.40\n"));
}

TEST_CASE("thesis_report: each average of the thesis stands beside what it is the average of") {
    CHECK_THAT(
        thesis_text(linear_run()),
        Catch::Contains("average of table 4-1: 12.50 ms at 125000 particles (16 cells; the thesis's 16 cells, at "
                        "125000 particles, average 43.00 ms)") &&
            Catch::Contains("average of dragon B: 12.50 ms (thesis 46.75 ms") &&
            Catch::Contains("abstract says 71 ms"));
}

TEST_CASE("thesis_report: scenes that were left out have empty rows") {
    ThesisRun run = linear_run();
    run.cells.erase(std::remove_if(run.cells.begin(), run.cells.end(),
                                   [](const ThesisCell& cell) { return cell.scene.starts_with("dragon"); }),
                    run.cells.end());
    const std::string text = thesis_text(run);
    CHECK_THAT(text, Catch::Contains("at 125000 particles (8 cells;") && Catch::Contains("average of dragon B: - ms"));
    CHECK_THAT(text, Catch::Contains("\ndragon B            -         -         -         -         -"));
    CHECK_THAT(thesis_chart(run), Catch::Contains("\n50000 NaN NaN 13.5 102\n"));

    run.cells.erase(run.cells.begin(), run.cells.end() - 4);
    CHECK_THAT(thesis_text(run), Catch::Contains("average of table 4-1: - ms at - particles (0 cells;"));
}

TEST_CASE("thesis_report: how time grows without what a frame costs anyway") {
    ThesisRun run = linear_run();
    CHECK_THAT(thesis_text(run), Catch::Contains("to a frame with one alone: x - (CDT), - (octree), - (depth)"));
    for (ThesisCell& cell : run.cells) {
        cell.cdt.fixed = 0.02;
        cell.cdt.wall += 0.02;
        cell.octree->fixed = 0.001;
        cell.octree->wall = 0.001 + 1e-9 * static_cast<double>(cell.particles) * static_cast<double>(cell.particles);
    }
    CHECK_THAT(thesis_text(run),
               Catch::Contains("x 0.33 to 0.33 (CDT), 2.00 to 2.00 (octree), 1.00 to 1.00 (depth); 0.9") &&
                   Catch::Contains("alone: x 1.00 to 1.00 (CDT), 2.00 to 2.00 (octree), - (depth)\n"));
}

TEST_CASE("thesis_report: without compute shaders the columns of octree and depth are empty") {
    const ThesisRun run = linear_run(false);
    CHECK_THAT(thesis_text(run), Catch::Contains("25.0 / - / -") &&
                                     Catch::Contains("octree slower in every cell: no") &&
                                     Catch::Contains("(octree); 0.9"));
    CHECK_THAT(thesis_csv(run), Catch::Contains("\nbunny_b,50000,5,2.5,0.25,,,,,13,100,,,,0.5,,\n"));
    CHECK_FALSE(thesis_json(run).at("cells").front().contains("octree"));
    CHECK_FALSE(thesis_json(run).at("cells").front().contains("depth"));
}

TEST_CASE("thesis_report: CSV has a line a cell, what is not known left empty") {
    const std::string csv = thesis_csv(linear_run());
    CHECK_THAT(csv,
               Catch::StartsWith("scene,particles,cdt_ms,cdt_gpu_ms,cdt_recall,octree_ms,octree_gpu_ms,"
                                 "octree_recall,octree_over_cdt,thesis_cdt_ms,thesis_octree_ms,depth_ms,depth_gpu_ms,"
                                 "depth_over_cdt,cdt_answers,octree_answers,depth_answers\n"));
    CHECK_THAT(csv, Catch::Contains("\nbunny_b,50000,5,2.5,0.25,30,,0.9375,6,13,100,2,,0.4,0.5,0.75,0.375\n"));
    CHECK_THAT(csv, Catch::Contains("\nx_streams,200000,20,10,0.25,120,,0.9375,6,,,8,,0.4,0.5,0.75,0.375\n"));
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 21);
}

TEST_CASE("thesis_report: what was written as JSON is read back, what is wrong in it told") {
    const test::TemporaryFolder folder;
    ThesisRun run = linear_run();
    run.cells[3].cdt.recall = std::numeric_limits<double>::quiet_NaN();
    run.cells[4].octree.reset();
    run.cells[5].depth.reset();
    run.cells[6].depth->answers = std::numeric_limits<double>::quiet_NaN();
    for (ThesisCell& cell : run.cells)
        cell.cdt.fixed = 0.001;
    const auto file = folder.write("run.json", thesis_json(run).dump());
    const ThesisRun read = read_thesis_json(file);
    CHECK(thesis_csv(read) == thesis_csv(run));
    CHECK(thesis_text(read) == thesis_text(run));

    run.cells.pop_back();
    folder.write("run.json", thesis_json(run).dump());
    CHECK_THROWS_WITH(read_thesis_json(file),
                      Catch::Contains("/cells: scene x_streams has other particle counts than bunny_a"));
    folder.write("run.json", R"({"context": "made up", "cells": []})");
    CHECK_THROWS_WITH(read_thesis_json(file), Catch::Contains("/cells: no cells; a run has one at least"));
    nlohmann::json json = thesis_json(run);
    json["cells"][0]["cdt"]["recall"] = 2.0;
    folder.write("run.json", json.dump());
    CHECK_THROWS_WITH(read_thesis_json(file), Catch::Contains("/cells/0/cdt/recall: 2.0 is not a share from 0 to 1"));
}

TEST_CASE("thesis_report: the chart has both tables and both figures") {
    const std::string script = thesis_chart(linear_run(false));
    CHECK_THAT(script, Catch::Contains("Table 4-1") && Catch::Contains("Table 5-1") && Catch::Contains("Figure 5-3") &&
                           Catch::Contains("Figure 5-5") && Catch::Contains("\n50000 5 NaN 13.5 102\n"));
}

} // namespace lockstep::test::thesis_report_test
