#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gpu/gl.hpp"
#include "gpu/shader_source.hpp"
#include "reference/text/memory.hpp"
#include "reference/text/program.hpp"
#include "reference/text/stage_run.hpp"

namespace lockstep {

/// A stage of a draw or a dispatch: what GL had bound to its names, with what it ran, and what it made.
struct CapturedStage {
    const text::Program* program = nullptr;
    std::vector<std::vector<std::uint32_t>> words; ///< of its blocks, then of its images, as before it ran
    text::Bindings bindings;                       ///< refer to them
    std::array<std::uint32_t, 3> groups{1, 1, 1};  ///< of a compute stage
    std::vector<std::vector<std::uint32_t>> after; ///< of a compute stage, its blocks' words as it left them
    text::StageRun run;                            ///< of another, its invocations and their inputs
    text::StageResult made;                        ///< of another, what the GPU made of these
};

/// Looks into the stages that run while it lives, whichever host draws or dispatches them: GL's entry points go through
/// it. In one context, of GL 4.3 or later; one at a time. Programs have to be made while it lives.
///
/// Before a draw the same is drawn once for each stage that is looked at, with a text that keeps, of every invocation,
/// the inputs that it has and the outputs that it makes.
class StageCapture {
  public:
    struct Watch {
        /// The stage's program, which outlives the capture; null: this run of it is not looked at.
        std::function<const text::Program*(Stage stage, const std::string& text)> program;
        std::function<void(const std::string& text, CapturedStage stage)> take;
        /// Why a stage could not be looked at.
        std::function<void(const std::string& text, const std::string& why)> refuse;
    };
    /// `most`: invocations that are kept of a draw.
    StageCapture(Watch watch, std::size_t most);
    ~StageCapture();
    StageCapture(const StageCapture&) = delete;
    StageCapture& operator=(const StageCapture&) = delete;

  private:
    using Texts = std::map<GLenum, std::string>; ///< by stage
    using Draw = std::function<void()>;
    void draw(const Draw& real);
    void dispatch(const std::array<std::uint32_t, 3>& groups);
    CapturedStage drawn(GLenum type, const text::Program& program, const Texts& texts, const Draw& real) const;
    void begin();           ///< what counts or captures a draw begins behind those that are added
    const Texts& current(); ///< of the program in use

    Watch watch_;
    std::size_t most_;
    std::map<GLuint, GLenum> types_;
    std::map<GLuint, std::string> texts_;
    std::map<GLuint, Texts> programs_;
    std::vector<std::function<void()>> begun_;
    struct Real; ///< GL's own entry points
    std::unique_ptr<const Real> real_;
};

} // namespace lockstep
