#include <catch2/catch.hpp>

#include <array>
#include <cstdio>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/run_program.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::completion_test {

using Catch::Contains;
using lockstep::test::Outcome;
using lockstep::test::run_lockstep;
using lockstep::test::TemporaryFolder;

namespace {

std::string output_of(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string output;
    std::array<char, 4096> chunk{};
    while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), pipe))
        output.append(chunk.data(), count);
    CHECK(pclose(pipe) == 0);
    return output;
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// What bash offers for the last of `words`, which it has split as it does: also at an equals sign.
std::vector<std::string> offered(const std::string& words) {
    const TemporaryFolder folder;
    const auto script = folder.write("lockstep.bash", run_lockstep({"completion", "bash"}).out);
    return words_of(output_of("bash -c '. " + script.string() + "; COMP_WORDS=(" + words +
                              "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _lockstep 2>/dev/null; "
                              "echo \"${COMPREPLY[*]}\"'"));
}

using Words = std::vector<std::string>;

} // namespace

TEST_CASE("completion: verbs, options and values that are few") {
    CHECK(offered(R"(lockstep re)") == Words{"render", "record", "report"});
    CHECK(offered(R"(lockstep check --fra)") == Words{"--frames"});
    CHECK(offered(R"(lockstep check --mode "")") == Words{"resync", "free"});
    CHECK(offered(R"(lockstep check a.json --gl e)") == Words{"egl"});
    CHECK(offered(R"(lockstep completion "")") == Words{"-h", "--help", "bash", "zsh", "fish"});
    CHECK(offered(R"(lockstep capsule "")") == Words{"-h", "--help", "cut", "show"});
    CHECK(offered(R"(lockstep capsule c)") == Words{"cut"});
    CHECK(offered(R"(lockstep capsule cut --pix)") == Words{"--pixel"});
    CHECK(offered(R"(lockstep capsule cut a.json --legal g)") == Words{"glsl"});
    CHECK(offered(R"(lockstep study re)") == Words{"rest", "recall", "remedies"});
}

TEST_CASE("completion: switches and their values") {
    CHECK(offered(R"(lockstep check --set cdt_f)") == Words{"cdt_format="});
    CHECK(offered(R"(lockstep check --set cdt_format =)") == Words{"rgba32f", "rgba16f", "rgba8"});
    CHECK(offered(R"(lockstep check --set cdt_format = rgba1)") == Words{"rgba16f"});
}

TEST_CASE("completion: the rest is left to bash, which knows files") {
    CHECK(offered(R"(lockstep check "")").empty());
    CHECK(offered(R"(lockstep check --json "")").empty());
    CHECK(offered(R"(lockstep check --frames "")").empty());
}

TEST_CASE("completion: zsh and fish") {
    CHECK_THAT(run_lockstep({"completion", "zsh"}).out,
               Contains("bashcompinit\n") && Contains("complete -o bashdefault"));
    CHECK_THAT(run_lockstep({"completion", "fish"}).out,
               Contains("complete -c lockstep -n __fish_use_subcommand -f -a check -d ") &&
                   Contains("'__fish_seen_subcommand_from capsule' -f -a cut -d ") &&
                   Contains("'__fish_seen_subcommand_from check' -l mode -r -f -a 'resync free' -d "));
    const Outcome other = run_lockstep({"completion", "csh"});
    CHECK(other.status == 2);
    CHECK_THAT(other.err, Contains("'csh' is not one of bash, zsh, fish"));
    CHECK(run_lockstep({"completion"}).status == 2);
}

TEST_CASE("help: every verb has an example, and the manual page has every verb") {
    const Words verbs = offered(R"(lockstep "")");
    CHECK(verbs.size() > 12);
    const Outcome manual = run_lockstep({"manual"});
    CHECK(manual.status == 0);
    for (const std::string& verb : verbs) {
        if (verb.starts_with("--"))
            continue;
        CHECK_THAT(run_lockstep({verb, "--help"}).out, Contains("\nExample"));
        CHECK_THAT(manual.out, Contains(".SS lockstep " + verb + "\n"));
    }
    CHECK_THAT(manual.out, Contains(".SS lockstep capsule cut\n") && Contains(".SH ENVIRONMENT\n") &&
                               Contains(".SH FILES\n") && Contains(".SH EXAMPLES\n") && Contains("NO_COLOR"));
    CHECK_THAT(manual.out, Contains(".TP\n\\fB\\-\\-mode\\fR \\fIresync|free\\fR\n"));
}

} // namespace lockstep::test::completion_test
