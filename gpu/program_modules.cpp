#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "gpu/glsl_type.hpp"
#include "gpu/program_linking.hpp"
#include "gpu/shader_object.hpp"
#include "gpu/spirv_module.hpp"
#include "gpu/stage_texts.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Those of a vertex stage in SPIR-V.
void add_attributes(const SpirvModule& module, const Bindings* bindings, ProgramInterface& attributes) {
    for (const SpirvModule::Variable& input : module.inputs)
        add_attribute({input.name, input.location, input.type, {module.file}}, bindings, attributes);
}

/// The outputs of the last vertex-processing stage, in SPIR-V, that are to be captured.
std::vector<SpirvModule::Variable> captured_outputs(std::span<const ShaderSource> stages,
                                                    std::span<const Capture> captured) {
    std::vector<SpirvModule::Variable> found;
    for (const Capture& capture : captured) {
        const SpirvModule& last = *last_vertex_stage(stages)->module;
        const SpirvModule::Variable* const output = last.output(capture.name);
        if (output == nullptr)
            throw Error(fmt::format("shader {}: output {} is not written; it must write {}", last.file, capture.name,
                                    joined_names(captured)));
        if (output->type != capture.type || output->size != capture.size)
            throw Error(fmt::format("shader {}: output {} is {}, but must be {}", last.file, capture.name,
                                    declared_type(output->type, output->size),
                                    declared_type(capture.type, capture.size)));
        found.push_back(*output);
    }
    return found;
}

/// What GL says nothing of: inputs that no stage before writes, storage blocks outside compute stages that are not
/// `given`, and a fragment stage without an output 0.
void check_modules(std::span<const ShaderSource> stages, std::span<const std::string_view> given) {
    const SpirvModule* before = nullptr;
    for (const ShaderSource& stage : stages) {
        const SpirvModule& module = *stage.module;
        const auto has = [](const std::vector<SpirvModule::Variable>& all, GLint location) {
            return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.location == location; });
        };
        if (before != nullptr)
            for (const SpirvModule::Variable& input : module.inputs)
                if (!has(before->outputs, input.location))
                    throw Error(fmt::format("shader {}: input {} at location {} is written by no stage before it ({})",
                                            module.file, input.name, input.location, before->file));
        if (stage.stage == Stage::fragment && !has(module.outputs, 0))
            throw Error(
                fmt::format("shader {}: no output at location 0 is written; that is what is drawn", module.file));
        for (const InterfaceBlock& block : module.storage_blocks)
            if (stage.stage != Stage::compute && std::find(given.begin(), given.end(), block.name) == given.end())
                fail_storage(module.file, block.name);
        before = &module;
    }
}

/// GL tells a module's storage blocks apart by their binding points alone, which are the module's until others are set.
std::vector<InterfaceBlock> in_gl_order(GLuint program, std::span<const ShaderSource> stages) {
    std::vector<InterfaceBlock> blocks;
    if (gl::GetProgramInterfaceiv == nullptr)
        return blocks;
    for (GLuint b = 0; b < storage_block_count(program); ++b)
        for (const ShaderSource& stage : stages)
            for (const InterfaceBlock& block : stage.module->storage_blocks)
                if (block.binding == storage_binding(program, b) && blocks.size() == b)
                    blocks.push_back(block);
    return blocks;
}

} // namespace

/// Outputs named like captured ones that are neither, nor read by the fragment stage.
void check_nothing_lost(const SpirvModule& last, const SpirvModule* fragment, std::span<const Capture> captured) {
    for (const SpirvModule::Variable& output : last.outputs) {
        const bool is_captured = std::any_of(captured.begin(), captured.end(),
                                             [&](const Capture& capture) { return capture.name == output.name; });
        const bool is_read =
            fragment != nullptr && std::any_of(fragment->inputs.begin(), fragment->inputs.end(),
                                               [&](const auto& input) { return input.location == output.location; });
        if (output.name.starts_with("out_") && !is_captured && !is_read)
            throw Error(fmt::format("shader {}: output {} is captured by nobody and compared with nothing; what is "
                                    "compared is {}",
                                    last.file, output.name, joined_names(captured)));
    }
}

void Program::link_modules(std::span<const ShaderSource> stages, std::span<const Capture> outputs,
                           std::span<const std::string_view> storage_buffers) {
    const std::vector<SpirvModule::Variable> captured = captured_outputs(stages, outputs);
    check_modules(stages, storage_buffers);
    std::vector<ShaderObject> shaders;
    for (const ShaderSource& stage : stages)
        gl::AttachShader(id_, shaders
                                  .emplace_back(stage, &stage == last_vertex_stage(stages)
                                                           ? std::span(captured)
                                                           : std::span<const SpirvModule::Variable>())
                                  .id());
    if (!link(id_, {}))
        throw Error(fmt::format("{}: {}", name_, link_failure(id_, stages, {})));
    if (!outputs.empty())
        check_geometry_stage(id_, stages);
    for (const ShaderObject& shader : shaders)
        gl::DetachShader(id_, shader.id());
    if (stages.front().stage == Stage::vertex)
        add_attributes(*stages.front().module, bindings_.get(), attributes_);
    module_blocks_ = in_gl_order(id_, stages);
}

} // namespace lockstep
