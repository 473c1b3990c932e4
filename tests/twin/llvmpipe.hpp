#pragma once
#include <optional>
#include <string>

#include "tests/gpu/any_context.hpp"

namespace lockstep::test {

/// The context if Mesa's llvmpipe is behind it, whose rasteriser the default RasterRules describe; else a skip.
inline std::optional<Context> open_llvmpipe(const std::string& name) {
    std::optional<Context> context = open_context(name);
    if (!context || context->describe().renderer.find("llvmpipe") != std::string::npos)
        return context;
    skip(name + " is not llvmpipe but " + context->describe().renderer);
    return std::nullopt;
}

} // namespace lockstep::test
