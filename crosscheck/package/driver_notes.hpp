#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/package/shader_findings.hpp"
#include "crosscheck/package/text_passes.hpp"

namespace lockstep {

/// Of a DIVERGENT check: whether the GPU made what the text of its own shader says of the items that diverge. Where it
/// did not, that it is the driver, and the first operation that it makes otherwise when it runs it alone; nothing where
/// it did, where no text is run, or where `findings` say that GLSL leaves what it makes open. `own`: the texts that
/// were read already; `shaders`: where the user's own are.
std::vector<std::string> driver_notes(const ShadedSystem& of, const OwnTexts& own, const std::filesystem::path& shaders,
                                      const std::vector<ShortFinding>& findings, DivergentPass& divergence);

} // namespace lockstep
