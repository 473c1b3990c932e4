#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "gpu/gl_system.hpp"

namespace lockstep {

/// Passes with the same macros and uniforms, each of which takes what it has.
class GlPassList {
  public:
    GlPassList(ShaderDefines defines, std::function<Uniforms(int frame)> uniforms)
        : defines_(std::move(defines)), uniforms_(std::move(uniforms)) {}

    GlPass& add(std::string name, Stage stage, std::uint8_t resource) {
        return all_.emplace_back(GlPass{
            .name = std::move(name), .stage = stage, .resource = resource, .uniforms = uniforms_, .defines = defines_});
    }
    /// What the pass before writes besides.
    void add_second(std::string name, Stage stage, std::uint8_t resource) {
        all_.push_back({.name = std::move(name), .stage = stage, .resource = resource, .continues = true});
    }
    [[nodiscard]] std::vector<GlPass> take() { return std::move(all_); }

  private:
    ShaderDefines defines_;
    std::function<Uniforms(int)> uniforms_;
    std::vector<GlPass> all_;
};

} // namespace lockstep
