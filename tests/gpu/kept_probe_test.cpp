#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/sha256.hpp"
#include "crosscheck/scene/kept_probe.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::kept_probe_test {

using test::open_context;
namespace fs = std::filesystem;

namespace {

/// A variable of the environment for as long as this lives.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* const before = std::getenv(name); before != nullptr)
            before_ = before;
        setenv(name, value.c_str(), 1);
    }
    ~Variable() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// As the folder stands, of one file.
fs::path only_file(const fs::path& folder) {
    REQUIRE(files_in(folder) == 1);
    return fs::directory_iterator(folder)->path();
}

} // namespace

TEST_CASE("kept probe: a driver that was measured is not measured again, until something changes") {
    const auto context = open_context();
    if (!context)
        return;
    const test::TemporaryFolder folder;
    const Variable cache("LOCKSTEP_CACHE", folder.path().string());
    const ProbeResult measured = kept_probe(*context);
    const fs::path file = only_file(folder.path());

    // What the file says is what comes back: a sentence that no driver gives.
    const std::string before = text_of(file), text = before.substr(before.find('\n') + 1);
    nlohmann::json kept = nlohmann::json::parse(text);
    CHECK(kept == nlohmann::json(measured));
    kept["rows"][0]["finding"] = "read from the file";
    const std::string changed = kept.dump();
    std::ofstream(file) << sha256_of(std::as_bytes(std::span(changed))) << '\n' << changed << '\n';
    CHECK(kept_probe(*context).rows.front().finding == "read from the file");
    {
        const Variable other("LP_NATIVE_VECTOR_WIDTH", "128");
        CHECK(kept_probe(*context).rows.front().finding == measured.rows.front().finding);
        CHECK(files_in(folder.path()) == 2);
    }
    {
        const Variable home("OLDPWD", "/anywhere");
        CHECK(kept_probe(*context).rows.front().finding == "read from the file");
    }
    {
        const Variable off("LOCKSTEP_CACHE", "off");
        CHECK(kept_probe(*context).rows.front().finding == measured.rows.front().finding);
    }
    for (const std::string& damaged : {std::string(), before.substr(0, before.size() / 2), "0\n" + text}) {
        std::ofstream(file) << damaged;
        CHECK(kept_probe(*context).rows.front().finding == measured.rows.front().finding);
        CHECK(text_of(file).size() > before.size() / 2);
    }
}

TEST_CASE("kept probe: the newest results stay") {
    const auto context = open_context();
    if (!context)
        return;
    const test::TemporaryFolder folder;
    const Variable cache("LOCKSTEP_CACHE", folder.path().string());
    for (int k = 0; k < 40; ++k)
        folder.write(fmt::format("probe-{}.json", k), "{}");
    folder.write("anything.json", "{}");
    static_cast<void>(kept_probe(*context));
    CHECK(files_in(folder.path()) == 33);
    CHECK(fs::exists(folder.path() / fmt::format("probe-{}.json", probe_key(*context))));
    CHECK(fs::exists(folder.path() / "anything.json"));
}

TEST_CASE("kept probe: no folder of others, and none where there is none") {
    const test::TemporaryFolder folder;
    {
        const Variable cache("LOCKSTEP_CACHE", (folder.path() / "new" / "deep").string());
        CHECK(probe_folder() == folder.path() / "new" / "deep");
        CHECK(fs::is_directory(folder.path() / "new" / "deep"));
    }
    {
        const Variable cache("LOCKSTEP_CACHE", ""), caches("XDG_CACHE_HOME", folder.path().string());
        CHECK(probe_folder() == folder.path() / "lockstep");
    }
    {
        const Variable cache("LOCKSTEP_CACHE", ""), caches("XDG_CACHE_HOME", ""), home("HOME", folder.path().string());
        CHECK(probe_folder() == folder.path() / ".cache" / "lockstep");
    }
    {
        const Variable cache("LOCKSTEP_CACHE", ""), caches("XDG_CACHE_HOME", ""), home("HOME", "");
        CHECK(probe_folder() == std::nullopt);
    }
    {
        const std::string away = (folder.path() / "away").string();
        const Variable cache("LOCKSTEP_CACHE", ""), caches("XDG_CACHE_HOME", ""), home("HOME", away);
        CHECK(probe_folder() == std::nullopt);
        CHECK(!fs::exists(away));
    }
    for (const char* const other : {"off", "relative/folder", "/dev/null", "/dev/null/folder", "/proc/folder"}) {
        const Variable cache("LOCKSTEP_CACHE", other);
        INFO(other);
        CHECK(probe_folder() == std::nullopt);
    }
    const Variable cache("LOCKSTEP_CACHE", folder.path().string());
    fs::permissions(folder.path(), fs::perms::all);
    CHECK(probe_folder() == std::nullopt);
}

} // namespace lockstep::test::kept_probe_test
