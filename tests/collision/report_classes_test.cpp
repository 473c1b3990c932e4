#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/judge/step_judge.hpp"
#include "crosscheck/collision/page/report_page.hpp"
#include "crosscheck/collision/report/named_items.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "crosscheck/report/part_json.hpp"
#include "crosscheck/report/places.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "gpu/collision/gpu_side.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/same_bits.hpp"
#include "tests/collision/collision_scenes.hpp"
#include "tests/report_parts.hpp"
#include "tests/uneven_roots.hpp"

namespace lockstep::test::report_classes_test {

namespace {

constexpr int planted_frame = 1, width = 31, height = 24;

/// One frame's inputs and what the reference made of them.
struct Stepped {
    const FrameParams& params;
    const Particles& before;
    const CollisionImage& cdt;
    const ReferenceSimulation& made;
};

/// A GPU that is the reference in the arithmetic of a driver of its own, but for what is planted in one frame.
class OtherDriver final : public GpuSide {
  public:
    using Plant = std::function<void(const Stepped&, Particles&, CollisionImage&)>;
    OtherDriver(const Scene& scene, const Profile& profile, Plant plant = {})
        : simulation_(scene, profile), plant_(std::move(plant)) {}

    void upload(const Particles& particles, const CollisionImage& cdt) override {
        particles_ = particles;
        cdt_ = cdt;
        frame_ = 0;
    }
    void step(const FrameParams& params) override {
        simulation_.step_from(particles_, cdt_, params);
        Particles particles = simulation_.particles();
        CollisionImage cdt = simulation_.cdt();
        if (plant_ && frame_ == planted_frame)
            plant_({params, particles_, cdt_, simulation_}, particles, cdt);
        particles_ = std::move(particles);
        cdt_ = std::move(cdt);
        ++frame_;
    }
    void read(Particles& particles) const override { particles = particles_; }
    void read(CollisionImage& cdt) const override { cdt = cdt_; }

  private:
    ReferenceSimulation simulation_;
    Plant plant_;
    Particles particles_;
    CollisionImage cdt_;
    int frame_ = 0;
};

Scene crowded(const std::string& preset_name) {
    RandomScene random = random_scene(23, 500, width, height);
    Scene scene;
    scene.name = "crowded";
    scene.start = random.particles;
    scene.width = width;
    scene.height = height;
    scene.constants = random.params.constants;
    scene.switches = preset(preset_name);
    // A wall behind some of the particles.
    scene.obstacles.positions = {{-0.9F, -0.9F, 0.9F}, {0.9F, -0.8F, 0.7F}, {0.1F, 0.9F, 0.8F}};
    scene.obstacles.indices = {0, 1, 2};
    return scene;
}

struct Checked {
    CheckReport report;
    nlohmann::json head; ///< of its page
    std::vector<PageItem> items;
};

/// A check by all that GL allows, unless `known` says otherwise.
Checked checked(const Scene& scene, const Profile& followed, GpuSide& gpu, FrameCheckOptions options = {}) {
    PageCollector page(scene, followed, CheckMode::resync, 3);
    options.frames = 3;
    if (!options.known)
        options.known = KnownOperations{};
    options.on_state = [&](const ComparedFrame& frame) { page.add(frame); };
    CheckReport report = check(scene, followed, gpu, options);
    const RunDescription about{"crowded", "", "", "", "resync", "again", ""};
    // A part of a run says the same once it was written and read.
    const std::string written = part_json(report).dump();
    const CheckReport read = read_part(JsonValue(nlohmann::json::parse(written), "part"), report.schema);
    CHECK(part_json(read).dump() == written);
    if (report.verdicts)
        CHECK(verdict_text(*read.verdicts, report.schema, {}) == verdict_text(*report.verdicts, report.schema, {}));
    const nlohmann::json head = page_head_of(report_page("<!-- lockstep data -->", page, report, about, {}, {}, {}));
    CHECK(head.at("report").at("verdicts") == report_json(report, about).at("verdicts"));
    CHECK(head.at("text") == report_text(report, about));
    return {std::move(report), head, page.frames().items()};
}

bool has_item(const Checked& run, bool texel, std::size_t index, DifferenceClass kind) {
    return std::any_of(run.items.begin(), run.items.end(), [&](const PageItem& item) {
        return item.texel == texel && item.index == index && item.kind == static_cast<std::uint8_t>(kind);
    });
}

/// The step of a frame as a judged pass, its GPU's particles the reference's or what is put into `gpu`.
struct JudgedStep {
    const Stepped& frame;
    const Scene& scene;
    Particles gpu;
    KnownOperations known;
    Profile profile;

    [[nodiscard]] JudgedFrame judged() const {
        return {scene.obstacles, frame.params,           profile,          known, frame.before,
                frame.cdt,       frame.made.particles(), frame.made.cdt(), gpu,   frame.made.cdt()};
    }
};

/// The first particle that can differ by this class, and its words then.
std::optional<std::pair<std::size_t, Words>> particle_of(DifferenceClass kind, const Scene& scene,
                                                         const Profile& profile, const Stepped& frame) {
    JudgedStep step{frame, scene, frame.made.particles(), {}, profile};
    for (std::size_t item = 0; item < scene.start.size(); ++item) {
        const auto found = with_step_pass(
            step.judged(), [&](const JudgedPass& pass) { return words_by_class(pass, item, view(step.gpu)); });
        if (found.contains(kind))
            return std::pair(item, found.at(kind));
    }
    return {};
}

} // namespace

TEST_CASE("report of the collision step: one particle of each class, in text, JSON, JUnit, page and part") {
    const auto kind = GENERATE(DifferenceClass::rounding, DifferenceClass::undefined, DifferenceClass::divergent);
    CAPTURE(static_cast<int>(kind));
    const Scene scene = crowded(kind == DifferenceClass::undefined ? "paper" : "corrected");
    const Profile profile = named_profile("llvmpipe");
    std::optional<std::size_t> planted;
    OtherDriver gpu(scene, profile, [&](const Stepped& frame, Particles& particles, CollisionImage& cdt) {
        const auto found = particle_of(kind, scene, profile, frame);
        REQUIRE(found);
        planted = found->first;
        put_words(view(particles), found->first, found->second);
        ReferenceSimulation(scene, profile).draw(frame.before, particles, frame.params, cdt);
    });
    const Checked run = checked(scene, profile, gpu);
    REQUIRE(planted);
    check_report(run.report, collision::particles, *planted, planted_frame, kind,
                 kind != DifferenceClass::undefined && kind != DifferenceClass::divergent);
    CHECK(has_item(run, false, *planted, kind));
    // Texels that show the particle have its class, and sets of their own.
    const VerdictSummary& verdicts = *run.report.verdicts;
    for (std::size_t other = 0; other < class_names.size(); ++other)
        CHECK((verdicts.classes[collision::cdt][other] == 0 || other == static_cast<std::size_t>(kind)));
}

TEST_CASE("report of the collision step: a legal texel shows a set of its own components") {
    const CdtFormat format = GENERATE(CdtFormat::rgba32f, CdtFormat::rgba16f);
    CAPTURE(static_cast<int>(format));
    Scene scene = crowded("corrected");
    scene.switches.cdt_format = format;
    scene.cdt_box = {glm::vec3(-2.0F), glm::vec3(2.0F)};
    const Profile strict = named_profile("strict");
    OtherDriver gpu(scene, profile_with_roots());
    FrameCheckOptions options;
    const Checked run = checked(scene, strict, gpu, options);
    CHECK(run.report.verdict == Verdict::legal);
    const std::string text = report_text(run.report, {"crowded", "", "", "", "resync", "", ""});
    INFO(text);
    const std::optional<LegalWidths::Widest>& particles = run.report.verdicts->widths[collision::particles].widest();
    REQUIRE(particles);
    CHECK(particles->floats.field.resource == collision::particles);
    CHECK_THAT(text, Catch::Contains("leeway    the particles: "));
    const std::optional<LegalWidths::Widest>& texels = run.report.verdicts->widths[collision::cdt].widest();
    REQUIRE(texels);
    CHECK(texels->floats.field == collision::texel);
    CHECK(texels->index < static_cast<std::size_t>(width * height));
    CHECK(texels->floats.width() > 0.0);
    CHECK_THAT(text, Catch::Contains("leeway    the CDT: ") && Catch::Contains(" at most: texel."));
    CHECK(run.head.at("report").at("verdicts").at("texel_leeway").at("field") == "texel");
}

TEST_CASE("report of the collision step: the sets of a texel hold what the GPU stored there") {
    const Scene scene = crowded("corrected");
    const Profile strict = named_profile("strict");
    OtherDriver gpu(scene, profile_with_roots());
    std::size_t following = 0;
    FrameCheckOptions options;
    options.frames = 3;
    options.known = KnownOperations{};
    options.on_state = [&](const ComparedFrame& frame) {
        if (frame.verdicts == nullptr)
            return;
        for (const ItemVerdict& verdict : frame.verdicts->texels) {
            if (verdict.sets.empty())
                continue;
            REQUIRE(verdict.sets.size() == 4);
            following += verdict.follows_particle ? 1 : 0;
            for (int c = 0; c < 4; ++c)
                CHECK(verdict.sets[static_cast<std::size_t>(c)].contains(frame.gpu_cdt.texels[verdict.index][c]));
        }
        for (const ItemVerdict& verdict : frame.verdicts->particles)
            REQUIRE((verdict.sets.empty() || verdict.sets.size() == 8));
    };
    check(scene, strict, gpu, options);
    CHECK(following > 5);
}

TEST_CASE("report of the collision step: one texel by itself, of each class") {
    const Scene scene = crowded("corrected");
    const Profile profile = named_profile("llvmpipe");
    const auto kind = GENERATE(DifferenceClass::divergent, DifferenceClass::tie, DifferenceClass::rounding);
    CAPTURE(static_cast<int>(kind));
    std::optional<std::size_t> planted;
    OtherDriver gpu(scene, profile, [&](const Stepped& frame, Particles&, CollisionImage& cdt) {
        const Particles& particles = frame.made.particles();
        const KnownOperations known{};
        const auto judged_as = [&](std::size_t texel) -> std::optional<DifferenceClass> {
            const FrameVerdicts verdicts = judge({scene.obstacles, frame.params, profile, known, frame.before,
                                                  frame.cdt, particles, frame.made.cdt(), particles, cdt, false});
            std::optional<DifferenceClass> found;
            for (const ItemVerdict& verdict : verdicts.texels)
                if (verdict.index == texel && verdicts.texels.size() == 1)
                    found = verdict.kind;
            return found;
        };
        for (std::size_t t = 0; t < cdt.texels.size() && !planted; ++t) {
            if (cdt.texels[t].a == 0.0F)
                continue;
            const glm::vec4 before = cdt.texels[t];
            std::vector<glm::vec4> others{glm::vec4(0.0F), {9.0F, 9.0F, 9.0F, 1.0F}};
            glm::vec4 next = before;
            next.x = std::nextafter(next.x, 9.0F);
            others.push_back(next);
            // What hides behind the point that is seen, where the two are equally deep but for rounding.
            for (std::size_t i = 0; i < particles.size() && kind == DifferenceClass::tie && t % 8 == 0; i += 16)
                others.push_back(glm::vec4(particles.position[i], 1.0F));
            for (const glm::vec4& other : others) {
                cdt.texels[t] = other;
                if (judged_as(t) == kind) {
                    planted = t;
                    return;
                }
            }
            cdt.texels[t] = before;
        }
    });
    const Checked run = checked(scene, profile, gpu);
    REQUIRE(planted);
    check_report(run.report, collision::cdt, *planted, planted_frame, kind, true);
    CHECK(has_item(run, true, *planted, kind));
}

TEST_CASE("report of the collision step: agreement, a partial run, and what is undecided") {
    const Scene scene = crowded("corrected");
    const Profile profile = named_profile("llvmpipe");
    OtherDriver same(scene, profile);
    const Checked agree = checked(scene, profile, same);
    CHECK(agree.report.verdict == Verdict::agree);
    CHECK(agree.head.at("report").at("worst").empty());
    CHECK(agree.head.at("report").at("verdicts").at("particle_leeway").is_null());
    CHECK(agree.head.at("report").at("verdicts").at("texel_leeway").is_null());

    std::atomic<bool> stop = false;
    FrameCheckOptions options;
    options.stop = &stop;
    options.on_frame = [&](int done) { stop = done == 2; };
    OtherDriver uneven(scene, profile_with_roots());
    const Checked partial = checked(scene, named_profile("strict"), uneven, options);
    const std::string text = partial.head.at("text");
    CHECK_THAT(text, Catch::Contains("verdict   LEGAL (partial: stopped after 2 of 3 frames)") &&
                         Catch::Contains("leeway    the CDT: "));
    CHECK_FALSE(passes(partial.report));

    Scene layered = crowded("corrected");
    layered.switches.cdt_layers = 2;
    layered.obstacles = {};
    std::optional<std::size_t> planted;
    OtherDriver gpu(layered, profile, [&](const Stepped&, Particles&, CollisionImage& cdt) {
        for (std::size_t t = static_cast<std::size_t>(width * height); t < cdt.texels.size() && !planted; ++t)
            if (cdt.texels[t].a != 0.0F) {
                cdt.texels[t].x = std::nextafter(cdt.texels[t].x, 9.0F);
                planted = t;
            }
    });
    const Checked undecided = checked(layered, profile, gpu);
    REQUIRE(planted);
    check_report(undecided.report, collision::cdt, *planted, planted_frame, DifferenceClass::undefined, false);
    // The command that the report prints finds the texel, in whichever plane it lies.
    const std::string arguments = first_arguments(undecided.report, layered.width);
    CHECK(texel_named(arguments.substr(arguments.rfind(' ') + 1), layered) == *planted);
}

TEST_CASE("report of the collision step: a hint and a cause are each of the resource that they are about") {
    const Scene scene = crowded("corrected");
    const Profile strict = named_profile("strict");
    FrameCheckOptions options;
    options.known = measured_operations(named_profile("llvmpipe"));
    OtherDriver uneven(scene, profile_with_roots());
    const Checked hinted = checked(scene, named_profile("llvmpipe"), uneven, options);
    REQUIRE(hinted.report.verdict == Verdict::divergent);
    CHECK(hinted.report.wider_rule == Legal::glsl);
    CHECK_THAT(std::string(hinted.head.at("text")),
               Catch::Contains("hint      none of those that were tried is wrong"));

    OtherDriver wrong(scene, strict, [&](const Stepped& frame, Particles& particles, CollisionImage& cdt) {
        for (std::size_t i = 0; i < particles.size(); ++i)
            if (particles.collide_time[i] == scene.constants.collision_time)
                particles.collide_time[i] = frame.before.collide_time[i];
        ReferenceSimulation(scene, strict).draw(frame.before, particles, frame.params, cdt);
    });
    options.known = measured_operations(strict);
    const Checked caused = checked(scene, strict, wrong, options);
    REQUIRE(caused.report.verdict == Verdict::divergent);
    const nlohmann::json& verdicts = caused.head.at("report").at("verdicts");
    CHECK(verdicts.at("particle_cause").at("divergent") > 0);
    CHECK(verdicts.at("texel_cause").at("divergent") == 0);
    CHECK(verdicts.at("first").at("place").contains("particle"));
    CHECK(verdicts.at("first").at("field") == "collide_time");
}

TEST_CASE("report of the collision step: a table whose intermediate values were not captured blames no operation") {
    const Scene scene = crowded("corrected");
    const Profile profile = named_profile("llvmpipe");
    bool planted = false;
    OtherDriver gpu(scene, profile, [&](const Stepped& frame, Particles&, CollisionImage&) {
        JudgedStep step{frame, scene, frame.made.particles(), measured_operations(profile), profile};
        step.gpu.speed[7] *= 1.5F;
        with_step_pass(step.judged(), [&](const JudgedPass& pass) {
            const std::vector<StepRow> rows = item_rows(pass, 7, told_by_state(pass.pass, view(step.gpu), 7));
            const auto first = std::find_if(rows.begin(), rows.end(),
                                            [](const StepRow& row) { return row.verdict == RowVerdict::divergent; });
            REQUIRE(first != rows.end());
            CHECK_THAT(first->reason, Catch::StartsWith("expected ") &&
                                          Catch::EndsWith("; the GPU's intermediate values were not captured") &&
                                          !Catch::Contains("own values above"));
            planted = true;
        });
    });
    FrameCheckOptions options;
    options.frames = planted_frame + 1;
    check(scene, profile, gpu, options);
    CHECK(planted);
}

} // namespace lockstep::test::report_classes_test
