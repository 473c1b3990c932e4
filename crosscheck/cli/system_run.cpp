#include "crosscheck/cli/system_run.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/named_files.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/files/threads.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/package/text_passes.hpp"
#include "crosscheck/report/overlay.hpp"
#include "gpu/stages_run.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

RunOptions with_folders(const RegisteredSystem& system, RunOptions run) {
    if (system.folders == nullptr || run.scene.empty())
        return run;
    const SceneFolders named = system.folders(JsonValue(run.document.of(run.scene), run.scene.string()), run.scene);
    run.shaders_by_scene = run.shaders.empty();
    run.reference_by_scene = run.reference.empty();
    run.allow_unused = run.allow_unused || run.shaders_by_scene;
    if (run.shaders_by_scene)
        run.shaders = named.shaders;
    if (run.reference_by_scene)
        run.reference = named.reference;
    return run;
}

ReadScene read_scene(const RegisteredSystem& system, const RunOptions& run) {
    start_threads(run.threads);
    const nlohmann::json& document = run.document.of(run.scene);
    const std::string file = run.scene.string(), name = plain_line(run.scene.stem().string());
    const auto files = std::make_shared<NamedFiles>();
    SystemScene scene = system.load(JsonValue(document, file), name, {run.particles, run.preset, run.set, files});
    nlohmann::json options{{"set", run.set}};
    if (run.particles)
        options["particles"] = *run.particles;
    if (run.preset)
        options["preset"] = *run.preset;
    if (!files->contents().empty())
        options["files"] = carried_json(files->contents());
    return {file, document, std::move(options), std::move(scene), files->places()};
}

void ReadScene::protect(const RunOptions& run, OutputFiles& files) const {
    files.protect(run.scene);
    files.protect(run.shaders);
    files.protect(run.reference);
    for (const std::filesystem::path& place : places)
        files.protect(place);
}

ReadScene recorded_scene(const RegisteredSystem& system, const nlohmann::json& scene, const nlohmann::json& options,
                         const std::string& name, const std::string& file) {
    const JsonValue document(scene, file);
    const JsonValue given(options, file);
    if (system_of_scene(document) != &system)
        document.fail(fmt::format("is no scene of system {}", system.name));
    given.check_keys({"set", "particles", "preset", "files"});
    SceneOptions changes;
    for (const JsonValue& change : given.at("set").items())
        changes.set.push_back(change.text());
    if (const auto count = given.find("particles"))
        changes.particles = static_cast<std::size_t>(count->integer(1, most_particles));
    if (const auto preset = given.find("preset"))
        changes.preset = preset->text();
    const auto files = given.find("files");
    changes.files = std::make_shared<NamedFiles>(files ? read_carried(*files) : NamedFiles::Contents());
    return {file, scene, options, system.load(document, name, changes), {}};
}

namespace {

ReadScene read_recorded(const RegisteredSystem& system, const SystemRecording& recording) {
    if (system.folders != nullptr)
        throw Error(fmt::format("{}: is recorded of a check file, which holds its reference; expected that file beside "
                                "--trace: lockstep check FILE.json --trace {}",
                                recording.file(), shell_path(recording.file())));
    if (recording.info().scene.is_null())
        throw Error(fmt::format("{}: {}: missing; right is the text of a scene file", recording.file(),
                                "parameters/lockstep/scene"));
    return recorded_scene(system, recording.info().scene, recording.info().options, recording.info().name,
                          recording.file());
}

/// What draws a frame's picture, with all its stages.
std::vector<PassStages> drawn_passes(const SystemScene& scene) {
    std::vector<PassStages> passes;
    if (scene.picture)
        for (const GlPass& pass : scene.picture(scene.system.start, 0).passes)
            passes.push_back({pass.name, {pass.stage, Stage::fragment}, {stage_input(pass, scene.arithmetic)}});
    return passes;
}

} // namespace

SystemInput::SystemInput(const RegisteredSystem& system, const RunOptions& run, std::filesystem::path trace,
                         DrawnStages drawn)
    : run_(run), drawn_(drawn), trace_(std::move(trace)),
      recording_(trace_.empty() ? nullptr : std::make_unique<SystemRecording>(trace_, std::string(system.name))),
      read_(recording_ && run.scene.empty() ? read_recorded(system, *recording_) : read_scene(system, run)) {
    if (recording_)
        start_threads(run.threads);
    else
        shaders_ = shaders_of(scene(), run, drawn);
    if (!run.reference.empty())
        reference_use_ = references_of(read_.scene, run);
    own_texts_ = take_texts(shaded(), references_);
    if (!is_recorded())
        show_texts(shaded(), run.shaders);
    if (scene().picture && reference_use_) {
        SystemPicture picture = scene().picture(read_.scene.system.start, 0);
        take_texts({picture.system, picture.passes, scene().arithmetic}, references_);
    }
}

OwnTexts SystemInput::take_texts(const ShadedSystem& of, References& references) const {
    if (reference_use_) {
        References taken = take_references(of, *reference_use_, run_.reference,
                                           is_recorded() ? std::nullopt : std::optional(run_.shaders));
        references.lines.insert(references.lines.end(), taken.lines.begin(), taken.lines.end());
        if (references.texts.empty()) // a picture is another system
            references.texts = std::move(taken.texts);
    }
    return shaders_ && !run_.shaders.empty() ? open_by_own_text(of, *shaders_, run_.shaders) : OwnTexts();
}

DrawnSystem SystemInput::drawn(const SystemState& state, int frame) const {
    DrawnSystem made{scene().picture(state, frame), {}};
    References ignored; // the notes say it once
    const ShadedSystem of{made.picture.system, made.picture.passes, scene().arithmetic};
    made.own_texts = take_texts(of, ignored);
    if (!is_recorded())
        show_texts(of, run_.shaders);
    return made;
}

void SystemInput::protect(OutputFiles& files) const {
    files.protect(trace_);
    if (!run_.scene.empty())
        read_.protect(run_, files);
}

SystemSide& SystemInput::open() {
    if (recording_) {
        recording_->open(system());
        side_ = std::make_unique<RecordedSide>(*recording_, system());
        return *side_;
    }
    gl_.emplace(open_gl(run_));
    if (drawn_ != DrawnStages::all)
        compile_alone(system().schema.system, drawn_passes(scene()), run_.shaders);
    side_ = std::make_unique<GlSystemSide>(*gl_, system(), scene().passes, run_.shaders.string(), scene().arithmetic);
    return *side_;
}

void SystemInput::describe(RunDescription& about) const {
    about.scene = fmt::format("{} ({})", system().name, plain_line(read_.file));
    about.shaders = shaders_;
    if (recording_) {
        about.shaders_untold = "recorded: " + recording_->info().shaders;
        about.notes = recording_->warnings();
    }
    about.notes.insert(about.notes.end(), references_.lines.begin(), references_.lines.end());
}

std::vector<std::string> SystemInput::left_open(const Profile& profile) const {
    return scene().left_open ? scene().left_open(profile) : std::vector<std::string>();
}

std::string SystemInput::command(const std::string& verb, const std::string& words) const {
    if (!recording_)
        return command_line(verb, run_, words);
    return fmt::format("lockstep {} {}--trace {} {}", verb, run_.scene.empty() ? "" : shell_path(run_.scene) + " ",
                       shell_path(trace_), words);
}

ShaderUse references_of(const SystemScene& scene, const RunOptions& run) {
    RunOptions of_references = run;
    of_references.shaders = run.reference;
    ShaderUse use = shaders_of(scene, of_references);
    check_references(use, run.reference, scene.passes);
    return use;
}

ShaderUse shaders_of(const SystemScene& scene, const RunOptions& run, DrawnStages drawn) {
    std::vector<PassStages> stages = stages_of(scene.passes, scene.arithmetic);
    std::vector<PassStages> run_here = stages;
    for (PassStages& pass : drawn_passes(scene)) {
        stages.push_back(pass);
        pass.stages.resize(static_cast<std::size_t>(drawn));
        run_here.push_back(std::move(pass));
    }
    const std::string& system = scene.system.schema.system;
    const ShaderUse whole = shader_use(system, stages, run.shaders);
    ShaderUse use = shader_use(system, run_here, run.shaders);
    use.unused = whole.unused;
    check_shader_use(use, run.shaders, run.allow_unused);
    add_compiled(use, whole);
    return use;
}

Gl open_gl(const RunOptions& run) {
    Gl gl(run.gl);
    if (!gl)
        throw Error(gl.missing());
    return gl;
}

GlSystemSide side_of(const Gl& gl, const SystemPicture& picture, const SystemScene& scene, const RunOptions& run) {
    return {gl, picture.system, picture.passes, run.shaders.string(), scene.arithmetic};
}

GlSystemSide side_of(const Gl& gl, const SystemScene& scene, const RunOptions& run) {
    return {gl, scene.system, scene.passes, run.shaders.string(), scene.arithmetic};
}

ColorImage reference_picture(const SystemScene& scene, const SystemState& state, int frame, const Profile& profile) {
    if (scene.image)
        return scene.image(state);
    const SystemPicture picture = scene.picture(state, frame);
    ReferenceRun drawn(picture.system, profile);
    drawn.step(0);
    ColorImage image = picture.image(drawn.state().view());
    draw_overlay(image, picture.to_clip, picture.overlay);
    return image;
}

ColorImage gpu_picture(const Gl& gl, const SystemScene& scene, const SystemState& state, int frame,
                       const RunOptions& run) {
    if (scene.image)
        return scene.image(state);
    const SystemPicture picture = scene.picture(state, frame);
    GlSystemSide drawn = side_of(gl, picture, scene, run);
    drawn.upload(picture.system.start.view());
    ColorImage image = drawn.picture(0, 0, picture.how);
    draw_overlay(image, picture.to_clip, picture.overlay);
    return image;
}

} // namespace lockstep
