#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>

#include "gpu/data_folder.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::data_folder_test {

using test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// A folder as an installation has it, with one scene.
void fill(const TemporaryFolder& folder) {
    fs::create_directory(folder.path() / "shaders");
    fs::create_directory(folder.path() / "scenes");
    folder.write("scenes/only.json", "{}");
}

} // namespace

TEST_CASE("data folder: the source tree's, by name") {
    CHECK(built_in_shaders() == fs::current_path() / "shaders");
    CHECK(shipped_scene("lattice") == fs::current_path() / "data/scenes/lattice.json");
    CHECK(fs::is_regular_file(shipped_scene("catalogue/close_up")));
    CHECK_THROWS_WITH(shipped_scene("latice"), Catch::StartsWith("no scene latice in ") &&
                                                   Catch::EndsWith((fs::current_path() / "data/scenes").string()));
}

TEST_CASE("data folder: LOCKSTEP_DATA alone counts where it is set") {
    const TemporaryFolder folder;
    setenv("LOCKSTEP_DATA", folder.path().c_str(), 1);
    CHECK_THROWS_WITH(built_in_shaders(), "LOCKSTEP_DATA is " + folder.path().string() + ", but there is no folder " +
                                              (folder.path() / "shaders").string());
    fill(folder);
    CHECK(built_in_shaders() == folder.path() / "shaders");
    CHECK(shipped_scene("only") == folder.path() / "scenes/only.json");
    CHECK_THROWS_WITH(shipped_scene("lattice"), "no scene lattice in " + (folder.path() / "scenes").string() + " or " +
                                                    (folder.path() / "data/scenes").string());
    unsetenv("LOCKSTEP_DATA");
}

TEST_CASE("data folder: an installed package comes before the source tree it was built from") {
    const TemporaryFolder package;
    fill(package);
    CHECK(use_package_data(package.path()));
    CHECK(built_in_shaders() == package.path() / "shaders");
    CHECK(shipped_scene("only") == package.path() / "scenes/only.json");
    CHECK(shipped_scene("lattice") == fs::current_path() / "data/scenes/lattice.json");
    use_package_data("");
}

} // namespace lockstep::test::data_folder_test
