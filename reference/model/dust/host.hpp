#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "reference/model/dust/settings.hpp"

namespace lockstep::dust {

/// A collider as both sides get it: made in double, rounded once. 35 floats in the shaders' buffers.
struct ColliderMatrices {
    glm::mat4 local_to_world{1.0F}, world_to_local{1.0F};
    glm::vec3 scale{1.0F}; ///< a sphere's is its diameter
};

/// In the order of the list that they are in.
struct Colliders {
    std::vector<ColliderMatrices> spheres, boxes;
};

/// The host's colliders: those of the settings that are there, or what is left of the last one that was removed.
Colliders colliders_of(const Settings& settings);

struct Explosion {
    int frame = 0;
    glm::vec3 position{0.0F};
    float sqr_range = 0.0F, force = 0.0F;
};

/// What the host hands the kernels in a frame.
struct FrameValues {
    int frame = 0;
    float dt = 0.0F, time = 0.0F;
    float tool_dt = 0.0F, wind_dt = 0.0F, explosion_dt = 0.0F; ///< seconds that an impulse lasts
    glm::vec3 controller_pos{0.0F}, controller_forward{0.0F, 0.0F, 1.0F};
    glm::mat4 controller_matrix{1.0F};
    const Tool* tool = nullptr; ///< the one that is on
    float sqr_force = 0.0F, sqr_range = 0.0F, threshold = 0.0F, sqr_death_range = 0.0F, angle_rad = 0.0F,
          tangent = 0.0F;
};

/// The host's part of a run: what depends on the frame alone. Immutable; any number of threads may ask at once.
class Host {
  public:
    /// Throws Error as check() does.
    explicit Host(Settings settings);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] const Switches& switches() const { return settings_.switches; }
    [[nodiscard]] float radius() const { return settings_.scale * settings_.switches.radius_of_scale; }
    [[nodiscard]] FrameValues at(int frame) const;

    [[nodiscard]] bool is_on(Tool::Kind kind, int frame) const;
    /// The frame whose vacuum pulls, or last pulled, what Update moves in `frame`; -1: none.
    [[nodiscard]] int pulled_in(int frame) const;
    /// Whether Update asks who dies in the mouth, be it alone or again: in some frame, and in `frame`.
    [[nodiscard]] bool update_may_kill() const;
    [[nodiscard]] bool update_kills(int frame) const;
    /// Whether the tool's kernel has something to do in any frame.
    [[nodiscard]] bool has(Tool::Kind kind) const;
    [[nodiscard]] bool has_update() const { return switches().suction >= Suction::force_in_update; }
    [[nodiscard]] bool has_vacuum_kernel() const { return switches().suction != Suction::force_in_update; }

    /// The `ball`-th explosion of a frame, in the order in which the balls were shot.
    [[nodiscard]] const Explosion* explosion(int frame, std::size_t ball) const;
    /// The most explosions that a frame has.
    [[nodiscard]] std::size_t most_explosions() const;

    [[nodiscard]] const Colliders& colliders() const { return colliders_; }
    [[nodiscard]] const std::vector<ColliderMatrices>& spheres() const { return colliders_.spheres; }
    [[nodiscard]] const std::vector<ColliderMatrices>& boxes() const { return colliders_.boxes; }
    /// 4,096 directions, evenly round the circle: cosine and sine.
    [[nodiscard]] const std::vector<glm::vec2>& directions() const { return directions_; }

  private:
    [[nodiscard]] const Tool* tool_at(int frame) const;
    [[nodiscard]] std::optional<Explosion> fly(const Ball& ball) const;
    Settings settings_;
    Colliders colliders_;
    std::vector<Explosion> explosions_;
    std::vector<glm::vec2> directions_;
};

using HostPtr = std::shared_ptr<const Host>;

} // namespace lockstep::dust
