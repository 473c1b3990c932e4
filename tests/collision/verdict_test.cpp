#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/collision/judge/diagnosis.hpp"
#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/verdict_summary.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include <nlohmann/json.hpp>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/triangle_interpolation.hpp"
#include "tests/collision/collision_scenes.hpp"
#include "tests/collision/deviating_step.hpp"

namespace lockstep::test::verdict_test {

namespace {

/// A frame on both sides; the GPU's starts as a copy of the reference's.
struct Frame {
    RandomScene scene;
    Profile profile;
    KnownOperations known;
    Mesh obstacles;
    Particles reference, gpu;
    CollisionImage reference_cdt, gpu_cdt;

    explicit Frame(const std::string& preset_name, const std::string& profile_name = "llvmpipe")
        : scene(random_scene(23, 1500, 61, 47)), profile(named_profile(profile_name)),
          known(measured_operations(profile)) {
        scene.params.switches = preset(preset_name);
        update_particles(scene.particles, scene.cdt, scene.params, profile, reference);
        gpu = reference;
        reference_cdt = drawn(reference);
        gpu_cdt = reference_cdt;
    }
    [[nodiscard]] CollisionImage drawn(const Particles& particles) const {
        CollisionImage cdt = empty_cdt(scene.params);
        DepthImage depth(cdt.width, cdt.height, 1.0F);
        rasterise_particles(scene.particles, particles, scene.params, profile, cdt, depth);
        return cdt;
    }
    [[nodiscard]] JudgedFrame judged() const {
        return {obstacles, scene.params, profile,       known, scene.particles,
                scene.cdt, reference,    reference_cdt, gpu,   gpu_cdt};
    }
};

float& component(ParticleState& s, int c) {
    return c < 3 ? s.position[c] : c < 6 ? s.direction[c - 3] : c < 7 ? s.speed : s.collide_time;
}

std::string field_of(int c) {
    return collision_schema()[c < 3   ? collision::position
                              : c < 6 ? collision::direction
                              : c < 7 ? collision::speed
                                      : collision::collide_time]
        .name;
}

} // namespace

TEST_CASE("verdict: faults of one bit, anywhere in the state, are located exactly") {
    Frame frame("corrected");
    Random random(1);
    int planted = 0;
    for (int fault = 0; fault < 1000; ++fault) {
        const std::size_t particle = random.below(1500);
        const int c = static_cast<int>(random.below(8));
        frame.gpu = frame.reference;
        ParticleState state = frame.gpu[particle];
        const float before = component(state, c);
        component(state, c) = std::bit_cast<float>(std::bit_cast<std::uint32_t>(before) ^ (1U << random.below(32)));
        if (component(state, c) == before)
            continue; // the sign of a zero, which GLSL leaves open
        frame.gpu.set(particle, state);
        ++planted;
        const FrameVerdicts verdicts = judge(frame.judged());
        REQUIRE(verdicts.texels.empty());
        REQUIRE(verdicts.particles.size() == 1);
        REQUIRE(verdicts.particles[0].index == particle);
        REQUIRE(verdicts.particles[0].kind == DifferenceClass::divergent);
        const auto first = first_of(DifferenceClass::divergent, 7, frame.judged(), verdicts);
        REQUIRE(first);
        CHECK(first->place.frame == 7);
        CHECK(first->place.index == particle);
        CHECK_FALSE(first->wrong.operation.empty());
        const Difference& shown = first->wrong.difference;
        CHECK(collision_schema()[shown.field].name == field_of(c));
        CHECK(lockstep::same_bits(shown.reference, before));
        CHECK(lockstep::same_bits(shown.gpu, component(state, c)));
    }
    CHECK(planted > 900);
}

TEST_CASE("verdict: a decision that alone explains the state where it is made otherwise is the wrong step") {
    struct Case {
        Deviation made;
        const char *step, *instead;
    };
    for (const Case& one : {Case{Deviation::last_found_instead_of_nearest, "nearest", "took ("},
                            Case{Deviation::never_collides, "nearest", "took none"},
                            Case{Deviation::own_texel_not_skipped, "nearest", "computed as with this mistake: "},
                            Case{Deviation::collide_time_not_counted, "collide time", ""}}) {
        Frame frame("corrected");
        const FrameInputs inputs{
            .before = &frame.scene.particles, .cdt = &frame.scene.cdt, .params = &frame.scene.params};
        int differing = 0;
        for (std::size_t i = 0; i < 1500; ++i) {
            const ParticleState wrong = deviating_step(inputs, i, frame.profile, one.made);
            if (lockstep::same_bits(wrong, frame.reference[i]))
                continue;
            frame.gpu.set(i, wrong);
            const WrongStep step = wrong_step_of_particle(frame.judged(), i);
            CAPTURE(i, step.operation);
            CHECK(step.step == one.step);
            CHECK(step.gpu.starts_with(one.instead));
            CHECK(step.gpu.empty() == (*one.instead == 0));
            ++differing;
        }
        CHECK(differing > 3);
    }
}

TEST_CASE("verdict: what a frame found for one question of texels serves the next, and who finds it does not matter") {
    const auto text = [](const std::vector<LegalTexel>& legal) {
        std::string all;
        for (const LegalTexel& texel : legal) {
            for (const TexelOwner& o : texel.owners)
                all += fmt::format("{} {} {} {} {} ", static_cast<int>(o.kind), o.index, o.is_reference, o.sure,
                                   o.edge_margin);
            all += "/";
        }
        return all;
    };
    int several = 0;
    for (const Step step : {Step::transform_feedback, Step::compute}) {
        Frame frame("corrected", "nvidia");
        frame.known = {}; // what GL says alone, so that points may land on several texels
        FrameParams& params = frame.scene.params;
        params.switches.step = step;
        std::vector<std::int32_t> drawn(frame.gpu.size());
        point_texels_fast(frame.gpu.position, params, frame.profile, drawn);
        const auto asked = [&](std::span<const std::int32_t> texels) {
            return DrawnFrame(frame.obstacles, frame.scene.particles, frame.gpu, params, frame.profile, texels);
        };
        const DrawnFrame shared = asked(drawn), finding = asked({});
        Random random(5);
        for (int question = 0; question < 100; ++question) {
            std::vector<std::size_t> texels{random.below(61 * 47)};
            for (std::uint64_t i = random.below(4); i > 0; --i)
                texels.push_back((texels.front() + random.below(4) + 61 * random.below(4)) % (61 * 47));
            const auto near = shared.points_near(texels);
            REQUIRE(std::is_sorted(near.begin(), near.end()));
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                const bool beside = std::any_of(texels.begin(), texels.end(), [&](std::size_t texel) {
                    const int t = static_cast<int>(texel);
                    return std::abs(drawn[i] % 61 - t % 61) <= 1 && std::abs(drawn[i] / 61 - t / 61) <= 1;
                });
                if (drawn[i] == no_texel || beside)
                    REQUIRE(std::binary_search(near.begin(), near.end(), i));
            }
            for (const bool known : {true, false}) {
                frame.known.subnormals = known;
                const std::vector<LegalTexel> fresh = legal_texels(asked({}), frame.known, texels);
                REQUIRE(text(legal_texels(shared, frame.known, texels)) == text(fresh));
                REQUIRE(text(legal_texels(finding, frame.known, texels)) == text(fresh));
                several += fresh.front().owners.size() > 1;
            }
        }
    }
    CHECK(several > 20);
}

TEST_CASE("verdict: faults of one bit in a texel are located exactly") {
    Frame frame("corrected");
    Random random(2);
    for (int fault = 0; fault < 200; ++fault) {
        const std::size_t texel = random.below(61 * 47);
        const int c = static_cast<int>(random.below(4));
        frame.gpu_cdt = frame.reference_cdt;
        float& value = frame.gpu_cdt.texels[texel][c];
        value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ (1U << random.below(32)));
        const FrameVerdicts verdicts = judge(frame.judged());
        REQUIRE(verdicts.particles.empty());
        REQUIRE(verdicts.texels.size() == 1);
        CHECK(verdicts.texels[0].index == texel);
        CHECK(verdicts.texels[0].kind == DifferenceClass::divergent);
        const auto first = first_of(DifferenceClass::divergent, 0, frame.judged(), verdicts);
        REQUIRE(first);
        CHECK(first->wrong.difference.component == c);
        CHECK_FALSE(first->wrong.step.empty());
    }
}

TEST_CASE("verdict: what another driver computes is rounding or a tie by GLSL's rules, and so are its texels") {
    Frame frame("corrected", "strict");
    frame.known = {};
    for (const char* driver : {"llvmpipe", "nvidia"}) {
        update_particles(frame.scene.particles, frame.scene.cdt, frame.scene.params, named_profile(driver), frame.gpu);
        frame.gpu_cdt = frame.drawn(frame.gpu);
        const FrameVerdicts verdicts = judge(frame.judged());
        CHECK(verdicts.particles.size() > 100);
        CHECK(verdicts.texels.size() > 20);
        for (const auto* items : {&verdicts.particles, &verdicts.texels})
            for (const ItemVerdict& item : *items)
                CHECK(item.kind <= DifferenceClass::tie);
    }
}

TEST_CASE("verdict: a texel follows its particle's class, and one drawn elsewhere does not") {
    Frame frame("corrected");
    std::size_t particle = 0;
    while (point_fragment(frame.reference.position[particle], frame.scene.params, frame.profile).x < 3)
        ++particle;
    frame.gpu.position[particle].x += 0.5F;
    frame.gpu_cdt = frame.drawn(frame.gpu);
    FrameVerdicts verdicts = judge(frame.judged());
    REQUIRE(verdicts.particles.size() == 1);
    REQUIRE_FALSE(verdicts.texels.empty());
    for (const ItemVerdict& item : verdicts.texels) {
        CHECK(item.kind == DifferenceClass::divergent);
        CHECK(item.follows_particle);
    }
    // The same particles, drawn one texel to the right.
    frame.gpu = frame.reference;
    for (int y = 0; y < 47; ++y)
        for (int x = 1; x < 61; ++x)
            frame.gpu_cdt.at(x, y) = frame.reference_cdt.at(x - 1, y);
    verdicts = judge(frame.judged());
    CHECK(verdicts.particles.empty());
    CHECK(verdicts.texels.size() > 500);
    for (const ItemVerdict& item : verdicts.texels) {
        CHECK(item.kind == DifferenceClass::divergent);
        CHECK_FALSE(item.follows_particle);
    }
    const auto first = first_of(DifferenceClass::divergent, 0, frame.judged(), verdicts);
    REQUIRE(first);
    CHECK((first->wrong.step == "window position" || first->wrong.step == "texel"));
}

TEST_CASE("verdict: an obstacle's texel may lie within the bound of its interpolation, in every format") {
    for (const CdtFormat format : {CdtFormat::rgba32f, CdtFormat::rgba16f, CdtFormat::rgba8}) {
        Frame frame("corrected", "nvidia");
        frame.scene.params.cdt_box = {glm::vec3(-2.0F), glm::vec3(2.0F)};
        frame.scene.params.switches.cdt_format = format;
        frame.obstacles.positions = {{-0.9F, -0.9F, 0.9F}, {0.9F, -0.8F, 0.7F}, {0.1F, 0.9F, 0.8F}};
        frame.obstacles.indices = {0, 1, 2};
        const auto drawn = [&] {
            CollisionImage cdt = empty_cdt(frame.scene.params);
            DepthImage depth(cdt.width, cdt.height, 1.0F);
            obstacle_pass(frame.obstacles, frame.scene.params, frame.profile, cdt, depth);
            rasterise_particles(frame.scene.particles, frame.reference, frame.scene.params, frame.profile, cdt, depth);
            return cdt;
        };
        frame.scene.params.switches.cdt_format = CdtFormat::rgba32f;
        const CollisionImage exact = drawn();
        frame.scene.params.switches.cdt_format = format;
        frame.reference_cdt = frame.gpu_cdt = drawn();
        const CollisionCode code(frame.scene.params);
        const glm::vec3 bound(interpolation_bound(-0.9F, 0.9F, 0.1F), interpolation_bound(-0.9F, -0.8F, 0.9F),
                              interpolation_bound(0.9F, 0.7F, 0.8F));
        int moved = 0;
        for (std::size_t i = 0; i < exact.texels.size(); ++i) {
            const glm::vec3 position(exact.texels[i]);
            if (position.z < 0.5F) // a particle's
                continue;
            frame.gpu_cdt.texels[i] = code.encode(position + 0.9F * bound);
            moved += !lockstep::same_bits(frame.gpu_cdt.texels[i], frame.reference_cdt.texels[i]);
        }
        INFO(moved);
        CHECK(moved > 0);
        for (const ItemVerdict& item : judge(frame.judged()).texels)
            CHECK(item.kind == DifferenceClass::rounding);
        const std::size_t middle = frame.gpu_cdt.index(30, 20);
        frame.gpu_cdt = frame.reference_cdt;
        frame.gpu_cdt.texels[middle] = code.encode(glm::vec3(exact.texels[middle]) + glm::vec3(0.05F, 0.0F, 0.0F));
        const FrameVerdicts far = judge(frame.judged());
        REQUIRE(far.texels.size() == 1);
        CHECK(far.texels[0].kind == DifferenceClass::divergent);
    }
}

TEST_CASE("verdict: what a driver makes of plain floats is rounding, and two codes further is divergent") {
    for (const CdtFormat format : {CdtFormat::rgba16f, CdtFormat::rgba8}) {
        INFO(static_cast<int>(format));
        Frame frame("corrected");
        frame.scene.params.cdt_box = {glm::vec3(-2.0F), glm::vec3(2.0F)};
        frame.scene.params.switches.cdt_format = format;
        frame.reference_cdt = frame.gpu_cdt = frame.drawn(frame.reference);
        // The code next to what the reference rounds to, on the side of the position itself.
        const auto code_of = [&](double x, bool above) {
            const double unit = format == CdtFormat::rgba8 ? 4.0 / 255.0 : std::ldexp(1.0, std::ilogb(x) - 10);
            const double place = format == CdtFormat::rgba8 ? (x + 2.0) / unit : x / unit;
            const double code = above ? std::ceil(place) : std::floor(place);
            return static_cast<float>(format == CdtFormat::rgba8 ? code : code * unit);
        };
        std::map<std::pair<float, float>, glm::vec3> positions; // by stored code, x and y
        const CollisionCode encoder(frame.scene.params);
        for (const glm::vec3& p : frame.reference.position) {
            const glm::vec4 code = encoder.encode(p);
            if (const auto [entry, is_new] = positions.emplace(std::pair(code.x, code.y), p); !is_new)
                entry->second = glm::vec3(NAN); // either of several
        }
        std::size_t last = 0;
        for (std::size_t i = 0; i < frame.gpu_cdt.texels.size(); ++i) {
            glm::vec4& texel = frame.gpu_cdt.texels[i];
            if (texel.a == 0.0F || std::abs(texel.z) < 0x1p-10F)
                continue;
            const glm::vec3 p = positions.at({texel.x, texel.y});
            if (std::isnan(p.x))
                continue;
            for (int c = 0; c < 2; ++c)
                texel[c] = code_of(static_cast<double>(p[c]), (i + static_cast<std::size_t>(c)) % 2 == 0);
            last = i;
        }
        const auto worst = [&] {
            DifferenceClass kind = DifferenceClass::rounding;
            for (const ItemVerdict& verdict : judge(frame.judged()).texels)
                kind = std::max(kind, verdict.kind);
            return kind;
        };
        CHECK(worst() == DifferenceClass::divergent); // the shader rounds by itself
        frame.known.converts.particles = true;
        CHECK(worst() == DifferenceClass::rounding);
        glm::vec4& texel = frame.gpu_cdt.texels[last];
        const glm::vec4 right = texel;
        texel.x = format == CdtFormat::rgba8 ? right.x + 2.0F : right.x * (1.0F + 0x1p-9F);
        CHECK(worst() == DifferenceClass::divergent);
        texel = {right.y, right.x, right.z, right.w};
        CHECK(worst() == DifferenceClass::divergent);
        texel = {right.x, right.y, right.z, 0.0F};
        CHECK(worst() == DifferenceClass::divergent);
    }
}

TEST_CASE("verdict: normalize of zero is undefined, but the fields it does not touch are not") {
    Frame frame("paper");
    std::size_t particle = 0;
    while (particle < 1500 && !std::isnan(frame.reference.direction[particle].x))
        ++particle;
    REQUIRE(particle < 1500);
    frame.gpu.direction[particle] = {0.0F, 1.0F, 0.0F};
    frame.gpu.position[particle] =
        frame.scene.particles.position[particle] + glm::vec3(0.0F, 1.0F, 0.0F) * frame.gpu.speed[particle];
    ItemVerdict verdict = judge_particle(frame.judged(), particle);
    CHECK(verdict.kind == DifferenceClass::undefined);
    CHECK(verdict.undefined == Undefined::zero_direction);
    frame.gpu.position[particle].z += 1.0F; // whatever the direction, the position follows from it
    CHECK(judge_particle(frame.judged(), particle).kind == DifferenceClass::divergent);
    frame.gpu = frame.reference;
    frame.gpu.speed[particle] = std::nextafter(frame.gpu.speed[particle], 9.0F);
    CHECK(judge_particle(frame.judged(), particle).kind == DifferenceClass::divergent);
}

TEST_CASE("verdict: a summary counts classes, set sizes and ties, and its text and JSON say so") {
    const TieKind nearest_tie{"nearest", "world units"};
    VerdictSummary summary(collision_schema());
    FrameVerdicts verdicts;
    verdicts.particles = {{.index = 3, .kind = DifferenceClass::rounding},
                          {.index = 4, .kind = DifferenceClass::tie, .outcomes = 2, .tie = Tie{nearest_tie, 0.25}},
                          {.index = 9, .kind = DifferenceClass::tie, .outcomes = 3, .tie = Tie{nearest_tie, 0.125}}};
    verdicts.texels = {{.index = 70,
                        .kind = DifferenceClass::undefined,
                        .outcomes = 1,
                        .tie = std::nullopt,
                        .undefined = Undefined::zero_direction}};
    summary.add(5, collision::particles, verdicts.particles);
    summary.add(5, collision::cdt, verdicts.texels);
    CHECK(summary.total(DifferenceClass::tie) == 2);
    CHECK(summary.median_set_size() == 1);
    const TieCount& nearest = summary.ties.at(nearest_tie);
    CHECK(nearest.count == 2);
    CHECK(nearest.smallest == 0.125);
    CHECK(nearest.largest == 0.25);
    CHECK(nearest.closest.index == 9);
    const std::string text = verdict_text(summary, collision_schema(), std::vector<Extent>{{}, {64, 64}});
    CHECK_THAT(text, Catch::Contains("particles: 1 rounding, 2 tie; texels: 1 undefined"));
    CHECK_THAT(text, Catch::Contains("median 1, largest 3"));
    CHECK_THAT(text, Catch::Contains("nearest: 2, margins 0.125 to 0.25 world units; closest frame 5 particle 9"));
    CHECK_THAT(text, Catch::Contains("normalize of a vector of length 0: 1"));
    const nlohmann::json json = verdict_json(summary, collision_schema(), std::vector<Extent>{{}, {64, 64}});
    CHECK(json["particles"]["tie"] == 2);
    CHECK(json["set_size"]["largest"] == 3);
    CHECK(json["ties"]["nearest"]["closest"]["particle"] == 9);
    CHECK(json["first"].is_null());
}

TEST_CASE("verdict: a point at a pixel's edge is on one of its two texels, neither dropped nor drawn twice") {
    Frame frame("corrected", "strict");
    frame.known = {};
    const int width = frame.scene.params.width;
    frame.scene.params.collision_proj_view = glm::mat4(1.0F);
    frame.scene.params.switches.raster_position = RasterPosition::updated;
    for (glm::vec3& p : frame.gpu.position)
        p = glm::vec3(5.0F); // outside
    frame.gpu.position[7] = {20.0F * 2.0F / static_cast<float>(width) - 1.0F, 0.01F, 0.5F};
    frame.reference = frame.gpu;
    frame.reference_cdt = frame.drawn(frame.gpu);
    const auto drawn = std::find_if(frame.reference_cdt.texels.begin(), frame.reference_cdt.texels.end(),
                                    [](glm::vec4 t) { return t.a != 0.0F; });
    REQUIRE(drawn != frame.reference_cdt.texels.end());
    const auto at = static_cast<std::size_t>(drawn - frame.reference_cdt.texels.begin());
    const std::size_t beside = at % static_cast<std::size_t>(width) == 19 ? at + 1 : at - 1;
    const auto worst = [&](bool here, bool there) {
        frame.gpu_cdt = frame.reference_cdt;
        frame.gpu_cdt.texels[at] = here ? *drawn : glm::vec4(0.0F);
        frame.gpu_cdt.texels[beside] = there ? *drawn : glm::vec4(0.0F);
        DifferenceClass kind = DifferenceClass::rounding;
        for (const ItemVerdict& verdict : judge(frame.judged()).texels)
            kind = std::max(kind, verdict.kind);
        return kind;
    };
    CHECK(worst(false, true) == DifferenceClass::tie);
    CHECK(worst(false, false) == DifferenceClass::divergent);
    CHECK(worst(true, true) == DifferenceClass::divergent);
}

} // namespace lockstep::test::verdict_test
