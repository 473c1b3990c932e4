#pragma once
#include <filesystem>

#include "crosscheck/text/text_coverage.hpp"
#include "gpu/shader_source.hpp"
#include "reference/text/coverage.hpp"
#include "reference/text/program.hpp"

namespace lockstep {

/// What runs covered of a stage, of its files that lie in `folder` or below it: the user's. `stage`: as it was compiled
/// to `program`. What ran is left to say.
TextCoverage covered_text(const ShaderSource& stage, const text::Program& program, const text::Coverage& coverage,
                          const std::filesystem::path& folder);

} // namespace lockstep
