#include <catch2/catch.hpp>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"

namespace lockstep::test::own_shader_page_test {

using test::run_lockstep;

namespace {

/// The page's command lines of one verb on the example that starts from the thesis's listing, without `lockstep`.
/// A line that ends with a backslash goes on in the next.
std::vector<std::vector<std::string>> commands_on_listing(const std::string& verb) {
    std::ifstream stream("docs/own_shader.md");
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (std::size_t end = text.find("\\\n"); end != std::string::npos; end = text.find("\\\n"))
        text[end] = text[end + 1] = ' ';
    std::istringstream lines(text);
    std::vector<std::vector<std::string>> commands;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::vector<std::string> command{std::istream_iterator<std::string>(words), {}};
        if (command.size() < 2 || command[0] != "lockstep" || command[1] != verb ||
            line.find("data/examples/thesis_listing") == std::string::npos)
            continue;
        command.erase(command.begin());
        commands.push_back(command);
    }
    return commands;
}

} // namespace

TEST_CASE("own shader page: the example that starts from the thesis's listing agrees in every bit") {
    if (!test::have_software_gl())
        return;
    const auto commands = commands_on_listing("check");
    REQUIRE(commands.size() == 1);
    const test::Outcome outcome = run_lockstep(commands[0]);
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains("verdict   AGREE: every bit of "));
}

TEST_CASE("pages: how many mistakes would have shown, as the line power says") {
    if (!test::have_software_gl())
        return;
    const auto page = [](const char* file) {
        std::ifstream stream(file);
        return std::string{std::istreambuf_iterator<char>(stream), {}};
    };
    const test::Outcome outcome = run_lockstep(
        {"check", "data/scenes/stress/borders.json", "--frames", "60", "--gl", test::software_gl(), "--no-render"});
    unsigned shown = 0, all = 0;
    const std::size_t power = outcome.out.find("\npower ");
    REQUIRE(power != std::string::npos);
    REQUIRE(std::sscanf(outcome.out.c_str() + power, " power %u of %u", &shown, &all) == 2);
    CHECK_THAT(page("docs/unit_tests.md"),
               Catch::Contains(std::to_string(shown) + " of the " + std::to_string(all) + " mistakes"));
    CHECK_THAT(page("README.md"),
               Catch::Contains(" of " + std::to_string(all) + " mistakes with names would have shown"));
}

TEST_CASE("own shader page: explain shows the example's own output") {
    if (!test::have_software_gl())
        return;
    const auto commands = commands_on_listing("explain");
    REQUIRE(commands.size() == 1);
    const test::Outcome outcome = run_lockstep(commands[0]);
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Catch::Contains("  trace_particle_min_length ") && Catch::Contains("every bit agrees"));
}

} // namespace lockstep::test::own_shader_page_test
