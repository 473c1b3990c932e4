#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "gpu/program.hpp"
#include "gpu/taken_branches.hpp"
#include "reference/model/error.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::taken_branches_test {

/// Which included files the preprocessor takes, held to the driver's own where that is known.
using test::TemporaryFolder;

namespace {

constexpr const char* before = "#version 330 core\n"
                               "#define ZERO 0\n"
                               "#define ONE 1\n"
                               "#define TWO (ONE + ONE) /* of macros */\n"
                               "#define SUM 1 + 1\n"
                               "#define OF_SUM SUM * 2\n"
                               "#define IS ==\n"
                               "#define EMPTY\n"
                               "#define GONE 1\n"
                               "#undef GONE\n";

/// A stage that includes taken.glsl under a condition.
ShaderSource stage_of(const TemporaryFolder& folder, const std::string& conditions, const std::string& included) {
    folder.write("taken.glsl", included);
    folder.write("a.vert", before + conditions + "\nvoid main() { gl_Position = vec4(0.0); }\n");
    return load_stage({folder.path()}, "a", Stage::vertex, {{"FILTER", "FILTER_FLOW"}, {"FILTER_FLOW", "2"}});
}

bool is_taken(const ShaderSource& stage) { return taken_files(stage).at(1); }

bool driver_takes(const TemporaryFolder& folder, const std::string& conditions) {
    const std::vector<ShaderSource> stages{stage_of(folder, conditions, "#error this is taken\n")};
    try {
        outputs_with("out_", stages);
    } catch (const Error& error) {
        INFO(error.what());
        CHECK(std::string(error.what()).find("this is taken") != std::string::npos);
        return true;
    }
    return false;
}

const std::string include = "\n#include \"taken.glsl\"\n";

} // namespace

TEST_CASE("taken branches: an included file is taken where the driver takes it") {
    const auto context = test::open_context(test::software_gl());
    if (!context)
        return;
    const TemporaryFolder folder;
    const std::string conditions = GENERATE_COPY(
        "#if 1" + include + "#endif", "#if 0" + include + "#endif", "#if 0\n#else" + include + "#endif",
        "#if 1\n#else" + include + "#endif", "#if 0\n#elif ONE" + include + "#endif",
        "#if 1\n#elif ONE" + include + "#endif", "#if 0\n#elif 0\n#elif 1\n#elif 1" + include + "#endif",
        "#ifdef ONE" + include + "#endif", "#ifndef ONE" + include + "#endif", "#ifdef GONE" + include + "#endif",
        "#ifdef EMPTY" + include + "#endif", "#if defined ONE && !defined(NOWHERE)" + include + "#endif",
        "#if FILTER == FILTER_FLOW" + include + "#endif", "#if FILTER != FILTER_FLOW" + include + "#endif",
        "#if FILTER == 1 || FILTER == 2" + include + "#endif", "#if TWO * 2 == 4" + include + "#endif",
        "#if (1 + 2 * 3 == 7) == ONE" + include + "#endif", "#if 7 / 2 == 3 && 7 % 4 == 3" + include + "#endif",
        "#if SUM * 2 == 3" + include + "#endif", "#if 2 * SUM == 4" + include + "#endif",
        "#if OF_SUM IS 3" + include + "#endif", "#if -SUM == 0 && defined(SUM)" + include + "#endif",
        "#if EMPTY 1 EMPTY" + include + "#endif", "#if (1 << 4) >> 2 == 4" + include + "#endif",
        "#if (6 & 3) == 2 && (6 | 1) == 7 && (6 ^ 3) == 5" + include + "#endif",
        "#if -1 < 0 && !0 && ~0 == -1 && +1 > 0" + include + "#endif",
        "#if 0x10 == 16 && 010 == 8" + include + "#endif", "#if 3 <= 2 || 2 >= 3" + include + "#endif",
        "#if 1 /* and */ && 0 // never" + include + "#endif", "#if 0\n#if 1\n#else\n#endif\n#else" + include + "#endif",
        "#if 0\n#if 1" + include + "#endif\n#endif", "#if 1\n#define LATE 1\n#endif\n#if LATE" + include + "#endif",
        "#if 0\n#define LATE 1\n#endif\n#ifdef LATE" + include + "#endif", "#if ONE && \\\n ZERO" + include + "#endif",
        "/*\n#if 0\n*/" + include, "// c \\\n#if 0" + include, "#if 0 /* a\n b */ || 1" + include + "#endif",
        "#if 1 /* a\n b */ && 0" + include + "#endif", "#define LATE 0 /*\n*/ + 1\n#if LATE" + include + "#endif",
        "#define LATE 1 // c \\\n#undef LATE\n#ifdef LATE" + include + "#endif", "/*" + include + "*/",
        "// c \\" + include, "#if __VERSION__ >= 450" + include + "#endif",
        "#if __VERSION__ < 450" + include + "#endif", "#ifdef GL_ES" + include + "#endif",
        "#if 0\r\n#else // \\\r\n#endif" + include + "#endif", "/* #if 0 */" + include, "//#if 0" + include,
        "#if ZERO - ONE" + include + "#endif");
    INFO(conditions);
    CHECK(is_taken(stage_of(folder, conditions, "float taken;\n")) == driver_takes(folder, conditions));
}

TEST_CASE("taken branches: both ways count where what a condition asks for is not known") {
    const TemporaryFolder folder;
    const std::string condition =
        GENERATE("#if __LINE__ >= 130", "#ifdef GL_core_profile", "#ifndef GL_es_profile", "#ifdef LOCKSTEP_TRACE",
                 "#if 1 +", "#if", "#if (1", "#ifdef GL_core_profile\n#define MAY_BE 1\n#endif\n#if MAY_BE == 1",
                 "#ifdef GL_core_profile\n#undef ONE\n#endif\n#ifdef ONE");
    CAPTURE(condition);
    CHECK(is_taken(stage_of(folder, condition + include + "#endif", "float taken;\n")));
    CHECK(is_taken(stage_of(folder, condition + "\n#else" + include + "#endif", "float taken;\n")));
}

TEST_CASE("taken branches: deep brackets and unmatched lines are no harm") {
    const TemporaryFolder folder;
    const std::string lines = GENERATE("#endif", "#else", "#elif 0", "#if 0", "#");
    CAPTURE(lines);
    stage_of(folder, lines + include, "float taken;\n");
    const std::string deep = "#if " + std::string(100'000, '(');
    CHECK(is_taken(stage_of(folder, deep + include + "#endif", "float taken;\n")));
    CHECK(is_taken(stage_of(folder, "#if " + std::string(100'000, '!') + include + "#endif", "float taken;\n")));
}

TEST_CASE("taken branches: a file that only includes others is taken, and every inclusion is one of its own") {
    const TemporaryFolder folder;
    folder.write("outer.glsl", "#include \"taken.glsl\"\n");
    const ShaderSource stage =
        stage_of(folder, "#include \"outer.glsl\"\n#if 0" + include + "#endif", "float taken;\n");
    CHECK(taken_files(stage) == std::vector<bool>{true, true, true, false});
}

} // namespace lockstep::test::taken_branches_test
