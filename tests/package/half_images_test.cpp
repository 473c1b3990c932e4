#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "crosscheck/judge/system_run.hpp"
#include "reference/paired_rows.hpp"
#include "reference/stored_half.hpp"
#include "reference/system/item_words.hpp"
#include "reference/system/stored_pass.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::half_images_test {

using lockstep::test::TemporaryFolder;

/// A system of two images of halves, whose twins say nothing of halves: `fog` is made by a compute pass, `mist` drawn
/// by points at places of its own.
namespace {

enum : std::uint8_t { drops, fog, mist };
constexpr FieldId place{drops, 0}, weight{drops, 1}, of_fog{fog, 0};
constexpr Extent flat{8, 4, 1};

namespace site {
inline constexpr Site weight{"weight"}, fog{"fog"}, mist{"mist"}, share{"share"};
} // namespace site

const Schema& schema() {
    static const Schema all = checked({"weather",
                                       {{.name = "drops",
                                         .item = "drop",
                                         .title = "the drops",
                                         .fields = {{.name = "place", .components = 2}, {.name = "weight"}}},
                                        {.name = "fog",
                                         .item = "texel",
                                         .title = "the fog",
                                         .fields = {{.name = "fog"}},
                                         .dimensions = 2,
                                         .format = "r16f"},
                                        {.name = "mist",
                                         .item = "texel",
                                         .title = "the mist",
                                         .fields = {{.name = "mist"}},
                                         .dimensions = 2,
                                         .format = "r16f"}}});
    return all;
}

struct Fog {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        const auto old = r.read(site::fog, in.before.real(of_fog, item));
        ItemWords<R> words;
        words.add(r.note(site::fog, old * r.uniform(site::share, 0.7F) + typename R::Real(0.1F)));
        return words;
    }
};

struct Mist {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        ItemWords<R> words;
        words.add(
            r.note(site::mist, r.read(site::weight, in.before.real(weight, item)) * r.uniform(site::share, 0.3F)));
        return words;
    }
};

System system() {
    System made{.name = "weather",
                .schema = schema(),
                .passes = {},
                .mistakes = {},
                .start = {schema(), {{32}, flat, flat}},
                .settings = {}};
    for (std::size_t i = 0; i < 32; ++i) {
        made.start.set(place, i, glm::vec2(static_cast<float>(i % 8), static_cast<float>(i / 8)));
        made.start.set(weight, i, 1.0F + 0.37F * static_cast<float>(i));
    }
    made.passes.push_back(item_pass({.name = "fog", .resource = fog, .stage = PassStage::compute}, Fog{}));
    made.passes.push_back(item_pass({.name = "mist", .resource = mist}, Mist{}));
    return made;
}

std::vector<GlPass> passes() {
    std::vector<GlPass> all{{.name = "fog", .stage = Stage::compute, .resource = fog},
                            {.name = "mist", .resource = mist}};
    all[1].draw = GlDraw{.buffer = drops};
    return all;
}

/// `fog_stored`, `mist_stored`: the expressions that are stored.
void write_shaders(const TemporaryFolder& folder, const std::string& fog_stored = "fog",
                   const std::string& mist_stored = "mist") {
    folder.write("fog.comp", "#version 430 core\n"
                             "layout(local_size_x = 8, local_size_y = 4) in;\n"
                             "uniform sampler2D u_FogBefore;\n"
                             "layout(r16f) writeonly uniform image2D u_FogAfter;\n"
                             "void main() {\n"
                             "    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);\n"
                             "    precise float fog = texelFetch(u_FogBefore, texel, 0).x * 0.7 + 0.1;\n"
                             "    imageStore(u_FogAfter, texel, vec4(" +
                                 fog_stored + "));\n}\n");
    folder.write("mist.vert", "#version 330 core\n"
                              "in vec2 a_Place;\n"
                              "in float a_Weight;\n"
                              "flat out float weight;\n"
                              "void main() {\n"
                              "    weight = a_Weight;\n"
                              "    gl_Position = vec4((a_Place + 0.5) / vec2(4.0, 2.0) - 1.0, 0.0, 1.0);\n}\n");
    folder.write("mist.frag", "#version 330 core\n"
                              "flat in float weight;\n"
                              "out float o_Mist;\n"
                              "void main() {\n"
                              "    float mist = weight * 0.3;\n"
                              "    o_Mist = " +
                                  mist_stored + ";\n}\n");
}

const Gl& gl() {
    static const Gl one;
    return one;
}

CheckReport run(const TemporaryFolder& shaders) {
    const System made = system();
    GlSystemSide side(gl(), made, passes(), shaders.path().string());
    CheckOptions options;
    options.frames = 6;
    return check(made, side, options);
}

} // namespace

TEST_CASE("half images: twins that say nothing of halves agree with what the driver stores, in draws and imageStore") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder shaders;
    write_shaders(shaders);
    const CheckReport report = run(shaders);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.total.compared() == std::uint64_t{6} * (32 + 32));
}

TEST_CASE("half images: a value one half off is divergent, and explain has the stored half on both sides") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder shaders;
    write_shaders(shaders, "fog + exp2(-11.0)", "mist * (1.0 + exp2(-9.0))");
    const CheckReport report = run(shaders);
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::divergent);
    CHECK(report.total.differing(fog) > 0);
    CHECK(report.total.differing(mist) > 0);
    const System made = system();
    GlSystemSide side(gl(), made, passes(), shaders.path().string());
    SystemRun frame(made, side, measured_operations(side.describe().profile), 0, 1);
    CHECK(is_half(frame.judged().reference.value(0, 5, 0).real()));
    CHECK_THAT(explain_item(frame, 5), Catch::Contains("divergent"));
    CHECK(judge(cut_item_capsule(frame, 5, "here"), made).kind == DifferenceClass::divergent);
}

TEST_CASE("half images: a driver of which nothing was measured may store either neighbour, and no third") {
    const System made = system();
    const auto stored = stored_pass(*made.passes[1], schema());
    const SystemView start = made.start.view();
    const PassInput in{start, 0};
    const auto legal = [&](const Profile& profile, float value) {
        const auto outcomes = stored->outcomes(in, 5, profile, KnownOperations::all(), nullptr);
        return outcomes.at(0).values.at(0).contains(value);
    };
    const float exact = (1.0F + 0.37F * 5.0F) * 0.3F;
    const float below = half_toward(exact, false), above = half_toward(exact, true);
    REQUIRE(below < above);
    Profile open, cuts, rounds;
    cuts.not_followed = {std::string(drawn_half_rows.first)};
    rounds.not_followed = {std::string(drawn_half_rows.second)};
    CHECK((legal(open, below) && legal(open, above)));
    CHECK_FALSE(legal(open, half_toward(std::nextafter(above, 2.0F), true)));
    CHECK((legal(cuts, below) && !legal(cuts, above)));
    CHECK(legal(rounds, half_nearest(exact)));
    CHECK_FALSE((legal(rounds, below) && legal(rounds, above)));
}

} // namespace lockstep::test::half_images_test
