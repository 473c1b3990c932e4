#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "tests/skip.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::python_example_test {

namespace {

const std::string example = "data/examples/write_trace.py";

bool have_h5py() {
    if (std::system("/usr/bin/python3 -c 'import h5py, numpy' 2>/dev/null") == 0)
        return true;
    test::skip("no h5py: install python3-h5py");
    return false;
}

CheckReport check_written_by(const std::filesystem::path& script) {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    REQUIRE(std::system(("/usr/bin/python3 " + script.string() + " " + file.string()).c_str()) == 0);
    CHECK(TraceReader(file).info().warnings.empty());
    return test::check_trace(file);
}

} // namespace

TEST_CASE("python example: what 40 lines of numpy and h5py write agrees with the reference in every bit") {
    const std::string script = test::bytes_of(example);
    CHECK(std::count(script.begin(), script.end(), '\n') <= 40);
    if (!have_h5py())
        return;
    const CheckReport report = check_written_by(example);
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.frames == 60);
    CHECK(report.particles == 20);
}

TEST_CASE("python example: a mistake in it is divergent") {
    if (!have_h5py())
        return;
    std::string script = test::bytes_of(example);
    const std::string sum = "gravity * tick";
    REQUIRE(script.find(sum) != std::string::npos);
    script.replace(script.find(sum), sum.size(), "gravity * tick * f32(1.01)");
    const test::TemporaryFolder folder;
    const CheckReport report = check_written_by(folder.write("mistaken.py", script));
    CHECK(report.verdict == Verdict::divergent);
    CHECK(report.first_frame == 0);
}

} // namespace lockstep::test::python_example_test
