#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "crosscheck/scene/kept_probe.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "tests/gpu/any_context.hpp"

namespace lockstep::test {

/// What the probe found behind the last open_llvmpipe.
inline ProbeResult& probed_llvmpipe() {
    static ProbeResult result;
    return result;
}

/// What llvmpipe computes here, for passes of `shaders`: the named profile where it still is as that was measured (Mesa
/// 22.3), else its own. The named one too where the current context is not the one that was probed, but another
/// driver's.
inline Profile llvmpipe_profile(const std::filesystem::path& shaders = {}) {
    const ContextInfo current = query_context_info({});
    const ContextInfo& probed = probed_llvmpipe().context;
    if (current.renderer != probed.renderer || current.version != probed.version)
        return named_profile("llvmpipe");
    const Profile measured = measured_profile(probed_llvmpipe(), shaders);
    return measured.name == "llvmpipe" ? named_profile("llvmpipe") : measured;
}

/// The context if Mesa's llvmpipe is behind it; else a skip.
inline std::optional<Context> open_llvmpipe(const std::string& name = software_gl()) {
    std::optional<Context> context = open_context(name);
    if (!context)
        return context;
    if (context->describe().renderer.find("llvmpipe") != std::string::npos) {
        if (summary(probed_llvmpipe().context) != summary(context->describe()))
            probed_llvmpipe() = kept_probe(*context);
        return context;
    }
    skip(name + " is not llvmpipe but " + context->describe().renderer);
    return std::nullopt;
}

} // namespace lockstep::test
