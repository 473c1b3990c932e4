#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::thesis_page_test {

namespace {

std::string page() {
    std::ifstream stream("docs/thesis.md");
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// What the page runs, without `lockstep`: lines of commands up to their comment, and commands within a line.
std::set<std::string> commands() {
    const std::string begin = "lockstep ", text = page();
    std::set<std::string> all;
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
        const bool in_line = at > 0 && text[at - 1] == '`';
        const std::string command = text.substr(at, text.find_first_of(in_line ? "`" : "#\n", at) - at);
        all.insert(command.substr(begin.size()));
    }
    return all;
}

std::vector<std::string> words(const std::string& command) {
    std::istringstream split(command);
    return {std::istream_iterator<std::string>(split), {}};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The columns `at rest %` of what `study rest` printed.
std::vector<std::string> at_rest(const std::string& table) {
    std::vector<std::string> column;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        const std::vector<std::string> row = words(line);
        if (row.size() == 15 && row[1].find_first_not_of("0123456789") == std::string::npos)
            column.push_back(row[9]);
    }
    return column;
}

} // namespace

TEST_CASE("thesis page: its commands that need no mesh run as printed, and the heap's and the horn's give the numbers "
          "there") {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory_symlink(std::filesystem::current_path() / "data", folder.path() / "data");
    test::Surroundings surroundings;
    surroundings.folder = folder.path();
    const std::string text = page();
    int run = 0;
    std::size_t numbers = 0;
    for (const std::string& command : commands()) {
        if (has(command, "bunny") || has(command, "dragon") || has(command, "NAME=VALUE") || has(command, "OUT/"))
            continue;
        if (has(command, "--report")) // needs the page; tests/page runs what it shows
            continue;
        INFO(command);
        const test::Outcome outcome = test::run_lockstep(words(command), surroundings);
        CHECK(outcome.err.empty());
        CHECK(outcome.status == 0);
        ++run;
        std::vector<std::string> shares = at_rest(outcome.out);
        if (!shares.empty() && has(command, "study rest data/scenes/thesis/plane_pile.json --frames 1200 --every 300"))
            shares.erase(shares.begin(), shares.end() - 1); // the page has the heap that stays
        else if (!has(command, "study rest data/scenes/thesis/horn.json"))
            continue;
        for (const std::string& share : shares) {
            CHECK(has(text, "| " + share + " |"));
            ++numbers;
        }
    }
    CHECK(run >= 10);
    CHECK(numbers == 12);
}

} // namespace lockstep::test::thesis_page_test
