#include <string>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "reference/system/item_words.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::guard_test {

using lockstep::test::TemporaryFolder;

/// 100 numbers that are halved, in groups of 64: 28 invocations of the last group have none.
namespace {

namespace site {
inline constexpr Site before{"number before"}, number{"number", "number"};
} // namespace site

const Schema& schema() {
    static const Schema all = checked(
        {"halves", {{.name = "numbers", .item = "number", .title = "the numbers", .fields = {{.name = "number"}}}}});
    return all;
}
constexpr FieldId number{0, 0};

struct Halve {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        ItemWords<R> words;
        words.add(r.note(site::number, r.read(site::before, in.before.real(number, item)) * 0.5F));
        return words;
    }
};

System halves() {
    System system{.name = "halves",
                  .schema = schema(),
                  .passes = {},
                  .mistakes = {},
                  .start = {schema(), {{100}}},
                  .settings = {}};
    for (std::size_t i = 0; i < 100; ++i)
        system.start.set(number, i, static_cast<float>(i));
    system.passes.push_back(item_pass({.name = "halve", .stage = PassStage::compute}, Halve{}));
    return system;
}

const Gl& gl() {
    static const Gl one;
    return one;
}

CheckReport run(const std::string& guard) {
    const TemporaryFolder folder;
    folder.write("halve.comp", "#version 430 core\n"
                               "layout(local_size_x = 64) in;\n"
                               "uniform uint u_ItemCount;\n"
                               "layout(std430) readonly buffer NumbersBefore { float before[]; };\n"
                               "layout(std430) writeonly buffer NumbersAfter { float after[]; };\n"
                               "void main() {\n"
                               "    uint i = gl_GlobalInvocationID.x;\n" +
                                   guard +
                                   "    precise float half_of_it = before[i] * 0.5;\n"
                                   "    after[i] = half_of_it;\n"
                                   "}\n");
    const System system = halves();
    GlSystemSide side(gl(), system, {{.name = "halve", .stage = Stage::compute}}, folder.path().string());
    CheckOptions options;
    options.frames = 3;
    return check(system, side, options);
}

} // namespace

TEST_CASE("guard: a compute shader that returns behind the last item agrees, by count and by an array's length") {
    if (!gl())
        return skip(gl().missing());
    CHECK(run("    if (i >= u_ItemCount) return;\n").verdict == Verdict::agree);
    CHECK(run("    if (i >= uint(before.length())) return;\n").verdict == Verdict::agree);
}

TEST_CASE("guard: one that writes behind the last item is an error that says where to return") {
    if (!gl())
        return skip(gl().missing());
    const auto head = Catch::StartsWith("frame 0: halve ("); // a conjunction refers to its parts
    const auto tail = Catch::EndsWith("halve.comp) wrote past the end of NumbersAfter (100 numbers), at item 100; "
                                      "expected no write from item 100 on");
    const auto said = head && tail;
    CHECK_THROWS_WITH(run(""), said);
    CHECK_THROWS_WITH(run("    if (i > u_ItemCount) return;\n"), Catch::Contains("wrote past the end of NumbersAfter"));
    CHECK_THROWS_WITH(run("    const float some[2] = float[2](1.0, 2.0);\n    if (some.length() == 3) return;\n"),
                      said);
}

TEST_CASE("guard: a value that was read past the end of a buffer is known as one") {
    if (!gl())
        return skip(gl().missing());
    CHECK_THROWS_WITH(
        run("    if (i >= u_ItemCount) return;\n    if (i == 7u) { after[i] = before[i + 100u]; return; }\n"),
        "frame 0: halve read past the end of a buffer, and wrote what lies there into number 7");
}

TEST_CASE("guard: blocks that bindings.json binds by member are watched, in an array without a size and in one") {
    if (!gl())
        return skip(gl().missing());
    for (const std::string size : {"", "128"})
        for (const std::string guard : {"if (i >= u_ItemCount) return;", ""}) {
            const TemporaryFolder folder;
            folder.write("halve.comp", "#version 430 core\n"
                                       "layout(local_size_x = 64) in;\n"
                                       "uniform uint u_ItemCount;\n"
                                       "layout(std430) readonly buffer Old { float old_ones[" +
                                           size + "]; };\nlayout(std430) writeonly buffer New { float new_ones[" +
                                           size +
                                           "]; };\n"
                                           "void main() {\n"
                                           "    uint i = gl_GlobalInvocationID.x;\n    " +
                                           guard + "\n    new_ones[i] = old_ones[i] * 0.5;\n}\n");
            folder.write("bindings.json", R"({"storage_blocks": {"Old": {"old_ones": "NumbersBefore.number"},
                                                                "New": {"new_ones": "NumbersAfter.number"}}})");
            const System system = halves();
            GlSystemSide side(gl(), system, {{.name = "halve", .stage = Stage::compute}}, folder.path().string());
            CheckOptions options;
            options.frames = 1;
            if (guard.empty())
                CHECK_THROWS_WITH(check(system, side, options), Catch::StartsWith("frame 0: halve (") &&
                                                                    Catch::Contains("wrote past the end of New"));
            else
                CHECK(check(system, side, options).verdict == Verdict::agree);
        }
}

} // namespace lockstep::test::guard_test
