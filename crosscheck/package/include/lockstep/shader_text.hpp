#pragma once
/// Shaders' own texts as the reference of a system of one's own (docs/own_system.md): no twin in C++.
#include <memory>
#include <string>
#include <vector>

#include "lockstep/system.hpp"

namespace lockstep {

/// For each of `passes` one whose reference is a text in `folder`: NAME.comp or NAME.vert, GLSL that plainly does what
/// the pass has to do, with the names of blocks, images, attributes and outputs that the pass's shader has. Every legal
/// outcome follows from that text. A pass that draws has none. Throws Error for a text that is missing or not
/// interpreted, naming what it is. `schema` outlives them.
std::vector<std::unique_ptr<ItemPass>> passes_by_text(const Schema& schema, const std::vector<GlPass>& passes,
                                                      const std::string& folder);

} // namespace lockstep
