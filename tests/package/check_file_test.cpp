#include <filesystem>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>

#include "lockstep/check_file.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/skip.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::check_file_test {

TEST_CASE("own system by a check file: passes, and fails with a reference that does something else") {
    const Gl gl(test::software_gl());
    if (!gl)
        return skip(gl.missing());
    const std::string file = "data/checks/scan/scan.json";
    const MatchResult right = match_check_file(gl, file, {.frames = 2});
    INFO(right.text());
    CHECK(right.passed());
    const TemporaryFolder folder;
    for (const char* shader : {"scan.comp", "add.comp"}) {
        std::ifstream stream(std::filesystem::path("data/checks/scan/reference") / shader);
        std::string text{std::istreambuf_iterator<char>(stream), {}};
        if (const std::size_t at = text.find("sum += values[k]"); at != std::string::npos)
            text.replace(at, 16, "sum -= values[k]");
        folder.write(shader, text);
    }
    const MatchResult wrong = match_check_file(gl, file, {.frames = 2, .reference = folder.path().string()});
    CHECK_FALSE(wrong.passed());
    CHECK_THAT(wrong.text(), Catch::Contains("DIVERGENT from frame 0 on") &&
                                 Catch::Contains("lockstep check data/checks/scan/scan.json"));
    CHECK_THROWS_WITH(match_check_file(gl, "data/graphs/README.md"), Catch::Contains("data/graphs/README.md"));
    CHECK_THROWS_WITH(match_check_file(gl, "none.json"), Catch::Contains("none.json"));
}

} // namespace lockstep::test::check_file_test
