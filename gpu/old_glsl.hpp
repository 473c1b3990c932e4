#pragma once
#include <string>

#include "gpu/shader_source.hpp"

namespace lockstep {

/// What a text of GLSL 1.10, 1.20 or GLSL ES 1.00 needs before it to be one of a later version: `varying` and
/// `attribute`, the functions that sample, and built-in variables that went, which are ls_FragColor, ls_Vertex and so
/// on. Lines of its own, before the text. `text`: which of them it uses.
std::string words_of_old_glsl(const std::string& text, Stage stage);

/// gl_FragColor of ls_FragColor: a variable as the text has it.
std::string old_name(const std::string& name);

/// Whether a text has such words.
bool says_old_glsl(const std::string& text);

} // namespace lockstep
