#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace lockstep::test::include_borders_test {

namespace fs = std::filesystem;

namespace {

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
    for (const std::string& prefix : prefixes)
        if (text.starts_with(prefix))
            return true;
    return false;
}

/// The jobs of crosscheck/, each knowing those before it.
const std::vector<std::string> jobs{"files",  "scene",      "text",    "judge",   "report",
                                    "record", "check_file", "command", "package", "cli"};

/// The place of a file's job among them; nothing of files that are no job's.
std::optional<std::size_t> job_of(const std::string& file) {
    for (std::size_t job = 0; job < jobs.size(); ++job)
        if (file.starts_with("crosscheck/" + jobs[job] + "/"))
            return job;
    return {};
}

/// What every system goes through: it knows none.
const std::set<std::string> machinery_jobs{"files", "text", "judge", "report", "record", "check_file"};

/// Whether a file does what verbs do on any system.
bool runs_any_system(const std::string& file) {
    return starts_with_any(file, {"crosscheck/command/", "crosscheck/package/item_verbs", "crosscheck/package/system",
                                  "crosscheck/cli/system_"});
}

/// The system in whose folder a file of both sides lies; nothing of what is every system's.
std::optional<std::string> system_of(const std::string& file) {
    static const std::regex folder("(?:reference/model|reference|gpu)/([a-z_]+)/.*");
    static const std::set<std::string> machinery{"model", "readings", "system", "probe", "text"};
    std::smatch match;
    if (!std::regex_match(file, match, folder) || machinery.contains(match[1].str()))
        return {};
    return match[1].str();
}

/// The system in whose folder a file lies, on either side or where crosscheck/ puts both together; nothing of what is
/// every system's.
std::optional<std::string> any_system_of(const std::string& file) {
    static const std::regex folder("crosscheck/([a-z_]+)/.*");
    std::smatch match;
    if (std::regex_match(file, match, folder))
        return std::find(jobs.begin(), jobs.end(), match[1].str()) == jobs.end() ? std::optional(match[1].str())
                                                                                 : std::nullopt;
    return system_of(file);
}

/// Whether a file puts both sides of a system together.
bool system_in_crosscheck(const std::string& file) { return file.starts_with("crosscheck/") && any_system_of(file); }

/// The file that names the systems there are.
const std::string registration = "crosscheck/cli/registered_systems.cpp.in", default_system = "collision";

/// The system in whose folder a file lies, of those with one in crosscheck/ that puts both of its sides together; but
/// for the system that the verbs are of besides.
std::optional<std::string> registered_system_of(const std::string& file) {
    static const std::regex folder("(?:crosscheck|gpu|reference/model|reference)/([a-z_]+)/.*");
    std::smatch match;
    if (!std::regex_match(file, match, folder) || !fs::is_directory("crosscheck/" + match[1].str()) ||
        std::find(jobs.begin(), jobs.end(), match[1].str()) != jobs.end() || match[1].str() == default_system)
        return {};
    return match[1].str();
}

/// Why `file` may not include `header`; empty if it may.
std::string forbidden(const std::string& file, const std::string& header) {
    if (!file.starts_with("gpu/") && starts_with_any(header, {"GL/", "EGL/", "GLES", "KHR/", "OpenGL/", "glbinding/"}))
        return "GL headers belong to gpu/";
    if (header.starts_with("CLI/") && file != "crosscheck/command/command_line.cpp")
        return "verbs describe their options as data";
    if (file.starts_with("reference/model/") && starts_with_any(header, {"reference/"}) &&
        !header.starts_with("reference/model/"))
        return "the model stands by itself";
    if (file.starts_with("reference/") && starts_with_any(header, {"gpu/", "crosscheck/", "tests/"}))
        return "the reference knows no other folder";
    if (file.starts_with("gpu/") && header.starts_with("reference/") && !header.starts_with("reference/model/"))
        return "gpu/ shares only the model with its twin";
    if (file.starts_with("gpu/") && starts_with_any(header, {"crosscheck/", "tests/"}))
        return "gpu/ knows nothing of its users";
    if (const auto system = system_of(header);
        system && system_of(file) != system && starts_with_any(file, {"reference/", "gpu/"}))
        return "only the system's own folders know " + *system;
    if (const auto system = registered_system_of(header);
        system && registered_system_of(file) != system && file.starts_with("crosscheck/") && file != registration)
        return "only " + registration + " knows " + *system;
    if (file.starts_with("crosscheck/") && header.starts_with("tests/"))
        return "only tests include tests";
    const auto job = job_of(file), used = job_of(header);
    if (const auto system = any_system_of(header); job && system && machinery_jobs.contains(jobs[*job]))
        return jobs[*job] + " knows no system, " + *system + " neither";
    if (const auto system = any_system_of(header); system && runs_any_system(file))
        return "verbs on any system know none, " + *system + " neither";
    if (system_in_crosscheck(file) && used && jobs[*used] != "scene" && !machinery_jobs.contains(jobs[*used]))
        return "a system knows nothing of " + jobs[*used];
    if (job && used && *used > *job)
        return jobs[*job] + " knows nothing of " + jobs[*used];
    return {};
}

/// Every line of `text` that crosses a border, as "FILE:LINE: reason".
std::vector<std::string> crossings(const std::string& file, const std::string& text) {
    static const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"].*$)");
    static const std::regex shader(R"(#\s*version\s+[0-9])");
    std::vector<std::string> found;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::smatch match;
        std::string reason;
        if (std::regex_match(line, match, include))
            reason = forbidden(file, match[1].str());
        else if (!file.starts_with("tests/") && std::regex_search(line, shader))
            reason = "shaders belong to shaders/";
        if (!reason.empty())
            found.push_back(file + ":" + std::to_string(number) + ": " + reason);
    }
    return found;
}

} // namespace

TEST_CASE("include borders: every source keeps them") {
    std::vector<std::string> found;
    std::size_t files = 0;
    for (const char* folder : {"reference", "gpu", "crosscheck", "tests"}) {
        REQUIRE(fs::is_directory(folder));
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
            if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp")
                continue;
            std::ostringstream text;
            text << std::ifstream(entry.path()).rdbuf();
            for (const std::string& crossing : crossings(entry.path().generic_string(), text.str()))
                found.push_back(crossing);
            ++files;
        }
    }
    CHECK(files > 20);
    CHECK(found == std::vector<std::string>{});
}

TEST_CASE("include borders: a crossing is seen, with its line") {
    using Strings = std::vector<std::string>;
    CHECK(crossings("gpu/a.cpp", "\n#include \"reference/collision/collision_pass.hpp\"\n") ==
          Strings{"gpu/a.cpp:2: gpu/ shares only the model with its twin"});
    CHECK(crossings("gpu/a.cpp", "#include \"reference/model/image.hpp\"\n#include <GL/glcorearb.h>\n").empty());
    CHECK(crossings("gpu/a.cpp", "#include \"crosscheck/judge/compare.hpp\"\n").size() == 1);
    CHECK(crossings("reference/a.hpp", "  # include <EGL/egl.h> // why\n").size() == 1);
    CHECK(crossings("reference/a.hpp", "#include \"gpu/context.hpp\"\n").size() == 1);
    CHECK(crossings("reference/model/a.hpp", "#include \"reference/arithmetic.hpp\"\n").size() == 1);
    CHECK(crossings("crosscheck/a.cpp", "#include <GL/gl.h>\n").size() == 1);
    CHECK(crossings("crosscheck/judge/a.cpp", "#include \"crosscheck/report/report.hpp\"\n") ==
          Strings{"crosscheck/judge/a.cpp:1: judge knows nothing of report"});
    CHECK(crossings("crosscheck/report/a.cpp", "#include \"crosscheck/judge/check.hpp\"\n").empty());
    CHECK(crossings("crosscheck/judge/a.cpp", "#include \"crosscheck/dust/system.hpp\"\n") ==
          Strings{"crosscheck/judge/a.cpp:1: only crosscheck/cli/registered_systems.cpp.in knows dust"});
    CHECK(crossings("crosscheck/report/a.cpp", "#include \"reference/model/dust/settings.hpp\"\n").size() == 1);
    CHECK(crossings("crosscheck/report/a.cpp", "#include \"reference/model/collision/scene.hpp\"\n") ==
          Strings{"crosscheck/report/a.cpp:1: report knows no system, collision neither"});
    CHECK(crossings("crosscheck/record/a.hpp", "#include \"crosscheck/collision/judge/verdict.hpp\"\n").size() == 1);
    CHECK(crossings("crosscheck/judge/a.hpp", "#include \"gpu/collision/gpu_side.hpp\"\n").size() == 1);
    CHECK(crossings("crosscheck/collision/judge/a.hpp", "#include \"gpu/collision/gpu_side.hpp\"\n").empty());
    CHECK(crossings("crosscheck/collision/page/a.hpp", "#include \"crosscheck/record/seal.hpp\"\n").empty());
    CHECK(crossings("crosscheck/collision/page/a.hpp", "#include \"crosscheck/command/verb.hpp\"\n") ==
          Strings{"crosscheck/collision/page/a.hpp:1: a system knows nothing of command"});
    CHECK(crossings("crosscheck/report/a.cpp", "#include \"crosscheck/collision/study/study.hpp\"\n").size() == 1);
    CHECK(
        crossings("crosscheck/collision/study/a.cpp", "#include \"crosscheck/collision/judge/verdict.hpp\"\n").empty());
    for (const char* file :
         {"crosscheck/cli/system_verbs.cpp", "crosscheck/package/item_verbs.cpp", "crosscheck/command/a.cpp"})
        CHECK(crossings(file, "#include \"reference/model/collision/scene.hpp\"\n") ==
              Strings{std::string(file) + ":1: verbs on any system know none, collision neither"});
    CHECK(crossings("crosscheck/dust/a.cpp", "#include \"gpu/dust/passes.hpp\"\n").empty());
    CHECK(crossings("crosscheck/cli/registered_systems.cpp.in", "#include \"crosscheck/dust/system.hpp\"\n").empty());
    CHECK(crossings("reference/readings/a.hpp", "#include \"reference/model/collision/scene.hpp\"\n") ==
          Strings{"reference/readings/a.hpp:1: only the system's own folders know collision"});
    CHECK(crossings("gpu/dust/a.hpp", "#include \"gpu/collision/octree.hpp\"\n").size() == 1);
    CHECK(crossings("gpu/collision/a.hpp", "#include \"reference/model/collision/octree.hpp\"\n").empty());
    CHECK(crossings("tests/gpu/a.cpp", "#include <GL/gl.h>\n").size() == 1);
    CHECK(crossings("crosscheck/cli/main.cpp", "#include <CLI/CLI.hpp>\n").size() == 1);
    CHECK(crossings("crosscheck/a.cpp", "const char* text = \"#version 330 core\";\n") ==
          Strings{"crosscheck/a.cpp:1: shaders belong to shaders/"});
    CHECK(crossings("tests/gpu/a.cpp", "const char* text = \"#version 330 core\";\n").empty());
}

// Catch2 version 3 has other names, for which tests/catch2_v3 stands in; one's own project has one of the two.
TEST_CASE("include borders: a test that uses the matcher includes Catch2 by itself") {
    for (const fs::directory_entry& entry : fs::directory_iterator("tests/package")) {
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        INFO(entry.path());
        CHECK((text.str().find("<lockstep/catch.hpp>") == std::string::npos ||
               text.str().find("#include <catch2/catch.hpp>\n") != std::string::npos));
    }
}

} // namespace lockstep::test::include_borders_test
