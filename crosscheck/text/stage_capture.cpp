#include "crosscheck/text/stage_capture.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/text/bound_words.hpp"
#include "crosscheck/text/keeping_text.hpp"
#include "gpu/object.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::size_t most_words = std::size_t{1} << 22U; ///< of records: as large as any storage block may be

/// The last there is, which a host is the least likely to use.
GLuint records_binding() {
    GLint count = 0;
    gl::GetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &count);
    return static_cast<GLuint>(std::max(count, 1) - 1);
}

StageCapture* capture = nullptr; ///< that lives

void compile(GLuint program, GLenum type, const std::string& text) {
    const GLuint shader = gl::CreateShader(type);
    const char* const words = text.c_str();
    gl::ShaderSource(shader, 1, &words, nullptr);
    gl::CompileShader(shader);
    GLint is_compiled = 0;
    gl::GetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
    std::array<char, 2048> log{};
    if (is_compiled == 0)
        gl::GetShaderInfoLog(shader, log.size(), nullptr, log.data());
    gl::AttachShader(program, shader);
    gl::DeleteShader(shader);
    if (is_compiled == 0)
        throw Error(fmt::format("the text that keeps invocations does not compile: {}", log.data()));
}

/// A program of the stages up to `type`, whose text keeps its invocations; it is in use while it lives, with what the
/// one before has bound.
class KeepingProgram {
  public:
    /// Throws Error where GL does not take it.
    KeepingProgram(std::map<GLenum, std::string> texts, GLenum type, std::string text) : before_(current_program()) {
        texts[type] = std::move(text);
        try {
            make(texts, type);
        } catch (const Error&) {
            gl::DeleteProgram(id_);
            throw;
        }
        gl::UseProgram(id_);
        copy_bindings(before_, id_, records_binding());
    }
    ~KeepingProgram() {
        gl::UseProgram(before_);
        gl::DeleteProgram(id_);
    }
    KeepingProgram(const KeepingProgram&) = delete;
    KeepingProgram& operator=(const KeepingProgram&) = delete;

  private:
    void make(const std::map<GLenum, std::string>& texts, GLenum type) const {
        for (const auto& [stage, source] : texts)
            if ((type != GL_VERTEX_SHADER || stage == type) &&
                (type != GL_GEOMETRY_SHADER || stage != GL_FRAGMENT_SHADER))
                compile(id_, stage, source);
        GLint count = 0, size = 0, is_linked = 0;
        GLenum kind = 0;
        std::array<char, 256> name{};
        gl::GetProgramiv(before_, GL_ACTIVE_ATTRIBUTES, &count);
        for (GLint i = 0; i < count; ++i) {
            gl::GetActiveAttrib(before_, static_cast<GLuint>(i), name.size(), nullptr, &size, &kind, name.data());
            if (const GLint location = gl::GetAttribLocation(before_, name.data()); location >= 0)
                gl::BindAttribLocation(id_, static_cast<GLuint>(location), name.data());
        }
        gl::LinkProgram(id_);
        gl::GetProgramiv(id_, GL_LINK_STATUS, &is_linked);
        if (is_linked == 0) {
            std::array<char, 2048> log{};
            gl::GetProgramInfoLog(id_, log.size(), nullptr, log.data());
            throw Error(fmt::format("the text that keeps invocations does not link: {}", log.data()));
        }
    }

    GLuint before_;
    GLuint id_ = gl::CreateProgram();
};

/// A buffer of so many words, bound for the records while it lives.
class KeptRecords {
  public:
    explicit KeptRecords(std::size_t words) : words_(words) {
        gl::BindBuffer(GL_COPY_WRITE_BUFFER, buffer_.id());
        gl::BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(words * sizeof words_[0]), words_.data(),
                       GL_DYNAMIC_COPY);
        gl::GetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &before_);
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, records_binding(), buffer_.id());
    }
    ~KeptRecords() {
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, records_binding(), 0);
        gl::BindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(before_));
    }
    KeptRecords(const KeptRecords&) = delete;
    KeptRecords& operator=(const KeptRecords&) = delete;
    [[nodiscard]] const std::vector<std::uint32_t>& read() {
        gl::MemoryBarrier(GL_ALL_BARRIER_BITS);
        gl::BindBuffer(GL_COPY_WRITE_BUFFER, buffer_.id());
        gl::GetBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(words_.size() * sizeof words_[0]),
                             words_.data());
        return words_;
    }

  private:
    std::vector<std::uint32_t> words_;
    GlBuffer buffer_;
    GLint before_ = 0;
};

/// Nothing is drawn into the targets while it lives; `discards`: nothing is rasterised.
class WithoutTargets {
  public:
    explicit WithoutTargets(bool discards) : was_discarding_(gl::IsEnabled(GL_RASTERIZER_DISCARD) == GL_TRUE) {
        gl::GetBooleanv(GL_COLOR_WRITEMASK, colours_.data());
        gl::GetBooleanv(GL_DEPTH_WRITEMASK, &depth_);
        gl::ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        gl::DepthMask(GL_FALSE);
        if (discards)
            gl::Enable(GL_RASTERIZER_DISCARD);
    }
    ~WithoutTargets() {
        if (!was_discarding_)
            gl::Disable(GL_RASTERIZER_DISCARD);
        gl::ColorMask(colours_[0], colours_[1], colours_[2], colours_[3]);
        gl::DepthMask(depth_);
    }
    WithoutTargets(const WithoutTargets&) = delete;
    WithoutTargets& operator=(const WithoutTargets&) = delete;

  private:
    bool was_discarding_;
    std::array<GLboolean, 4> colours_{};
    GLboolean depth_ = GL_TRUE;
};

/// What GL has bound to the names of a stage of the program in use.
CapturedStage bound(const text::Program& program) {
    CapturedStage stage;
    stage.program = &program;
    const GLuint in_use = current_program();
    for (const text::Block& block : program.blocks)
        stage.words.push_back(words_of_block(in_use, block));
    for (const text::ImageUniform& image : program.images) {
        BoundTexels texels = texels_of(in_use, image);
        stage.words.push_back(std::move(texels.words));
        stage.bindings.images.push_back(std::move(texels.memory));
    }
    for (const text::PlainUniform& uniform : program.uniforms)
        stage.bindings.uniforms.push_back(words_of_uniform(in_use, uniform));
    for (std::size_t b = 0; b < program.blocks.size(); ++b)
        stage.bindings.blocks.emplace_back(stage.words[b]);
    for (std::size_t i = 0; i < program.images.size(); ++i)
        stage.bindings.images[i].words = stage.words[program.blocks.size() + i];
    return stage;
}

} // namespace

struct StageCapture::Real {
    decltype(gl::CreateShader) create = gl::CreateShader;
    decltype(gl::ShaderSource) source = gl::ShaderSource;
    decltype(gl::AttachShader) attach = gl::AttachShader;
    decltype(gl::DispatchCompute) dispatch = gl::DispatchCompute;
    decltype(gl::DrawArrays) arrays = gl::DrawArrays;
    decltype(gl::DrawArraysInstanced) instanced = gl::DrawArraysInstanced;
    decltype(gl::DrawElements) elements = gl::DrawElements;
    decltype(gl::DrawElementsIndirect) indirect = gl::DrawElementsIndirect;
    decltype(gl::BeginQuery) query = gl::BeginQuery;
    decltype(gl::EndQuery) end_query = gl::EndQuery;
    decltype(gl::BeginTransformFeedback) feedback = gl::BeginTransformFeedback;
};

StageCapture::StageCapture(Watch watch, std::size_t most)
    : watch_(std::move(watch)), most_(most), real_(std::make_unique<const Real>()) {
    capture = this;
    gl::CreateShader = [](GLenum type) {
        const GLuint shader = capture->real_->create(type);
        capture->types_[shader] = type;
        return shader;
    };
    gl::ShaderSource = [](GLuint shader, GLsizei count, const GLchar* const* text, const GLint* lengths) {
        if (count == 1 && lengths == nullptr)
            capture->texts_[shader] = text[0];
        capture->real_->source(shader, count, text, lengths);
    };
    gl::AttachShader = [](GLuint program, GLuint shader) {
        capture->programs_[program][capture->types_[shader]] = capture->texts_[shader];
        capture->real_->attach(program, shader);
    };
    gl::DispatchCompute = [](GLuint x, GLuint y, GLuint z) { capture->dispatch({x, y, z}); };
    gl::DrawArrays = [](GLenum mode, GLint first, GLsizei count) {
        capture->draw([=] { capture->real_->arrays(mode, first, count); });
    };
    gl::DrawArraysInstanced = [](GLenum mode, GLint first, GLsizei count, GLsizei instances) {
        capture->draw([=] { capture->real_->instanced(mode, first, count, instances); });
    };
    gl::DrawElements = [](GLenum mode, GLsizei count, GLenum type, const void* indices) {
        capture->draw([=] { capture->real_->elements(mode, count, type, indices); });
    };
    gl::DrawElementsIndirect = [](GLenum mode, GLenum type, const void* at) {
        capture->draw([=] { capture->real_->indirect(mode, type, at); });
    };
    gl::BeginQuery = [](GLenum target, GLuint id) {
        capture->begun_.emplace_back([=] { capture->real_->query(target, id); });
    };
    gl::EndQuery = [](GLenum target) {
        capture->begin();
        capture->real_->end_query(target);
    };
    gl::BeginTransformFeedback = [](GLenum mode) {
        capture->begun_.emplace_back([=] { capture->real_->feedback(mode); });
    };
}

StageCapture::~StageCapture() {
    gl::CreateShader = real_->create;
    gl::ShaderSource = real_->source;
    gl::AttachShader = real_->attach;
    gl::DispatchCompute = real_->dispatch;
    gl::DrawArrays = real_->arrays;
    gl::DrawArraysInstanced = real_->instanced;
    gl::DrawElements = real_->elements;
    gl::DrawElementsIndirect = real_->indirect;
    gl::BeginQuery = real_->query;
    gl::EndQuery = real_->end_query;
    gl::BeginTransformFeedback = real_->feedback;
    capture = nullptr;
}

void StageCapture::begin() {
    for (const std::function<void()>& one : std::exchange(begun_, {}))
        one();
}

const StageCapture::Texts& StageCapture::current() { return programs_[current_program()]; }

void StageCapture::dispatch(const std::array<std::uint32_t, 3>& groups) {
    const Texts texts = current();
    const auto run = [&] { real_->dispatch(groups[0], groups[1], groups[2]); };
    const auto text = texts.find(GL_COMPUTE_SHADER);
    const text::Program* const program = text == texts.end() ? nullptr : watch_.program(Stage::compute, text->second);
    if (program == nullptr)
        return run();
    CapturedStage stage;
    try {
        stage = bound(*program);
    } catch (const Error& error) {
        run();
        return watch_.refuse(text->second, error.what());
    }
    run();
    gl::MemoryBarrier(GL_ALL_BARRIER_BITS);
    stage.groups = groups;
    for (const text::Block& block : program->blocks)
        stage.after.push_back(words_of_block(current_program(), block));
    watch_.take(text->second, std::move(stage));
}

void StageCapture::draw(const Draw& real) {
    const Texts texts = current();
    for (const auto& [type, stage] : {std::pair<GLenum, Stage>(GL_VERTEX_SHADER, Stage::vertex),
                                      {GL_GEOMETRY_SHADER, Stage::geometry},
                                      {GL_FRAGMENT_SHADER, Stage::fragment}}) {
        const auto text = texts.find(type);
        if (text == texts.end() || text->second.empty() ||
            (type == GL_FRAGMENT_SHADER && gl::IsEnabled(GL_RASTERIZER_DISCARD) == GL_TRUE))
            continue;
        if (const text::Program* const program = watch_.program(stage, text->second))
            try {
                watch_.take(text->second, drawn(type, *program, texts, real));
            } catch (const Error& error) {
                watch_.refuse(text->second, error.what());
            }
    }
    begin();
    real();
}

CapturedStage StageCapture::drawn(GLenum type, const text::Program& program, const Texts& texts,
                                  const Draw& real) const {
    const InvocationRecord record(program);
    CapturedStage stage = bound(program);
    const std::size_t most = std::min(most_, most_words / record.words());
    const KeepingProgram keeper(texts, type, keeping_text(record, texts.at(type), most));
    KeptRecords kept(1 + most * record.words());
    {
        const WithoutTargets without(type != GL_FRAGMENT_SHADER);
        real();
    }
    const std::span<const std::uint32_t> words = kept.read(),
                                         records =
                                             words.subspan(1, std::min<std::size_t>(words[0], most) * record.words());
    stage.run = run_of(record, records);
    stage.made = result_of(record, records);
    return stage;
}

} // namespace lockstep
