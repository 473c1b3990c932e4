#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reference/text/stage_run.hpp"
#include "tests/text/gl_programs.hpp"

namespace lockstep::test {

/// Runs the text of each vertex, geometry and fragment stage that is drawn with, whichever host does it. Before a draw
/// the same is drawn once for each stage with a text that keeps, of every invocation, the inputs that it has and the
/// outputs that it makes; the text of the stage as it is then runs on these inputs. While it lives, GL's entry points
/// go through it; one at a time.
class DrawWatch {
  public:
    struct Row {
        std::size_t draws = 0, invocations = 0, words = 0, discarded = 0, vertices = 0, differing = 0;
        std::string first = {}, finding = {}, refused = {};
    };
    /// `most`: invocations of a draw that are kept; `most_draws`: of one stage that are looked at.
    explicit DrawWatch(Profile profile, std::size_t most = 16384, std::size_t most_draws = 4)
        : profile_(std::move(profile)), most_(most), most_draws_(most_draws) {
        instance() = this;
        real_arrays_ = gl::DrawArrays;
        real_instanced_ = gl::DrawArraysInstanced;
        real_elements_ = gl::DrawElements;
        real_indirect_ = gl::DrawElementsIndirect;
        real_query_ = gl::BeginQuery;
        real_end_query_ = gl::EndQuery;
        real_feedback_ = gl::BeginTransformFeedback;
        gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
            instance()->draw([=] { instance()->real_arrays_(mode, first, count); });
        };
        gl::DrawArraysInstanced = [](GLenum mode, GLint first, GLsizei count, GLsizei instances) {
            instance()->draw([=] { instance()->real_instanced_(mode, first, count, instances); });
        };
        gl::DrawElements = [](GLenum mode, GLsizei count, GLenum type, const void* indices) {
            instance()->draw([=] { instance()->real_elements_(mode, count, type, indices); });
        };
        gl::DrawElementsIndirect = [](GLenum mode, GLenum type, const void* at) {
            instance()->draw([=] { instance()->real_indirect_(mode, type, at); });
        };
        // What counts or captures a draw begins behind those that are added.
        gl::BeginQuery = [](GLenum target, GLuint id) {
            instance()->begun_.push_back([=] { instance()->real_query_(target, id); });
        };
        gl::EndQuery = [](GLenum target) {
            instance()->begin();
            instance()->real_end_query_(target);
        };
        gl::BeginTransformFeedback = [](GLenum mode) {
            instance()->begun_.push_back([=] { instance()->real_feedback_(mode); });
        };
    }
    ~DrawWatch() {
        gl::DrawArrays = real_arrays_;
        gl::DrawArraysInstanced = real_instanced_;
        gl::DrawElements = real_elements_;
        gl::DrawElementsIndirect = real_indirect_;
        gl::BeginQuery = real_query_;
        gl::EndQuery = real_end_query_;
        gl::BeginTransformFeedback = real_feedback_;
        instance() = nullptr;
    }
    DrawWatch(const DrawWatch&) = delete;
    DrawWatch& operator=(const DrawWatch&) = delete;

    /// By the stage and what its first comment says.
    [[nodiscard]] const std::map<std::string, Row>& rows() const { return rows_; }

  private:
    static DrawWatch*& instance() {
        static DrawWatch* one = nullptr;
        return one;
    }
    void begin() {
        for (const std::function<void()>& one : std::exchange(begun_, {}))
            one();
    }

    template <class Draw> void draw(const Draw& real) {
        const GlPrograms::Texts texts = programs_.current();
        for (const auto& [type, stage, name] : {std::tuple(GL_VERTEX_SHADER, Stage::vertex, "vert"),
                                                std::tuple(GL_GEOMETRY_SHADER, Stage::geometry, "geom"),
                                                std::tuple(GL_FRAGMENT_SHADER, Stage::fragment, "frag")}) {
            const auto text = texts.find(static_cast<GLenum>(type));
            if (text == texts.end() || text->second.empty())
                continue;
            Row& row = rows_[fmt::format("{}: {}", name, programs_.name_of(text->second))];
            if (row.draws >= most_draws_ || !row.refused.empty())
                continue;
            try {
                watch(static_cast<GLenum>(type), stage, texts, real, row);
            } catch (const Error& error) {
                row.refused = error.what();
            }
        }
        begin();
        real();
    }

    /// Words that are kept of an invocation.
    struct Record {
        std::vector<const text::StageVariable*> inputs;
        std::vector<std::pair<const text::StageVariable*, std::uint32_t>> outputs; ///< with the component
        std::uint32_t vertices = 1;
        [[nodiscard]] std::uint32_t first_output() const {
            std::uint32_t words = 3; // whether it ended, vertices that were emitted, and after which a strip ended
            for (const text::StageVariable* input : inputs)
                words += input->words();
            return words;
        }
        [[nodiscard]] std::uint32_t words() const {
            return first_output() + vertices * static_cast<std::uint32_t>(outputs.size());
        }
    };
    static Record record_of(const text::Program& stage) {
        Record record;
        for (const text::StageVariable& input : stage.stage_inputs)
            if (input.is_read)
                record.inputs.push_back(&input);
        for (const text::StageVariable& output : stage.stage_outputs)
            for (std::uint32_t c = 0; c < output.cells; ++c)
                if (stage.is_written[output.cell + c] != 0)
                    record.outputs.emplace_back(&output, c);
        if (stage.stage == spv::ExecutionModelGeometry)
            record.vertices = stage.most_vertices;
        return record;
    }
    /// GLSL for a component's word.
    static std::string word_of(const text::StageVariable& variable, const std::string& name, std::uint32_t component) {
        std::string all = name;
        if (variable.cells > variable.components)
            all += fmt::format("[{}]", component / variable.components);
        if (variable.components > 1)
            all += fmt::format("[{}]", component % variable.components);
        return fmt::format("{}({})", variable.is_real ? "floatBitsToUint" : "uint", all);
    }

    /// The text, which keeps what its invocations have and make in LsRecords.
    [[nodiscard]] std::string keeping(const text::Program& stage, std::string text) const {
        const Record record = record_of(stage);
        const bool is_geometry = stage.stage == spv::ExecutionModelGeometry;
        std::string before, after;
        std::uint32_t word = 3;
        for (const text::StageVariable* input : record.inputs)
            for (std::uint32_t vertex = 0; vertex < input->vertices; ++vertex)
                for (std::uint32_t c = 0; c < input->cells; ++c) {
                    const std::string name = input->vertices == 1 && input->stride == 0 ? input->name
                                             : input->builtin ? fmt::format("gl_in[{}].{}", vertex, input->name)
                                                              : fmt::format("{}[{}]", input->name, vertex);
                    before += fmt::format("    ls_keep({}u, {});\n", word++, word_of(*input, name, c));
                }
        for (std::size_t k = 0; k < record.outputs.size(); ++k)
            after +=
                fmt::format("    ls_keep({}u + ls_emitted * {}u + {}u, {});\n", word, record.outputs.size(), k,
                            word_of(*record.outputs[k].first, record.outputs[k].first->name, record.outputs[k].second));
        const std::string end = text.ends_with('\n') ? "" : "\n";
        const std::size_t undefined = text.rfind("\n#undef main"); // those before it go by another name
        for (std::size_t at = undefined == std::string::npos ? 0 : undefined;
             (at = text.find("void main(", at)) != std::string::npos;)
            text.replace(at, 10, "void ls_main(");
        text += fmt::format("{}#undef EmitVertex\n#undef EndPrimitive\n"
                            "layout(std430) buffer LsRecords {{ uint ls_count; uint ls_records[]; }};\n"
                            "uint ls_at = {}u, ls_emitted = 0u, ls_ends = 0u;\n"
                            "void ls_keep(uint word, uint value) {{\n"
                            "    if (ls_at < {}u)\n        ls_records[ls_at * {}u + word] = value;\n}}\n",
                            end, most_, most_, record.words());
        if (is_geometry)
            text +=
                fmt::format("void ls_emit_vertex() {{\n{}    ++ls_emitted;\n    EmitVertex();\n}}\n"
                            "void ls_end_primitive() {{\n    ls_ends |= 1u << ls_emitted;\n    EndPrimitive();\n}}\n",
                            after);
        text += fmt::format("void main() {{\n    ls_at = atomicAdd(ls_count, 1u);\n{}    ls_main();\n{}"
                            "    ls_keep(0u, 1u);\n    ls_keep(1u, ls_emitted);\n    ls_keep(2u, ls_ends);\n}}\n",
                            before, is_geometry ? "" : after);
        const std::size_t version_end = text.find('\n') + 1, extension = text.rfind("\n#extension");
        const std::size_t head_end = extension == std::string::npos ? version_end : text.find('\n', extension + 1) + 1;
        text.insert(head_end, is_geometry ? "#define EmitVertex ls_emit_vertex\n#define EndPrimitive ls_end_primitive\n"
                                            "void ls_emit_vertex();\nvoid ls_end_primitive();\n"
                                          : "");
        return "#version 450 core\n" + text.substr(version_end);
    }

    /// A program of the stages up to this one, which keeps its invocations; uniforms and bindings are those in use.
    static GLuint program_of(GlPrograms::Texts texts, GLenum type, const std::string& text) {
        const GLuint from = GlPrograms::current_program(), made = gl::CreateProgram();
        texts[type] = text;
        for (const auto& [stage, source] : texts) {
            if ((type == GL_VERTEX_SHADER && stage != type) ||
                (type == GL_GEOMETRY_SHADER && stage == GL_FRAGMENT_SHADER))
                continue;
            const GLuint shader = gl::CreateShader(stage);
            const char* const words = source.c_str();
            gl::ShaderSource(shader, 1, &words, nullptr);
            gl::CompileShader(shader);
            GLint is_compiled = 0;
            gl::GetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
            if (is_compiled == 0) {
                std::array<char, 2048> log{};
                gl::GetShaderInfoLog(shader, log.size(), nullptr, log.data());
                throw Error(fmt::format("the text that keeps invocations does not compile: {}", log.data()));
            }
            gl::AttachShader(made, shader);
            gl::DeleteShader(shader);
        }
        GLint count = 0, is_linked = 0;
        gl::GetProgramiv(from, GL_ACTIVE_ATTRIBUTES, &count);
        std::array<char, 256> name{};
        GLint size = 0;
        GLenum kind = 0;
        for (GLint i = 0; i < count; ++i) {
            gl::GetActiveAttrib(from, static_cast<GLuint>(i), name.size(), nullptr, &size, &kind, name.data());
            if (const GLint location = gl::GetAttribLocation(from, name.data()); location >= 0)
                gl::BindAttribLocation(made, static_cast<GLuint>(location), name.data());
        }
        gl::LinkProgram(made);
        gl::GetProgramiv(made, GL_LINK_STATUS, &is_linked);
        if (is_linked == 0) {
            std::array<char, 2048> log{};
            gl::GetProgramInfoLog(made, log.size(), nullptr, log.data());
            throw Error(fmt::format("the text that keeps invocations does not link: {}", log.data()));
        }
        gl::UseProgram(made);
        gl::GetProgramiv(made, GL_ACTIVE_UNIFORMS, &count);
        for (GLint i = 0; i < count; ++i) {
            gl::GetActiveUniform(made, static_cast<GLuint>(i), name.size(), nullptr, &size, &kind, name.data());
            copy_uniform(from, made, name.data(), size, kind);
        }
        gl::GetProgramInterfaceiv(made, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
        for (GLint i = 0; i < count; ++i) {
            gl::GetProgramResourceName(made, GL_SHADER_STORAGE_BLOCK, static_cast<GLuint>(i), name.size(), nullptr,
                                       name.data());
            const GLuint index = gl::GetProgramResourceIndex(from, GL_SHADER_STORAGE_BLOCK, name.data());
            const GLenum property = GL_BUFFER_BINDING;
            GLint binding = records_binding;
            if (index != GL_INVALID_INDEX)
                gl::GetProgramResourceiv(from, GL_SHADER_STORAGE_BLOCK, index, 1, &property, 1, nullptr, &binding);
            gl::ShaderStorageBlockBinding(made, static_cast<GLuint>(i), static_cast<GLuint>(binding));
        }
        return made;
    }
    static void copy_uniform(GLuint from, GLuint to, std::string name, GLint size, GLenum kind) {
        if (name.ends_with("[0]"))
            name.resize(name.size() - 3);
        for (GLint i = 0; i < size; ++i) {
            const std::string one = size > 1 ? fmt::format("{}[{}]", name, i) : name;
            const GLint source = gl::GetUniformLocation(from, one.c_str()),
                        at = gl::GetUniformLocation(to, one.c_str());
            if (source < 0 || at < 0)
                continue;
            std::array<GLfloat, 16> reals{};
            std::array<GLint, 16> numbers{};
            switch (kind) {
            case GL_FLOAT:
            case GL_FLOAT_VEC2:
            case GL_FLOAT_VEC3:
            case GL_FLOAT_VEC4:
            case GL_FLOAT_MAT4:
                gl::GetUniformfv(from, source, reals.data());
                break;
            default:
                gl::GetUniformiv(from, source, numbers.data());
            }
            switch (kind) {
            case GL_FLOAT:
                gl::Uniform1fv(at, 1, reals.data());
                break;
            case GL_FLOAT_VEC2:
                gl::Uniform2fv(at, 1, reals.data());
                break;
            case GL_FLOAT_VEC3:
                gl::Uniform3fv(at, 1, reals.data());
                break;
            case GL_FLOAT_VEC4:
                gl::Uniform4fv(at, 1, reals.data());
                break;
            case GL_FLOAT_MAT4:
                gl::UniformMatrix4fv(at, 1, GL_FALSE, reals.data());
                break;
            case GL_INT_VEC2:
                gl::Uniform2iv(at, 1, numbers.data());
                break;
            case GL_INT_VEC3:
                gl::Uniform3iv(at, 1, numbers.data());
                break;
            case GL_INT_VEC4:
                gl::Uniform4iv(at, 1, numbers.data());
                break;
            case GL_UNSIGNED_INT:
                gl::Uniform1uiv(at, 1, reinterpret_cast<const GLuint*>(numbers.data()));
                break;
            default: // int, bool, samplers
                gl::Uniform1i(at, numbers[0]);
            }
        }
    }

    template <class Draw>
    void watch(GLenum type, Stage stage, const GlPrograms::Texts& texts, const Draw& real, Row& row) {
        const text::Program& program = programs_.decoded(stage, texts.at(type));
        const Record record = record_of(program);
        const bool is_discarding = gl::IsEnabled(GL_RASTERIZER_DISCARD) == GL_TRUE;
        if (type == GL_FRAGMENT_SHADER && is_discarding)
            return;
        const GLuint from = GlPrograms::current_program();
        BoundWords bound(from, program);
        const GLuint keeper = program_of(texts, type, keeping(program, texts.at(type)));
        Words words(1 + most_ * record.words());
        GLuint buffer = 0;
        gl::GenBuffers(1, &buffer);
        gl::BindBuffer(GL_COPY_WRITE_BUFFER, buffer);
        gl::BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(words.size() * sizeof words[0]), words.data(),
                       GL_DYNAMIC_COPY);
        GLint before = 0;
        gl::GetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &before);
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, records_binding, buffer);
        std::array<GLboolean, 4> colours{};
        GLboolean depth = GL_TRUE;
        gl::GetBooleanv(GL_COLOR_WRITEMASK, colours.data());
        gl::GetBooleanv(GL_DEPTH_WRITEMASK, &depth);
        gl::ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        gl::DepthMask(GL_FALSE);
        if (type != GL_FRAGMENT_SHADER)
            gl::Enable(GL_RASTERIZER_DISCARD);
        real();
        gl::MemoryBarrier(GL_ALL_BARRIER_BITS);
        gl::GetBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(words.size() * sizeof words[0]),
                             words.data());
        if (!is_discarding)
            gl::Disable(GL_RASTERIZER_DISCARD);
        gl::ColorMask(colours[0], colours[1], colours[2], colours[3]);
        gl::DepthMask(depth);
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, records_binding, 0);
        gl::BindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(before));
        gl::DeleteBuffers(1, &buffer);
        gl::UseProgram(from);
        gl::DeleteProgram(keeper);
        compare(program, record, bound, words, row);
    }

    void compare(const text::Program& program, const Record& record, BoundWords& bound, const Words& words, Row& row) {
        text::StageRun run;
        run.invocations = static_cast<std::uint32_t>(std::min<std::size_t>(words[0], most_));
        ++row.draws;
        if (run.invocations == 0)
            return;
        const auto kept = [&](std::uint32_t i) { return words.begin() + 1 + std::ptrdiff_t{i} * record.words(); };
        for (std::uint32_t i = 0; i < run.invocations; ++i) {
            std::ptrdiff_t at = 3;
            for (const text::StageVariable* input : record.inputs) {
                Words& to = run.inputs[text::name_of(*input)];
                to.insert(to.end(), kept(i) + at, kept(i) + at + input->words());
                at += input->words();
            }
        }
        text::Findings findings;
        run.is_watched = row.draws == 1;
        const text::StageResult made = text::run_stage(program, run, bound.bindings(), profile_, findings);
        for (const text::Finding& one : findings.all())
            row.finding = fmt::format("{}: {}: {}", program.line_name(one.place.line), one.rule, one.what);
        row.invocations += run.invocations;
        row.vertices += made.vertices;
        std::uint32_t vertex = 0;
        std::size_t strip = 0;
        const auto differs = [&](std::uint32_t i, const std::string& what) {
            if (++row.differing == 1)
                row.first = fmt::format("invocation {}: {}", i, what);
        };
        for (std::uint32_t i = 0; i < run.invocations; ++i) {
            const bool is_discarded = kept(i)[0] == 0;
            row.discarded += is_discarded ? 1 : 0;
            if (is_discarded != (made.is_discarded[i] != 0))
                differs(i, fmt::format("discarded: text {}, GPU {}", made.is_discarded[i], is_discarded));
            const bool is_geometry = program.stage == spv::ExecutionModelGeometry;
            const std::uint32_t vertices = is_geometry ? kept(i)[1] : 1;
            if (is_geometry) {
                std::uint32_t count = 0, ends = 0;
                for (; strip < made.strips.size() && made.strips[strip].invocation == i; ++strip)
                    ends |= 1U << (count += made.strips[strip].count);
                if (count != vertices || ends != ((kept(i)[2] | 1U << vertices) & ~1U))
                    differs(i, fmt::format("vertices: text {} strips {:x}, GPU {} {:x}", count, ends, vertices,
                                           kept(i)[2]));
                if (count != vertices) {
                    vertex += count;
                    continue;
                }
            }
            for (std::uint32_t v = 0; v < vertices; ++v, ++vertex)
                for (std::size_t k = 0; k < record.outputs.size() && !is_discarded; ++k) {
                    const auto& [output, c] = record.outputs[k];
                    const std::uint32_t gpu = kept(i)[record.first_output() + v * record.outputs.size() + k];
                    const std::uint32_t text = made.outputs.at(text::name_of(*output))[vertex * output->cells + c];
                    ++row.words;
                    if (gpu != text)
                        differs(i, fmt::format("{}[{}]: text {:08x}, GPU {:08x}", output->name, c, text, gpu));
                }
        }
    }

    static constexpr GLint records_binding = 14;
    Profile profile_;
    std::size_t most_, most_draws_;
    GlPrograms programs_;
    std::vector<std::function<void()>> begun_;
    decltype(gl::DrawArrays) real_arrays_;
    decltype(gl::DrawArraysInstanced) real_instanced_;
    decltype(gl::DrawElements) real_elements_;
    decltype(gl::DrawElementsIndirect) real_indirect_;
    decltype(gl::BeginQuery) real_query_;
    decltype(gl::EndQuery) real_end_query_;
    decltype(gl::BeginTransformFeedback) real_feedback_;
    std::map<std::string, Row> rows_;
};

} // namespace lockstep::test
