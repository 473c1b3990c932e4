#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::arguments_test {

using test::refusal;
using test::run_lockstep;

namespace {

const std::string scene = "data/scenes/lattice.json";
const std::string help = " (lockstep --help says more)";

/// What stands behind a misuse of a verb.
std::string help_of(const std::string& verb) { return " (lockstep " + verb + " --help says more)"; }

struct Refused {
    std::vector<std::string> arguments;
    std::string message;
};

void check_all(const std::vector<Refused>& cases) {
    for (const Refused& refused : cases) {
        CAPTURE(refused.arguments);
        CHECK(refusal(run_lockstep(refused.arguments)) == refused.message);
    }
}

} // namespace

TEST_CASE("arguments: an unknown verb, or none, is told with the verbs") {
    const std::string verbs = "; the verbs are check, explain, debug, render, hash, info, ";
    CHECK_THAT(refusal(run_lockstep({})), Catch::StartsWith("a verb is missing" + verbs) && Catch::EndsWith(help));
    CHECK_THAT(refusal(run_lockstep({"chekc", scene})),
               Catch::StartsWith("unknown verb 'chekc'" + verbs) && Catch::EndsWith(help));
    CHECK(refusal(run_lockstep({"--frames", "3"})) == "unknown option '--frames'" + help);
}

TEST_CASE("arguments: a slip is told with what was meant; another word is not") {
    const auto says = [](const std::vector<std::string>& arguments) { return refusal(run_lockstep(arguments)); };
    CHECK_THAT(says({"chekc", scene}), Catch::EndsWith("; did you mean check?" + help));
    CHECK_THAT(says({"recrd", scene}), Catch::EndsWith("; did you mean record?" + help));
    CHECK_THAT(says({"frobnicate"}), Catch::EndsWith(", manual" + help));
    CHECK(says({"capsule", "shw"}) ==
          "unknown verb 'shw'; the verbs of capsule are cut, show; did you mean show?" + help_of("capsule"));
    CHECK(says({"new", "sistem"}) ==
          "unknown verb 'sistem'; the verbs of new are system, check; did you mean system?" + help_of("new"));
    CHECK(says({"capsule"}) == "a verb is missing; the verbs of capsule are cut, show" + help_of("capsule"));
    CHECK(says({"check", scene, "--freams=3"}) ==
          "unknown option '--freams=3'; did you mean --frames?" + help_of("check"));
    CHECK(says({"check", scene, "-x"}) == "unknown option '-x'" + help_of("check"));
    CHECK(says({"check", "data/scenes/latice.json"}) ==
          "data/scenes/latice.json: cannot be read: No such file or directory; did you mean data/scenes/lattice.json?");
    CHECK(says({"hash", "lattice"}) ==
          "lattice: cannot be read: No such file or directory; did you mean data/scenes/lattice.json?");
    CHECK(says({"hash", "nothing_like_it.json"}) == "nothing_like_it.json: cannot be read: No such file or directory");
    const test::TemporaryFolder folder;
    const std::string link = (folder.path() / "link.json").string();
    std::filesystem::create_symlink("nowhere.json", link);
    CHECK(says({"hash", link}) == link + ": a link to nowhere.json: cannot be read: No such file or directory");
    CHECK_THAT(says({"check", scene, "--set", "base_texle=floor"}), Catch::EndsWith("; did you mean base_texel?"));
    CHECK_THAT(says({"check", scene, "--set", "tik=1"}), Catch::EndsWith("; did you mean tick?"));
}

TEST_CASE("arguments: the version is printed") {
    const test::Outcome outcome = run_lockstep({"--version"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out, Catch::Matches("lockstep [0-9]+[.][0-9]+[.][0-9]+\n"));
}

TEST_CASE("arguments: an unknown option, or a missing one, is named") {
    check_all({
        {{"check", scene, "--particle", "3"},
         "unknown option '--particle'; did you mean --particles?" + help_of("check")},
        {{"--frames", "3", "check", scene},
         "option '--frames' stands before the verb; right is lockstep check --frames ..." + help_of("check")},
        {{"check"}, "check: a scene or --trace FILE is needed"},
        {{"debug"}, "debug: a scene or --trace FILE is needed"},
        {{"report"},
         "FILE is missing: what `lockstep record` wrote, or an engine of your own (docs/traces.md)" +
             help_of("report")},
        {{"explain", "--frame", "3"}, "explain: one of --particle I, --texel X,Y and --pixel X,Y is needed"},
        {{"explain", scene, "--frame", "3", "--particle", "1", "--texel", "2,2"},
         "explain: --particle, --texel and --pixel do not go together; right is one of them"},
        {{"explain", "--frame", "3", "--particle", "1"}, "explain: a scene or --trace FILE is needed"},
        {{"render", scene}, "--output FILE is missing: PNG file to write" + help_of("render")},
        {{"render", scene, "-o", "x.JPG"},
         "--output x.JPG: a picture is written as PNG; right is a name that ends in .png"},
        {{"check", scene, "--frames"}, "--frames needs a value" + help_of("check")},
        {{"check", scene, "--frames", "2", "--frames", "3"}, "--frames is given more than once" + help_of("check")},
        {{"check", scene, scene}, "'" + scene + "' is one argument too many" + help_of("check")},
        {{"hash", scene, "--", "--frames", "3"},
         "'--frames' is one argument too many; behind -- nothing is an option" + help_of("hash")},
        {{"hash", scene, "--set", "--frames", "3"},
         "--set needs a value, and '--frames' is an option" + help_of("hash")},
    });
}

TEST_CASE("arguments: a flag takes no value") {
    check_all({
        {{"hash", scene, "--every=false"}, "--every takes no value; '--every=false' gives it one" + help_of("hash")},
        {{"hash", scene, "--every=true"}, "--every takes no value; '--every=true' gives it one" + help_of("hash")},
        {{"hash", scene, "--every=10"}, "--every takes no value; '--every=10' gives it one" + help_of("hash")},
        {{"hash", scene, "--every="}, "--every takes no value; '--every=' gives it one" + help_of("hash")},
        {{"check", scene, "--quiet=no"}, "--quiet takes no value; '--quiet=no' gives it one" + help_of("check")},
    });
}

TEST_CASE("arguments: a name that is set twice is refused") {
    check_all({
        {{"hash", scene, "--set", "tick=0.01", "--set", "base_texel=floor", "--set", "tick=0.02"},
         "--set: tick is given more than once" + help_of("hash")},
        {{"bench", scene, "--counts", "50,60,50"}, "--counts: '50' is given more than once" + help_of("bench")},
    });
}

TEST_CASE("arguments: what stands before a part of a verb is refused, with where it belongs") {
    check_all({
        {{"study", scene, "rest"},
         "'" + scene + "' stands before the verb; right is lockstep study rest " + scene + help_of("study rest")},
        {{"study", scene, "rest", scene},
         "'" + scene + "' stands before the verb; right is lockstep study rest " + scene + help_of("study rest")},
        {{"study", "--every", "2", "rest", scene},
         "option '--every' stands before the verb; right is lockstep study rest --every ..." + help_of("study rest")},
        {{"study", "--csv", "a", "rest", scene}, "--csv does not go with the verb rest" + help_of("study rest")},
    });
    CHECK_THAT(run_lockstep({"study", "--help"}).out,
               Catch::Contains("\nUsage: lockstep study [OPTIONS] [SCENE]\n       lockstep study VERB ...\n"));
}

TEST_CASE("arguments: a number that is none, or out of range, is told with the range") {
    check_all({
        {{"check", scene, "--particles", "0"},
         "--particles: '0' is not an integer from 1 to 100000000" + help_of("check")},
        {{"check", scene, "--particles", "-5"},
         "--particles: '-5' is not an integer from 1 to 100000000" + help_of("check")},
        {{"check", scene, "--particles", "1e3"},
         "--particles: '1e3' is not an integer from 1 to 100000000" + help_of("check")},
        {{"hash", scene, "--particles", "100000001"},
         "--particles: '100000001' is not an integer from 1 to 100000000" + help_of("hash")},
        {{"check", scene, "--frames", "0"}, "--frames: '0' is not an integer from 1 to 100000000" + help_of("check")},
        {{"check", scene, "--frames", "99999999999999999999"},
         "--frames: '99999999999999999999' is not an integer from 1 to 100000000" + help_of("check")},
        {{"hash", scene, "--frames", "-1"}, "--frames: '-1' is not an integer from 1 to 100000000" + help_of("hash")},
        {{"render", scene, "-o", "x.png", "--frame", "-1"},
         "--frame: '-1' is not an integer from 0 to 100000000" + help_of("render")},
        {{"check", scene, "--threads", "-2"}, "--threads: '-2' is not an integer from 0 to 1024" + help_of("check")},
        {{"bench", scene, "--counts", "10,0"},
         "--counts: '0' is not an integer from 1 to 100000000" + help_of("bench")},
        {{"bench", scene, "--counts", "5,"}, "--counts: '5,' lacks a value; right is N,..." + help_of("bench")},
        {{"bench", scene, "--counts", "5,,6"}, "--counts: '5,,6' lacks a value; right is N,..." + help_of("bench")},
        {{"bench", scene, "--radius", "65"}, "--radius: '65' is not an integer from 0 to 64" + help_of("bench")},
    });
}

TEST_CASE("arguments: a number with zeros before it is the same number") {
    CHECK(run_lockstep({"hash", scene, "--frames", "010"}).out == run_lockstep({"hash", scene, "--frames", "10"}).out);
    CHECK(run_lockstep({"hash", scene, "--frames", "08"}).status == 0);
}

TEST_CASE("arguments: a file without a name is refused, wherever one can be given") {
    const std::string no_file = "'' names no file", no_folder = "'' names no folder";
    check_all({
        {{"check", scene, "--json", ""}, "--json: " + no_file + help_of("check")},
        {{"check", scene, "--hashes", ""}, "--hashes: " + no_file + help_of("check")},
        {{"check", scene, "--images", ""}, "--images: " + no_folder + help_of("check")},
        {{"check", scene, "--report", ""}, "--report: " + no_folder + help_of("check")},
        {{"check", scene, "--shaders", ""}, "--shaders: " + no_folder + help_of("check")},
        {{"check", "--trace", ""}, "--trace: " + no_file + help_of("check")},
        {{"check", ""}, "scene: " + no_file + help_of("check")},
        {{"record", scene, "-o", ""}, "--output: " + no_file + help_of("record")},
        {{"study", scene, "--csv", ""}, "--csv: " + no_file + help_of("study")},
        {{"capsule", "show", ""}, "capsule: " + no_file + help_of("capsule show")},
    });
}

TEST_CASE("arguments: an option that the side or the verb would ignore is refused") {
    check_all({
        {{"render", scene, "-o", "x.png", "--gl", test::software_gl()}, "render: --gl goes with --side gpu"},
        {{"hash", scene, "--gl", test::software_gl()}, "hash: --gl goes with --side gpu"},
        {{"hash", scene, "--side", "gpu", "--profile", "strict"}, "hash: --profile goes with --side cpu"},
        {{"hash", scene, "--frames", "2..3", "--lead-in", "step"},
         "hash: --lead-in goes with --side gpu and --frames A..B"},
        {{"hash", scene, "--side", "gpu", "--lead-in", "step"},
         "hash: --lead-in goes with --side gpu and --frames A..B"},
        {{"hash", scene, "--side", "gpu", "--frames", "2..3", "--lead-in", "step"},
         "hash: --lead-in goes with a scene that names its \"system\"; a collision frame needs all of the one before"},
        {{"render", scene, "-o", "x.png", "--shaders", "."}, "render: --shaders goes with --side gpu"},
        {{"render", scene, "-o", "x.png", "--side", "gpu", "--profile", "nvidia"},
         "render: --profile goes with --side cpu"},
        {{"check", scene, "--render", "--no-render"},
         "check: --render does not go with --no-render; right is one of them"},
        {{"check", scene, "--mode", "free", "--legal", "glsl"},
         "check: --legal does not go with --mode free, which judges nothing; right is --mode resync"},
        {{"bench", scene, "--gl-only", "--require-hits"},
         "bench: --require-hits does not go with --gl-only, which judges nothing"},
        {{"bench", scene, "--gl-only", "--power-at-least", "100%"},
         "bench: --power-at-least does not go with --gl-only, which judges nothing"},
        {{"bench", scene, "--gl-only", "--legal", "glsl"},
         "bench: --legal does not go with --gl-only, which judges nothing"},
        {{"bench", scene, "--particles", "3", "--counts", "5"},
         "bench: --particles N and --counts N mean the same; right is one of them"},
    });
}

TEST_CASE("arguments: a stack too small to run in is told in one line") {
    const test::Outcome outcome = run_lockstep({"info"}, {.stack = std::size_t{64} << 10U});
    CHECK(test::refusal(outcome) ==
          "the stack is limited to 64 KiB (ulimit -s), too little to run in; 256 KiB and more are enough");
}

TEST_CASE("arguments: threads that cannot be started are no verdict; the reference runs on fewer") {
    const auto run = [](const char* name, const char* value) {
        test::Surroundings surroundings;
        surroundings.environment = {{name, value}};
        return run_lockstep({"hash", scene, "--frames", "2", "--particles", "3000"}, surroundings);
    };
    const test::Outcome right = run("OMP_NUM_THREADS", "1");
    for (const auto& [name, value] :
         {std::pair{"OMP_STACKSIZE", "4000000000000"}, std::pair{"OMP_NUM_THREADS", "100000"}}) {
        CAPTURE(name);
        const test::Outcome outcome = run(name, value);
        CHECK(outcome.status == 0);
        CHECK(outcome.out == right.out);
    }
}

TEST_CASE("arguments: an unknown choice is told with the choices") {
    check_all({
        {{"check", scene, "--mode", "fre"},
         "--mode: 'fre' is not one of resync, free; did you mean free?" + help_of("check")},
        {{"render", scene, "-o", "x.png", "--side", "tpu"},
         "--side: 'tpu' is not one of cpu, gpu; did you mean cpu?" + help_of("render")},
        {{"check", scene, "--preset", "correct"},
         "--preset: 'correct' is not one of listing, paper, corrected, exact; did you mean corrected?" +
             help_of("check")},
        {{"hash", scene, "--profile", "amd"},
         "--profile: 'amd' is not one of strict, llvmpipe, nvidia" + help_of("hash")},
        {{"study", scene, "--profile", "nvidai"},
         "--profile: 'nvidai' is not one of strict, llvmpipe, nvidia; did you mean nvidia?" + help_of("study")},
        {{"check", scene, "--gl", "glx"},
         "unknown GL context 'glx'; allowed are auto, osmesa, egl, egl-device:N (N = 0, 1, ...)"},
    });
}

TEST_CASE("arguments: a setting that cannot be is told with what can") {
    check_all({
        {{"check", scene, "--set", "base_texel=up"}, "switch base_texel: 'up' is not one of truncate, floor"},
        {{"check", scene, "--set", "speed_factor=nan"}, "switch speed_factor: 'nan' is not a finite number"},
        {{"check", scene, "--set", "tick=nan"}, "--set: tick: \"nan\" is not a number above 0"},
        {{"check", scene, "--set", "gravity=0,nan,0"},
         "--set: gravity: \"0,nan,0\" is not a vector of three finite numbers, [x, y, z]"},
        {{"check", scene, "--set", "texel_collide_range=-1"},
         "--set: texel_collide_range: -1 is not an integer from 0 to 64"},
        {{"check", scene, "--set", "tick"}, "--set tick: a setting is name=value"},
        {{"check", scene, "--set", "=floor"}, "--set =floor: a setting is name=value"},
    });
    CHECK_THAT(refusal(run_lockstep({"check", scene, "--set", "base_texle=floor"})),
               Catch::StartsWith("--set base_texle=floor: nothing is named 'base_texle'; the switches are ") &&
                   Catch::Contains(", base_texel, ") && Catch::Contains("; the constants are tick, "));
    CHECK_THAT(refusal(run_lockstep({"check", scene, "--set", "base_texel =floor"})),
               Catch::Contains("nothing is named 'base_texel '; ") && Catch::EndsWith("; did you mean base_texel?"));
}

TEST_CASE("arguments: the command that repeats a run names a file that begins with a dash so that it is none") {
    if (!test::have_software_gl())
        return;
    const test::TemporaryFolder folder;
    folder.write("-a b.json", test::small_scene);
    test::Surroundings there;
    there.folder = folder.path();
    const auto outcome = run_lockstep(
        {"check", "--gl", test::software_gl(), "--frames", "2", "--json", "r.json", "--", "-a b.json"}, there);
    CHECK(outcome.status == 0);
    std::ifstream stream(folder.path() / "r.json");
    const std::string report(std::istreambuf_iterator<char>(stream), {});
    CHECK_THAT(report, Catch::Contains("lockstep check './-a b.json' --frames 2"));
}

TEST_CASE("arguments: help ends with 0, and every verb has its own") {
    for (const char* verb : {"", "check", "render", "hash", "info", "bench", "probe"}) {
        std::vector<std::string> arguments{"--help"};
        if (*verb != '\0')
            arguments.insert(arguments.begin(), verb);
        const test::Outcome outcome = run_lockstep(arguments);
        CAPTURE(verb);
        CHECK(outcome.status == 0);
        CHECK_THAT(outcome.out,
                   Catch::Contains(fmt::format("\nUsage: lockstep{}{} [OPTIONS]", *verb ? " " : "", verb)));
        CHECK(outcome.err.empty());
    }
}

TEST_CASE("arguments: help keeps to 80 columns, and says what holds without an option") {
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{},
                                                                                       {"check"},
                                                                                       {"study"},
                                                                                       {"study", "thesis"},
                                                                                       {"bench"},
                                                                                       {"capsule", "cut"},
                                                                                       {"function"},
                                                                                       {"new", "system"}}) {
        std::vector<std::string> arguments = words;
        arguments.emplace_back("--help");
        std::istringstream help_lines(run_lockstep(arguments).out);
        for (std::string line; std::getline(help_lines, line);) {
            CAPTURE(line);
            CHECK(line.size() <= 80);
        }
    }
    const std::string check = run_lockstep({"check", "--help"}).out;
    CHECK_THAT(check, Catch::Contains("(default: resync)") && Catch::Contains("(default: auto)") &&
                          Catch::Contains("\nArguments:\n  SCENE "));
    CHECK_THAT(run_lockstep({"explain", "--help"}).out, Catch::Contains("counted from 0 (required)"));
    CHECK_THAT(run_lockstep({"hash", "--help"}).out, Catch::Contains("with --side gpu and --frames A..B"));
    CHECK_THAT(run_lockstep({"study", "--help"}).out,
               Catch::Contains("\n  thesis ") && !Catch::Contains("--recall-table"));
}

TEST_CASE("arguments: a new system takes no name that its project cannot have") {
    const test::TemporaryFolder folder;
    const auto refused = [&](const std::string& name) {
        const std::string made = (folder.path() / "made").string();
        const std::string error = refusal(run_lockstep({"new", "system", name, "-o", made}));
        CHECK(!std::filesystem::exists(made));
        return error;
    };
    for (const char* const name : {"preinstall", "all", "test", "install", "clean", "help", "edit_cache", "package",
                                   "rebuild_cache", "depend", "list_install_components", "package_source"})
        CHECK_THAT(refused(name), Catch::Contains("CMake has a target of that name; expected another, as " +
                                                  std::string(name) + "_system"));
    for (const char* const name : {"int", "class", "std", "co_await", "char8_t", "main"})
        CHECK_THAT(refused(name), Catch::Contains("it is a word of C++; expected another"));
    for (const char* const name : {"lockstep", "dust", "collision", "graph"})
        CHECK_THAT(refused(name), Catch::Contains("lockstep has shaders of that name; expected another, as my_"));
    for (const char* const name : {"Sparks", "2d", "heat-map", "", "a/b"})
        CHECK_THAT(refused(name), Catch::Contains("expected a word of at most 40 small letters"));
    CHECK(run_lockstep({"new", "system", "tests", "-o", folder.path() / "made"}).status == 0);
}

TEST_CASE("arguments: a full disk behind standard output is no success") {
    test::Surroundings full;
    full.standard_output = "/dev/full";
    const test::Outcome outcome = run_lockstep({"hash", scene, "--frames", "1", "--particles", "10"}, full);
    CHECK(refusal(outcome) == "standard output: cannot be written: No space left on device");
}

TEST_CASE("arguments: the program starts itself once more for threads that sleep, unless a policy is set") {
    const auto starts = [](const std::vector<std::pair<std::string, std::string>>& environment) {
        test::Surroundings surroundings;
        surroundings.environment = environment;
        surroundings.environment.emplace_back("OMP_DISPLAY_ENV", "true");
        const std::string shown = run_lockstep({"--help"}, surroundings).err;
        std::size_t count = 0;
        for (std::size_t at = 0; (at = shown.find("ENVIRONMENT BEGIN", at)) != std::string::npos; ++at)
            ++count;
        return count;
    };
    CHECK(starts({}) == (std::getenv("OMP_WAIT_POLICY") == nullptr ? 2U : 1U));
    CHECK(starts({{"OMP_WAIT_POLICY", "active"}}) == 1);
}

#ifndef __SANITIZE_ADDRESS__ // which needs more address space than there is memory
TEST_CASE("arguments: more particles than fit into memory are refused in one line") {
    test::Surroundings small;
    small.memory = std::size_t{1} << 30U;
    CHECK(refusal(run_lockstep({"hash", scene, "--particles", "100000000"}, small)) ==
          "not enough memory; memory is limited to 1048576 KiB (ulimit -v)");
}
#endif

} // namespace lockstep::test::arguments_test
