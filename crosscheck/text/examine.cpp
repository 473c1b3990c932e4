#include "crosscheck/text/examine.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/text/covered_text.hpp"
#include "crosscheck/text/made_up_inputs.hpp"
#include "crosscheck/text/made_up_races.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "crosscheck/text/watched_run.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

/// Throws Error for a name among those given that the shader does not have.
template <class Given>
void check_names(std::string_view option, const Given& given, const std::vector<std::string>& names) {
    for (const auto& [name, value] : given)
        if (std::find(names.begin(), names.end(), name) == names.end())
            throw Error(fmt::format("{} {}: the shader has no such name; it has {}{}", option, plain_line(name),
                                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
                                    did_you_mean(name, names)));
}

template <class All> std::vector<std::string> names_of(const All& all) {
    std::vector<std::string> names;
    for (const auto& one : all)
        names.push_back(one.name);
    return names;
}

/// Plain uniforms and members of blocks.
std::vector<std::string> uniform_names(const text::Program& program) {
    std::vector<std::string> names = names_of(program.uniforms);
    for (const text::Block& block : program.blocks)
        for (const std::string& name : names_of(block.members))
            names.push_back(name);
    return names;
}

/// Uniforms that are 0, since they are not given.
std::vector<std::string> not_given(const Examination& of, const text::Program& program) {
    std::vector<std::string> names = names_of(program.uniforms);
    for (const text::Block& block : program.blocks)
        if (block.name == block_of_uniforms)
            names = names_of(block.members);
    std::erase_if(names, [&](const std::string& name) { return of.uniforms.contains(name); });
    return names;
}

/// "64 vertices".
std::string what_ran(const Examination& of, const text::Program& program) {
    switch (program.stage) {
    case spv::ExecutionModelVertex:
        return fmt::format("{} vertices", of.invocations);
    case spv::ExecutionModelGeometry:
        return fmt::format("{} primitives", of.invocations);
    case spv::ExecutionModelFragment:
        return fmt::format("{} fragments", invocations_of(of, program));
    default:
        return fmt::format("{} groups of {} invocations", of.groups[0] * of.groups[1] * of.groups[2],
                           program.invocations());
    }
}

/// Names of inputs that may be given.
std::vector<std::string> input_names(const text::Program& program) {
    std::vector<std::string> names;
    for (const text::StageVariable& input : program.stage_inputs)
        if (input.is_read)
            names.push_back(text::name_of(input));
    return names;
}

/// Names of blocks and images.
std::vector<std::string> sized_names(const text::Program& program) {
    std::vector<std::string> names = names_of(program.blocks);
    for (const std::string& name : names_of(program.images))
        names.push_back(name);
    return names;
}

/// Of the text as it is compiled; what is looked into may have other steps, for operations of constants.
TextCoverage coverage_of(const Examination& of, const StageText& opened, const WatchedRun& watched) {
    const std::filesystem::path folder = of.file.parent_path();
    const StageText stage = read_stage(of.file, of.defines);
    if (stage.module.words != opened.module.words && !is_endless(watched.findings)) {
        Examination plain = of;
        plain.is_watched = false;
        const bool is_compute = stage.program.stage == spv::ExecutionModelGLCompute;
        text::StageRun run = is_compute ? text::StageRun{} : made_up_run(plain, stage.program);
        run.is_watched = false;
        const WatchedRun again = run_watched(plain, stage.program, made_up_world(plain, stage.program), run);
        return covered_text(*stage.source, stage.program, again.coverage, folder);
    }
    return covered_text(*opened.source, opened.program, watched.coverage, folder);
}

} // namespace

ExaminationResult examine(const Examination& of, const MeasuredGl* gl) {
    // What is looked into has each operation of constants; what is compared has their values.
    const StageText opened = read_stage(of.file, of.defines, ConstantExpressions::open);
    const text::Program& program = opened.program;
    std::optional<StageText> reference;
    if (!of.reference.empty())
        reference = read_stage(of.reference, of.defines);
    const auto check = [&](std::string_view option, const auto& given, const auto& names_in) {
        std::vector<std::string> names = names_in(program);
        if (reference)
            for (std::string& name : names_in(reference->program))
                if (std::ranges::find(names, name) == names.end())
                    names.push_back(std::move(name));
        check_names(option, given, names);
    };
    check("--uniform", of.uniforms, uniform_names);
    check("--input", of.inputs, input_names);
    check_names("--size", of.sizes, sized_names(program));
    check_names("--fill", of.fills, fill_names(program));
    check_invocations(of, program);
    MadeUpWorld world = made_up_world(of, program);
    const bool is_compute = program.stage == spv::ExecutionModelGLCompute;
    const text::StageRun run = is_compute ? text::StageRun{} : made_up_run(of, program);
    const bool is_kept = gl != nullptr || reference; // for those that start from the same
    const MadeUpWorld before = is_kept ? world.copy() : MadeUpWorld();
    const WatchedRun watched = run_watched(of, program, std::move(world), run);
    ExaminationResult result;
    if (is_kept) {
        const StageText stage = read_stage(of.file, of.defines);
        if (gl != nullptr)
            result.gpu = compare_with_gpu(*gl, stage, of.groups, before, watched.findings);
        if (reference)
            result.reference =
                compare_texts(of, stage, *reference, before, run, run_watched(of, stage.program, before.copy(), run));
    }
    result.ran = what_ran(of, program);
    if (is_compute)
        result.group_size = program.invocations();
    result.not_given = not_given(of, program);
    result.findings = named(watched.findings, program);
    result.coverage = coverage_of(of, opened, watched);
    result.coverage.in = result.ran;
    const auto made_up = made_up_races(of, program, watched.findings);
    for (std::size_t k = 0; k < result.findings.size(); ++k)
        for (const auto& [name, races] : made_up)
            if (std::ranges::find(races, &watched.findings.all()[k]) != races.end()) {
                result.findings[k].found.what += fmt::format(" (not with --fill {}=iota)", name);
                break;
            }
    return result;
}

std::string ExaminationResult::text(const Examination& of) const {
    std::string all =
        fmt::format("{}: {} finding{} in {}\n", of.file.filename().string(),
                    findings.empty() ? "no" : std::to_string(findings.size()), findings.size() == 1 ? "" : "s", ran);
    for (const NamedFinding& one : findings)
        all += one.text();
    if (!coverage.lines.empty())
        all += fmt::format("coverage  {}\n", coverage_text(coverage));
    if (!not_given.empty())
        all += fmt::format("0 for want of --uniform: {}\n", fmt::join(not_given, ", "));
    if (gpu)
        all += gpu->text();
    if (reference)
        all += reference->text(findings.size());
    return all;
}

nlohmann::json ExaminationResult::json(const Examination& of) const {
    nlohmann::json all{{"file", of.file.filename().string()},
                       {"ran", ran},
                       {"uniforms_not_given", not_given},
                       {"findings", nlohmann::json::array()}};
    if (group_size > 0) {
        all["groups"] = of.groups;
        all["group_size"] = group_size;
    }
    for (const NamedFinding& one : findings)
        all["findings"].push_back(one.json());
    if (!coverage.lines.empty())
        all["coverage"] = coverage_json({&coverage, 1});
    if (gpu)
        all["gl"] = gpu->json();
    if (reference)
        all["reference"] = reference->json();
    return all;
}

} // namespace lockstep
