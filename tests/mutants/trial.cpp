#include "tests/mutants/trial.hpp"

#include <algorithm>
#include <utility>

#include "crosscheck/report/report.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/simulation.hpp"
#include "reference/collision/render_pass.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "tests/mutants/host_faults.hpp"

namespace lockstep::test {
namespace {

Scene load(const std::string& name, const std::string& preset) {
    SceneOptions options;
    if (!preset.empty())
        options.preset = preset;
    return load_scene("tests/mutants/scenes/" + name + ".json", options);
}

bool same_pixels(const ColorImage& a, const ColorImage& b) { return a.texels == b.texels; }

/// Whether a mutant changes what renders.
bool renders(const Mutant& mutant) {
    return std::any_of(mutant.edits.begin(), mutant.edits.end(), [](const Edit& edit) {
        return edit.file.starts_with("render_") || edit.file == "shading.glsl";
    });
}

void note_verdict(Trial& trial, const CheckReport& report, const Mutant& mutant) {
    trial.verdict = verdict_name(report.verdict);
    trial.frame = report.first_frame.value_or(-1);
    if (!report.verdicts)
        return;
    const VerdictSummary& verdicts = *report.verdicts;
    trial.divergent = verdicts.total(DifferenceClass::divergent);
    if (verdicts.first) {
        trial.frame = verdicts.first->place.frame;
        trial.step = verdicts.first->wrong.step;
    }
    const CauseFindings& found = verdicts.causes[verdicts.causes[0].divergent > 0 ? 0 : 1];
    // Of the listing, whose mistakes have names, only these are claims.
    trial.explained = found.explains_all() && (found.best.front().has_name || !makes_listing(mutant.pass));
    for (const Cause& cause : found.best)
        trial.causes.push_back(cause.name());
}

bool is_unmutated(const Mutant& mutant) { return mutant.edits.empty() && mutant.fault.empty(); }

/// What the power of the right run in the scene says of the mutant's mistake.
std::optional<bool> predicted(const Mutant& mutant, const TrialScene& scene) {
    if (mutant.differs_in.contains(scene.name()))
        return {};
    for (const PowerSummary::Mistake& mistake : scene.power.mistakes)
        if (mistake.name == mutant.cause)
            return mistake.first_frame.has_value();
    return {};
}

/// The end of a run that nothing checks; nothing if there is none.
std::optional<FinalState> run_unchecked(GpuSimulation& gpu, const Scene& scene) {
    FinalState end;
    try {
        gpu.upload(scene.start, CollisionImage(scene.width, scene.height));
        for (int frame = 0; frame < trial_frames; ++frame)
            gpu.step(frame_params(scene, frame));
        gpu.read(end.particles);
        gpu.read(end.cdt);
    } catch (const Error&) {
        return {};
    }
    return end;
}

} // namespace

TrialScene::TrialScene(const std::string& name, const std::string& preset, const Profile& profile)
    : name_(preset.empty() ? name : name + " " + preset), scene_(load(name, preset)), profile_(profile),
      last_frame_(frame_params(scene_, trial_frames - 1)),
      render_pass_(std::make_unique<RenderPass>(scene_.switches, "", scene_.render_width, scene_.render_height)) {
    ReferenceSimulation reference(scene_, profile_);
    for (int frame = 0; frame < trial_frames; ++frame)
        reference.step(frame_params(scene_, frame));
    expected_ = {reference.particles(), reference.cdt(), render_reference(reference.particles())};
}

const char* TrialScene::pass() const {
    if (scene_.switches.search == Search::octree)
        return "octree_pass";
    if (scene_.switches.search == Search::depth)
        return "depth_pass";
    if (scene_.switches.step == Step::compute)
        return "compute_collision_pass";
    return has_remedies(scene_.switches) ? "layered_collision_pass" : "collision_pass";
}

ColorImage TrialScene::render(const Particles& particles, const std::filesystem::path& folder) {
    ParticleBuffer buffer(particles.size());
    buffer.upload(particles);
    const MeshBuffer obstacles(scene_.obstacles);
    ColorImage picture;
    const auto draw = [&](RenderPass& pass) {
        pass.run(buffer, obstacles, last_frame_);
        pass.read(picture);
    };
    if (folder.empty()) {
        draw(*render_pass_);
    } else {
        RenderPass planted(scene_.switches, folder, scene_.render_width, scene_.render_height);
        draw(planted);
    }
    return picture;
}

ColorImage TrialScene::render_reference(const Particles& particles) const {
    return render_pass(particles, scene_.obstacles, last_frame_, profile_);
}

std::vector<TrialScene> trial_scenes(const Profile& profile, std::span<const std::string_view> names) {
    constexpr std::pair<const char*, const char*> set[] = {{"crowd", ""},
                                                           {"listing", ""},
                                                           {"exact", ""},
                                                           {"halves", ""},
                                                           {"bytes", ""},
                                                           {"lattice", ""},
                                                           {"lattice", "paper"},
                                                           {"lattice", "exact"},
                                                           {"strip", ""},
                                                           {"strip", "paper"},
                                                           {"octree", ""},
                                                           {"octree", "paper"},
                                                           {"octree", "exact"},
                                                           {"octree_edges", ""},
                                                           {"depth", ""},
                                                           {"depth", "exact"},
                                                           {"depth_edges", ""},
                                                           {"layers", ""},
                                                           {"layers", "exact"},
                                                           {"mutual", ""},
                                                           {"mutual", "exact"},
                                                           {"two_cameras", ""},
                                                           {"layer_edges", ""},
                                                           {"compute_crowd", ""},
                                                           {"compute_exact", ""},
                                                           {"compute_lattice", ""},
                                                           {"compute_lattice", "paper"},
                                                           {"compute_strip", "paper"},
                                                           {"compute_ties", ""},
                                                           {"compute_ties", "exact"}};
    std::vector<TrialScene> scenes;
    for (const auto& [name, preset] : set)
        if (names.empty() || std::find(names.begin(), names.end(), name) != names.end())
            scenes.emplace_back(name, preset, profile);
    return scenes;
}

Trial run_trial(const Mutant& mutant, TrialScene& trial_scene) {
    const Scene& scene = trial_scene.scene();
    const TemporaryFolder folder;
    plant(mutant, folder);
    Trial trial;
    trial.scene = trial_scene.name();
    trial.predicted = predicted(mutant, trial_scene);
    std::optional<FinalState> end;
    {
        const HostFault fault(mutant.fault);
        try {
            GpuSimulation gpu(scene, mutant.edits.empty() ? std::filesystem::path() : folder.path());
            FrameCheckOptions options;
            options.frames = trial_frames;
            options.on_state = [&](const ComparedFrame& frame) {
                if (frame.frame == trial_frames - 1)
                    end = {frame.gpu, frame.gpu_cdt, {}};
            };
            try {
                const CheckReport report = check(scene, trial_scene.profile(), gpu, options);
                if (is_unmutated(mutant))
                    trial_scene.power = report.power;
                note_verdict(trial, report, mutant);
            } catch (const Error& error) {
                trial.verdict = "ERROR";
                trial.error = error.what();
            }
            if (!end)
                end = run_unchecked(gpu, scene);
        } catch (const Error& error) {
            trial.verdict = "ERROR";
            trial.error = error.what();
        }
    }
    if (!end)
        return trial;
    end->picture = trial_scene.render(end->particles, renders(mutant) ? folder.path() : std::filesystem::path());
    if (!trial.killed() && !same_pixels(end->picture, trial_scene.render_reference(end->particles))) {
        trial.verdict = "PIXELS";
        trial.frame = trial_frames - 1;
    }
    for (std::size_t rule = 0; rule < common_rule_count; ++rule)
        trial.rules[rule] = common_rules()[rule].accepts(trial_scene.expected(), *end);
    return trial;
}

const Trial* Outcome::killer() const {
    const auto found = std::find_if(trials.begin(), trials.end(), [](const Trial& trial) { return trial.killed(); });
    return found == trials.end() ? nullptr : &*found;
}

bool Outcome::rejected_by(std::size_t rule) const {
    return std::any_of(trials.begin(), trials.end(), [&](const Trial& t) { return t.rules[rule] == false; });
}

bool Outcome::judged_by(std::size_t rule) const {
    return std::any_of(trials.begin(), trials.end(), [&](const Trial& t) { return t.rules[rule].has_value(); });
}

bool Outcome::named() const {
    const Trial* trial = killer();
    if (trial == nullptr || !trial->explained)
        return false;
    // Of several that explain as much, the report shows three.
    const auto shown = trial->causes.begin() + std::min<std::ptrdiff_t>(3, std::ssize(trial->causes));
    return trial->causes.front() == mutant.cause || (mutant.alike.contains(trial->causes.front()) &&
                                                     std::find(trial->causes.begin(), shown, mutant.cause) != shown);
}

bool Outcome::wrongly_named() const {
    return std::any_of(trials.begin(), trials.end(), [&](const Trial& trial) {
        return trial.explained && !mutant.is_called(trial.causes.front()) &&
               std::find(trial.causes.begin(), trial.causes.end(), mutant.cause) == trial.causes.end();
    });
}

Outcome run_mutant(const Mutant& mutant, std::vector<TrialScene>& scenes) {
    Outcome outcome{mutant, {}};
    for (TrialScene& scene : scenes)
        if (is_unmutated(mutant) || scene.pass() == mutant.pass)
            outcome.trials.push_back(run_trial(mutant, scene));
    return outcome;
}

} // namespace lockstep::test
