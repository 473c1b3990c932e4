#include "crosscheck/package/text_passes.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/dispatch.hpp"
#include "crosscheck/judge/open_pass.hpp"
#include "crosscheck/package/item_steps.hpp"
#include "crosscheck/text/pass_witness.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Whether a pass's shader is in a folder of the user's, or includes a file there that is no stage itself.
bool is_own(const ShaderUse& use, const GlPass& pass) {
    const std::string stage = fmt::format("{}{}", pass.name, extension(pass.stage));
    return std::ranges::any_of(use.files, [&](const UsedShader& file) {
        return !file.foreign.empty() && (file.file.starts_with(stage) || !stage_of(file.file));
    });
}

std::shared_ptr<const PassText> text_of(const ShadedSystem& of, std::size_t p, const ShaderFolders& folders) {
    return std::make_shared<const PassText>(of.system.schema, of.passes[p], written_by(of.system, p), folders,
                                            of.arithmetic);
}

/// The pass that dispatches what pass p takes an output of: p itself, or the one that it continues.
std::size_t lead_of(const ShadedSystem& of, std::size_t p) {
    while (p > 0 && of.passes[p].continues)
        --p;
    return p;
}

/// What the passes before p of its dispatch wrote.
std::vector<std::uint8_t> made_before(const ShadedSystem& of, std::size_t p) {
    std::vector<std::uint8_t> made;
    for (std::size_t k = lead_of(of, p); k < p; ++k)
        made.push_back(of.system.passes[k]->resource());
    return made;
}

/// Whether that is nothing that the text reads: then its dispatch makes of the state that p finds what it made of the
/// one before.
bool is_made_again(const std::vector<std::uint8_t>& made_before, const PassText& text) {
    return std::ranges::none_of(made_before, [&](std::uint8_t resource) { return text.reads(resource); });
}

} // namespace

std::vector<PassStages> stages_of(const std::vector<GlPass>& passes, ArithmeticSwitch arithmetic) {
    std::vector<PassStages> stages;
    for (const GlPass& pass : passes) {
        if (pass.continues)
            continue;
        const StageInput input = stage_input(pass, arithmetic);
        const auto known = std::ranges::find(stages, pass.name, &PassStages::name);
        if (known != stages.end()) {
            if (std::ranges::find(known->inputs, input) == known->inputs.end())
                known->inputs.push_back(input);
            continue;
        }
        stages.push_back({pass.name, {pass.stage}, {input}});
        if (pass.draw && pass.draw->has_geometry)
            stages.back().stages.push_back(Stage::geometry);
        if (pass.draws_vertices())
            stages.back().stages.push_back(Stage::fragment);
    }
    return stages;
}

void check_references(const ShaderUse& references, const std::filesystem::path& folder,
                      std::span<const GlPass> passes) {
    const bool has_fragments =
        std::ranges::any_of(passes, [](const GlPass& one) { return one.stage == Stage::fragment; });
    for (const UsedShader& file : references.files)
        if (const std::optional<Stage> stage = stage_of(file.file);
            !file.foreign.empty() && stage && *stage != Stage::compute && *stage != Stage::vertex &&
            !(has_fragments && *stage == Stage::fragment))
            throw Error(
                fmt::format("--reference {}: {} is no compute or vertex stage; a text is the reference of these",
                            plain_line(folder.string()), file.file));
}

References take_references(const ShadedSystem& of, const ShaderUse& references, const std::filesystem::path& folder,
                           const std::optional<std::filesystem::path>& gpu) {
    const ShaderFolders folders = shader_folders(folder, of.system.schema.system);
    References taken{.texts = OwnTexts(of.passes.size()), .lines = {}};
    std::vector<std::unique_ptr<ItemPass>>& passes = of.system.passes;
    for (std::size_t p = 0; p < passes.size();) {
        const std::size_t end = end_of_dispatch(of.system, p);
        if (of.passes[p].draws_vertices() || !is_own(references, of.passes[p])) {
            p = end;
            continue;
        }
        const std::shared_ptr<const PassText> text = text_of(of, p, folders);
        const bool is_gpus = gpu && text->is_text_of(shader_folders(*gpu, of.system.schema.system));
        std::string line = fmt::format(
            "reference of {}: its text in {}{}", of.passes[p].name, plain_line(folder.string()),
            is_gpus ? ", the same that the GPU runs: this says what the driver does, not whether the shader is right"
                    : "");
        if (std::ranges::find(taken.lines, line) == taken.lines.end()) // one shader may be that of several passes
            taken.lines.push_back(std::move(line));
        taken.texts[p] = text;
        // What twins may do wrong is nothing that a text does.
        std::erase_if(of.system.mistakes, [&](const NamedMistake& one) { return one.pass == of.passes[p].name; });
        take_text(std::span(passes).subspan(p, end - p), text);
        p = end;
    }
    return taken;
}

OwnTexts open_by_own_text(const ShadedSystem& of, const ShaderUse& use, const std::filesystem::path& shaders) {
    OwnTexts texts(of.passes.size());
    const ShaderFolders folders = shader_folders(shaders, of.system.schema.system);
    for (std::size_t p = 0; p < of.passes.size(); ++p) {
        const std::size_t lead = lead_of(of, p);
        if (of.passes[lead].draws_vertices() || !is_own(use, of.passes[lead]))
            continue;
        try {
            if (lead == p)
                texts[p] = text_of(of, p, folders);
            else if (texts[lead] != nullptr && is_made_again(made_before(of, p), *texts[lead]))
                texts[p] = texts[lead];
            else
                continue;
            std::unique_ptr<ItemPass>& reference = of.system.passes[p];
            const std::uint8_t resource = reference->resource();
            reference = open_pass(std::move(reference), own_text(texts[p], resource));
        } catch (const Error&) { // shader_findings says why a text is not interpreted
        }
    }
    return texts;
}

std::shared_ptr<const PassText> text_of_pass(const ShadedSystem& of, std::size_t p,
                                             const std::filesystem::path& shaders) {
    const std::size_t lead = lead_of(of, p);
    if (of.passes[lead].draws_vertices())
        return nullptr;
    std::shared_ptr<const PassText> text = text_of(of, lead, shader_folders(shaders, of.system.schema.system));
    return is_made_again(made_before(of, p), *text) ? text : nullptr;
}

void show_texts(const ShadedSystem& of, const std::filesystem::path& shaders) {
    const Schema& schema = of.system.schema;
    of.system.texts.resize(of.passes.size());
    for (std::size_t p = 0; p < of.passes.size(); ++p) {
        const std::size_t lead = lead_of(of, p);
        if (of.passes[lead].draws_vertices())
            continue;
        of.system.texts[p] = steps_of_text(
            of.system.passes[p]->resource(), [&schema, pass = of.passes[lead], written = written_by(of.system, lead),
                                              folders = shader_folders(shaders, schema.system),
                                              arithmetic = of.arithmetic, before = made_before(of, p)] {
                auto text = std::make_shared<const PassText>(schema, pass, written, folders, arithmetic);
                if (!is_made_again(before, *text))
                    throw Error("its dispatch wrote what it reads");
                return text;
            });
    }
}

std::vector<std::string> lines_without_counterpart(const ShadedSystem& of, const OwnTexts& own, const ShaderUse& use,
                                                   const std::filesystem::path& reference,
                                                   DivergentPass& divergence) try {
    if (!divergence.pass() || own.size() <= *divergence.pass() || own[*divergence.pass()] == nullptr)
        return {};
    const std::size_t p = *divergence.pass();
    const std::shared_ptr<const PassText> expected =
        text_of(of, lead_of(of, p), shader_folders(reference, of.system.schema.system));
    const JudgedPass judged = divergence.judged();
    const DivergentPass::Items& items = divergence.items();
    const auto is_own_line = [&](std::string_view where) {
        return std::ranges::any_of(use.files, [&](const UsedShader& file) {
            return !file.foreign.empty() && where.starts_with(file.file + ":");
        });
    };
    std::vector<std::string> lines;
    for (const WitnessLine& one : witness_lines(*own[p], *expected, judged.input(), judged.profile,
                                                judged.pass.resource(), items.wrong, items.right, is_own_line))
        lines.push_back(plain_line(line_of(one)));
    return lines;
} catch (const Error&) {
    return {}; // notes say what is not interpreted
}

} // namespace lockstep
