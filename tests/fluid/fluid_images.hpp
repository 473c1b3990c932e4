#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reference/portable.hpp"
#include "reference/readings/values.hpp"
#include "tests/fluid/fluid_run.hpp"

namespace lockstep::test {

/// A state of the fluid system on the reference alone: images as passes make them, or as a test writes them.
class FluidImages {
  public:
    using Reading = Values<Portable>;

    explicit FluidImages(fluid::Settings settings)
        : host_(host_of(std::move(settings))), system_(fluid::system(host_)), state_(system_.start),
          next_(system_.start) {}

    [[nodiscard]] const fluid::Host& host() const { return *host_; }
    [[nodiscard]] const System& system() const { return system_; }
    [[nodiscard]] SystemView view() const { return state_.view(); }
    [[nodiscard]] int width() const { return host_->settings().width; }
    [[nodiscard]] int height() const { return host_->settings().height; }
    [[nodiscard]] std::size_t item(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x);
    }

    /// Runs the passes of these names, all of each, in the frame's order; without names all.
    FluidImages& run(std::initializer_list<std::string_view> names = {}, int frame = 0) {
        for (const auto& pass : system_.passes)
            if (names.size() == 0 || std::find(names.begin(), names.end(), pass->name()) != names.end())
                run_one(*pass, frame);
        return *this;
    }
    /// A pass at one pixel.
    void run_at(const ItemPass& pass, int x, int y) {
        next_.take(pass.resource(), state_);
        pass.run({state_.view(), 0}, named_profile("strict"), item(x, y), item(x, y) + 1, next_[pass.resource()]);
        state_.take(pass.resource(), next_);
    }
    void run_one(const ItemPass& pass, int frame = 0) {
        next_.take(pass.resource(), state_);
        run_pass(pass, {state_.view(), frame}, named_profile("strict"), next_[pass.resource()]);
        state_.take(pass.resource(), next_);
    }
    /// The passes of a name, in order.
    [[nodiscard]] std::vector<const ItemPass*> passes(std::string_view name) const {
        std::vector<const ItemPass*> all;
        for (const auto& pass : system_.passes)
            if (pass->name() == name)
                all.push_back(pass.get());
        return all;
    }

    /// A number of an image at each pixel.
    FluidImages& fill(FieldId field, const std::function<double(int x, int y)>& value, int component = 0) {
        for (int y = 0; y < height(); ++y)
            for (int x = 0; x < width(); ++x)
                state_.set(field, item(x, y), static_cast<float>(value(x, y)), component);
        return *this;
    }
    void set(FieldId field, int x, int y, float value, int component = 0) {
        state_.set(field, item(x, y), value, component);
    }
    [[nodiscard]] float at(FieldId field, int x, int y, int component = 0) const {
        return state_.view().real(field, item(x, y), component);
    }
    [[nodiscard]] glm::vec3 vector(FieldId field, int x, int y) const {
        return glm::vec3(state_.view().vec4(field, item(x, y)));
    }
    [[nodiscard]] std::uint32_t word(FieldId field, int x, int y, int component = 0) const {
        return state_.view().word(field, item(x, y), component);
    }

  private:
    fluid::HostPtr host_;
    System system_;
    SystemState state_, next_;
};

/// A camera at the origin that looks along -z, fov 60 degrees, from 0.1 to 100 m.
inline Camera plain_camera() {
    return {.eye = {0.0F, 0.0F, 0.0F},
            .target = {0.0F, 0.0F, -1.0F},
            .fov_y = 60.0F,
            .near_plane = 0.1F,
            .far_plane = 100.0F};
}

/// Nothing but images of this size; the one particle is not seen.
inline fluid::Settings blank(int width, int height) {
    fluid::Settings s;
    s.particles = {{0.0F, 0.0F, 5.0F}};
    s.camera = plain_camera();
    s.width = width;
    s.height = height;
    s.radius = 0.01F;
    s.switches.scene_depth = fluid::SceneDepth::ignore;
    return s;
}

/// One sphere on the camera's axis, or beside it.
inline fluid::Settings sphere(float radius, int pixels, const glm::vec3& centre = {0.0F, 0.0F, -2.0F}) {
    fluid::Settings s = blank(pixels, pixels);
    s.particles = {centre};
    s.radius = radius;
    return s;
}

} // namespace lockstep::test
