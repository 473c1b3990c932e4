#include "tests/fluid/fluid_run.hpp"
#include "tests/system_reports.hpp"
#include "tests/uneven_roots.hpp"

namespace lockstep::test::report_classes_test {

namespace fluid = lockstep::fluid;

namespace {

fluid::Settings small_heap() {
    fluid::Settings s = in_preset(heap(4), "paper");
    s.width = 20;
    s.height = 16;
    s.filter_radius = 2;
    s.flow_iterations = 1;
    return s;
}

} // namespace

TEST_CASE("fluid report: one item of each image and class, in text, JSON, JUnit and page") {
    const System system = fluid::system(host_of(small_heap()));
    const auto counts = check_planted_items(system, named_profile("strict"));
    CHECK(counts[static_cast<std::size_t>(DifferenceClass::rounding)] > 3);
    CHECK(counts[static_cast<std::size_t>(DifferenceClass::divergent)] > 3);
}

TEST_CASE("fluid report: a driver with uneven roots is legal, and each line is of its own image") {
    const System system = fluid::system(host_of(small_heap()));
    check_whole_reports(system, profile_with_roots());
}

} // namespace lockstep::test::report_classes_test
