#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/check_file/new_file.hpp"
#include "crosscheck/cli/commands.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "gpu/data_folder.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

struct NewRequest {
    std::string name;
    fs::path folder; ///< empty: NAME
};

/// A file of the skeleton, and what it is called in a system of that name.
struct SkeletonFile {
    std::string_view file, before, after;
};
constexpr std::array<SkeletonFile, 5> skeleton{{{"CMakeLists.txt", "CMakeLists.txt", ""},
                                                {"system.hpp", "", ".hpp"},
                                                {"system_step.vert", "", "_step.vert"},
                                                {"main.cpp", "main.cpp", ""},
                                                {"system_test.cpp", "", "_test.cpp"}}};

std::string name_in(const SkeletonFile& file, const std::string& system) {
    return file.before.empty() ? system + std::string(file.after) : std::string(file.before);
}

/// Beside the shaders, in an installation or in the source tree.
std::string text_of(std::string_view file) {
    const fs::path data = built_in_shaders().parent_path();
    for (const fs::path& folder : {data / "skeleton", data / "data" / "skeleton"}) {
        std::ifstream stream(folder / fmt::format("{}.in", file), std::ios::binary);
        if (stream.is_open())
            return {std::istreambuf_iterator<char>(stream), {}};
    }
    throw Error(
        fmt::format("{} has no skeleton/{}.in; the installation is not whole", plain_line(data.string()), file));
}

/// Targets of CMake's generators, of CTest and CPack.
constexpr std::array<std::string_view, 21> targets{"all",
                                                   "clean",
                                                   "cmake_check_build_system",
                                                   "cmake_force",
                                                   "codegen",
                                                   "continuous",
                                                   "default_target",
                                                   "depend",
                                                   "edit_cache",
                                                   "experimental",
                                                   "help",
                                                   "install",
                                                   "list_install_components",
                                                   "nightly",
                                                   "nothing",
                                                   "package",
                                                   "package_source",
                                                   "preinstall",
                                                   "rebuild_cache",
                                                   "run_tests",
                                                   "test"};

/// Keywords of C++20 and alternative tokens, in the standard's order, and what no program may open or define.
constexpr auto words = std::to_array<std::string_view>(
    {"alignas",       "alignof",     "asm",       "auto",      "bool",         "break",
     "case",          "catch",       "char",      "char8_t",   "char16_t",     "char32_t",
     "class",         "concept",     "const",     "consteval", "constexpr",    "constinit",
     "const_cast",    "continue",    "co_await",  "co_return", "co_yield",     "decltype",
     "default",       "delete",      "do",        "double",    "dynamic_cast", "else",
     "enum",          "explicit",    "export",    "extern",    "false",        "float",
     "for",           "friend",      "goto",      "if",        "inline",       "int",
     "long",          "mutable",     "namespace", "new",       "noexcept",     "nullptr",
     "operator",      "private",     "protected", "public",    "register",     "reinterpret_cast",
     "requires",      "return",      "short",     "signed",    "sizeof",       "static",
     "static_assert", "static_cast", "struct",    "switch",    "template",     "this",
     "thread_local",  "throw",       "true",      "try",       "typedef",      "typeid",
     "typename",      "union",       "unsigned",  "using",     "virtual",      "void",
     "volatile",      "wchar_t",     "while",     "and",       "and_eq",       "bitand",
     "bitor",         "compl",       "not",       "not_eq",    "or",           "or_eq",
     "xor",           "xor_eq",      "main",      "posix",     "std"});

void check_name(const std::string& name) {
    const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
    const bool fits = !name.empty() && name.size() <= 40 && is_small(name.front()) &&
                      std::all_of(name.begin(), name.end(),
                                  [&](char c) { return is_small(c) || (c >= '0' && c <= '9') || c == '_'; });
    if (!fits)
        throw Error(fmt::format("new system: '{}' cannot be its name; expected a word of at most 40 small letters, "
                                "digits and _, as sparks or heat_map",
                                plain_line(name)));
    if (std::find(targets.begin(), targets.end(), name) != targets.end())
        throw Error(fmt::format("new system: '{}' cannot be its name: CMake has a target of that name; expected "
                                "another, as {}_system",
                                name, name));
    if (std::find(words.begin(), words.end(), name) != words.end())
        throw Error(fmt::format("new system: '{}' cannot be its name: it is a word of C++; expected another, as "
                                "{}_system",
                                name, name));
    std::error_code ignored;
    if (name == "lockstep" || fs::is_directory(built_in_shaders() / name, ignored))
        throw Error(fmt::format("new system: '{}' cannot be its name: lockstep has shaders of that name; expected "
                                "another, as my_{}",
                                name, name));
}

int make(const NewRequest& options) {
    check_name(options.name);
    const fs::path folder = options.folder.empty() ? fs::path(options.name) : options.folder;
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_empty(folder, ignored))
        throw Error(fmt::format("new system: {} exists and is not empty; right is a folder that does not exist yet",
                                plain_line(folder.string())));
    OutputFiles files;
    files.expect_folder(folder);
    for (const SkeletonFile& file : skeleton) {
        std::string text = text_of(file.file);
        constexpr std::string_view mark = "@NAME@";
        for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at))
            text.replace(at, mark.size(), options.name);
        files.write(folder / name_in(file, options.name), std::move(text));
    }
    files.commit();
    const std::string shown = shell_path(folder);
    fmt::print("{0}: a system with one pass, whose twin you write in {1}.hpp. Build and run it:\n\n"
               "    cmake -S {0} -B {0}/build && cmake --build {0}/build && {0}/build/{1} check\n\n"
               "It says DIVERGENT until the twin does what {1}_step.vert does. docs/own_system.md goes on from here.\n",
               shown, options.name);
    return status_agree;
}

struct NewCheckRequest {
    std::vector<std::string> shaders;
    fs::path file; ///< empty: beside the first shader, by its name
};

int make_check(const NewCheckRequest& options) {
    const std::vector<fs::path> shaders(options.shaders.begin(), options.shaders.end());
    const fs::path file = options.file.empty() ? fs::path(shaders.front()).replace_extension(".json") : options.file;
    std::error_code ignored;
    if (fs::exists(file, ignored))
        throw Error(fmt::format("new check: {} exists; expected a file that does not exist yet, by --output FILE",
                                plain_line(file.string())));
    OutputFiles files;
    files.expect(file);
    files.write(file, check_file::new_file(shaders));
    files.commit();
    const std::string shown = shell_path(file);
    fmt::print(
        "{0}: a check of these shaders against their own text. Its list \"todo\" has what is guessed. Run it:\n\n"
        "    lockstep check {0}\n\n"
        "A folder \"reference\" in it, with shaders of the same names, is what they are held against then: "
        "docs/check_files.md.\n",
        shown);
    return status_agree;
}

} // namespace

Verb new_command() {
    auto options = std::make_shared<NewRequest>();
    Verb system{"system", "write a system's schema, twin, shader, program and test"};
    system.add(required(text_option("name", "NAME", options->name, "what it is called: small letters, digits and _")));
    system.add(path_option("-o,--output", "DIR", options->folder, "the folder to make; without it NAME"));
    system.footer = "Exit status: 0 written, 2 could not be.\nExample: lockstep new system sparks";
    system.run = [options](const Call&) { return make(*options); };
    auto asked = std::make_shared<NewCheckRequest>();
    Verb check{"check", "write a check file for compute shaders, from what they declare"};
    check.add(required(texts_option("shader", "SHADER", asked->shaders, "NAME.comp, in the order in which they run")));
    check.add(
        path_option("-o,--output", "FILE", asked->file, "the file to write; without it NAME.json beside the first"));
    check.footer = "Exit status: 0 written, 2 could not be.\nExample: lockstep new check flock/boids.comp";
    check.run = [asked](const Call&) { return make_check(*asked); };
    Verb verb{"new", "create a project skeleton, or a check file"};
    verb.verbs = {system, check};
    verb.footer = "Example: lockstep new check flock/boids.comp";
    return verb;
}

} // namespace lockstep
