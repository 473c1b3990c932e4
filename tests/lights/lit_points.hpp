#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "reference/lights/lighting_twin.hpp"
#include "reference/portable.hpp"
#include "tests/lights/lights_run.hpp"

namespace lockstep::test {

/// A state of the lights system on the reference alone, and what lighting makes of points in it.
class LitPoints {
  public:
    using Reading = Values<Portable>;
    using Texel = std::array<float, 8>; ///< (C, count) and (D, W)

    explicit LitPoints(lights::Settings settings)
        : host_(host_of(std::move(settings))), system_(lights::system(host_)), state_(system_.start) {}

    /// Runs a frame.
    LitPoints& step() {
        ReferenceRun run(system_, named_profile("strict"));
        run.step(0);
        state_ = run.state();
        return *this;
    }
    [[nodiscard]] const lights::Host& host() const { return *host_; }
    [[nodiscard]] SystemState& state() { return state_; }
    [[nodiscard]] SystemView view() const { return state_.view(); }

    void set(const glm::ivec3& v, const Texel& texel) {
        const std::size_t i = lights::Voxel{v.x, v.y, v.z}.index(host_->grid());
        for (int c = 0; c < 4; ++c) {
            state_.set(lights::field::voxel_colour, i, texel[static_cast<std::size_t>(c)], c);
            state_.set(lights::field::voxel_direction, i, texel[static_cast<std::size_t>(c) + 4], c);
        }
    }
    [[nodiscard]] Texel texel(const glm::ivec3& v) const {
        return texel(lights::Voxel{v.x, v.y, v.z}.index(host_->grid()));
    }
    [[nodiscard]] Texel texel(std::size_t i) const {
        const SystemView seen = state_.view();
        Texel found{};
        for (int c = 0; c < 4; ++c) {
            found[static_cast<std::size_t>(c)] = seen.real(lights::field::voxel_colour, i, c);
            found[static_cast<std::size_t>(c) + 4] = seen.real(lights::field::voxel_direction, i, c);
        }
        return found;
    }
    /// The mean of the samples around a place, in voxels.
    [[nodiscard]] Texel sampled(const glm::vec3& u) const {
        Reading r(Portable{});
        const SystemView seen = state_.view();
        const auto sample = lights::SamplingTwin<Reading>(r, *host_, seen).mean_at({u.x, u.y, u.z});
        Texel found{};
        std::transform(sample.begin(), sample.end(), found.begin(), [](auto x) { return static_cast<float>(x); });
        return found;
    }
    [[nodiscard]] glm::vec3 lit(const glm::vec3& p, const glm::vec3& n = {0.0F, 1.0F, 0.0F},
                                float albedo = 0.5F) const {
        Reading r(Portable{});
        lights::Surface<Reading> surface;
        surface.position = {p.x, p.y, p.z};
        surface.normal = {n.x, n.y, n.z};
        surface.albedo = {albedo, albedo, albedo};
        return floats(lights::radiance(r, *host_, state_.view(), surface));
    }
    /// What one light adds to a voxel; nothing where it does not reach it.
    [[nodiscard]] std::optional<lights::Contribution<Reading>> added(std::size_t light, const glm::ivec3& at) const {
        Reading r(Portable{});
        const lights::Voxel v{at.x, at.y, at.z};
        return lights::contribution(r, *host_, state_.view(), light, lights::voxel_point(r, *host_, v), v);
    }
    /// The integral of light without a grid, in double: sum of c w max(0, n.l), red.
    [[nodiscard]] double truth(const glm::dvec3& p, const glm::dvec3& n = {0.0, 1.0, 0.0}) const {
        double sum = 0.0;
        for (const lights::Light& light : host_->settings().lights) {
            const glm::dvec3 q = glm::dvec3(light.position) - p;
            const double s = q.x * q.x + q.y * q.y + q.z * q.z, r2 = double{light.range} * light.range;
            if (s > r2 || s == 0.0)
                continue;
            const double k = 1.0 - s / r2 * (s / r2);
            const double cosine = (n.x * q.x + n.y * q.y + n.z * q.z) / std::sqrt(s);
            sum += double{light.colour.x} * k * k / (s + 1.0) * std::max(0.0, cosine);
        }
        return sum;
    }

  private:
    lights::HostPtr host_;
    System system_;
    SystemState state_;
};

/// The light and the grid of the worked numbers.
inline lights::Settings one_light(int side = 16) {
    lights::Settings s;
    s.grid = {.size = glm::ivec3(side), .voxel = 1.0F, .origin = glm::vec3(0.0F)};
    s.lights = {{.position = {4.25F, 3.5F, 4.75F}}};
    s.switches.motion = lights::Motion::still;
    s.switches.glow = lights::OffOn::off;
    s.switches.supersample = lights::Supersample::one;
    s.ambient = glm::vec3(0.0F);
    add_surface(s, plane_surface(side, side), {0.5 * side, 1.5, 0.5 * side}, {128, 128, 128});
    s.camera = {.eye = {8.0F, 12.0F, 20.0F}, .target = {8.0F, 1.0F, 6.0F}, .near_plane = 0.5F, .far_plane = 60.0F};
    s.width = 16;
    s.height = 8;
    return s;
}

} // namespace lockstep::test
