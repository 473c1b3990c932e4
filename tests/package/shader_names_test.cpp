#include <string>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/shader_names.hpp>
#include <lockstep/system.hpp>

#include "tests/temporary_folder.hpp"

namespace lockstep::test::shader_names_test {

using Catch::Contains;
using lockstep::test::TemporaryFolder;

/// Cells with a value and a tag, which a compute shader with names of its own steps.
namespace {

constexpr FieldId value{0, 0}, tag{0, 1}, place{0, 2};

const Schema& cells() {
    static const Schema all = checked(
        {"cells",
         {{.name = "cells",
           .item = "cell",
           .title = "the cells",
           .fields = {
               {.name = "value"}, {.name = "tag", .scalar = Scalar::int32}, {.name = "place", .components = 3}}}}});
    return all;
}

namespace site {
constexpr Site value{"value", "value"}, gain{"gain"}, tag{"tag"}, place{"place", "place"};
} // namespace site

template <class R> struct Cell {
    typename R::Real value;
    typename R::Int tag;
    typename R::Vec3 place;
    auto fields() const { return std::tie(value, tag, place); }
};

struct Step {
    template <class R> Cell<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const auto old = r.read(site::value, in.before.real(value, item));
        Cell<R> made{r.note(site::value, old * r.uniform(site::gain, 0.5F)), {}, {}};
        made.tag = r.uniform(site::tag, in.before.integer(tag, item)) + 1;
        made.place = r.note(site::place, r.read(site::place, in.before.vec3(place, item)) * 2.0F);
        return made;
    }
};

System system() {
    System made{
        .name = "cells", .schema = cells(), .passes = {}, .mistakes = {}, .start = {cells(), {{100}}}, .settings = {}};
    for (std::size_t i = 0; i < 100; ++i) {
        made.start.set(value, i, 1.0F + static_cast<float>(i));
        made.start.set(tag, i, static_cast<std::int32_t>(i) - 50);
        made.start.set(place, i, glm::vec3(1.0F, static_cast<float>(i), 3.0F));
    }
    made.passes.push_back(item_pass({.name = "step", .stage = PassStage::compute}, Step{}));
    return made;
}

const std::string shader = "#version 430 core\n"
                           "layout(local_size_x = 32) in;\n"
                           "struct C { vec3 at; float amount; int mark; };\n"
                           "layout(std430) readonly buffer Old { C old[]; };\n"
                           "layout(std430) writeonly buffer New { C made[]; };\n"
                           "layout(std140) uniform Frame { float gain; uint many; } frame;\n"
                           "void main() {\n"
                           "    uint i = gl_GlobalInvocationID.x;\n"
                           "    if (i >= frame.many) return;\n"
                           "    precise float amount = old[i].amount * frame.gain;\n"
                           "    made[i].amount = amount;\n"
                           "    made[i].mark = old[i].mark + 1;\n"
                           "    made[i].at = old[i].at + old[i].at;\n"
                           "}\n";

ShaderNames names() {
    ShaderNames all;
    all.uniform_blocks["Frame"] = {{"gain", "u_Gain"}, {"many", "u_ItemCount"}};
    all.storage_blocks["Old"] =
        ShaderNames::Names{{"amount", "CellsBefore.value"}, {"mark", "CellsBefore.tag"}, {"at", "CellsBefore.place"}};
    all.storage_blocks["New"] =
        ShaderNames::Names{{"amount", "CellsAfter.value"}, {"mark", "CellsAfter.tag"}, {"at", "CellsAfter.place"}};
    return all;
}

const Gl& gl() {
    static const Gl one;
    return one;
}

MatchResult match(const TemporaryFolder& folder, const std::string& text = shader) {
    folder.write("step.comp", text);
    const System made = system();
    std::vector<GlPass> passes{{.name = "step", .stage = Stage::compute}};
    passes.front().uniforms = [](int) { return Uniforms{{"u_Gain", 0.5F}}; };
    GlSystemSide gpu(gl(), made, std::move(passes), folder.path().string());
    return match_system(gpu, made, {.frames = 4});
}

std::string error_of(const ShaderNames& given) {
    const TemporaryFolder folder;
    folder.write("step.comp", shader);
    const NamedShaders bound(folder.path(), given);
    try {
        return "no error: " + match(folder).text();
    } catch (const Error& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("shader names: a compute shader of one's own system with its own blocks agrees, and is held to its twin") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    {
        const NamedShaders bound(folder.path(), names());
        LOCKSTEP_CHECK(match(folder));
        CHECK_FALSE(match(folder, std::string(shader).replace(shader.find("mark + 1"), 8, "mark + 2")).passed());
        CHECK_THROWS_WITH(NamedShaders(folder.path() / ".", names()), Contains("they are given already"));
    }
    {
        ShaderNames uniforms = names();
        uniforms.storage_blocks.clear();
        const NamedShaders bound(folder.path(), uniforms);
        CHECK_THROWS_WITH(match(folder), Contains("nothing is given for storage block ") &&
                                             Contains("; right is one of CellsAfter, CellsBefore"));
    }
    folder.write("bindings.json", names().json());
    LOCKSTEP_CHECK(match(folder));
}

TEST_CASE("shader names: those of a test count before the file's, and end with it") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    folder.write("bindings.json", "{ nothing");
    {
        const NamedShaders bound(folder.path(), names());
        LOCKSTEP_CHECK(match(folder));
    }
    CHECK_THROWS_WITH(match(folder), Contains("bindings.json:1:") && Contains("malformed JSON"));
}

TEST_CASE("shader names: what does not fit names the folder and the place") {
    if (!gl())
        return skip(gl().missing());
    ShaderNames number = names();
    number.uniform_blocks["Frame"].insert_or_assign("gain", 0.5);
    CHECK_THAT(error_of(number), Contains("AGREE"));
    ShaderNames misspelt = names();
    std::get<ShaderNames::Names>(misspelt.storage_blocks["Old"]).insert_or_assign("mark", "CellsBefore.tags");
    CHECK_THAT(error_of(misspelt), Contains("names of ") &&
                                       Contains("/storage_blocks/Old/mark: CellsBefore.tags is "
                                                "nothing here; right is a number, or one of count, ") &&
                                       Contains("did you mean CellsBefore.tag?"));
    ShaderNames other_type = names();
    std::get<ShaderNames::Names>(other_type.storage_blocks["Old"]).insert_or_assign("mark", "CellsBefore.value");
    CHECK_THAT(error_of(other_type), Contains("/storage_blocks/Old/mark: CellsBefore.value is float, but old.mark is "
                                              "int"));
    ShaderNames whole = names();
    whole.storage_blocks["Old"] = "CellBefore";
    CHECK_THAT(error_of(whole), Contains("/storage_blocks/Old: CellBefore is no storage block here; right is one of "
                                         "CellsAfter, CellsBefore; did you mean CellsBefore?"));
}

} // namespace lockstep::test::shader_names_test
