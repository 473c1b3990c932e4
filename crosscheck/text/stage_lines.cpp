#include "crosscheck/text/stage_lines.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "crosscheck/text/stage_capture.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "crosscheck/text/text_comparison.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::size_t most_invocations = 65536, most_runs = 4, most_lines = 3;

/// A pair whose texts are interpreted, and what was found of it so far.
struct ReadPair {
    StageText own, reference;
    std::size_t runs = 0;
    std::optional<MadeUpWorld> reference_world; ///< of the reference's own run
    std::vector<WitnessLine> lines;
};

std::string file_of(const ShaderSource& stage) { return stage.files.front(); }

/// Whether FILE:LINE lies in a file that is not shipped, or in a shipped one that goes by such a file's name.
bool is_of_user(const ShaderSource& stage, std::string_view where) {
    return std::ranges::any_of(stage.files, [&](const std::string& file) {
        return !file.starts_with("shaders/") &&
               where.starts_with(std::filesystem::path(file).filename().string() + ":");
    });
}

std::optional<ReadPair> read(const StagePair& pair) {
    try {
        return ReadPair{
            stage_text(pair.own, file_of(*pair.own)), stage_text(pair.reference, file_of(*pair.reference)), 0, {}, {}};
    } catch (const Error&) {
        return {}; // a driver may take what is not interpreted
    }
}

/// Calls f(pair, captured) for the first runs of the stages whose texts, of the two, are wanted.
template <class F> void capture_runs(std::vector<ReadPair>& pairs, const RunStages& run, StageText ReadPair::*which,
                                     std::size_t invocations, const F& f) {
    const auto pair_of = [&](const std::string& text) {
        return std::ranges::find_if(pairs, [&](const ReadPair& pair) { return (pair.*which).source->text == text; });
    };
    bool looks = false;
    for (ReadPair& pair : pairs)
        pair.runs = 0;
    const StageCapture watched({.program = [&](Stage, const std::string& text) -> const text::Program* {
                                    const auto pair = pair_of(text);
                                    return looks && pair != pairs.end() && pair->lines.empty() && pair->runs < most_runs
                                               ? &((*pair).*which).program
                                               : nullptr;
                                },
                                .take =
                                    [&](const std::string& text, CapturedStage stage) {
                                        if (stage.program->stage != spv::ExecutionModelGLCompute &&
                                            stage.run.invocations == 0)
                                            return;
                                        ReadPair& pair = *pair_of(text);
                                        ++pair.runs;
                                        f(pair, std::move(stage));
                                    },
                                .refuse = [](const std::string&, const std::string&) {}},
                               invocations);
    run(which == &ReadPair::reference, [&] { looks = true; });
}

void keep_uniforms(std::map<std::string, std::vector<std::uint32_t>>& kept, const text::Program& program,
                   const std::vector<std::vector<std::uint32_t>>& words) {
    for (std::size_t u = 0; u < program.uniforms.size(); ++u)
        if (!words[u].empty())
            kept[program.uniforms[u].name] = words[u];
}

void compare(ReadPair& pair, CapturedStage stage) {
    Examination of;
    of.file = pair.own.file;
    of.reference = pair.reference.file;
    of.groups = stage.groups;
    of.invocations = stage.run.invocations;
    of.is_watched = false;
    if (pair.reference_world)
        keep_uniforms(of.uniform_words, pair.reference.program, pair.reference_world->bindings.uniforms);
    keep_uniforms(of.uniform_words, pair.own.program, stage.bindings.uniforms);
    const MadeUpWorld world{std::move(stage.words), std::move(stage.bindings)};
    const HostedTexts hosted{[&](std::string_view where) { return is_of_user(*pair.own.source, where); },
                             pair.reference_world ? &*pair.reference_world : nullptr};
    try {
        const WatchedRun run = run_watched(of, pair.own.program, world.copy(), stage.run);
        pair.lines = compare_texts(of, pair.own, pair.reference, world, stage.run, run, &hosted).lines;
    } catch (const Error&) { // of too different kinds
    }
}

} // namespace

std::vector<WitnessLine> lines_of_stages(const std::vector<StagePair>& stages, const RunStages& run) {
    if (gl::DispatchCompute == nullptr || gl::GetProgramInterfaceiv == nullptr)
        return {};
    std::vector<ReadPair> pairs;
    for (const StagePair& pair : stages)
        if (std::optional<ReadPair> one = read(pair))
            pairs.push_back(std::move(*one));
    if (pairs.empty())
        return {};
    try {
        capture_runs(pairs, run, &ReadPair::reference, 1, [](ReadPair& pair, CapturedStage stage) {
            pair.reference_world = MadeUpWorld{std::move(stage.words), std::move(stage.bindings)};
        });
        capture_runs(pairs, run, &ReadPair::own, most_invocations, compare);
    } catch (const Error&) { // a run that ends early has what it came to
    }
    std::vector<WitnessLine> lines;
    for (ReadPair& pair : pairs)
        std::ranges::move(pair.lines, std::back_inserter(lines));
    lines.resize(std::min(lines.size(), most_lines));
    return lines;
}

} // namespace lockstep
