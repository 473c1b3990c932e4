#include "crosscheck/cli/rule_by_text.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include <GLSL.std.450.h>
#include <fmt/format.h>

#include "crosscheck/text/glsl_module.hpp"
#include "gpu/collision/collision_shaders.hpp"
#include "reference/model/error.hpp"
#include "reference/text/program.hpp"

namespace lockstep {
namespace {

/// Whether it is arithmetic that GL may fuse or take in another order where nothing says `precise`.
bool has_order(std::uint16_t op) {
    switch (op) {
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
    case spv::OpVectorTimesMatrix:
    case spv::OpMatrixTimesVector:
    case spv::OpMatrixTimesMatrix:
    case spv::OpDot:
    case text::code::extended + GLSLstd450Fma:
        return true;
    default:
        return false;
    }
}

/// Whether the stage has a file that is the user's.
bool is_of_user(const ShaderSource& stage, const ShaderUse& use) {
    return std::ranges::any_of(stage.files, [&](const std::string& file) {
        const std::string name = std::filesystem::path(file).filename().string();
        return std::ranges::any_of(use.files,
                                   [&](const UsedShader& one) { return !one.foreign.empty() && one.file == name; });
    });
}

/// The lines of the user's files with such arithmetic that an output depends on, as far as a stage is interpreted.
void add_open_lines(const std::shared_ptr<const ShaderSource>& stage, const ShaderUse& use,
                    std::set<std::string>& lines) {
    const auto is_own = [&](const std::string& line) {
        return std::ranges::any_of(use.files, [&](const UsedShader& file) {
            return !file.foreign.empty() && (line == file.file || line.starts_with(file.file + ":"));
        });
    };
    try {
        const text::Program program = live_program_of(stage);
        for (std::size_t k = 0; k < program.steps.size(); ++k)
            if (has_order(program.steps[k].op) && program.precise[k] == 0)
                if (const std::string line = program.line_name(program.lines[k]); is_own(line))
                    lines.insert(line);
    } catch (const Error&) { // a driver may take what is not interpreted
    }
}

} // namespace

RuleByText rule_by_text(Legal asked, const Scene& scene, const ShaderUse& use, const std::filesystem::path& shaders,
                        bool rendered) {
    if (asked != Legal::by_text)
        return {asked, {}};
    std::set<std::string> lines;
    if (!shaders.empty())
        for (const PassStages& pass : collision_stages(scene, rendered))
            for (ShaderSource& stage : load_stages(collision_shaders(shaders), pass.name, pass.stages,
                                                   pass.inputs.front().defines, pass.inputs.front().texts))
                if (is_of_user(stage, use))
                    add_open_lines(std::make_shared<const ShaderSource>(std::move(stage)), use, lines);
    if (lines.empty())
        return {asked, {}};
    const std::string others = lines.size() > 1 ? fmt::format(" and {} more lines", lines.size() - 1) : "";
    return {Legal::any_order,
            {fmt::format("{}{}: floats without `precise`, which GL may fuse or take in any order; judged by --legal "
                         "any_order",
                         *lines.begin(), others)}};
}

} // namespace lockstep
