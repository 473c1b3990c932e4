#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/registered_system.hpp"
#include "crosscheck/text/pass_text.hpp"
#include "gpu/shader_use.hpp"
#include "reference/known_operations.hpp"

namespace lockstep {

/// Takes the compute shaders of run.reference as the references of their passes, instead of the twins. Returns a line
/// for each. Throws Error where none of them is of a pass, one is of another stage, or is not interpreted.
std::vector<std::string> take_references(SystemScene& scene, const RunOptions& run);

/// Of each pass, its shader's text; null: it is not the user's own, or not interpreted.
using OwnTexts = std::vector<std::shared_ptr<const PassText>>;

/// Of each pass whose compute shader is the user's own: what its text leaves open is legal (open_pass.hpp). A text that
/// is not interpreted leaves the pass as it is. Returns the texts.
OwnTexts open_by_own_text(SystemScene& scene, const ShaderUse& use, const std::filesystem::path& shaders);

/// Where a check is DIVERGENT in a pass whose compute shader is the user's own: the lines of its text that have no
/// counterpart in the reference's, which is run.reference's or the shipped one (text/witness.hpp).
std::vector<std::string> lines_without_counterpart(const SystemScene& scene, const OwnTexts& own, const ShaderUse& use,
                                                   const RunOptions& run, SystemSide& side,
                                                   const KnownOperations& known, const CheckReport& report);

} // namespace lockstep
