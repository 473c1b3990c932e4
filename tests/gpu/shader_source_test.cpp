#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/stat.h>

#include <fmt/format.h>

#include "gpu/collision/collision_shaders.hpp"
#include "gpu/shader_log.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/shader_words.hpp"
#include "gpu/shaders_read_once.hpp"
#include "reference/model/error.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::shader_source_test {

using test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// `file:line` of every line of the source's text.
std::vector<std::string> origins(const ShaderSource& source) {
    std::vector<std::string> result;
    for (const ShaderSource::Origin& origin : source.origins)
        result.push_back(fmt::format("{}:{}", origin.file, origin.line));
    return result;
}

} // namespace

TEST_CASE("shader source: definitions follow #version, and every line knows where it was") {
    const TemporaryFolder folder;
    folder.write("a.vert", "// a comment\n#version 330 core\nvoid main() {}\n");
    const ShaderSource source = load_stage({folder.path()}, "a", Stage::vertex, {{"RADIUS", "2"}});
    CHECK(source.text == "// a comment\n#version 330 core\n#define RADIUS 2\nvoid main() {}\n");
    CHECK(origins(source) == std::vector<std::string>{"0:1", "0:2", "0:2", "0:3"});
    CHECK(source.files == std::vector{(folder.path() / "a.vert").string()});
}

TEST_CASE("shader source: an include is replaced by its file") {
    const TemporaryFolder folder;
    folder.write("inner.glsl", "float inner;\n");
    folder.write("outer.glsl", "float outer;\n  #  include \"inner.glsl\"  // why\nfloat last;\n");
    folder.write("a.frag", "#version 330\n#include \"outer.glsl\"\nvoid main() {}");
    const ShaderSource source = load_stage({folder.path()}, "a", Stage::fragment);
    CHECK(source.text == "#version 330\nfloat outer;\nfloat inner;\nfloat last;\nvoid main() {}\n");
    CHECK(origins(source) == std::vector<std::string>{"0:1", "1:1", "2:1", "1:3", "0:3"});
    REQUIRE(source.files.size() == 3);
    CHECK(source.files[2] == (folder.path() / "inner.glsl").string());
}

TEST_CASE("shader source: a file beside the one that includes it is found, after those of the folders") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "colour" / "space");
    folder.write("colour/space/hsv.glsl", "#include \"../clamped.glsl\"\nfloat hsv;\n");
    folder.write("colour/clamped.glsl", "float clamped;\n");
    folder.write("a.frag", "#version 330\n#include \"colour/space/hsv.glsl\"\nvoid main() {}");
    const ShaderSource source = load_stage({folder.path()}, "a", Stage::fragment);
    CHECK(source.text.find("float clamped;") < source.text.find("float hsv;"));
    folder.write("colour/space/hsv.glsl", "#include \"../absent.glsl\"\n");
    CHECK_THROWS_WITH(load_stage({folder.path()}, "a", Stage::fragment),
                      Catch::Contains("hsv.glsl:1: no shader file ../absent.glsl"));
}

TEST_CASE("shader source: a user's file comes before the built-in one, included files too") {
    const TemporaryFolder user;
    const TemporaryFolder built_in;
    user.write("lib.glsl", "int users;\n");
    built_in.write("lib.glsl", "int built_in;\n");
    built_in.write("a.vert", "#version 330\n#include \"lib.glsl\"\n");
    CHECK_THAT(load_stage({user.path(), built_in.path()}, "a", Stage::vertex).text, Catch::Contains("int users;"));
}

TEST_CASE("shader source: a blank file leaves its stage out") {
    const TemporaryFolder user;
    const TemporaryFolder built_in;
    user.write("a.geom", " \n");
    built_in.write("a.geom", "#version 330\n");
    built_in.write("a.vert", "#version 330\n");
    const Stage stages[] = {Stage::vertex, Stage::geometry};
    CHECK(load_stages({built_in.path()}, "a", stages).size() == 2);
    const auto sources = load_stages({user.path(), built_in.path()}, "a", stages);
    REQUIRE(sources.size() == 1);
    CHECK(sources[0].stage == Stage::vertex);
}

TEST_CASE("shader source: a folder or a pipe of a shader's name is told as one") {
    const TemporaryFolder folder;
    const std::string where = folder.path().string();
    fs::create_directory(folder.path() / "a.vert");
    REQUIRE(mkfifo((folder.path() / "b.vert").c_str(), 0600) == 0);
    CHECK_THROWS_WITH(read_shader_file(folder.path() / "a.vert"),
                      "shader " + where + "/a.vert: is a folder; right is a file");
    CHECK_THROWS_WITH(read_shader_file(folder.path() / "b.vert"),
                      "shader " + where + "/b.vert: is a pipe or a device; right is a file");
    CHECK_THROWS_WITH(read_shader_file(folder.path() / "c.vert"), "shader " + where + "/c.vert: cannot be read");
}

TEST_CASE("shader source: what is wrong with a file is told with file and line") {
    const TemporaryFolder folder;
    const std::string where = folder.path().string();
    const ShaderFolders folders{folder.path()};
    CHECK_THROWS_WITH(load_stage(folders, "none", Stage::compute), "no shader file none.comp in " + where);
    const TemporaryFolder second;
    CHECK_THROWS_WITH(load_stage({folder.path(), second.path()}, "none", Stage::geometry),
                      "no shader file none.geom in " + where + " or " + second.path().string());
    folder.write("a.vert", "void main() {}\n");
    CHECK_THROWS_WITH(load_stage(folders, "a", Stage::vertex),
                      "shader " + where + "/a.vert:1: no #version line; GLSL 330 or later is needed");
    folder.write("b.vert", "#version 330\n#include \"gone.glsl\"\n");
    CHECK_THROWS_WITH(load_stage(folders, "b", Stage::vertex),
                      "shader " + where + "/b.vert:2: no shader file gone.glsl in " + where);
    for (const char* argument : {"<gone.glsl>", "", "\"\"", "\"open"}) {
        folder.write("c.vert", fmt::format("#version 330\n\n#include {}\n", argument));
        CHECK_THROWS_WITH(load_stage(folders, "c", Stage::vertex),
                          "shader " + where + "/c.vert:3: #include needs a file name in double quotes");
    }
    folder.write("x.glsl", "#include \"y.glsl\"\n");
    folder.write("y.glsl", "\n#include \"x.glsl\"\n");
    folder.write("d.vert", "#version 330\n#include \"x.glsl\"\n");
    CHECK_THROWS_WITH(load_stage(folders, "d", Stage::vertex),
                      "shader " + where + "/y.glsl:2: " + where + "/x.glsl includes itself");
}

TEST_CASE("shader source: what a branch would include is the preprocessor's to ask for") {
    const TemporaryFolder folder;
    const ShaderFolders folders{folder.path()};
    folder.write("a.vert", "#version 330\n#if 0\n#include \"gone.glsl\"\n#include <of_another.h>\n#include \"a.vert\"\n"
                           "#endif\nvoid main() {}\n");
    const ShaderSource source = load_stage(folders, "a", Stage::vertex);
    CHECK(source.text ==
          fmt::format("#version 330\n#if 0\n#error no shader file gone.glsl in {0}\n"
                      "#error #include needs a file name in double quotes\n#error {0}/a.vert includes itself\n"
                      "#endif\nvoid main() {{}}\n",
                      folder.path().string()));
    CHECK(source.origins.size() == 7);
    folder.write("b.vert", "#version 330\n#ifndef B\n#define B\n#endif\n#include \"gone.glsl\"\n");
    CHECK_THROWS_WITH(load_stage(folders, "b", Stage::vertex), "shader " + folder.path().string() +
                                                                   "/b.vert:5: no shader file gone.glsl in " +
                                                                   folder.path().string());
}

TEST_CASE("shader source: includes that grow without end are refused, soon") {
    const TemporaryFolder folder;
    const std::string file = folder.write("a.vert", "#version 330\n#include \"0.glsl\"\n").string();
    for (int i = 0; i < 30; ++i)
        folder.write(fmt::format("{}.glsl", i), fmt::format("#include \"{0}.glsl\"\n#include \"{0}.glsl\"\n", i + 1));
    folder.write("30.glsl", "int x;\n");
    CHECK_THROWS_WITH(load_stage({folder.path()}, "a", Stage::vertex),
                      "shader " + file + ": includes more than 1000 files");
    folder.write(
        "0.glsl",
        "#include \"1.glsl\"\n#include \"1.glsl\"\n#include \"1.glsl\"\n#include \"1.glsl\"\n#include \"1.glsl\"\n");
    folder.write("1.glsl", "// " + std::string(1'000'000, 'x') + "\n");
    CHECK_THROWS_WITH(load_stage({folder.path()}, "a", Stage::vertex),
                      "shader " + file + ": more than 4 MiB of shader text");
    folder.write("0.glsl", std::string(5'000'000, ' '));
    CHECK_THROWS_WITH(load_stage({folder.path()}, "a", Stage::vertex),
                      "shader " + (folder.path() / "0.glsl").string() + ": more than 4 MiB of shader text");
}

TEST_CASE("shader source: a text that no compiler ends is refused by file and line") {
    const TemporaryFolder folder;
    const auto refusal_of = [&](const std::string& text) -> std::string {
        folder.write("a.comp", "#version 430\n" + text);
        try {
            load_stage({folder.path()}, "a", Stage::compute);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const auto chain = [](const std::string& first, const std::string& next) { // of 30 macros, each from the one before
        std::string all = "#define A0" + first + "\n";
        for (int k = 1; k <= 30; ++k)
            all += fmt::format(fmt::runtime("#define A{0}" + next + "\n"), k, k - 1);
        return all;
    };
    const std::string bomb = "a.comp:33: macros expand to more than 262144 words";
    const auto contains = [](const std::string& what) { return Catch::Contains(what); };
    CHECK_THAT(refusal_of(chain(" x", " A{1} + A{1}") + "float f() { return A30; }\n"), contains(bomb));
    CHECK_THAT(refusal_of(chain("(x) x", "(x) A{1}(x) * A{1}(x)") + "float f() { return A30(1.0); }\n"),
               contains(bomb));
    CHECK(refusal_of(chain(" x", " A{1} + 1") + "float f() { return A30; }\n").empty());
    CHECK(refusal_of(chain(" x", " A{1} + A{1}") + "float f() { return A9; }\n").empty());
    std::string nested = "1.0";
    for (int k = 0; k < 30; ++k)
        nested = "D(" + nested + ")";
    CHECK_THAT(refusal_of("#define D(x) \\\n (x) + (x)\nfloat f() { return\n" + nested + "; }\n"),
               contains("a.comp:5: macros expand"));
    CHECK(refusal_of("#define D(x) (x)\nfloat f() { return " + nested + "; }\n").empty());
    std::string deep = "1.0";
    for (int k = 0; k < 10000; ++k)
        deep = "D(" + deep + ")";
    CHECK_THAT(refusal_of("#define D(x) (x)\nfloat f() { return " + deep + "; }\n"),
               contains("a.comp:3: macros are nested deeper than 256"));
    CHECK(refusal_of("#define A A B\n#define B A B\n#define F(x) F(x) x\nint f() { return F(A) + F; }\n").empty());
    const std::string array = "arrays of at most 67108864 elements are compiled";
    CHECK_THAT(refusal_of("void f() {\n    float x[2000000000];\n}\n"), contains("a.comp:3: [2000000000]: " + array));
    CHECK_THAT(refusal_of("#define N 99999999999999999999\nfloat x[N];\n"), contains("a.comp:3: [") && contains(array));
    CHECK(refusal_of("#define N 64\nfloat x[N], y[67108864u];\n").empty());
}

TEST_CASE("shader source: a byte order mark is skipped; another encoding and a zero byte are told") {
    const TemporaryFolder folder;
    const std::string file = folder.write("a.vert", "\xef\xbb\xbf#version 330\n").string();
    CHECK(load_stage({folder.path()}, "a", Stage::vertex).text == "#version 330\n");
    folder.write("a.vert", std::string("\xff\xfe#\0v\0", 6));
    CHECK_THROWS_WITH(load_stage({folder.path()}, "a", Stage::vertex),
                      "shader " + file + ": is UTF-16; a shader is UTF-8");
    folder.write("a.vert", std::string("#version 330\n\0void main() {}\n", 29));
    CHECK_THROWS_WITH(load_stage({folder.path()}, "a", Stage::vertex),
                      "shader " + file + ": holds a zero byte, at 13; a compiler would read no further");
}

TEST_CASE("shader source: GLSL of other kinds and of older days is told as that") {
    const TemporaryFolder folder;
    const auto told = [&](const std::string& version) {
        const std::string file = folder.write("a.vert", "\n#version " + version + "\nvoid main() {}\n").string();
        try {
            load_stage({folder.path()}, "a", Stage::vertex);
        } catch (const Error& error) {
            const std::string text = error.what();
            CHECK_THAT(text, Catch::StartsWith("shader " + file + ":2: "));
            return text.substr(("shader " + file + ":2: ").size());
        }
        return std::string();
    };
    // A stage's own file may be in any dialect: the driver gets it in desktop GLSL.
    for (const char* right : {"300 es", "100", "120", "140", "150 core", "330", "450 core // es", "words"})
        CHECK(told(right).empty());
    const auto included = [&](const std::string& version) {
        folder.write("part.glsl", "#version " + version + "\n");
        const std::string file = folder.write("b.vert", "#include \"part.glsl\"\nvoid main() {}\n").string();
        try {
            load_stage({folder.path()}, "b", Stage::vertex);
        } catch (const Error& error) {
            return std::string(error.what()).substr(std::string(error.what()).find("glsl:1: ") + 8);
        }
        return std::string();
    };
    CHECK(included("300 es") == "GLSL ES 300; GLSL 330 or later is needed, that of desktop GL");
    CHECK(included("120") == "GLSL 1.20, which a core profile does not have; GLSL 330 or later is needed");
}

TEST_CASE("shader folders: the user's first, then LOCKSTEP_DATA or the source tree") {
    const TemporaryFolder user;
    CHECK(shader_folders(user.path()).front() == user.path());
    CHECK(fs::is_regular_file(shader_folders().front() / "arithmetic.glsl"));
    CHECK(shader_folders(user.path(), "collision") ==
          ShaderFolders{user.path(), shader_folders().front() / "collision", shader_folders().front()});
    CHECK(shader_folders({}, "no_such_system") == shader_folders());
    CHECK_THROWS_WITH(shader_folders("/no/such/folder"), "shader folder /no/such/folder does not exist");
    const TemporaryFolder data;
    setenv("LOCKSTEP_DATA", data.path().c_str(), 1);
    CHECK_THROWS_WITH(shader_folders(), "LOCKSTEP_DATA is " + data.path().string() + ", but there is no folder " +
                                            (data.path() / "shaders").string());
    fs::create_directory(data.path() / "shaders");
    CHECK(shader_folders() == ShaderFolders{data.path() / "shaders"});
    unsetenv("LOCKSTEP_DATA");
}

TEST_CASE("shader source: every switch with named values is defined") {
    Switches switches;
    switches.base_texel = BaseTexel::truncate;
    const ShaderDefines defines = switch_defines(switches);
    const auto value = [&](const std::string& name) {
        const auto found = std::find_if(defines.begin(), defines.end(), [&](const auto& d) { return d.first == name; });
        return found == defines.end() ? "undefined" : found->second;
    };
    CHECK(value("BASE_TEXEL_TRUNCATE") == "0");
    CHECK(value("BASE_TEXEL_FLOOR") == "1");
    CHECK(value("BASE_TEXEL") == "BASE_TEXEL_TRUNCATE");
    CHECK(value("CDT_FORMAT") == "CDT_FORMAT_RGBA32F");
    CHECK(value("SPEED_FACTOR") == "undefined");
}

TEST_CASE("shader log: the first error is found in every compiler's form") {
    ShaderSource source;
    source.files = {"a.vert", "lib.glsl"};
    source.origins = {{0, 1}, {0, 1}, {1, 1}, {1, 2}, {0, 3}};
    CHECK(first_compile_error("0:5(3): warning: unused\n0:4(10): error: `x' undeclared\n0:5(1): error: late\n",
                              source) == "lib.glsl:2: `x' undeclared");
    CHECK(first_compile_error("0:2(1): preprocessor error: syntax error\n", source) == "a.vert:1: syntax error");
    CHECK(first_compile_error("0(4) : warning C7011: cast\n0(5) : error C1503: undefined variable \"x\"\n", source) ==
          "a.vert:3: C1503: undefined variable \"x\"");
    const std::size_t end = source.origins.size() + 1; // where a compiler misses what the text leaves open
    CHECK(first_compile_error("ERROR: 0:" + std::to_string(end) + ": '' : missing #endif\n", source) ==
          first_compile_error("ERROR: 0:" + std::to_string(end - 1) + ": '' : missing #endif\n", source));
    CHECK(first_link_error("\nERROR: Linking compute stage: Recursion detected:\n    f(f1; calling f(f1;\n") ==
          "ERROR: Linking compute stage: Recursion detected: f(f1; calling f(f1;");
    CHECK(first_compile_error("ERROR: 0:3: 'x' : undeclared identifier\n", source) ==
          "lib.glsl:1: 'x' : undeclared identifier");
    CHECK(first_compile_error("\nout of registers\n", source) == "a.vert: out of registers");
    CHECK(first_compile_error("0:7(1): error: odd\n", source) == "a.vert: 0:7(1): error: odd");
    CHECK(first_compile_error("0:0(1): error: odd\n", source) == "a.vert: 0:0(1): error: odd");
    CHECK(first_compile_error("", source) == "a.vert: the driver gives no reason");
    CHECK(first_compile_error("0:99999999999999999999(1): error: odd\n", source) ==
          "a.vert: 0:99999999999999999999(1): error: odd");
    const std::string quoted(1'000'000, 'x');
    for (const std::string form : {"0:4(10): error: ", "0(4) : error ", "ERROR: 0:4: ", "an error: "})
        CHECK(first_compile_error(form + quoted, source).size() < 1100);
    CHECK(first_link_error(quoted).size() == 1000);
    CHECK(first_link_error("Vertex info\n-----------\n0(3) : error C5041: no\n") == "0(3) : error C5041: no");
}

TEST_CASE("shader_source: a run reads each file once") {
    const test::TemporaryFolder user, built_in;
    built_in.write("a.vert", "#version 330\n#include \"b.glsl\"\n");
    built_in.write("b.glsl", "int first;\n");
    const ShaderFolders folders{user.path(), built_in.path()};
    const auto text = [&] { return load_stage(folders, "a", Stage::vertex).text; };
    const std::string before = text();
    {
        const ShadersReadOnce once;
        CHECK(text() == before);
        SECTION("saved meanwhile") { built_in.write("b.glsl", "int second;\n"); }
        SECTION("gone meanwhile") { std::filesystem::remove(built_in.path() / "b.glsl"); }
        SECTION("new meanwhile") { user.write("b.glsl", "int second;\n"); }
        CHECK(text() == before);
    }
    built_in.write("b.glsl", "int third;\n");
    CHECK(text() != before);
}

TEST_CASE("shader_source: a run finds its folder once") {
    const ShadersReadOnce once;
    std::filesystem::path path;
    {
        const test::TemporaryFolder user;
        path = user.path();
        CHECK(shader_folders(path).front() == path);
    }
    CHECK(shader_folders(path).front() == path);
}

// A driver may fuse what it copies to an output that is not precise, though it was precise before (NVIDIA 580).
TEST_CASE("shader source: what a shipped stage computes is precise where it is handed on") {
    std::size_t outputs = 0;
    for (const auto& file : fs::recursive_directory_iterator("shaders")) {
        const std::string path = file.path().string();
        if (!file.is_regular_file() || path.find("/probe/") != std::string::npos)
            continue;
        std::ifstream stream(path);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        if (!says(text, "precise") && !says(text, "arithmetic.glsl"))
            continue; // it copies
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            const bool is_float = line.find(" float ") != std::string::npos || line.find(" vec") != std::string::npos;
            const bool is_output = line.starts_with("out ") || line.starts_with("flat out ");
            INFO(path << ": " << line);
            CHECK_FALSE((is_float && is_output && line.find("trace_") == std::string::npos));
            outputs += line.starts_with("precise ") && line.find("out ") != std::string::npos ? 1 : 0;
        }
    }
    CHECK(outputs >= 30);
}

} // namespace lockstep::test::shader_source_test
