#include "crosscheck/cli/text_passes.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/cli/system_run.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/open_pass.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/text/examine.hpp"
#include "crosscheck/text/text_pass.hpp"
#include "crosscheck/text/witness.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Whether a pass's shader is in a folder of the user's, or includes a file there that is no stage itself.
bool is_own(const ShaderUse& use, const GlPass& pass) {
    return std::ranges::any_of(use.files, [&](const UsedShader& file) {
        return !file.foreign.empty() && (file.file.starts_with(pass.name + ".comp") || !stage_of(file.file));
    });
}

std::shared_ptr<const PassText> text_of(const SystemScene& scene, std::size_t p, const ShaderFolders& folders) {
    return std::make_shared<const PassText>(scene.system.schema, scene.passes[p], written_by(scene.system, p), folders,
                                            scene.arithmetic);
}

bool is_compute(const GlPass& pass) { return pass.stage == Stage::compute; }

} // namespace

std::vector<std::string> take_references(SystemScene& scene, const RunOptions& run) {
    RunOptions of_references = run;
    of_references.shaders = run.reference;
    const ShaderUse use = shaders_of(scene, of_references);
    for (const UsedShader& file : use.files)
        if (const std::optional<Stage> stage = stage_of(file.file);
            !file.foreign.empty() && stage && *stage != Stage::compute)
            throw Error(fmt::format("--reference {}: {} is no compute stage; a text is the reference of one alone",
                                    plain_line(run.reference.string()), file.file));
    const ShaderFolders folders = shader_folders(run.reference, scene.system.schema.system);
    std::vector<std::string> lines;
    std::vector<std::unique_ptr<ItemPass>>& passes = scene.system.passes;
    for (std::size_t p = 0; p < passes.size();) {
        const std::size_t end = end_of_dispatch(scene.system, p);
        if (!is_compute(scene.passes[p]) || !is_own(use, scene.passes[p])) {
            p = end;
            continue;
        }
        const std::shared_ptr<const PassText> text = text_of(scene, p, folders);
        lines.push_back(
            fmt::format("reference of {}: its text in {}", scene.passes[p].name, plain_line(run.reference.string())));
        // What twins may do wrong is nothing that a text does.
        std::erase_if(scene.system.mistakes, [&](const NamedMistake& one) { return one.pass == scene.passes[p].name; });
        take_text(std::span(passes).subspan(p, end - p), text);
        p = end;
    }
    return lines;
}

OwnTexts open_by_own_text(SystemScene& scene, const ShaderUse& use, const std::filesystem::path& shaders) {
    OwnTexts texts(scene.passes.size());
    const ShaderFolders folders = shader_folders(shaders, scene.system.schema.system);
    for (std::size_t p = 0; p < scene.passes.size(); ++p) {
        const GlPass& pass = scene.passes[p];
        if (!is_compute(pass) || pass.continues || !is_own(use, pass))
            continue;
        try {
            texts[p] = text_of(scene, p, folders);
            std::unique_ptr<ItemPass>& reference = scene.system.passes[p];
            const std::uint8_t resource = reference->resource();
            reference = open_pass(std::move(reference), own_text(texts[p], resource));
        } catch (const Error&) { // shader_findings says why a text is not interpreted
        }
    }
    return texts;
}

namespace {

/// Items that the GPU made otherwise than the reference, and such that both changed alike; few of each, from all over.
struct SomeItems {
    std::vector<std::size_t> wrong, right;
};

SomeItems some_items(const JudgedPass& judged) {
    constexpr std::size_t most = 10;
    SomeItems all;
    const std::uint8_t r = judged.pass.resource();
    for (std::size_t item = 0; item < judged.gpu.count(); ++item) {
        const auto gpu = item_words(judged.gpu, item);
        if (gpu != item_words(judged.reference, item))
            all.wrong.push_back(item);
        else if (gpu != item_words(judged.before[r], item))
            all.right.push_back(item);
    }
    for (std::vector<std::size_t>* items : {&all.wrong, &all.right}) {
        std::vector<std::size_t> some;
        for (std::size_t k = 0; k < std::min(most, items->size()); ++k)
            some.push_back((*items)[k * items->size() / std::min(most, items->size())]);
        *items = std::move(some);
    }
    return all;
}

} // namespace

std::vector<std::string> lines_without_counterpart(const SystemScene& scene, const OwnTexts& own, const ShaderUse& use,
                                                   const RunOptions& run, SystemSide& side,
                                                   const KnownOperations& known, const CheckReport& report) try {
    if (report.verdict != Verdict::divergent || !report.verdicts || !report.verdicts->first)
        return {};
    const std::size_t p = report.verdicts->first->pass;
    if (own[p] == nullptr)
        return {};
    const std::shared_ptr<const PassText> reference =
        text_of(scene, p, shader_folders(run.reference, scene.system.schema.system));
    const SystemRun again(scene.system, side, known, report.verdicts->first->place.frame, p);
    const JudgedPass judged = again.judged();
    const SomeItems items = some_items(judged);
    const auto is_own_line = [&](std::string_view where) {
        return std::ranges::any_of(use.files, [&](const UsedShader& file) {
            return !file.foreign.empty() && where.starts_with(file.file + ":");
        });
    };
    std::vector<std::string> lines;
    for (const WitnessLine& one : witness_lines(*own[p], *reference, judged.input(), judged.profile,
                                                judged.pass.resource(), items.wrong, items.right, is_own_line))
        lines.push_back(fmt::format("{}: {}: {}", one.where, plain_line(one.text), one.what));
    return lines;
} catch (const Error&) {
    return {}; // notes say what is not interpreted
}

} // namespace lockstep
