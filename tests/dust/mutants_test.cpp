#include <cmath>
#include <cstring>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/matrix.hpp>

#include "crosscheck/dust/picture.hpp"
#include "reference/dust/sites.hpp"
#include "tests/dust/rooms.hpp"
#include "tests/text_mutants.hpp"

namespace lockstep::test::mutants_test {

namespace dust = lockstep::dust;

namespace {

/// All die at once, and come back in twos and threes of a group of lanes.
dust::Settings nursery() {
    dust::Settings s = room(false);
    s.count = 20'000;
    s.cannon.clear();
    s.tools[0].angle = 90.0F;
    s.tools[0].range = s.tools[0].death_range = 1000.0F;
    s.tools[0].to = 6;
    s.tools[1].from = 6;
    return s;
}

/// Long movements among small colliders, and a vacuum whose victims Update asks for again.
dust::Settings swept(bool aabb) {
    dust::Settings s = room(aabb);
    s.cannon.clear();
    s.tools.resize(1);
    s.tools[0].force = 5.0F;
    s.gravity = {40.0F, -1500.0F, 600.0F};
    s.switches.sweep = dust::OffOn::on;
    s.switches.sphere_data = dust::SphereData::vec4;
    s.switches.forecast = dust::Forecast::moved;
    s.switches.colour_format = dust::ColourFormat::rgb16f;
    s.colliders.push_back({.position = {0.0F, 9.0F, 5.0F}, .radius = 3.0F});
    for (dust::Collider& one : s.colliders) {
        one.radius *= 0.4F;
        one.scale *= 0.4F;
    }
    return s;
}

std::vector<dust::Settings> rooms(const std::string& run) {
    if (run == "swept")
        return {swept(false), swept(true)};
    return {room(false), room(true), nursery()};
}

/// In the first room that shows a difference.
Outcome run_of(const std::string& shaders, const std::string& run) {
    Outcome outcome;
    for (const dust::Settings& settings : rooms(run))
        if (!outcome.found())
            outcome = outcome_of([&] { return run_dust(settings, frames, CheckMode::resync, shaders); });
    return outcome;
}

} // namespace

TEST_CASE("dust mutants: each text stands in the shipped kernel as often as the catalogue says") {
    check_texts("dust");
}

TEST_CASE("dust mutants: some of each kernel are found and named, and the shipped kernels are not") {
    if (!gl())
        return skip(gl().missing());
    for (const char* run : {"", "swept"})
        CHECK(run_of("shaders/dust", run).verdict == "AGREE");
    check_mutants("dust",
                  {"stride_16_read",
                   "death_not_counted",
                   "death_not_atomic",
                   "spawned_dead",
                   "cone_ignored",
                   "suction_reversed",
                   "emitted_all",
                   "wind_reversed",
                   "blast_not_fading",
                   "gravity_missing",
                   "drag_reversed",
                   "sphere_far_side",
                   "sphere_normal_of_next",
                   "reflection_once",
                   "death_counted_up",
                   "birth_counted_down",
                   "matrix_transposed",
                   "random_pcg_shift",
                   "faces_turned",
                   "box_velocity_as_point",
                   "wall_path_uncut",
                   "moved_for_constant_time",
                   "air_resists_by_the_square",
                   "bounce_slows_normal_alone",
                   "suction_along_the_axis",
                   "wind_fades_to_the_rim",
                   "blast_fades_by_distance",
                   "swept_line_alone",
                   "forecast_not_repeated"},
                  run_of);
}

/// All of them, as a table: lockstep_tests_dust "[mutants]"
TEST_CASE("dust mutants: the whole catalogue", "[.][mutants]") {
    if (!gl())
        return skip(gl().missing());
    check_catalogue("dust", run_of);
}

namespace {

/// A pass of which the reference makes a mistake.
class WrongTwin : public ItemPass {
  public:
    WrongTwin(std::unique_ptr<ItemPass> right, Mistake mistake) : right_(std::move(right)), mistake_(mistake) {}

    [[nodiscard]] std::string_view name() const override { return right_->name(); }
    [[nodiscard]] std::uint8_t resource() const override { return right_->resource(); }
    [[nodiscard]] PassStage stage() const override { return right_->stage(); }
    [[nodiscard]] bool runs(int frame) const override { return right_->runs(frame); }
    [[nodiscard]] bool continues() const override { return right_->continues(); }
    [[nodiscard]] std::string_view output(const Resource& about, std::uint8_t field) const override {
        return right_->output(about, field);
    }
    void run(const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
             const WritableView& after) const override {
        const std::vector<Component> parts = components(after.about());
        for (std::size_t item = first; item < last; ++item) {
            const std::vector<std::uint32_t> words = right_->mistaken(in, item, profile, std::span(&mistake_, 1));
            for (std::size_t w = 0; w < words.size(); ++w) {
                const auto stride = static_cast<std::size_t>(after.fields()[parts[w].field].components);
                const std::size_t word = item * stride + static_cast<std::size_t>(parts[w].component);
                std::memcpy(after.columns[parts[w].field] + word * sizeof words[w], &words[w], sizeof words[w]);
            }
        }
    }
    [[nodiscard]] std::vector<ItemOutcome> outcomes(const PassInput& in, std::size_t item, const Profile& profile,
                                                    const KnownOperations& known, const View* observed) const override {
        return right_->outcomes(in, item, profile, known, observed);
    }
    [[nodiscard]] std::vector<RecordedRow> record(const PassInput& in, std::size_t item,
                                                  const Profile& profile) const override {
        return right_->record(in, item, profile);
    }
    [[nodiscard]] FollowedStep follow(const PassInput& in, std::size_t item, const Profile& profile,
                                      const KnownOperations& known, std::span<const ToldValue> told) const override {
        return right_->follow(in, item, profile, known, told);
    }
    [[nodiscard]] std::vector<SeenSite> sites(const PassInput& in, std::size_t item,
                                              const Profile& profile) const override {
        return right_->sites(in, item, profile);
    }
    [[nodiscard]] std::vector<std::uint32_t> mistaken(const PassInput& in, std::size_t item, const Profile& profile,
                                                      std::span<const Mistake> made) const override {
        return right_->mistaken(in, item, profile, made);
    }

  private:
    std::unique_ptr<ItemPass> right_;
    Mistake mistake_;
};

} // namespace

TEST_CASE("dust mutants: a mistake in any kernel's twin, with the shader right, is found as well") {
    if (!gl())
        return skip(gl().missing());
    const dust::HostPtr host = host_of(room(false));
    std::set<std::string> kernels;
    for (const auto& pass : dust::system(host).passes)
        kernels.insert(std::string(pass->name()));
    CHECK(kernels.size() == 12);
    for (const std::string& kernel : kernels) {
        INFO(kernel);
        System system = dust::system(host);
        for (auto& pass : system.passes)
            if (pass->name() == kernel) {
                const bool is_count = pass->resource() == dust::count_buffer;
                pass = std::make_unique<WrongTwin>(
                    std::move(pass), is_count               ? mistake_at(dust::site::count, Change::one_more)
                                     : kernel == "populate" ? mistake_at(dust::site::position, Change::negated)
                                                            : mistake_at(dust::site::velocity, Change::negated));
            }
        GlSystemSide side(gl(), system, dust::passes(host), "shaders/dust");
        CheckOptions options;
        options.frames = frames;
        options.mode = CheckMode::free;
        CHECK(check(system, side, options).verdict == Verdict::differ);
    }
}

TEST_CASE("dust mutants: a mistake in the twin of the draw's vertex stage is found as well") {
    if (!gl())
        return skip(gl().missing());
    const dust::HostPtr host = host_of(room(false));
    const System kernels = dust::system(host);
    ReferenceRun run(kernels, named_profile("strict"));
    run.step(0);
    for (const bool wrong : {false, true}) {
        SystemPicture picture = dust::picture(host, run.state(), 0);
        if (wrong)
            picture.system.passes[0] = std::make_unique<WrongTwin>(
                std::move(picture.system.passes[0]), mistake_at(dust::site::world_corner, Change::negated));
        GlSystemSide side(gl(), picture.system, picture.passes, "shaders/dust");
        CheckOptions options;
        options.frames = 1;
        options.mode = CheckMode::free;
        CHECK(check(picture.system, side, options).verdict == (wrong ? Verdict::differ : Verdict::agree));
    }
}

namespace {

/// A mistake of the host: what it hands the shaders is another thing than what the twins get.
struct HostMutant {
    std::string name;
    std::function<void(dust::Settings&)> settings = {}; ///< of the shaders' side
    std::function<void(GlPass&)> pass = {};
    std::string cause = {}; ///< as a report names it; empty: no one change of the twin is the same
};

/// Of one kernel's uniform.
std::function<void(GlPass&)> uniform(const std::string& kernel, const std::string& name,
                                     const std::function<UniformValue(const Uniforms&)>& wrong) {
    return [=](GlPass& pass) {
        if (pass.name != kernel || pass.continues)
            return;
        pass.uniforms = [right = pass.uniforms, name, wrong](int frame) {
            Uniforms all = right(frame);
            if (all.contains(name))
                all[name] = wrong(all);
            return all;
        };
    };
}

float number(const Uniforms& all, const std::string& name) { return std::get<float>(all.at(name)); }

std::function<void(GlPass&)> floats(const std::string& block,
                                    const std::function<std::vector<float>(std::vector<float>)>& wrong) {
    return [=](GlPass& pass) {
        const auto found = pass.data.find(block);
        if (found == pass.data.end())
            return;
        found->second = [right = found->second, wrong](int frame) { return wrong(right(frame)); };
    };
}

/// Records of 35 floats at a stride of 36, as std430 lays a struct of two matrices and a vec3.
std::vector<float> at_stride_36(const std::vector<float>& records) {
    std::vector<float> padded;
    for (std::size_t i = 0; i < records.size(); ++i) {
        padded.push_back(records[i]);
        if (i % 35 == 34)
            padded.push_back(0.0F);
    }
    return padded;
}

std::vector<HostMutant> host_catalogue() {
    using dust::Settings;
    const auto sqrt_of = [](const std::string& name) {
        return [name](const Uniforms& all) { return std::sqrt(number(all, name)); };
    };
    return {
        {"stale_collider_stays",
         [](Settings& s) {
             s.colliders.push_back({.position = {-3, 5, 6}, .radius = 3.0F});
         }},
        {"stale_collider_not_moved", [](Settings& s) { s.colliders[0].position.x -= 1.5F; }},
        {"stale_collider_gone",
         [](Settings& s) { s.colliders.erase(s.colliders.begin() + 1); },
         {},
         "spheres: last skipped"},
        {"zeros_for_a_removed_collider",
         [](Settings& s) {
             s.colliders.erase(s.colliders.begin(), s.colliders.begin() + 2);
             s.colliders.push_back({.position = {0, 0, 0}, .radius = 1e-3F});
         },
         {},
         "spheres_missing"},
        {"colliders_padded_to_144_bytes", {}, floats("boxColliderBuffer", at_stride_36), "boxes_padded"},
        {"spheres_padded_to_144_bytes", {}, floats("sphereColliderBuffer", at_stride_36), "spheres_padded"},
        {"boxes_not_turned",
         [](Settings& s) {
             for (dust::Collider& one : s.colliders)
                 one.rotate = glm::vec3(0.0F);
         },
         {},
         "boxes_unturned"},
        {"sphere_scale_is_its_radius",
         [](Settings& s) {
             for (dust::Collider& one : s.colliders)
                 one.radius *= 0.5F;
         },
         {},
         "sphere's radius: halved"},
        {"colliders_not_counted",
         {},
         uniform("update", "sphereColliderCount", [](const Uniforms&) { return 0; }),
         "spheres_missing"},
        {"radius_is_scale",
         {},
         uniform("update", "radius", [](const Uniforms& all) { return 2.0F * number(all, "radius"); }),
         "radius_doubled"},
        {"gravity_not_set",
         {},
         uniform("update", "gravity", [](const Uniforms&) { return glm::vec3(0.0F); }),
         "gravity_missing"},
        {"drag_not_set", {}, uniform("update", "airResistance", [](const Uniforms&) { return 0.0F; }), "drag_missing"},
        {"elasticity_not_set",
         {},
         uniform("update", "elasticity", [](const Uniforms&) { return 1.0F; }),
         "elasticity_missing"},
        {"time_does_not_pass",
         {},
         uniform("update", "deltaTime", [](const Uniforms&) { return 0.0F; }),
         "deltaTime: zero"},
        {"world_turned_over",
         {},
         uniform("update", "worldBoundsMin", [](const Uniforms& all) { return all.at("worldBoundsMax"); }),
         "world_turned_over"},
        {"tail_not_dispatched",
         {},
         uniform("update", "dustCount",
                 [](const Uniforms& all) { return std::get<unsigned>(all.at("dustCount")) & ~1023U; }),
         "tail_left_out"},
        {"mass_not_set", {}, uniform("vacuum_up", "mass", [](const Uniforms&) { return 1.0F; }), "mass: one"},
        {"suction_not_squared",
         {},
         uniform("vacuum_up", "cleanerSqrForce", sqrt_of("cleanerSqrForce")),
         "force_not_squared"},
        {"suction_range_not_squared",
         {},
         uniform("vacuum_up", "cleanerSqrDist", sqrt_of("cleanerSqrDist")),
         "range_not_squared"},
        {"cone_of_the_angle",
         {},
         uniform("vacuum_up", "cleanerDotThreshold",
                 [](const Uniforms& all) { return number(all, "emitterAngleRad"); }),
         "cone_of_the_angle"},
        {"tool_faces_back",
         {},
         uniform("vacuum_up", "controllerForward",
                 [](const Uniforms& all) { return -std::get<glm::vec3>(all.at("controllerForward")); }),
         "controllerForward: negated"},
        {"tool_a_frame_late",
         [](Settings& s) {
             for (dust::Pose& pose : s.controller)
                 pose.frame += 1;
         },
         {},
         "tool_a_frame_late"},
        {"death_range_not_squared",
         {},
         uniform("vacuum_up", "cleanerSqrDeathRange", sqrt_of("cleanerSqrDeathRange")),
         "death_range_not_squared"},
        {"emitter_matrix_transposed",
         {},
         uniform("emit", "controllerMatrix",
                 [](const Uniforms& all) { return glm::transpose(std::get<glm::mat4>(all.at("controllerMatrix"))); }),
         "controllerMatrix: transposed"},
        {"emitter_angle_for_tangent",
         {},
         uniform("emit", "emitterTangent", [](const Uniforms& all) { return number(all, "emitterAngleRad"); }),
         "angle_for_tangent"},
        {"emitter_distance_left_out",
         {},
         uniform("emit", "emitterDist", [](const Uniforms&) { return 1.0F; }),
         "emitterDist: one"},
        {"directions_not_uploaded",
         {},
         floats("directionBuffer", [](std::vector<float> all) { return std::vector<float>(all.size(), 0.0F); }),
         "direction of the table: zero"},
        {"seed_not_set", {}, uniform("populate", "seed", [](const Uniforms&) { return 0U; }), "seed of the run: zero"},
        {"spawn_box_of_points",
         {},
         uniform("populate", "spawnBoundsMax", [](const Uniforms& all) { return all.at("spawnBoundsMin"); }),
         "spawnBoundsMax: instead spawnBoundsMin"},
        {"colours_changed_over",
         {},
         uniform("populate", "dustColorB", [](const Uniforms& all) { return all.at("dustColorA"); }),
         "colour's share: zero"},
        {"blast_range_not_squared",
         {},
         uniform("explode", "explosionSqrRange", sqrt_of("explosionSqrRange")),
         "blast_range_not_squared"},
        {"blast_from_controller",
         {},
         uniform("explode", "explosionPosition", [](const Uniforms& all) { return all.at("controllerPos"); }),
         "blast_at_the_tool"},
        {"blast_of_the_frame",
         {},
         uniform("explode", "impulseDeltaTime", [](const Uniforms& all) { return all.at("deltaTime"); }),
         "blast_by_frames"},
        {"wind_constant",
         {},
         uniform("blow_wind", "impulseDeltaTime", [](const Uniforms&) { return 0.02F; }),
         "wind_by_frames"},
        {"wind_not_squared", {}, uniform("blow_wind", "blowerSqrForce", sqrt_of("blowerSqrForce")), "wind_not_squared"},
    };
}

} // namespace

TEST_CASE("dust mutants: what the host hands over wrongly is found, and nine in ten have their cause") {
    if (!gl())
        return skip(gl().missing());
    const dust::Settings right = room(false);
    const dust::HostPtr host = host_of(right);
    std::size_t with_cause = 0;
    const std::vector<HostMutant> all = host_catalogue();
    for (const HostMutant& mutant : all) {
        dust::Settings wrong = right;
        if (mutant.settings)
            mutant.settings(wrong);
        std::vector<GlPass> passes = dust::passes(host_of(wrong));
        for (GlPass& pass : passes)
            if (mutant.pass)
                mutant.pass(pass);
        const System system = dust::system(host);
        GlSystemSide side(gl(), system, std::move(passes), "shaders/dust");
        CheckOptions options;
        options.frames = frames;
        const Outcome outcome = outcome_of([&] { return check(system, side, options); });
        with_cause += outcome.causes.empty() ? 0 : 1;
        INFO(mutant.name << ": " << fmt::format("{}", fmt::join(outcome.causes, " | ")));
        CHECK(outcome.verdict == "DIVERGENT");
        CHECK((mutant.cause.empty() || outcome.names(mutant.cause)));
    }
    CHECK(10 * with_cause >= 9 * all.size());
}

} // namespace lockstep::test::mutants_test
