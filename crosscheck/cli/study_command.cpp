#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/cli/thesis_study.hpp"
#include "crosscheck/collision/study/camera_experiments.hpp"
#include "crosscheck/collision/study/catalogue.hpp"
#include "crosscheck/collision/study/catalogue_pictures.hpp"
#include "crosscheck/collision/study/recall_table.hpp"
#include "crosscheck/collision/study/remedy_table.hpp"
#include "crosscheck/collision/study/rest.hpp"
#include "crosscheck/collision/study/study.hpp"
#include "crosscheck/collision/study/study_pictures.hpp"
#include "crosscheck/collision/study/study_report.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/png.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/report/gnuplot.hpp"
#include "crosscheck/report/progress.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/collision/simulation.hpp"
#include "gpu/context.hpp"
#include "gpu/data_folder.hpp"
#include "reference/model/error.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {
namespace {

enum class StudySide { cpu, gpu };

struct StudyRequest {
    RunOptions run;
    int every = 1;
    std::string profile = "strict";
    std::filesystem::path csv, json, images, chart;
    std::filesystem::path scenes; ///< empty: those that come with lockstep
    bool recall_table = false;
    bool catalogue = false;
    bool cameras = false;
    bool rest = false;
    StudySide side = StudySide::cpu;
    bool remedies = false;
    bool gl_asked = false;
    bool thesis = false;
    ThesisStudy thesis_study;
};

void print_recall_table(const StudyRequest& options) {
    fmt::print("{}", recall_table_head());
    recall_table(options.scenes, [](const RecallRow& row) {
        fmt::print("{}", recall_row_text(row));
        std::fflush(stdout);
    });
    fmt::print("{}", recall_table_foot());
}

/// With --gl on that context, else recall alone.
void print_remedies(const StudyRequest& options) {
    const bool gl = options.gl_asked;
    OutputFiles files;
    if (!options.json.empty())
        files.expect(options.json);
    std::optional<Context> context;
    if (gl)
        context.emplace(parse_context_request(options.run.gl));
    RemedyOptions remedies;
    remedies.scenes = options.scenes;
    remedies.shaders = options.run.shaders;
    remedies.particles = options.run.particles.value_or(remedies.particles);
    remedies.gl = gl;
    remedies.profile = context ? measured_profile(*context) : named_profile(options.profile);
    remedies.on_row = [](const RemedyRow& row) {
        fmt::print("{}", remedy_text(row));
        std::fflush(stdout);
    };
    const std::string where = context ? summary(context->describe()) : "no GL: recall alone; --gl measures the cost";
    fmt::print("{}\n{} particles in a cube at rest, radius 4\n\n{}", where, remedies.particles, remedy_head());
    const std::vector<RemedyRow> rows = remedy_table(remedies);
    if (!options.json.empty())
        files.write(options.json, json_text({{"gl", where}, {"rows", remedy_json(rows)}}));
    files.commit();
}

/// Whether every effect is there.
bool print_catalogue(const StudyRequest& options) {
    const std::filesystem::path scenes = options.scenes / "catalogue";
    OutputFiles files;
    if (!options.images.empty())
        files.expect_folder(options.images);
    bool all = true;
    fmt::print("{}", catalogue_head());
    for (const std::string_view name : catalogue_names()) {
        for (const CatalogueRow& row : measure_catalogue(name, scenes)) {
            fmt::print("{}", catalogue_text(row));
            all = all && row.holds();
        }
        if (!options.images.empty())
            files.write(options.images / fmt::format("{}.png", name), png(catalogue_picture(name, scenes)));
    }
    files.commit();
    if (!options.images.empty())
        fmt::print("\npictures  {}: what the viewer sees, and the collision camera's texels: {}\n",
                   options.images.string(), picture_legend());
    return all;
}

void print_cameras(const StudyRequest& options, const Scene& scene, const Profile& profile) {
    CameraOptions cameras;
    cameras.frames = options.run.frames;
    cameras.every = options.every;
    cameras.on_row = [](const CameraRow& row) {
        fmt::print("{}", camera_text(row));
        std::fflush(stdout);
    };
    fmt::print("{}", camera_head());
    camera_experiments(scene, profile, cameras);
    fmt::print("\nHoles: of the particles in contact that the viewer sees, those that find no neighbour.\n");
}

void print_rest(const StudyRequest& options) {
    const Scene scene = load(options.run);
    RestOptions rest;
    rest.frames = options.run.frames;
    rest.every = options.every;
    rest.on_frame = [first = true](const RestFrame& row) mutable {
        fmt::print("{}{}", std::exchange(first, false) ? rest_head() : "", rest_text(row));
        std::fflush(stdout);
    };
    rest_run(scene, named_profile(options.profile), rest);
    fmt::print("\nAt rest: above the lowest point of the obstacles and slower than {} units a second, of all "
               "particles; heights are over that point.\n",
               rest_speed);
}

void study_scene(const StudyRequest& options) {
    const Scene scene = load(options.run);
    if (scene.switches.search != Search::cdt)
        throw Error(
            fmt::format("study: search = {} leaves no CDT of particles to study; study thesis has the octree's recall",
                        switch_value(scene.switches, "search")));
    if (!options.chart.empty() && !have_gnuplot())
        throw Error(fmt::format("study: --chart: {}", no_gnuplot));
    std::optional<Context> context;
    if (options.side == StudySide::gpu)
        context.emplace(parse_context_request(options.run.gl));
    const Profile profile = context ? measured_profile(*context) : named_profile(options.profile);
    if (options.cameras)
        return print_cameras(options, scene, profile);
    OutputFiles files;
    protect_inputs(options.run, files);
    if (!options.images.empty())
        files.expect_folder(options.images);
    for (const auto& file : {options.csv, options.json, options.chart})
        if (!file.empty())
            files.expect(file);

    StudyOptions study_options;
    study_options.frames = options.run.frames;
    study_options.every = options.every;
    if (!options.images.empty())
        study_options.on_state = [&](const StudiedState& state) {
            files.write(options.images / fmt::format("misses_{:05}.png", state.frame),
                        png(study_picture(state, profile)));
        };
    const std::vector<StudyFrame> frames = [&] {
        Progress progress("study", options.run.frames, true);
        study_options.on_frame = [&](int done) { progress.show(done); };
        if (!context)
            return study_run(scene, profile, study_options);
        GpuSimulation gpu(scene, options.run.shaders);
        return study_run(scene, profile, gpu, study_options);
    }();

    if (!options.csv.empty())
        files.write(options.csv, study_csv(frames));
    if (!options.json.empty()) {
        nlohmann::json json = study_json(frames);
        json["scene"] = scene.name;
        json["switches"] = settings_text(options.run, scene);
        json["repeat"] = command_line("study", options.run, options.run.frames);
        files.write(options.json, json_text(json));
    }
    if (!options.chart.empty())
        files.write(options.chart, chart_svg(frames, scene.name));
    files.commit();
    fmt::print("scene     {} ({}): {} particles, range {}\nswitches  {}\n\n{}", scene.name,
               plain_line(options.run.scene.string()), scene.start.size(), scene.constants.collision_range,
               settings_text(options.run, scene), study_text(frames));
    if (!options.images.empty())
        fmt::print("\npictures  {}: {}\n", options.images.string(), picture_legend());
}

/// What a study is of, the words for it, and the options that it takes.
struct Mode {
    std::string text;
    std::vector<std::string_view> options;
};

using Names = std::vector<std::string_view>;

/// By mode, whatever is asked for besides.
const Names of_recall{"--scenes", "--threads"};
const Names of_catalogue{"--scenes", "--threads", "--images"};
const Names of_remedies{"--scenes", "--threads", "--particles", "--json", "--profile", "--gl", "--shaders"};
const Names of_thesis{"--scenes", "--threads", "--frames",  "--json",   "--csv",     "--chart", "--set",
                      "--preset", "--gl",      "--shaders", "--counts", "--seconds", "--from"};
const Names of_run{"scene", "--particles", "--preset", "--set", "--threads", "--frames", "--every", "--profile"};
const Names of_side{"--side", "--gl", "--shaders"};
const Names of_outputs{"--csv", "--json", "--images", "--chart"};

Names joined(std::initializer_list<Names> parts) {
    Names all;
    for (const Names& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// `names` but for those that an answer to another option takes away.
Names without(Names names, std::initializer_list<std::string_view> taken) {
    std::erase_if(names,
                  [&](std::string_view name) { return std::find(taken.begin(), taken.end(), name) != taken.end(); });
    return names;
}

Mode mode_of(const StudyRequest& options) {
    if (options.recall_table)
        return {"recall", joined({of_recall, {"--recall-table"}})};
    if (options.catalogue)
        return {"catalogue", joined({of_catalogue, {"--catalogue"}})};
    if (options.remedies)
        return options.gl_asked ? Mode{"remedies --gl", joined({{"--remedies"}, without(of_remedies, {"--profile"})})}
                                : Mode{"remedies without --gl",
                                       joined({{"--remedies"}, without(of_remedies, {"--gl", "--shaders"})})};
    if (options.thesis)
        return options.thesis_study.from.empty()
                   ? Mode{"thesis", joined({{"--thesis"}, without(of_thesis, {"--from"})})}
                   : Mode{"thesis --from", {"--thesis", "--from", "--json", "--csv", "--chart"}};
    if (options.rest)
        return {"rest", joined({{"--rest"}, of_run})};
    Mode mode{options.cameras ? "cameras" : "SCENE", joined({of_run, of_side})};
    mode.options = joined({mode.options, options.cameras ? Names{"--cameras"} : of_outputs});
    const bool gpu = options.side == StudySide::gpu;
    mode.text += gpu ? " --side gpu" : " --side cpu";
    mode.options = gpu ? without(mode.options, {"--profile"}) : without(mode.options, {"--gl", "--shaders"});
    return mode;
}

int run(StudyRequest options, const Call& call) {
    if (options.thesis && options.run.particles)
        throw Error("study: thesis has several counts; --counts N,... names them");
    if (options.recall_table || options.catalogue || options.remedies || options.thesis) {
        if (!options.run.scene.empty())
            throw Error("study: recall, catalogue, remedies and thesis have scenes of their own; leave SCENE out");
        const Mode mode = mode_of(options);
        check_options(call, mode.text, mode.options);
        start_threads(options.run.threads);
        if (options.scenes.empty())
            options.scenes = shipped_scene("lattice").parent_path();
        if (options.thesis) {
            ThesisStudy study = options.thesis_study;
            study.run = options.run;
            study.scenes = options.scenes;
            study.csv = options.csv;
            study.json = options.json;
            study.chart = options.chart;
            run_thesis_study(study);
        }
        if (options.recall_table)
            print_recall_table(options);
        if (options.remedies)
            print_remedies(options);
        return options.catalogue && !print_catalogue(options) ? status_differ : status_agree;
    }
    if (options.run.scene.empty())
        throw Error("study: a SCENE is needed, or one of recall, catalogue, remedies, thesis");
    if (options.run.frames < 2)
        throw Error("study: --frames 1 is the frame with the empty CDT; 2 or more have something to study");
    const Mode mode = mode_of(options);
    check_options(call, mode.text, mode.options);
    if (options.rest)
        print_rest(options);
    else
        study_scene(options);
    return status_agree;
}

/// The study's parts by their own names; `all` has their options.
std::vector<Verb> parts(const Verb& all, const std::shared_ptr<StudyRequest>& options) {
    std::vector<Verb> verbs;
    const auto add = [&](Verb verb, const Names& names, bool StudyRequest::*asked, std::string footer) {
        for (const Option& option : all.options)
            if (std::find(names.begin(), names.end(), lockstep::names(option).back()) != names.end()) {
                verb.add(option);
                verb.options.back().hidden = false;
                if (is_argument(option))
                    verb.options.back() = required(verb.options.back());
            }
        verb.footer = std::move(footer);
        verb.run = [options, asked](const Call& call) {
            (*options).*asked = true;
            options->gl_asked = call.has("--gl");
            return run(*options, call);
        };
        verbs.push_back(std::move(verb));
    };
    add({"rest", "how many particles of SCENE have come to rest over the frames, and how high they lie"}, of_run,
        &StudyRequest::rest, "Example: lockstep study rest data/scenes/plane_pile.json --frames 600 --every 60");
    add({"cameras", "SCENE with the thesis's collision cameras (chapter 3.4): z offsets, fixed, side, rear"},
        joined({of_run, of_side}), &StudyRequest::cameras,
        "Example: lockstep study cameras data/scenes/bunny_a.json --frames 60 --every 20");
    add({"recall", "clouds at rest: what the search finds, by radius"}, of_recall, &StudyRequest::recall_table,
        "Example: lockstep study recall");
    add({"catalogue", "the thesis's failures as a table (docs/catalogue.md)"}, of_catalogue, &StudyRequest::catalogue,
        "Exit status: 0 every effect is there, 1 one is not, 2 could not run.\n"
        "Example: lockstep study catalogue --images pictures");
    add({"remedies", "what the remedies find, and with --gl what they cost (docs/remedies.md)"}, of_remedies,
        &StudyRequest::remedies, "Example: lockstep study remedies --gl egl-device:0");
    add({"thesis", "the thesis's tables 4-1 and 5-1 and figures 5-3 and 5-5, CDT, octree and the scene's depth, on GL"},
        of_thesis, &StudyRequest::thesis,
        "Example: lockstep study thesis --gl egl-device:0 --json thesis.json --chart thesis.svg");
    return verbs;
}

} // namespace

Verb study_command() {
    auto options = std::make_shared<StudyRequest>();
    Verb verb{"study", "compare what the CDT search finds with the exact neighbours, and say "
                       "why it misses what it misses; needs no GL but for thesis and --side gpu"};
    add_scene_options(verb, options->run, SceneArgument::optional);
    verb.add(integer_option("--frames", "N", {1, most_frames}, options->run.frames, "frames to run"));
    verb.add(integer_option("--every", "N", {1, most_frames}, options->every, "study every Nth frame only"));
    verb.add(text_option("--profile", "strict|llvmpipe|nvidia", options->profile,
                         "strict, llvmpipe or nvidia: the order of sums"));
    verb.add(path_option("--csv", "FILE", options->csv, "write every number of every studied frame"));
    verb.add(path_option("--json", "FILE", options->json, "the same as JSON"));
    verb.add(path_option(
        "--images", "DIR", options->images,
        "write a false-colour picture of each studied frame, by cause; of the catalogue one of each effect"));
    verb.add(
        path_option("--chart", "FILE", options->chart, "draw recall and misses over the frames as SVG, by gnuplot"));
    verb.add(flag("--recall-table", options->recall_table, "clouds at rest instead of a scene: recall by radius"));
    verb.add(flag("--catalogue", options->catalogue,
                  "the thesis's failure catalogue as a table; exit status 1 if an effect is not there"));
    verb.add(flag("--cameras", options->cameras,
                  "SCENE with the thesis's collision cameras (chapter 3.4): z offsets, fixed, side, rear"));
    verb.add(flag("--rest", options->rest,
                  "how many particles of SCENE have come to rest over the frames, and how high they lie"));
    verb.add(choice_option<StudySide>("--side", options->side, {{"cpu", StudySide::cpu}, {"gpu", StudySide::gpu}},
                                      "the side that runs SCENE: the reference, or the shaders, read back each frame"));
    verb.add(flag("--thesis", options->thesis,
                  "the thesis's tables 4-1 and 5-1 and figures 5-3 and 5-5, CDT, octree and the scene's depth, on GL; "
                  "--frames, --json, --csv, --chart, --set and --gl apply"));
    verb.add(
        integers_option("--counts", "N,...", {1, most_particles}, options->thesis_study.counts, "particle counts"));
    verb.add(seconds_option("--seconds", options->thesis_study.seconds,
                            "a measurement ends with the frame in which this is over"));
    verb.add(path_option("--from", "FILE", options->thesis_study.from,
                         "report and draw what an earlier --json wrote, on a machine without that GL"));
    verb.add(flag("--remedies", options->remedies,
                  "what the remedies find (docs/remedies.md), and with --gl what they cost, as a table; --json and "
                  "--particles apply"));
    add_gl_options(verb, options->run);
    verb.add(path_option("--scenes", "DIR", options->scenes,
                         "where the study's own scenes are, instead of those that come with lockstep"));
    verb.verbs = parts(verb, options);
    const Names own = joined({of_run, of_side, of_outputs});
    for (Option& option : verb.options) // the others' options stay with it under their earlier names
        option.hidden = std::find(own.begin(), own.end(), names(option).back()) == own.end();
    verb.footer = "Examples: lockstep study data/scenes/x_streams.json --frames 60 --every 10\n"
                  "          lockstep study thesis --gl egl-device:0 --json thesis.json --chart thesis.svg";
    verb.run = [options](const Call& call) {
        options->gl_asked = call.has("--gl");
        return run(*options, call);
    };
    return verb;
}

} // namespace lockstep
