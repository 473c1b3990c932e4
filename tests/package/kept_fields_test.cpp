#include <cstdint>
#include <fstream>
#include <string>
#include <tuple>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "tests/system_run.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::kept_fields_test {

using lockstep::test::run_system;
using lockstep::test::TemporaryFolder;

/// Sparks of a hue that cool, and keep their hue.
namespace {

namespace site {
inline constexpr Site heat{"heat", "heat"}, hue{"hue", "hue"}, before{"heat before"}, loss{"loss"};
} // namespace site

const Schema& schema() {
    static const Schema all = checked({"sparks",
                                       {{.name = "sparks",
                                         .item = "spark",
                                         .title = "the sparks",
                                         .fields = {{.name = "heat", .block = "heatBuffer"},
                                                    {.name = "hue", .components = 3, .block = "hueBuffer"}}}}});
    return all;
}
constexpr FieldId heat{0, 0}, hue{0, 1};
constexpr std::size_t count = 1500;

/// `fades_in`: the frame in which the twin, but not the pass's word, changes a hue.
struct Cool {
    int fades_in = -1;
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        struct Spark {
            typename R::Real heat;
            typename R::Vec3 hue;
            auto fields() const { return std::tie(heat, hue); }
        };
        Spark spark{r.read(site::before, in.before.real(heat, item)), r.read(site::hue, in.before.vec3(hue, item))};
        spark.heat = r.note(site::heat, spark.heat - r.uniform(site::loss, 0.25F));
        if (in.frame == fades_in && item == 77)
            spark.hue.x = spark.heat;
        return spark;
    }
};

System sparks(Cool twin = {}) {
    System system{.name = "sparks",
                  .schema = schema(),
                  .passes = {},
                  .mistakes = {},
                  .start = {schema(), {{count}}},
                  .settings = {}};
    system.passes.push_back(item_pass(
        {.name = "cool", .stage = PassStage::compute, .in_place = from_any_state, .keeps = {hue.field}}, twin));
    for (std::size_t i = 0; i < count; ++i) {
        system.start.set(heat, i, static_cast<float>(i % 23) * 0.13F);
        system.start.set(hue, i, glm::vec3(0.5F, 0.25F, static_cast<float>(i)));
    }
    return system;
}

/// `more` stands behind the step, and may use `frame` and hues.
CheckReport run(const std::string& more, CheckMode mode, const System& system = sparks()) {
    const TemporaryFolder folder;
    std::ofstream shader(folder.path() / "cool.comp");
    shader << "#version 430 core\n"
              "layout(local_size_x = 64) in;\n"
              "layout(std430) buffer heatBuffer { float heat[]; };\n";
    if (!more.empty())
        shader << "layout(std430) buffer hueBuffer { float hue[]; };\n"
                  "uniform int frame;\n";
    shader << "uniform uint u_ItemCount;\n"
              "void main() {\n"
              "    uint i = gl_GlobalInvocationID.x;\n"
              "    if (i >= u_ItemCount)\n"
              "        return;\n"
              "    heat[i] = heat[i] - 0.25;\n"
           << more << "}\n";
    shader.close();
    GlPass cool{.name = "cool", .stage = Stage::compute};
    if (!more.empty())
        cool.uniforms = [](int frame) { return Uniforms{{"frame", frame}}; };
    return run_system(system, {cool}, folder.path().string(), ArithmeticSwitch::plain, 20, mode);
}

} // namespace

TEST_CASE("kept fields: a run in which they are neither copied nor compared again is the same run") {
    if (!test::gl())
        return skip(test::gl().missing());
    for (const CheckMode mode : {CheckMode::resync, CheckMode::free}) {
        const CheckReport report = run("", mode);
        INFO(report_text(report, {}));
        CHECK(report.verdict == Verdict::agree);
        CHECK(report.total.compared() == std::uint64_t{20} * 4 * count);
        CHECK(report.reference_hash == report.gpu_hash);
        const System system = sparks();
        ReferenceRun alone(system, named_profile("strict"));
        for (int frame = 0; frame < 20; ++frame)
            alone.step(frame);
        CHECK(report.reference_hash == alone.hash());
    }
}

TEST_CASE("kept fields: a shader that changes one in a late frame diverges there") {
    if (!test::gl())
        return skip(test::gl().missing());
    const CheckReport judged = run("    if (frame == 12 && i == 77u) hue[3u * i] = 9.0;\n", CheckMode::resync);
    REQUIRE(judged.verdict == Verdict::divergent);
    CHECK(judged.verdicts->first->wrong.step == "cool, hue");
    CHECK(judged.verdicts->first->place.frame == 12);
    CHECK(judged.verdicts->first->place.index == 77);
    CHECK(judged.total[hue].differing == 1);
    const CheckReport free = run("    if (frame == 12 && i == 77u) hue[3u * i] = 9.0;\n", CheckMode::free);
    CHECK(free.verdict == Verdict::differ);
    CHECK(free.total[hue].differing == 8); // from then on
    CHECK(free.reference_hash != free.gpu_hash);
}

TEST_CASE("kept fields: a twin that changes what its pass keeps is an error") {
    if (!test::gl())
        return skip(test::gl().missing());
    CHECK_THROWS_WITH(run("", CheckMode::resync, sparks({0})),
                      "frame 0: the reference of cool changes hue of spark 77, which the pass keeps here "
                      "(ItemPassOptions::keeps of a twin of your own)");
}

TEST_CASE("kept fields: two states share a column until one of them is written") {
    SystemState one = sparks().start, other(schema(), {{count}});
    other.share(hue, one);
    const SystemState copy = other;
    const View view = std::as_const(one)[0];
    CHECK(std::as_const(other)[0].columns[hue.field] == view.columns[hue.field]);
    CHECK(copy.view().vec3(hue, 5) == glm::vec3(0.5F, 0.25F, 5.0F));
    other.set(hue, 5, glm::vec3(1.0F));
    CHECK(one.view().vec3(hue, 5) == glm::vec3(0.5F, 0.25F, 5.0F));
    CHECK(other.view().vec3(hue, 5) == glm::vec3(1.0F));
    CHECK(other.view().vec3(hue, 6) == one.view().vec3(hue, 6));
    CHECK(std::as_const(one)[0].columns[hue.field] == view.columns[hue.field]);
}

} // namespace lockstep::test::kept_fields_test
