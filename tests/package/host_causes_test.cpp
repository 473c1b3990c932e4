#include <fstream>
#include <string>
#include <tuple>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "tests/system_run.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::host_causes_test {

using lockstep::test::run_system;
using lockstep::test::TemporaryFolder;

/// Cells that grow and age, in two copies: what a host, or a store, does wrongly with items is told from wrong
/// formulas.
namespace {

namespace site {
inline constexpr Site size{"size", "size"}, age{"age", "age"}, size_before{"size before"}, age_before{"age before"};
} // namespace site

const Schema& schema() {
    static const Schema all = checked(
        {"cells",
         {{.name = "cells", .item = "cell", .title = "the cells", .fields = {{.name = "size"}, {.name = "age"}}}}});
    return all;
}

struct Grow {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        struct Cell {
            typename R::Real size, age;
            auto fields() const { return std::tie(size, age); }
        };
        const auto size = r.read(site::size_before, in.before.real({0, 0}, item));
        const auto age = r.read(site::age_before, in.before.real({0, 1}, item));
        return Cell{r.note(site::size, size + 0.25F), r.note(site::age, age + 1.0F)};
    }
};

/// The name of the cause where cells of `count` are stored by `store`, which may use `cell`, the number `i`, what was
/// `before[i]` and the `frame`.
std::string cause(std::size_t count, const std::string& store) {
    System system{.name = "cells",
                  .schema = schema(),
                  .passes = {},
                  .mistakes = {},
                  .start = {schema(), {{count}}},
                  .settings = {}};
    system.passes.push_back(item_pass({.name = "grow", .stage = PassStage::compute}, Grow{}));
    for (std::size_t i = 0; i < count; ++i) {
        system.start.set({0, 0}, i, static_cast<float>(i) * 0.5F);
        system.start.set({0, 1}, i, static_cast<float>(i % 7) * 3.0F + 100.0F);
    }
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "grow.comp") << "#version 430 core\n"
                                                  "layout(local_size_x = 64) in;\n"
                                                  "struct Cell { float size, age; };\n"
                                                  "layout(std430) readonly buffer CellsBefore { Cell before[]; };\n"
                                                  "layout(std430) buffer CellsAfter { Cell after[]; };\n"
                                                  "uniform uint u_ItemCount;\n"
                                                  "uniform int frame;\n"
                                                  "void main() {\n"
                                                  "    uint i = gl_GlobalInvocationID.x;\n"
                                                  "    if (i >= u_ItemCount)\n"
                                                  "        return;\n"
                                                  "    Cell cell = Cell(before[i].size + 0.25, before[i].age + 1.0);\n"
                                               << store << "}\n";
    GlPass grow{.name = "grow", .stage = Stage::compute};
    grow.uniforms = [](int frame) { return Uniforms{{"frame", frame}}; };
    const CheckReport report =
        run_system(system, {grow}, folder.path().string(), ArithmeticSwitch::plain, 8, CheckMode::resync);
    INFO(report_text(report, {}));
    REQUIRE(report.verdict == Verdict::divergent);
    std::string all;
    for (const Cause& one : report.verdicts->causes[0].best)
        all += (all.empty() ? "" : ", ") + one.name();
    return all;
}

} // namespace

TEST_CASE("host causes: items that are not written are told from items that are written as they were") {
    if (!test::gl())
        return skip(test::gl().missing());
    const std::string right = "    if (frame < 3 || i % 3u != 0u) after[i] = cell;\n";
    CHECK(cause(600, right) == "items_not_written");
    CHECK_THAT(cause(600, right + "    else after[i] = before[i];\n"), !Catch::Contains("not_written"));
}

TEST_CASE("host causes: a field that is not written is told from one that is written as it was") {
    if (!test::gl())
        return skip(test::gl().missing());
    const std::string right =
        "    after[i].size = cell.size;\n    if (frame < 3 || i % 3u != 0u) after[i].age = cell.age;\n";
    CHECK(cause(600, right) == "age_not_written");
    CHECK_THAT(cause(600, right + "    else after[i].age = before[i].age;\n"), !Catch::Contains("not_written"));
}

TEST_CASE("host causes: fields that are swapped are a cause where enough items show it") {
    if (!test::gl())
        return skip(test::gl().missing());
    const std::string swapped = "    after[i] = Cell(cell.age, cell.size);\n";
    CHECK_THAT(cause(600, swapped), Catch::Contains("size_and_age_swapped"));
    CHECK_THAT(cause(7, "    after[i] = frame == 5 ? Cell(cell.age, cell.size) : cell;\n"),
               !Catch::Contains("swapped"));
}

} // namespace lockstep::test::host_causes_test
