#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "crosscheck/text/glsl_module.hpp"
#include "gpu/shader_source.hpp"
#include "reference/text/invocation.hpp"
#include "reference/text/memory.hpp"
#include "reference/text/module.hpp"
#include "reference/text/program.hpp"

namespace lockstep {

/// A stage's text as it was read from a file.
struct StageText {
    std::string file;                           ///< as messages name it
    std::shared_ptr<const ShaderSource> source; ///< that lines are named by
    text::Module module;
    text::Program program;
};

/// By the extension of its name, in GLSL or SPIR-V; null: it is no stage's.
std::optional<Stage> stage_of(const std::filesystem::path& file);

/// Throws Error naming what is not interpreted.
StageText read_stage(const std::filesystem::path& file, const ShaderDefines& defines,
                     ConstantExpressions constants = ConstantExpressions::folded);

/// The same of what was read already. `file`: as messages name it.
StageText stage_text(std::shared_ptr<const ShaderSource> source, std::string file,
                     ConstantExpressions constants = ConstantExpressions::folded);

/// A line of the stage's text, from 1, without its comment and what is blank around it.
std::string line_text(const ShaderSource& stage, std::uint32_t line);

/// A word of a block, an image or an output by its name in the text.
struct NamedWord {
    std::string name; ///< "Boids.boids[3].velocity.y", "u_Target(3, 4).x", "v_Colour.w"
    bool is_real = true;
};
NamedWord named_word(const StageText& stage, const text::Bindings& bindings, const text::WrittenPlace& place);

} // namespace lockstep
