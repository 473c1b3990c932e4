#include <catch2/catch.hpp>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::signals_test {

namespace fs = std::filesystem;

namespace {

struct Setting {
    test::TemporaryFolder input, output;
    std::string scene = input.write("scene.json", test::small_scene).string();

    /// Runs until there are so many files, then ends it.
    void ends_by(int signal, std::vector<std::string> arguments, int files) const {
        arguments.insert(arguments.begin() + 1, scene);
        const auto ready = [&] {
            int count = 0;
            std::error_code error;
            for (const auto& entry : fs::recursive_directory_iterator(output.path(), error))
                count += entry.is_regular_file(error) ? 1 : 0;
            return count >= files;
        };
        CAPTURE(signal, arguments);
        CHECK(test::run_lockstep_until(ready, signal, arguments).signal == signal);
        CHECK(test::names_in(output.path()).empty());
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (output.path() / name).string(); }
};

} // namespace

TEST_CASE("signals: a run that one ends leaves no file and no folder") {
    const Setting setting;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1})
        setting.ends_by(signal, {"study", "--frames", "100000000", "--images", setting.path("new/pictures")}, 5);
}

TEST_CASE("signals: a crash leaves no file and no folder either") {
    const Setting setting;
    for (const int signal : {SIGSEGV, SIGABRT})
        setting.ends_by(signal, {"study", "--frames", "100000000", "--images", setting.path("new")}, 5);
}

TEST_CASE("signals: a recording that one ends goes away") {
    if (!test::have_software_gl())
        return;
    const Setting setting;
    for (const int signal : {SIGINT, SIGTERM})
        setting.ends_by(
            signal, {"record", "--gl", test::software_gl(), "--frames", "100000000", "-o", setting.path("run.h5")}, 1);
}

} // namespace lockstep::test::signals_test
