#include "crosscheck/cli/study_parts.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/collision/study/camera_experiments.hpp"
#include "crosscheck/collision/study/catalogue.hpp"
#include "crosscheck/collision/study/catalogue_pictures.hpp"
#include "crosscheck/collision/study/recall_table.hpp"
#include "crosscheck/collision/study/remedy_table.hpp"
#include "crosscheck/collision/study/rest.hpp"
#include "crosscheck/collision/study/study_pictures.hpp"
#include "crosscheck/command/exit_status.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/png.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "gpu/context.hpp"
#include "gpu/data_folder.hpp"
#include "reference/model/error.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {
namespace {

/// Of scenes of its own: recall and the catalogue.
struct TableRequest {
    RunOptions run; ///< its threads
    std::filesystem::path scenes, images;
};

struct RemedyRequest {
    RunOptions run;
    std::string profile = "strict";
    std::filesystem::path scenes, json;
};

void print_recall_table(const std::filesystem::path& scenes) {
    fmt::print("{}", recall_table_head());
    recall_table(scenes, [](const RecallRow& row) {
        fmt::print("{}", recall_row_text(row));
        std::fflush(stdout);
    });
    fmt::print("{}", recall_table_foot());
}

/// With --gl on that context, else recall alone.
void print_remedies(const RemedyRequest& options, bool gl) {
    OutputFiles files;
    if (!options.json.empty())
        files.expect(options.json);
    std::optional<Context> context;
    if (gl)
        context.emplace(parse_context_request(options.run.gl));
    RemedyOptions remedies;
    remedies.scenes = scenes_or_shipped(options.scenes);
    remedies.shaders = options.run.shaders;
    remedies.particles = options.run.particles.value_or(remedies.particles);
    remedies.gl = gl;
    remedies.profile = context ? measured_profile(*context) : named_profile(options.profile);
    remedies.on_row = [](const RemedyRow& row) {
        fmt::print("{}", remedy_text(row));
        std::fflush(stdout);
    };
    const std::string where = context ? summary(context->describe()) : "no GL: recall alone; --gl measures the cost";
    fmt::print("{}\n{} in a cube at rest, radius 4\n\n{}", where, counted(remedies.particles, "particle"),
               remedy_head());
    const std::vector<RemedyRow> rows = remedy_table(remedies);
    if (!options.json.empty())
        files.write(options.json, json_text({{"gl", where}, {"rows", remedy_json(rows)}}));
    files.commit();
}

/// Whether every effect is there.
bool print_catalogue(const std::filesystem::path& scenes, const std::filesystem::path& images) {
    OutputFiles files;
    if (!images.empty())
        files.expect_folder(images);
    bool all = true;
    fmt::print("{}", catalogue_head());
    for (const std::string_view name : catalogue_names()) {
        for (const CatalogueRow& row : measure_catalogue(name, scenes)) {
            fmt::print("{}", catalogue_text(row));
            all = all && row.holds();
        }
        if (!images.empty())
            files.write(images / fmt::format("{}.png", name), png(catalogue_picture(name, scenes)));
    }
    files.commit();
    if (!images.empty())
        fmt::print("\npictures  {}: what the viewer sees, and the collision camera's texels: {}\n", images.string(),
                   picture_legend());
    return all;
}

void print_cameras(const StudiedScene& studied) {
    const Scene scene = load(studied.run);
    check_has_cdt(scene);
    CameraOptions cameras;
    cameras.frames = studied.run.frames;
    cameras.every = studied.every;
    cameras.on_row = [](const CameraRow& row) {
        fmt::print("{}", camera_text(row));
        std::fflush(stdout);
    };
    fmt::print("{}", camera_head());
    camera_experiments(scene, named_profile(studied.profile), cameras);
    fmt::print("\nHoles: of the particles in contact that the viewer sees, those that find no neighbour.\n");
}

void print_rest(const StudiedScene& studied) {
    const Scene scene = load(studied.run);
    RestOptions rest;
    rest.frames = studied.run.frames;
    rest.every = studied.every;
    rest.on_frame = [first = true](const RestFrame& row) mutable {
        fmt::print("{}{}", std::exchange(first, false) ? rest_head() : "", rest_text(row));
        std::fflush(stdout);
    };
    rest_run(scene, named_profile(studied.profile), rest);
    fmt::print("\nAt rest: above the lowest point of the obstacles and slower than {} units a second, of all "
               "particles; heights are over that point.\n",
               rest_speed);
}

/// Of one scene, run for some frames.
Verb scene_verb(const char* name, const char* about, const char* footer, void (*print)(const StudiedScene&)) {
    auto options = std::make_shared<StudiedScene>();
    Verb verb{name, about};
    add_studied_scene(verb, *options);
    verb.footer = footer;
    verb.run = [options, print](const Call&) {
        check_frames(*options);
        print(*options);
        return status_agree;
    };
    return verb;
}

Verb rest_verb() {
    return scene_verb("rest", "how many particles of SCENE have come to rest over the frames, and how high they lie",
                      "Example: lockstep study rest data/scenes/thesis/plane_pile.json --frames 600 --every 60",
                      print_rest);
}

Verb cameras_verb() {
    return scene_verb("cameras",
                      "SCENE with the thesis's collision cameras (chapter 3.4): z offsets, fixed, side, rear",
                      "Example: lockstep study cameras data/scenes/bunny_a.json --frames 60 --every 20", print_cameras);
}

Verb recall_verb() {
    auto options = std::make_shared<TableRequest>();
    Verb verb{"recall", "clouds at rest: what the search finds, by radius"};
    add_threads_option(verb, options->run);
    add_scenes_option(verb, options->scenes);
    verb.footer = "Example: lockstep study recall";
    verb.run = [options](const Call&) {
        start_threads(options->run.threads);
        print_recall_table(scenes_or_shipped(options->scenes));
        return status_agree;
    };
    return verb;
}

Verb catalogue_verb() {
    auto options = std::make_shared<TableRequest>();
    Verb verb{"catalogue", "the thesis's failures as a table (docs/catalogue.md)"};
    add_threads_option(verb, options->run);
    verb.add(path_option("--images", "DIR", options->images, "write a picture of each effect"));
    add_scenes_option(verb, options->scenes);
    verb.footer = "Exit status: 0 every effect is there, 1 one is not, 2 could not run.\n"
                  "Example: lockstep study catalogue --images pictures";
    verb.run = [options](const Call&) {
        start_threads(options->run.threads);
        const bool all = print_catalogue(scenes_or_shipped(options->scenes) / "catalogue", options->images);
        return all ? status_agree : status_differ;
    };
    return verb;
}

Verb remedies_verb() {
    auto options = std::make_shared<RemedyRequest>();
    Verb verb{"remedies", "what the remedies find, and with --gl what they cost (docs/remedies.md)"};
    verb.add(integer_option("--particles", "N", {1, most_particles}, options->run.particles, "number of particles"));
    add_threads_option(verb, options->run);
    add_profile_option(verb, options->profile);
    verb.add(path_option("--json", "FILE", options->json, "write the table as JSON"));
    add_gl_options(verb, options->run);
    add_scenes_option(verb, options->scenes);
    verb.footer = "Example: lockstep study remedies --gl egl-device:0";
    verb.run = [options](const Call& call) {
        const bool gl = call.has("--gl");
        if (gl && call.has("--profile"))
            throw Error("study remedies: --profile does not go with --gl, whose driver has one of its own");
        for (const std::string_view name : {"--shaders", "--allow-unused"})
            if (!gl && call.has(name))
                throw Error(fmt::format("study remedies: {} goes with --gl", name));
        start_threads(options->run.threads);
        print_remedies(*options, gl);
        return status_agree;
    };
    return verb;
}

} // namespace

void add_scenes_option(Verb& verb, std::filesystem::path& scenes) {
    verb.add(path_option("--scenes", "DIR", scenes,
                         "where the study's own scenes are, instead of those that come with lockstep"));
}

std::filesystem::path scenes_or_shipped(const std::filesystem::path& scenes) {
    return scenes.empty() ? shipped_scene("lattice").parent_path() : scenes;
}

void check_frames(const StudiedScene& studied) {
    if (studied.run.frames < 2)
        throw Error("study: --frames 1 is the frame with the empty CDT; 2 or more have something to study");
}

void check_has_cdt(const Scene& scene) {
    if (scene.switches.search != Search::cdt)
        throw Error(
            fmt::format("study: search = {} leaves no CDT of particles to study; study thesis has the octree's recall",
                        switch_value(scene.switches, "search")));
}

void add_studied_scene(Verb& verb, StudiedScene& studied, SceneArgument scene) {
    add_scene_options(verb, studied.run, scene);
    verb.add(integer_option("--frames", "N", {1, most_frames}, studied.run.frames, "frames to run"));
    verb.add(integer_option("--every", "N", {1, most_frames}, studied.every, "study every Nth frame only"));
    add_profile_option(verb, studied.profile);
}

std::vector<Verb> study_parts() {
    return {rest_verb(), cameras_verb(), recall_verb(), catalogue_verb(), remedies_verb()};
}

} // namespace lockstep
