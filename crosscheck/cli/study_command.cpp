#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/study_parts.hpp"
#include "crosscheck/cli/thesis_study.hpp"
#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/collision/study/study_pictures.hpp"
#include "crosscheck/collision/study/study_report.hpp"
#include "crosscheck/command/exit_status.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/png.hpp"
#include "crosscheck/report/gnuplot.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {
namespace {

enum class StudySide { cpu, gpu };

struct StudyRequest {
    StudiedScene studied;
    StudySide side = StudySide::cpu;
    std::filesystem::path csv, json, images, chart;
};

void study_scene(const StudyRequest& options) {
    const Scene scene = load(options.studied.run);
    check_has_cdt(scene);
    if (!options.chart.empty() && !have_gnuplot())
        throw Error(fmt::format("study: --chart: {}", no_gnuplot));
    std::optional<Context> context;
    if (options.side == StudySide::gpu)
        context.emplace(parse_context_request(options.studied.run.gl));
    const Profile profile = context ? measured_profile(*context) : named_profile(options.studied.profile);
    OutputFiles files;
    protect_inputs(options.studied.run, files);
    if (!options.images.empty())
        files.expect_folder(options.images);
    for (const auto& file : {options.csv, options.json, options.chart})
        if (!file.empty())
            files.expect(file);

    StudyOptions study_options;
    study_options.frames = options.studied.run.frames;
    study_options.every = options.studied.every;
    if (!options.images.empty())
        study_options.on_state = [&](const StudiedState& state) {
            files.write(options.images / fmt::format("misses_{:05}.png", state.frame),
                        png(study_picture(state, profile)));
        };
    const std::vector<StudyFrame> frames = [&] {
        Progress progress("study", options.studied.run.frames, true);
        study_options.on_frame = [&](int done) { progress.show(done); };
        if (!context)
            return study_run(scene, profile, study_options);
        GpuSimulation gpu(scene, options.studied.run.shaders);
        return study_run(scene, profile, gpu, study_options);
    }();

    if (!options.csv.empty())
        files.write(options.csv, study_csv(frames));
    if (!options.json.empty()) {
        nlohmann::json json = study_json(frames);
        json["scene"] = scene.name;
        json["switches"] = settings_text(options.studied.run, scene);
        json["repeat"] = command_line("study", options.studied.run, options.studied.run.frames);
        files.write(options.json, json_text(json));
    }
    if (!options.chart.empty())
        files.write(options.chart, chart_svg(frames, scene.name));
    files.commit();
    fmt::print("scene     {} ({}): {}, range {}\nswitches  {}\n\n{}", scene.name,
               plain_line(options.studied.run.scene.string()), counted(scene.start.size(), "particle"),
               scene.constants.collision_range, settings_text(options.studied.run, scene), study_text(frames));
    if (!options.images.empty())
        fmt::print("\npictures  {}: {}\n", options.images.string(), picture_legend());
}

} // namespace

Verb study_command() {
    auto options = std::make_shared<StudyRequest>();
    Verb verb{"study", "compare what the CDT search finds with the exact neighbours, and say why it misses some; only "
                       "thesis and --side gpu need GL"};
    add_studied_scene(verb, options->studied, SceneArgument::optional);
    verb.add(path_option("--csv", "FILE", options->csv, "write every number of every studied frame"));
    verb.add(path_option("--json", "FILE", options->json, "the same as JSON"));
    verb.add(path_option("--images", "DIR", options->images,
                         "write a false-colour picture of each studied frame, by cause"));
    verb.add(
        path_option("--chart", "FILE", options->chart, "draw recall and misses over the frames as SVG, by gnuplot"));
    verb.add(choice_option<StudySide>("--side", options->side, {{"cpu", StudySide::cpu}, {"gpu", StudySide::gpu}},
                                      "the side that runs SCENE: the reference, or the shaders, read back each frame"));
    add_gl_options(verb, options->studied.run);
    verb.verbs = study_parts();
    verb.verbs.push_back(thesis_verb());
    verb.footer = "Examples: lockstep study data/scenes/x_streams.json --frames 60 --every 10\n"
                  "          lockstep study thesis --gl egl-device:0 --json thesis.json --chart thesis.svg";
    verb.run = [options](const Call& call) {
        if (options->studied.run.scene.empty())
            throw Error("study: a SCENE is needed, or one of rest, cameras, recall, catalogue, remedies, thesis");
        const bool gpu = options->side == StudySide::gpu;
        for (const std::string_view name : {"--gl", "--shaders", "--allow-unused", "--profile"})
            if (call.has(name) && gpu == (name == "--profile"))
                throw Error(fmt::format("study: {} goes with --side {}", name, gpu ? "cpu" : "gpu"));
        check_frames(options->studied);
        study_scene(*options);
        return status_agree;
    };
    return verb;
}

} // namespace lockstep
