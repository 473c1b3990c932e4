#pragma once
#include <cstdlib>
#include <optional>
#include <string>

#include "tests/gpu/any_context.hpp"

namespace lockstep::test {

/// The context if Mesa's llvmpipe is behind it, whose rasteriser the default RasterRules describe; else a skip. EGL's
/// instead of OSMesa's where the machine has no OSMesa and is not said to.
inline std::optional<Context> open_llvmpipe(const std::string& wanted) {
    const bool without_osmesa =
        wanted == "osmesa" && !has_osmesa_library() && std::getenv("LOCKSTEP_REQUIRE_OSMESA") == nullptr;
    const std::string name = without_osmesa ? "egl" : wanted;
    std::optional<Context> context = open_context(name);
    if (!context || context->describe().renderer.find("llvmpipe") != std::string::npos)
        return context;
    skip(name + " is not llvmpipe but " + context->describe().renderer);
    return std::nullopt;
}

} // namespace lockstep::test
