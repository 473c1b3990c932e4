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
    explicit Shader(const ShaderSource& source) {
        if (source.stage == Stage::compute && gl::DispatchCompute == nullptr)
            throw Error(
                fmt::format("shader {}: this GL has no compute shaders; they need GL 4.3", source.files.front()));
        id_ = gl::CreateShader(gl_stage(source.stage));
        const char* text = source.text.c_str();
        gl::ShaderSource(id_, 1, &text, nullptr);
        gl::CompileShader(id_);
        GLint compiled = GL_FALSE;
        gl::GetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_TRUE)
            return;
        GLint length = 0;
        gl::GetShaderiv(id_, GL_INFO_LOG_LENGTH, &length);
        std::string log(static_cast<std::size_t>(length), '\0');
        gl::GetShaderInfoLog(id_, length, nullptr, log.data());
        gl::DeleteShader(id_);
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
    bool is_flat = false;
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
                                       fmt::format("{}:{}", stage.files[origin.file], origin.line), has("flat")};
        }
        statement.clear();
    }
    return found;
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
        if (bindings != nullptr)
            if (const auto bound = bindings->attributes.find(variable.name); bound != bindings->attributes.end()) {
                attributes.add(std::move(variable), bound->second);
                continue;
            }
        attributes.add(std::move(variable));
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
    if (name != capture.name)
        throw Error(fmt::format("shader {}: a layout(xfb_...) of its own has {} captured in the place of {}",
                                last_vertex_stage_file(stages), name, capture.name));
    const ShaderSource* last = last_vertex_stage(stages);
    const std::span from(last, last == nullptr ? 0 : 1);
    if (type != capture.type || size != capture.size)
        throw Error(fmt::format("shader {}: output {} is {}, but is to be {}",
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
            throw Error(fmt::format("shader {}: layout({}) {}; is to be layout(points) {}, a point a particle",
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
            throw Error(fmt::format("shader {}: nothing is given for storage buffer {}, and this GL is too old to tell "
                                    "whether it is used (4.3 or GL_ARB_program_interface_query does)",
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

} // namespace

void check_nothing_lost(std::span<const ShaderSource> stages, std::span<const Capture> by_our_names) {
    const std::vector<Capture> captured = by_their_names(by_our_names, bindings_of(stages).get());
    const ShaderSource* last = last_vertex_stage(stages);
    if (last == nullptr)
        return;
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

std::vector<Capture> outputs_with(std::string_view prefix, std::span<const ShaderSource> stages) {
    const ShaderSource* last = last_vertex_stage(stages);
    if (last == nullptr)
        return {};
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

Program::Program(std::string name, std::span<const ShaderSource> stages, std::span<const Capture> captured,
                 std::span<const std::string_view> storage_buffers)
    : name_(std::move(name)), bindings_(bindings_of(stages)) {
    std::vector<Shader> shaders;
    for (const ShaderSource& stage : stages)
        shaders.emplace_back(stage);
    const Bindings* const bindings = bindings_.get();
    const std::vector<Capture> outputs = by_their_names(captured, bindings);
    id_ = gl::CreateProgram();
    try {
        for (const Shader& shader : shaders)
            gl::AttachShader(id_, shader.id());
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
        uniforms_.emplace(id_, stages, bindings);
        add_attributes(id_, stages, bindings, attributes_);
        check_gl(name_);
    } catch (...) {
        gl::DeleteProgram(id_);
        throw;
    }
}

Program::Program(Program&& other) noexcept
    : name_(std::move(other.name_)), id_(std::exchange(other.id_, 0)), bindings_(std::move(other.bindings_)),
      uniforms_(std::move(other.uniforms_)), attributes_(std::move(other.attributes_)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(id_, other.id_);
    std::swap(bindings_, other.bindings_);
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
    GLint count = 0;
    gl::GetProgramInterfaceiv(id_, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLuint block = 0; block < static_cast<GLuint>(count); ++block) {
        const GLenum property = GL_BUFFER_BINDING;
        GLint bound = 0;
        gl::GetProgramResourceiv(id_, GL_SHADER_STORAGE_BLOCK, block, 1, &property, 1, nullptr, &bound);
        if (static_cast<GLuint>(bound) == binding)
            return true;
    }
    return false;
}

GLint Program::attribute(std::string_view attribute, GLenum type) const {
    const auto given = attributes_.asked(attribute, type);
    return given.empty() ? -1 : attributes_[given.front().variable].location;
}

} // namespace lockstep
