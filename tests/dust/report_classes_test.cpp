#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/judge/untried.hpp"
#include "tests/dust/rooms.hpp"
#include "tests/system_reports.hpp"
#include "tests/uneven_roots.hpp"

namespace lockstep::test::report_classes_test {

namespace dust = lockstep::dust;

namespace {

dust::Settings small_room() {
    dust::Settings s = room(false);
    s.count = 400;
    return s;
}

/// A GPU whose passes ran over nothing that it knows of.
class EmptySide final : public TwinSide {
  public:
    using TwinSide::TwinSide;
    [[nodiscard]] std::optional<std::uint64_t> ran_over() const override { return std::uint64_t{0}; }
};

} // namespace

TEST_CASE("dust report: one item of each buffer and class, in text, JSON, JUnit and page") {
    const System system = dust::system(host_of(small_room()));
    const auto counts = check_planted_items(system, named_profile("strict"));
    CHECK(counts[static_cast<std::size_t>(DifferenceClass::rounding)] > 0);
    CHECK(counts[static_cast<std::size_t>(DifferenceClass::divergent)] > 0);
}

TEST_CASE("dust report: a driver with uneven roots is legal, and each line is of its own buffer") {
    const System system = dust::system(host_of(small_room()));
    check_whole_reports(system, profile_with_roots());
}

TEST_CASE("dust report: no effect is what the GPU left as it was, not what the reference did") {
    const System system = dust::system(host_of(small_room()));
    const Profile strict = named_profile("strict");
    std::size_t moved = 0;
    while (system.passes[moved]->derived() || !system.passes[moved]->runs(0))
        ++moved;
    const std::string name(system.passes[moved]->name());
    const std::uint8_t r = system.passes[moved]->resource();
    CheckOptions options;
    options.frames = 1;
    options.power = false;
    const auto without_effect = [&](const TwinSide::Plant& plant) {
        TwinSide gpu(system, strict, strict, plant);
        return check(system, gpu, options).without_effect;
    };
    const auto has = [&](const std::vector<std::string>& passes) {
        return std::find(passes.begin(), passes.end(), name) != passes.end();
    };
    CHECK_FALSE(has(without_effect({})));
    CHECK(has(without_effect([&](std::size_t p, int, SystemState& state) {
        if (p == moved)
            state.take(r, system.start);
    })));
    // The other way round: a reference that changes nothing says nothing of a GPU that does.
    UntriedParts parts;
    const View start = system.start[r];
    SystemState other = system.start;
    other.set(FieldId{r, 0}, 0, 1234.5F);
    const View changed = std::as_const(other)[r];
    parts.note(*system.passes[moved], {start, start}, {start, changed});
    CHECK(parts.without_effect().empty());
    UntriedParts idle;
    idle.note(*system.passes[moved], {start, changed}, {start, start});
    CheckReport report;
    report.schema = system.schema;
    CHECK_THAT(idle.texts(report), Catch::VectorContains(name + " changed nothing on the GPU, where the reference "
                                                                "changed 1 grain"));
}

TEST_CASE("dust report: a pass over no invocations is not exercised, though it ran") {
    const System system = dust::system(host_of(small_room()));
    const Profile strict = named_profile("strict");
    EmptySide empty(system, strict, strict);
    CheckOptions options;
    options.frames = 1;
    options.power = false;
    const CheckReport report = check(system, empty, options);
    CHECK(report.verdict == Verdict::agree);
    CHECK_THAT(report_text(report, {"room", "", "", "", "resync", "", ""}), Catch::Contains(" ran over 0 invocations"));
}

} // namespace lockstep::test::report_classes_test
