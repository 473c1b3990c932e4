#pragma once
#include <optional>
#include <string>

namespace lockstep {

/// A stage's text as the preprocessor leaves it, by glslang: macros in their places, only branches that are taken,
/// lines where they were, no comments. Nothing where glslang refuses it. `preamble`: lines before it, which do not
/// count.
std::optional<std::string> preprocessed(const std::string& text, const std::string& preamble = "");

} // namespace lockstep
