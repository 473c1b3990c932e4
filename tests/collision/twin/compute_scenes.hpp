#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "crosscheck/scene/scene_file.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/twin_scenes.hpp"

namespace lockstep::test {

/// The context if it is llvmpipe's and has compute shaders; else a skip.
inline std::optional<Context> open_compute(const std::string& name = software_gl()) {
    std::optional<Context> context = open_llvmpipe(name);
    if (!context || context->describe().compute)
        return context;
    skip(name + " has no compute shaders");
    return std::nullopt;
}

/// The crowded scene with the collision pass in compute stages.
inline Scene compute_scene(const char* base, std::size_t count = 1200, int width = 97, int height = 64) {
    Scene scene = crowded_scene(count, width, height);
    scene.switches = preset(base);
    scene.switches.step = Step::compute;
    return scene;
}

} // namespace lockstep::test
