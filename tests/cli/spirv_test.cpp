#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "gpu/shader_source.hpp"
#include "gpu/spirv_module.hpp"
#include "tests/cli/cli_checks.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::spirv_test {

namespace fs = std::filesystem;
using Catch::Contains;

/// Shaders as SPIR-V modules. That right ones agree, and planted mistakes are named, is in foreign_shaders_test.
namespace {

void run(const std::string& command) { REQUIRE(std::system((command + " >/dev/null").c_str()) == 0); }

std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Texts of a stage and what stands instead of them.
using Changes = std::vector<std::pair<std::string, std::string>>;

/// tests/foreign/spirv_stages with both stages as modules, the vertex stage after changes of its text.
struct Modules {
    explicit Modules(const Changes& changes = {}) {
        const fs::path shipped = "tests/foreign/spirv_stages";
        for (const char* name : {"bindings.json", "collision_pass.geom"})
            fs::copy_file(shipped / name, folder.path() / name);
        std::string text = content(shipped / "collision_pass.vert");
        for (const auto& [from, to] : changes) {
            REQUIRE(text.find(from) != std::string::npos);
            for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
                text.replace(at, from.size(), to);
        }
        std::ofstream(texts.path() / "collision_pass.vert") << text;
        run("glslangValidator -G -o '" + vertex() + "' '" + (texts.path() / "collision_pass.vert").string() + "'");
        run("glslangValidator -G -o '" + (folder.path() / "collision_pass.frag.spv").string() + "' '" +
            (shipped / "collision_pass.frag").string() + "'");
    }

    Modules(const std::string& from, const std::string& to) : Modules(Changes{{from, to}}) {}

    [[nodiscard]] std::string vertex() const { return folder.path() / "collision_pass.vert.spv"; }

    [[nodiscard]] test::Outcome check(const test::Surroundings& surroundings = {}, const char* particles = "500",
                                      const char* frames = "3") const {
        return test::run_lockstep({"check", "data/scenes/x_streams.json", "--particles", particles, "--frames", frames,
                                   "--gl", test::software_gl(), "--no-render", "--shaders", folder.path()},
                                  surroundings);
    }

    /// What it says instead of running; FOLDER stands for its place.
    [[nodiscard]] std::string refusal(const test::Surroundings& surroundings = {}) const {
        std::string said = test::refusal(check(surroundings));
        for (std::size_t at = 0; (at = said.find(folder.path().string())) != std::string::npos;)
            said.replace(at, folder.path().string().size(), "FOLDER");
        return said;
    }

    test::TemporaryFolder folder, texts;
};

constexpr const char* vertex_stage = "shader FOLDER/collision_pass.vert.spv: ";

} // namespace

TEST_CASE("SPIR-V: a module that calls normalize agrees, though drivers translate it in another way than GLSL's") {
    if (!test::have_software_gl())
        return;
    const Modules modules(Changes{{"velocity * inversesqrt(dot(velocity, velocity))", "normalize(velocity)"},
                                  {"away * inversesqrt(dot(away, away))", "normalize(away)"}});
    const test::Outcome outcome = modules.check({}, "4000", "20");
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("collision_pass.vert.spv (SPIR-V)"));
    CHECK_THAT(outcome.out, Contains("verdict   AGREE"));
    CHECK_THAT(outcome.out, !Contains("not followed"));
}

TEST_CASE("SPIR-V: a module that makes directions in two ways, one of them another than the driver's, is legal") {
    if (!test::have_software_gl())
        return;
    const Modules modules("velocity * inversesqrt(dot(velocity, velocity))", "normalize(velocity)");
    const test::Outcome outcome = modules.check({}, "4000", "5");
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.out, Contains("verdict   LEGAL"));
}

TEST_CASE("SPIR-V: explain shows the step of a module's particle") {
    if (!test::have_software_gl())
        return;
    const Modules modules(" && separation < closest", "");
    const test::Outcome outcome =
        test::run_lockstep({"explain", "data/scenes/x_streams.json", "--particles", "500", "--frame", "1", "--particle",
                            "1", "--gl", test::software_gl(), "--shaders", modules.folder.path()});
    CHECK(outcome.status != 2);
    CHECK_THAT(outcome.out, Contains("gl_Position.x"));
}

TEST_CASE("SPIR-V: what a module lacks is said in one line, with the remedy") {
    if (!test::have_software_gl())
        return;
    const std::string remedy = "`glslangValidator -G -S vert` compiles GLSL for OpenGL (docs/translators.md)";
    {
        const Modules stripped;
        run("spirv-opt --strip-debug '" + stripped.vertex() + "' -o '" + stripped.vertex() + "'");
        CHECK_THAT(stripped.refusal(), Contains("has no name; the names were stripped (OpName)") && Contains(remedy));
    }
    {
        const Modules cut;
        fs::resize_file(cut.vertex(), 1001);
        CHECK(cut.refusal() ==
              std::string(vertex_stage) + "1001 bytes are no whole number of words; the file was cut short");
        fs::resize_file(cut.vertex(), 1000);
        CHECK_THAT(cut.refusal(), Contains(std::string(vertex_stage) + "is no SPIR-V module that can be read"));
    }
    {
        const Modules text;
        std::ofstream(text.vertex()) << "#version 450\n";
        CHECK(text.refusal() == std::string(vertex_stage) + "does not begin as a SPIR-V module does; " + remedy);
    }
    {
        const Modules fragment;
        fs::copy_file(fragment.folder.path() / "collision_pass.frag.spv", fragment.vertex(),
                      fs::copy_options::overwrite_existing);
        CHECK(fragment.refusal() == std::string(vertex_stage) + "has no entry point of a vert stage; " + remedy);
    }
    {
        const Modules twice;
        std::ofstream(twice.folder.path() / "collision_pass.vert") << "#version 450\n";
        CHECK(twice.refusal() ==
              std::string(vertex_stage) + "collision_pass.vert lies beside it; right is one of them");
    }
    {
        const Modules renamed;
        fs::rename(renamed.vertex(), renamed.folder.path() / "collision_pass.vert");
        CHECK(renamed.refusal() == "shader FOLDER/collision_pass.vert: holds a SPIR-V module; right is the name "
                                   "collision_pass.vert.spv");
    }
}

TEST_CASE("SPIR-V: names are the module's: what is misspelt, not bound, or of another type") {
    if (!test::have_software_gl())
        return;
    CHECK(
        Modules("nextPace", "nextPaces").refusal() ==
        "FOLDER/bindings.json: /outputs/nextPace: no shader beside it has the name nextPace; did you mean nextPaces?");
    CHECK(Modules("delta", "deltas").refusal() ==
          "FOLDER/bindings.json: /uniforms/delta: no shader beside it has the name delta; did you mean deltas?");
}

TEST_CASE("SPIR-V: what is Vulkan's alone, and blocks at one binding point, are refused by name") {
    if (!test::have_software_gl())
        return;
    const auto refusal = [](const std::string& declared, const std::string& value, const std::string& compiler) {
        const test::TemporaryFolder texts;
        const Modules modules;
        fs::remove(modules.folder.path() / "bindings.json");
        const fs::path text = texts.path() / "collision_pass.vert";
        std::ofstream(text) << "#version 450\n" + declared + "\nlayout(location = 0) flat out vec3 place;\n" +
                                   "void main() { place = vec3(" + value + "); gl_Position = vec4(0.0); }\n";
        run(compiler + " -o '" + modules.vertex() + "' '" + text.string() + "'");
        return modules.refusal();
    };
    CHECK(
        refusal("layout(push_constant) uniform Pushed { float tick; } pushed;", "pushed.tick", "glslangValidator -V") ==
        std::string(vertex_stage) +
            "a push constant (pushed) is Vulkan's, and GL has none; `glslangValidator -G -S vert` compiles GLSL for "
            "OpenGL (docs/translators.md), `spirv-cross --version 450` translates it to GLSL");
    CHECK(refusal("", "gl_VertexIndex", "glslangValidator -V") ==
          std::string(vertex_stage) +
              "gl_VertexIndex is Vulkan's, GL has gl_VertexID; `glslangValidator -G -S vert` compiles "
              "GLSL for OpenGL (docs/translators.md)");
    CHECK(refusal("layout(binding = 1) uniform One { float a; }; layout(binding = 1) uniform Two { float b; };",
                  "a + b", "glslangValidator -G") ==
          std::string(vertex_stage) + "blocks One and Two both have binding 1; right is one each");
}

TEST_CASE("SPIR-V: a driver without GL_ARB_gl_spirv is named, with the translator's command") {
    if (!test::have_software_gl())
        return;
    test::Surroundings older;
    older.environment = {{"MESA_EXTENSION_OVERRIDE", "-GL_ARB_gl_spirv"}, {"MESA_GL_VERSION_OVERRIDE", "4.5"}};
    CHECK(
        Modules().refusal(older) ==
        std::string(vertex_stage) +
            "this GL takes no SPIR-V (GL_ARB_gl_spirv); `spirv-cross FOLDER/collision_pass.vert.spv --version 450 "
            "--no-420pack-extension --output FOLDER/collision_pass.vert` translates it to GLSL (docs/translators.md)");
}

namespace {

/// A module with some of its words changed, left out or doubled.
std::string damaged(const std::string& module, std::mt19937& random) {
    std::string bytes = module;
    const auto upto = [&](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random); };
    const std::size_t kind = upto(3);
    for (std::size_t left = upto(2) + 1; left > 0; --left) {
        const std::size_t at = 4 * (3 + upto(bytes.size() / 4 - 8)), count = 4 * (1 + upto(3));
        if (kind == 0)
            bytes[at + upto(3)] ^= static_cast<char>(1U << upto(7));
        else if (kind == 1)
            bytes.replace(at, 4,
                          std::array<std::string, 3>{std::string(4, '\xff'), std::string(4, '\0'),
                                                     std::string("\1\0\0\0", 4)}[upto(2)]);
        else if (kind == 2)
            bytes.erase(at, count);
        else
            bytes.insert(at, bytes.substr(at, count));
    }
    return bytes;
}

} // namespace

TEST_CASE("SPIR-V: a damaged module is refused in one line, or runs; it crashes nothing") {
    const Modules modules;
    const std::string good = content(modules.vertex());
    std::mt19937 random(11);
    std::vector<std::string> readable;
    std::string zero_bound = good;
    zero_bound.replace(12, 4, std::string("\1\0\0\0", 4));
    for (int i = 0; i < 100; ++i) {
        const std::string module = i == 0 ? zero_bound : damaged(good, random);
        try {
            const SpirvModule read = read_spirv("a.vert.spv", module, Stage::vertex);
            readable.push_back(module);
            CHECK_FALSE(glsl_of(read, true).empty());
        } catch (const Error& error) {
            CHECK_THAT(error.what(), Catch::StartsWith("shader a.vert.spv: "));
        }
    }
    CHECK(readable.size() < 50);
    if (!test::have_software_gl())
        return;
    readable.resize(std::min<std::size_t>(readable.size(), 6)); // what the driver's translator makes of them
    for (const std::string& module : readable) {
        std::ofstream(modules.vertex(), std::ios::binary) << module;
        const test::Outcome outcome = modules.check({}, "100", "1");
        CAPTURE(outcome.err);
        CHECK(outcome.signal == 0);
        CHECK((outcome.status != 2 || !test::refusal(outcome).empty()));
    }
}

} // namespace lockstep::test::spirv_test
