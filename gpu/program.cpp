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

#include "gpu/check.hpp"
#include "gpu/glsl_type.hpp"
#include "gpu/shader_log.hpp"
#include "gpu/shader_words.hpp"
#include "gpu/spirv_module.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

GLenum gl_stage(Stage stage) {
    switch (stage) {
    case Stage::vertex:
        return GL_VERTEX_SHADER;
    case Stage::geometry:
        return GL_GEOMETRY_SHADER;
    case Stage::fragment:
        return GL_FRAGMENT_SHADER;
    case Stage::compute:
        break;
    }
    return GL_COMPUTE_SHADER;
}

/// A shader object, for as long as it takes to link it.
class Shader {
  public:
    /// `captured`: of a module.
    explicit Shader(const ShaderSource& source, std::span<const SpirvModule::Variable> captured = {}) {
        if (source.stage == Stage::compute && gl::DispatchCompute == nullptr)
            throw Error(
                fmt::format("shader {}: this GL has no compute shaders; they need GL 4.3", source.files.front()));
        id_ = gl::CreateShader(gl_stage(source.stage));
        if (source.module != nullptr) {
            const std::vector<std::uint32_t> words = capturing(*source.module, captured);
            gl::ShaderBinary(1, &id_, GL_SHADER_BINARY_FORMAT_SPIR_V, words.data(),
                             static_cast<GLsizei>(words.size() * sizeof words.front()));
            gl::SpecializeShader(id_, source.module->entry_point.c_str(), 0, nullptr, nullptr);
        } else {
            const char* text = source.text.c_str();
            gl::ShaderSource(id_, 1, &text, nullptr);
            gl::CompileShader(id_);
        }
        GLint compiled = GL_FALSE;
        gl::GetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_TRUE)
            return;
        GLint length = 0;
        gl::GetShaderiv(id_, GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<std::size_t>(length), '\0');
        gl::GetShaderInfoLog(id_, length, nullptr, log.data());
        gl::DeleteShader(id_);
        if (source.module != nullptr)
            throw Error(fmt::format("shader {}: the driver refuses the module: {}", source.files.front(),
                                    first_link_error(log)));
        throw Error(fmt::format("shader {}", first_compile_error(log, source)));
    }
    Shader(Shader&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Shader& operator=(Shader&&) = delete;
    ~Shader() { gl::DeleteShader(id_); }
    [[nodiscard]] GLuint id() const { return id_; }

  private:
    GLuint id_ = 0;
};

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

bool link(GLuint program, std::span<const Capture> captured) {
    std::vector<const char*> names;
    for (const Capture& capture : captured)
        names.push_back(capture.name.c_str());
    gl::TransformFeedbackVaryings(program, static_cast<GLsizei>(names.size()), names.data(), GL_INTERLEAVED_ATTRIBS);
    gl::LinkProgram(program);
    GLint linked = GL_FALSE;
    gl::GetProgramiv(program, GL_LINK_STATUS, &linked);
    return linked == GL_TRUE;
}

std::string link_log(GLuint program) {
    GLint length = 0;
    gl::GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    gl::GetProgramInfoLog(program, length, nullptr, log.data());
    return log;
}

/// The last stage before rasterisation, whose outputs are captured; null if there is none.
const ShaderSource* last_vertex_stage(std::span<const ShaderSource> stages) {
    for (const Stage stage : {Stage::geometry, Stage::vertex})
        for (const ShaderSource& source : stages)
            if (source.stage == stage)
                return &source;
    return nullptr;
}

std::string last_vertex_stage_file(std::span<const ShaderSource> stages) {
    const ShaderSource* last = last_vertex_stage(stages);
    return last != nullptr ? last->files.front() : "no vertex shader";
}

std::string joined_names(std::span<const Capture> captured) {
    std::vector<std::string_view> names;
    for (const Capture& capture : captured)
        names.emplace_back(capture.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

/// A stage's own name of one of our outputs.
std::string their_name(const ShaderSource& stage, const std::string& ours) {
    return stage.bindings != nullptr ? stage.bindings->output(ours) : ours;
}

/// A stage's input or output, as declared.
struct Varying {
    std::string type, place;
    bool is_flat = false, located = false;
};

std::map<std::string, Varying> varyings(const ShaderSource& stage, std::string_view qualifier) {
    std::map<std::string, Varying> found;
    std::vector<std::string> statement;
    for (ShaderWords words(stage.text); words.next();) {
        if (words.token() != ";" && words.token() != "}") {
            statement.emplace_back(words.token());
            continue;
        }
        const auto has = [&](std::string_view word) {
            return std::find(statement.begin(), statement.end(), word) != statement.end();
        };
        if (words.token() == ";" && statement.size() > 2 && has(qualifier) && !has("(")) {
            const ShaderSource::Origin& origin = stage.origins[words.line() - 1];
            found[statement.back()] = {statement[statement.size() - 2],
                                       fmt::format("{}:{}", stage.files[origin.file], origin.line), has("flat"),
                                       has("location")};
        }
        statement.clear();
    }
    return found;
}

/// Whether what goes between a GLSL stage and its neighbours does by location.
bool goes_by_location(const ShaderSource& stage) {
    for (const std::string_view direction : {"in", "out"}) {
        const bool outside = stage.stage == (direction == "in" ? Stage::vertex : Stage::fragment);
        const std::map<std::string, Varying> all = varyings(stage, direction);
        if (!outside && std::any_of(all.begin(), all.end(), [](const auto& one) { return one.second.located; }))
            return true;
    }
    return false;
}

/// The stages as GL takes them: SPIR-V alone, or GLSL alone, into which modules beside GLSL are translated.
std::vector<ShaderSource> as_gl_takes(std::span<const ShaderSource> given) {
    std::vector<ShaderSource> stages(given.begin(), given.end());
    const auto in_spirv = [](const ShaderSource& stage) { return stage.module != nullptr; };
    const bool all = std::all_of(stages.begin(), stages.end(), in_spirv);
    if (all && (gl::ShaderBinary == nullptr || gl::SpecializeShader == nullptr))
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

/// Before GLSL 4.40 both sides of the border say `flat`, or neither.
std::string missing_flat(std::span<const ShaderSource> stages) {
    const ShaderSource* last = last_vertex_stage(stages);
    const auto fragment =
        std::find_if(stages.begin(), stages.end(), [](const ShaderSource& s) { return s.stage == Stage::fragment; });
    if (last == nullptr || fragment == stages.end())
        return {};
    const std::map<std::string, Varying> written = varyings(*last, "out");
    for (const auto& [name, read] : varyings(*fragment, "in")) {
        const std::string theirs = their_name(*last, name);
        const auto out = written.find(theirs);
        if (out != written.end() && read.is_flat && !out->second.is_flat)
            return fmt::format(
                "shader {}: output {} is interpolated, but {} reads it `flat`; right is `flat out {} {};`",
                out->second.place, theirs, read.place, out->second.type, theirs);
    }
    return {};
}

/// Why a program that failed to link did: a driver's own message need not name the output that is missing, so each is
/// tried by itself.
std::string link_failure(GLuint program, std::span<const ShaderSource> stages, std::span<const Capture> captured) {
    const std::string reason = first_link_error(link_log(program));
    if (const std::string flat = missing_flat(stages); !flat.empty())
        return flat;
    if (!captured.empty() && link(program, {}))
        for (const Capture& capture : captured)
            if (!link(program, {&capture, 1}))
                return fmt::format(
                    "output {} is not written by the last vertex-processing stage ({}); it is to write {}",
                    capture.name, last_vertex_stage_file(stages), joined_names(captured));
    std::vector<std::string_view> files;
    for (const ShaderSource& stage : stages)
        files.emplace_back(stage.files.front());
    return fmt::format("does not link ({}): {}", fmt::join(files, ", "), reason);
}

void add_attribute(ProgramVariable variable, const Bindings* bindings, ProgramInterface& attributes) {
    if (bindings != nullptr)
        if (const auto bound = bindings->attributes.find(variable.name); bound != bindings->attributes.end())
            return attributes.add(std::move(variable), bound->second);
    attributes.add(std::move(variable));
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

/// Those of a vertex stage in SPIR-V.
void add_attributes(const SpirvModule& module, const Bindings* bindings, ProgramInterface& attributes) {
    for (const SpirvModule::Variable& input : module.inputs)
        add_attribute({input.name, input.location, input.type, {module.file}}, bindings, attributes);
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
    if (name != capture.name)
        throw Error(fmt::format("shader {}: a layout(xfb_...) of its own has {} captured in the place of {}",
                                last_vertex_stage_file(stages), name, capture.name));
    const ShaderSource* last = last_vertex_stage(stages);
    const std::span from(last, last == nullptr ? 0 : 1);
    if (type != capture.type || size != capture.size)
        throw Error(fmt::format("shader {}: output {} is {}, but must be {}",
                                find_declaration(from, "out", capture.name).place, capture.name,
                                declared_type(type, size), declared_type(capture.type, capture.size)));
}

/// Points are drawn, one a particle, and one is captured of each: a geometry stage takes points and makes points.
void check_geometry_stage(GLuint program, std::span<const ShaderSource> stages) {
    const auto stage = std::find_if(stages.begin(), stages.end(),
                                    [](const ShaderSource& source) { return source.stage == Stage::geometry; });
    if (stage == stages.end())
        return;
    const auto name = [](GLint primitive) {
        switch (static_cast<GLenum>(primitive)) {
        case GL_LINES:
            return "lines";
        case GL_LINES_ADJACENCY:
            return "lines_adjacency";
        case GL_TRIANGLES_ADJACENCY:
            return "triangles_adjacency";
        case GL_LINE_STRIP:
            return "line_strip";
        case GL_TRIANGLE_STRIP:
            return "triangle_strip";
        default:
            return "triangles";
        }
    };
    for (const auto& [what, direction] : {std::pair{GL_GEOMETRY_INPUT_TYPE, "in"}, {GL_GEOMETRY_OUTPUT_TYPE, "out"}}) {
        GLint primitive = GL_POINTS;
        gl::GetProgramiv(program, what, &primitive);
        if (primitive != GL_POINTS)
            throw Error(fmt::format("shader {}: layout({}) {}; right is layout(points) {}, a point a particle",
                                    stage->files.front(), name(primitive), direction, direction));
    }
}

/// Words of `text` that start with `prefix`.
std::set<std::string> words_with(std::string_view prefix, std::string_view text) {
    std::set<std::string> found;
    for (ShaderWords words(text); words.next();)
        if (words.token().starts_with(prefix))
            found.emplace(words.token());
    return found;
}

/// Every block of the kind ("uniform", "buffer") that a stage declares: its name, and where.
std::vector<std::pair<std::string, std::string>> blocks(std::string_view kind, std::span<const ShaderSource> stages) {
    std::vector<std::pair<std::string, std::string>> found;
    for (const ShaderSource& stage : stages) {
        std::string before, last;
        for (ShaderWords words(stage.text); words.next();) {
            if (words.token() == "{" && before == kind) {
                const ShaderSource::Origin& origin = stage.origins[words.line() - 1];
                found.emplace_back(last, fmt::format("{}:{}", stage.files[origin.file], origin.line));
            }
            before = std::exchange(last, std::string(words.token()));
        }
    }
    return found;
}

/// Only a compute stage has storage buffers that are not `given`.
void check_storage(GLuint program, std::span<const ShaderSource> stages, std::span<const std::string_view> given) {
    if (stages.front().stage == Stage::compute)
        return;
    for (const auto& [name, place] : blocks("buffer", stages))
        if (std::find(given.begin(), given.end(), name) != given.end())
            continue;
        else if (gl::GetProgramInterfaceiv == nullptr)
            throw Error(fmt::format("shader {}: nothing is given for storage buffer {}, and this GL is too old to say "
                                    "whether it is used (4.3 or GL_ARB_program_interface_query says)",
                                    place, name));
        else if (gl::GetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, name.c_str()) != GL_INVALID_INDEX)
            throw Error(fmt::format("shader {}: nothing is given for storage buffer {}", place, name));
}

/// The same of a geometry stage, whose inputs are arrays: drivers leave what is missing undefined without a word.
void check_geometry_inputs(std::span<const ShaderSource> stages) {
    const auto of = [&](Stage stage) {
        return std::find_if(stages.begin(), stages.end(), [&](const ShaderSource& s) { return s.stage == stage; });
    };
    const auto vertex = of(Stage::vertex), geometry = of(Stage::geometry);
    if (vertex == stages.end() || geometry == stages.end())
        return;
    const std::set<std::string> written = words_with("", vertex->text);
    std::string qualifier, type, name; // the words before
    bool located = false;
    for (ShaderWords words(geometry->text); words.next();) {
        const std::string word(words.token());
        if (word == "[" && qualifier == "in" && !located && !written.contains(name)) {
            const ShaderSource::Origin& origin = geometry->origins[words.line() - 1];
            throw Error(fmt::format("shader {}:{}: input {} is written by no stage before it ({}); an empty {} leaves "
                                    "the geometry stage out",
                                    geometry->files[origin.file], origin.line, name, vertex->files.front(),
                                    std::filesystem::path(geometry->files.front()).filename().string()));
        }
        located = word != ";" && (located || word == "location");
        qualifier = std::exchange(type, std::exchange(name, word));
    }
}

/// What a fragment stage reads has to be written: by name, where no location stands beside it.
void check_fragment_inputs(std::span<const ShaderSource> stages) {
    const ShaderSource* last = last_vertex_stage(stages);
    if (last == nullptr)
        return;
    const std::set<std::string> written = words_with("", last->text);
    for (const ShaderSource& stage : stages) {
        if (stage.stage != Stage::fragment)
            continue;
        std::map<std::string, int> uses;
        for (ShaderWords words(stage.text); words.next();)
            ++uses[std::string(words.token())];
        std::string first, second, third; // the words before
        bool located = false;
        for (ShaderWords words(stage.text); words.next();) {
            if (words.token() == ";" && first == "in" && !located && uses[third] > 1 &&
                !written.contains(their_name(*last, third))) {
                const ShaderSource::Origin& origin = stage.origins[words.line() - 1];
                throw Error(fmt::format("shader {}:{}: input {} is written by no stage before it ({})",
                                        stage.files[origin.file], origin.line, third, last->files.front()));
            }
            located = words.token() != ";" && (located || words.token() == "location");
            first = std::exchange(second, std::exchange(third, std::string(words.token())));
        }
    }
}

/// A fragment stage writes what its target holds: output 0.
void check_fragment_output(GLuint program, std::span<const ShaderSource> stages) {
    for (const ShaderSource& stage : stages) {
        if (stage.stage != Stage::fragment)
            continue;
        for (const std::string& word : words_with("", stage.text))
            if (!word.starts_with("gl_") && gl::GetFragDataLocation(program, word.c_str()) == 0)
                return;
        throw Error(
            fmt::format("shader {}: no output at location 0 is written; that is what is drawn", stage.files.front()));
    }
}

/// The outputs of the last vertex-processing stage, in SPIR-V, that are to be captured.
std::vector<SpirvModule::Variable> captured_outputs(std::span<const ShaderSource> stages,
                                                    std::span<const Capture> captured) {
    std::vector<SpirvModule::Variable> found;
    for (const Capture& capture : captured) {
        const SpirvModule& last = *last_vertex_stage(stages)->module;
        const SpirvModule::Variable* const output = last.output(capture.name);
        if (output == nullptr)
            throw Error(fmt::format("shader {}: output {} is not written; it is to write {}", last.file, capture.name,
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
                throw Error(fmt::format("shader {}: nothing is given for storage buffer {}", module.file, block.name));
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
    std::vector<Shader> shaders;
    for (const ShaderSource& stage : stages)
        shaders.emplace_back(stage);
    const GLuint program = gl::CreateProgram();
    for (const Shader& shader : shaders)
        gl::AttachShader(program, shader.id());
    std::vector<Capture> outputs;
    for (const std::string& word : words_with(prefix, last->text))
        if (const Capture candidate{word}; link(program, {&candidate, 1}))
            outputs.push_back(linked_capture(program, 0));
    gl::DeleteProgram(program);
    check_gl("outputs");
    return outputs;
}

Program::Program(std::string name, std::span<const ShaderSource> given, std::span<const Capture> captured,
                 std::span<const std::string_view> storage_buffers)
    : name_(std::move(name)), bindings_(bindings_of(given)) {
    const std::vector<ShaderSource> stages = as_gl_takes(given);
    const Bindings* const bindings = bindings_.get();
    const std::vector<Capture> outputs = by_their_names(captured, bindings);
    id_ = gl::CreateProgram();
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
    std::vector<Shader> shaders;
    for (const ShaderSource& stage : stages)
        gl::AttachShader(id_, shaders.emplace_back(stage).id());
    if (!link(id_, outputs)) {
        check_geometry_inputs(stages);
        throw Error(fmt::format("{}: {}", name_, link_failure(id_, stages, outputs)));
    }
    if (!outputs.empty())
        check_geometry_stage(id_, stages);
    for (std::size_t i = 0; i < outputs.size(); ++i)
        check_capture_type(id_, static_cast<GLuint>(i), outputs[i], stages);
    check_storage(id_, stages, storage_buffers);
    check_geometry_inputs(stages);
    check_fragment_inputs(stages);
    check_fragment_output(id_, stages);
    for (const Shader& shader : shaders)
        gl::DetachShader(id_, shader.id());
    add_attributes(id_, stages, bindings_.get(), attributes_);
}

void Program::link_modules(std::span<const ShaderSource> stages, std::span<const Capture> outputs,
                           std::span<const std::string_view> storage_buffers) {
    const std::vector<SpirvModule::Variable> captured = captured_outputs(stages, outputs);
    check_modules(stages, storage_buffers);
    std::vector<Shader> shaders;
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
    for (const Shader& shader : shaders)
        gl::DetachShader(id_, shader.id());
    if (stages.front().stage == Stage::vertex)
        add_attributes(*stages.front().module, bindings_.get(), attributes_);
    module_blocks_ = in_gl_order(id_, stages);
}

Program::Program(Program&& other) noexcept
    : name_(std::move(other.name_)), id_(std::exchange(other.id_, 0)), bindings_(std::move(other.bindings_)),
      module_blocks_(std::move(other.module_blocks_)), uniforms_(std::move(other.uniforms_)),
      attributes_(std::move(other.attributes_)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(name_, other.name_);
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
    std::ranges::move(attributes_.unknown(), std::back_inserter(unknown));
    if (!unknown.empty())
        throw Error(fmt::format("shader {}", fmt::join(unknown, "; ")));
    uniforms_->bind();
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

void Program::set(std::string_view uniform, const glm::mat4& value) const {
    set_words(uniform, GL_FLOAT_MAT4, words_of<16>(glm::value_ptr(value)));
}

void Program::set_unit(std::string_view uniform, int unit, GLenum type) const {
    set_words(uniform, type, words_of<1>(&unit));
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
