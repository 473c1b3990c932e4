#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/package/text_passes.hpp"

namespace lockstep {

/// Of a DIVERGENT check: whether the GPU made what the text of its own shader says of the items that diverge. Where it
/// did not, that it is the driver, and the first operation that it makes otherwise when it runs it alone; nothing where
/// it did, or where no text is run. `own`: the texts that were read already; `shaders`: where the user's own are.
std::vector<std::string> driver_notes(const ShadedSystem& of, const OwnTexts& own, const std::filesystem::path& shaders,
                                      DivergentPass& divergence);

} // namespace lockstep
