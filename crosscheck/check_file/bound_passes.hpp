#pragma once
#include <memory>
#include <vector>

#include "crosscheck/check_file/document.hpp"
#include "gpu/gl_system.hpp"
#include "reference/model/schema.hpp"

namespace lockstep::check_file {

/// The name of the system that every check file is of.
inline constexpr std::string_view system_name = "own";

/// A check file with its shaders: records are as they declare them, and what is read and written is what they read and
/// write.
struct BoundPasses {
    std::shared_ptr<const Schema> schema; ///< a resource an entry of the state
    std::vector<GlPass> passes;
};

/// `shaders`: the folder to read them from. A block or image goes to the entry that "bind" names, or to that of its own
/// name. A buffer that one shader has as two blocks, of which one is only read, lies in two copies; another is changed
/// in place. Throws Error with FILE: /json/pointer for what does not fit, and as glsl_module.hpp does.
BoundPasses bound_passes(const Document& document, const std::filesystem::path& shaders);

} // namespace lockstep::check_file
