#include "gpu/program.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/type_ptr.hpp>

#include "gpu/bindings.hpp"
#include "gpu/check.hpp"
#include "gpu/desktop_text.hpp"
#include "gpu/glsl_type.hpp"
#include "gpu/nothing_given.hpp"
#include "gpu/program_linking.hpp"
#include "gpu/shader_object.hpp"
#include "gpu/spirv_module.hpp"
#include "gpu/stage_texts.hpp"
#include "gpu/stages_run.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Those that lie beside the stages; null where there are none.
std::shared_ptr<const Bindings> bindings_of(std::span<const ShaderSource> stages) {
    for (const ShaderSource& stage : stages)
        if (stage.bindings != nullptr)
            return stage.bindings;
    return nullptr;
}

std::vector<Capture> by_their_names(std::span<const Capture> captured, const Bindings* bindings) {
    std::vector<Capture> outputs(captured.begin(), captured.end());
    if (bindings != nullptr)
        for (Capture& output : outputs)
            output.name = bindings->output(output.name);
    return outputs;
}

/// The stages as GL takes them: SPIR-V alone, or GLSL alone, into which modules beside GLSL are translated.
std::vector<ShaderSource> as_gl_takes(std::span<const ShaderSource> given) {
    std::vector<ShaderSource> stages;
    for (const ShaderSource& stage : given)
        stages.push_back(stage.module == nullptr && (!stage.given.empty() || is_other_dialect(stage.text))
                             ? in_desktop_glsl(stage)
                             : stage);
    const auto in_spirv = [](const ShaderSource& stage) { return stage.module != nullptr; };
    const bool all = std::all_of(stages.begin(), stages.end(), in_spirv);
    if (all && !takes_spirv())
        throw Error(fmt::format("shader {0}: this GL takes no SPIR-V (GL_ARB_gl_spirv); `spirv-cross {0} --version 450 "
                                "--no-420pack-extension --output {1}` translates it to GLSL (docs/translators.md)",
                                stages.front().files.front(),
                                std::filesystem::path(stages.front().files.front()).replace_extension().string()));
    if (all)
        return stages;
    const bool located = std::any_of(stages.begin(), stages.end(), [&](const ShaderSource& stage) {
        return !in_spirv(stage) && goes_by_location(stage);
    });
    for (ShaderSource& stage : stages)
        if (const std::shared_ptr<const SpirvModule> module = std::exchange(stage.module, nullptr)) {
            stage.text = glsl_of(*module, located);
            const auto lines = std::count(stage.text.begin(), stage.text.end(), '\n');
            for (int line = 1; line <= lines; ++line)
                stage.origins.push_back({0, line});
        }
    return stages;
}

void add_attributes(GLuint program, std::span<const ShaderSource> stages, const Bindings* bindings,
                    ProgramInterface& attributes) {
    GLint count = 0;
    gl::GetProgramiv(program, GL_ACTIVE_ATTRIBUTES, &count);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        char name[256] = {};
        GLint size = 0;
        ProgramVariable variable;
        gl::GetActiveAttrib(program, i, sizeof name, nullptr, &size, &variable.type, name);
        variable.name = name;
        variable.location = gl::GetAttribLocation(program, name);
        variable.declared = find_declaration(stages, "in", std::string_view(name).substr(0, variable.name.find('[')));
        add_attribute(std::move(variable), bindings, attributes);
    }
}

Capture linked_capture(GLuint program, GLuint index) {
    char name[256] = {};
    Capture capture;
    gl::GetTransformFeedbackVarying(program, index, sizeof name, nullptr, &capture.size, &capture.type, name);
    capture.name = name;
    return capture;
}

void check_capture_type(GLuint program, GLuint index, const Capture& capture, std::span<const ShaderSource> stages) {
    const auto [name, type, size] = linked_capture(program, index);
    if (!is_same_output(name, capture.name))
        throw Error(fmt::format("shader {}: a layout(xfb_...) of its own has {} captured in the place of {}",
                                last_vertex_stage_file(stages), name, capture.name));
    const ShaderSource* last = last_vertex_stage(stages);
    const std::span from(last, last == nullptr ? 0 : 1);
    if (type != capture.type || size != capture.size)
        throw Error(fmt::format("shader {}: output {} is {}, but must be {}",
                                find_declaration(from, "out", capture.name).place, capture.name,
                                declared_type(type, size), declared_type(capture.type, capture.size)));
}

/// The files of each linked program.
std::map<GLuint, std::vector<std::string>>& files_of_programs() {
    static std::map<GLuint, std::vector<std::string>> all;
    return all;
}

} // namespace

void check_nothing_lost(std::span<const ShaderSource> given, std::span<const Capture> by_our_names) {
    const std::vector<ShaderSource> stages = as_gl_takes(given);
    const std::vector<Capture> captured = by_their_names(by_our_names, bindings_of(stages).get());
    const ShaderSource* last = last_vertex_stage(stages);
    if (last == nullptr)
        return;
    if (last->module != nullptr)
        return check_nothing_lost(
            *last->module, stages.back().stage == Stage::fragment ? stages.back().module.get() : nullptr, captured);
    std::set<std::string> lost = words_with("out_", last->text);
    for (const Capture& capture : captured)
        lost.erase(capture.name);
    for (const ShaderSource& stage : stages)
        if (stage.stage == Stage::fragment)
            for (const std::string& read : words_with("out_", stage.text))
                lost.erase(read);
    if (lost.empty())
        return;
    for (const Capture& output : outputs_with("out_", stages))
        if (lost.contains(output.name))
            throw Error(fmt::format("shader {}: output {} is captured by nobody and compared with nothing; what is "
                                    "compared is {}",
                                    find_declaration({last, 1}, "out", output.name).place, output.name,
                                    joined_names(captured)));
}

std::vector<Capture> outputs_with(std::string_view prefix, std::span<const ShaderSource> given) {
    const std::vector<ShaderSource> stages = as_gl_takes(given);
    const ShaderSource* last = last_vertex_stage(stages);
    if (last == nullptr)
        return {};
    if (last->module != nullptr) {
        std::vector<Capture> found;
        for (const SpirvModule::Variable& output : last->module->outputs)
            if (output.name.starts_with(prefix))
                found.push_back({output.name, output.type, output.size});
        return found;
    }
    std::vector<ShaderObject> shaders;
    for (const ShaderSource& stage : stages)
        shaders.emplace_back(stage);
    const GLuint program = gl::CreateProgram();
    for (const ShaderObject& shader : shaders)
        gl::AttachShader(program, shader.id());
    std::vector<Capture> outputs;
    for (const std::string& word : words_with(prefix, last->text))
        for (const std::string& name : spellings(last->text, word))
            if (const Capture candidate{name}; link(program, {&candidate, 1})) {
                outputs.push_back(linked_capture(program, 0));
                outputs.back().name = word;
                break;
            }
    gl::DeleteProgram(program);
    check_gl("outputs");
    return outputs;
}

Program::Program(std::string name, std::span<const ShaderSource> given, std::span<const Capture> captured,
                 std::span<const std::string_view> storage_buffers)
    : name_(std::move(name)), file_(given.front().files.front()), bindings_(bindings_of(given)) {
    const std::vector<ShaderSource> stages = as_gl_takes(given);
    for (const ShaderSource& stage : stages)
        lengths_asked_.merge(lengths_asked(stage));
    const Bindings* const bindings = bindings_.get();
    const std::vector<Capture> outputs = by_their_names(captured, bindings);
    id_ = gl::CreateProgram();
    std::vector<std::string>& files = files_of_programs()[id_];
    files.clear();
    for (const ShaderSource& stage : given)
        files.insert(files.end(), stage.files.begin(), stage.files.end());
    try {
        if (stages.front().module != nullptr)
            link_modules(stages, outputs, storage_buffers);
        else
            link_texts(stages, outputs, storage_buffers);
        uniforms_.emplace(id_, stages, bindings);
        check_gl(name_);
    } catch (...) {
        gl::DeleteProgram(id_);
        throw;
    }
}

void Program::link_texts(std::span<const ShaderSource> stages, std::span<const Capture> outputs,
                         std::span<const std::string_view> storage_buffers) {
    std::vector<ShaderObject> shaders;
    for (const ShaderSource& stage : stages)
        gl::AttachShader(id_, shaders.emplace_back(stage).id());
    if (!link(id_, outputs) && accepted_spellings(id_, stages, outputs).empty()) {
        check_geometry_inputs(stages);
        throw Error(fmt::format("{}: {}", name_, link_failure(id_, stages, outputs)));
    }
    note_link_warnings(id_, stages);
    if (!outputs.empty())
        check_geometry_stage(id_, stages);
    for (std::size_t i = 0; i < outputs.size(); ++i)
        check_capture_type(id_, static_cast<GLuint>(i), outputs[i], stages);
    check_storage(id_, stages, storage_buffers);
    check_geometry_inputs(stages);
    check_fragment_inputs(stages);
    check_fragment_output(id_, stages);
    for (const ShaderObject& shader : shaders)
        gl::DetachShader(id_, shader.id());
    add_attributes(id_, stages, bindings_.get(), attributes_);
}

Program::Program(Program&& other) noexcept
    : name_(std::move(other.name_)), file_(std::move(other.file_)), lengths_asked_(std::move(other.lengths_asked_)),
      id_(std::exchange(other.id_, 0)), bindings_(std::move(other.bindings_)),
      module_blocks_(std::move(other.module_blocks_)), uniforms_(std::move(other.uniforms_)),
      attributes_(std::move(other.attributes_)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(file_, other.file_);
    std::swap(lengths_asked_, other.lengths_asked_);
    std::swap(id_, other.id_);
    std::swap(bindings_, other.bindings_);
    std::swap(module_blocks_, other.module_blocks_);
    std::swap(uniforms_, other.uniforms_);
    std::swap(attributes_, other.attributes_);
    return *this;
}

Program::~Program() {
    if (id_ != 0 && gl::DeleteProgram != nullptr)
        gl::DeleteProgram(id_);
}

void Program::use() const { gl::UseProgram(id_); }

void Program::check_interface() const {
    std::vector<std::string> unknown = uniforms_->unknown();
    const std::string advice = unknown.empty()
                                   ? ""
                                   : fmt::format("; {} beside the shader binds a uniform to a name or a number "
                                                 "(docs/own_shader.md)",
                                                 bindings_file);
    std::ranges::move(attributes_.unknown(), std::back_inserter(unknown));
    if (!unknown.empty())
        throw NothingGiven(fmt::format("{}", fmt::join(unknown, "; ")), advice);
    uniforms_->bind();
    const std::vector<std::string>& files = files_of_programs()[id_];
    shaders_run().insert(files.begin(), files.end()); // a draw or dispatch comes next
}

void Program::set_words(std::string_view uniform, GLenum type, std::span<const std::uint32_t> words) const {
    use();
    uniforms_->set(uniform, type, words);
}

namespace {

/// The bits of a value's components.
template <std::size_t count> std::array<std::uint32_t, count> words_of(const auto* components) {
    static_assert(sizeof *components == sizeof(std::uint32_t));
    std::array<std::uint32_t, count> words{};
    std::memcpy(words.data(), components, sizeof words);
    return words;
}

} // namespace

void Program::set(std::string_view uniform, float value) const { set_words(uniform, GL_FLOAT, words_of<1>(&value)); }

void Program::set(std::string_view uniform, int value) const { set_words(uniform, GL_INT, words_of<1>(&value)); }

void Program::set(std::string_view uniform, unsigned value) const {
    set_words(uniform, GL_UNSIGNED_INT, words_of<1>(&value));
}

void Program::set(std::string_view uniform, bool value) const {
    const std::uint32_t word = value ? 1 : 0;
    set_words(uniform, GL_BOOL, {&word, 1});
}

void Program::set(std::string_view uniform, glm::vec2 value) const {
    set_words(uniform, GL_FLOAT_VEC2, words_of<2>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, glm::vec3 value) const {
    set_words(uniform, GL_FLOAT_VEC3, words_of<3>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, glm::vec4 value) const {
    set_words(uniform, GL_FLOAT_VEC4, words_of<4>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, glm::ivec2 value) const {
    set_words(uniform, GL_INT_VEC2, words_of<2>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, glm::ivec3 value) const {
    set_words(uniform, GL_INT_VEC3, words_of<3>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, glm::ivec4 value) const {
    set_words(uniform, GL_INT_VEC4, words_of<4>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, glm::uvec2 value) const {
    set_words(uniform, GL_UNSIGNED_INT_VEC2, words_of<2>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, glm::uvec3 value) const {
    set_words(uniform, GL_UNSIGNED_INT_VEC3, words_of<3>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, glm::uvec4 value) const {
    set_words(uniform, GL_UNSIGNED_INT_VEC4, words_of<4>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, const glm::mat2& value) const {
    set_words(uniform, GL_FLOAT_MAT2, words_of<4>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, const glm::mat3& value) const {
    set_words(uniform, GL_FLOAT_MAT3, words_of<9>(glm::value_ptr(value)));
}

void Program::set(std::string_view uniform, const glm::mat4& value) const {
    set_words(uniform, GL_FLOAT_MAT4, words_of<16>(glm::value_ptr(value)));
}

void Program::set_unit(std::string_view uniform, int unit, GLenum type) const {
    set_words(uniform, type, words_of<1>(&unit));
}

bool Program::asks_length(const InterfaceBlock& block) const {
    return lengths_asked_.contains("") || std::ranges::any_of(block.members, [&](const BlockMember& member) {
               std::string_view array = member.name;
               if (array.starts_with(block.name + "."))
                   array.remove_prefix(block.name.size() + 1);
               return lengths_asked_.contains(std::string(array.substr(0, array.find_first_of("[."))));
           });
}

bool Program::uses_storage(GLuint binding) const {
    for (GLuint block = 0; block < storage_block_count(id_); ++block)
        if (static_cast<GLuint>(storage_binding(id_, block)) == binding)
            return true;
    return false;
}

std::vector<InterfaceBlock> Program::storage_blocks() const {
    if (module_blocks_.empty())
        return linked_storage_blocks(id_);
    std::vector<InterfaceBlock> blocks = module_blocks_;
    for (GLuint b = 0; b < static_cast<GLuint>(blocks.size()); ++b)
        blocks[b].binding = storage_binding(id_, b);
    return blocks;
}

GLint Program::attribute(std::string_view attribute, GLenum type) const {
    const auto given = attributes_.asked(attribute, type);
    return given.empty() ? -1 : attributes_[given.front().variable].location;
}

} // namespace lockstep
