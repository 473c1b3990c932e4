#pragma once
#include <memory>

#include "reference/text/program.hpp"

namespace lockstep::text {

/// The program of a compute stage with fewer steps: what is copied is taken from where it lies, and what nothing takes
/// is not made. For runs in plain bits that are not watched: memory gets the same words, and findings are the same.
/// Null where a text is not taken: of another stage, of subgroups or quads, or too long.
std::shared_ptr<const Program> with_fewer_copies(const Program& program);

} // namespace lockstep::text
