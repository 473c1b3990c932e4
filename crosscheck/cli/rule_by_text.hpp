#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/judge/legal.hpp"
#include "gpu/shader_use.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// What a run's differences are judged by, and why where nobody asked for it.
struct RuleByText {
    Legal legal = Legal::by_text;
    std::vector<std::string> notes;
};

/// `asked`, but where that is by_text and the user's shaders compute floats without `precise`, which leaves GL their
/// order and fusing (GLSL 4.60, 4.7): any_order. A stage that is not interpreted counts as one that says `precise`
/// throughout.
RuleByText rule_by_text(Legal asked, const Scene& scene, const ShaderUse& use, const std::filesystem::path& shaders,
                        bool rendered);

} // namespace lockstep
