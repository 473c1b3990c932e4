#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "reference/model/basis.hpp"
#include "reference/model/lifecycle/rates.hpp"
#include "reference/model/lifecycle/settings.hpp"

namespace lockstep::lifecycle {

/// A force as both sides get it, made in double and rounded once.
struct HostForce {
    Force::Kind kind = Force::Kind::drag;
    glm::vec3 centre{0.0F}; ///< of curl noise the offset in the frame
    glm::vec3 axis{0.0F};
    float strength = 0.0F;
    float radius = 1.0F; ///< of curl noise the frequency
    float falloff = 0.0F;
    float pull = 0.0F;    ///< of attraction the kill radius
    float square = -1.0F; ///< of attraction the softening squared; below 0: linear
    float drag = 0.0F;    ///< k, or the factor of a frame
    float seed = 0.0F;
};

/// Who may die in a frame: by age, none ever, or anyone.
enum class Dies { window, none, all };

/// What the host has of an emitter: its segment of the buffers, its clock and its inputs.
class HostEmitter {
  public:
    HostEmitter(const Settings& settings, std::size_t number);

    [[nodiscard]] const Emitter& settings() const { return settings_; }

    std::size_t number = 0;
    std::size_t base = 0, slots = 0;           ///< particles
    std::size_t first_block = 0, blocks = 0;   ///< sums of 1,024, and of 256 for a ribbon
    std::size_t first_in_ring = 0, window = 0; ///< W; 0 where it is not asked for
    std::size_t first_key = 0, keys = 0;       ///< of a ribbon that is sorted: a power of two
    Dies dies = Dies::window;
    bool kills = false;      ///< a force or graph of its may kill
    std::uint32_t seed = 0;  ///< of its random numbers
    Basis basis;             ///< of the direction
    float cone_depth = 0.0F; ///< 1 - cos of the angle

    /// How many particles are asked for in a frame.
    [[nodiscard]] std::uint32_t request(int frame) const;
    [[nodiscard]] std::uint32_t largest_request() const;
    /// Where the emitter is; before frame 0 where it is in frame 0.
    [[nodiscard]] glm::vec3 origin(int frame) const;
    [[nodiscard]] glm::vec3 origin_velocity(int frame) const; ///< since the frame before, units/s
    [[nodiscard]] std::vector<HostForce> forces(int frame) const;

  private:
    Emitter settings_;
    double tick_;
    Drag drag_;
    RateCounter rate_;
};

/// What the host does for a run, for both sides.
class Host {
  public:
    /// Throws Error as check(settings) does.
    explicit Host(Settings settings);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] const Switches& switches() const { return settings_.switches; }
    [[nodiscard]] const std::vector<HostEmitter>& emitters() const { return emitters_; }
    [[nodiscard]] std::size_t slots() const;
    [[nodiscard]] std::size_t blocks() const;
    [[nodiscard]] std::size_t ring() const;
    [[nodiscard]] std::size_t keys() const;
    /// Of particles there are lists, and none moves.
    [[nodiscard]] bool lists() const { return settings_.switches.management == Management::index_lists; }
    [[nodiscard]] float time(int frame) const;
    [[nodiscard]] float half_tick_squared() const { return (0.5F * settings_.tick) * settings_.tick; }
    /// Of box16: 65,535 / size and size / 65,535.
    [[nodiscard]] glm::vec3 box_scale() const;
    [[nodiscard]] glm::vec3 box_step() const;
    [[nodiscard]] bool has_ribbons() const;
    /// What a sprite is drawn as: the corners of its polygon, counterclockwise, or of its quad, as a strip; in shares
    /// of its side, from the lower left. None where no texel is to be seen.
    [[nodiscard]] const std::vector<glm::vec2>& sprite_corners() const { return sprite_corners_; }

  private:
    Settings settings_;
    std::vector<glm::vec2> sprite_corners_;
    std::vector<HostEmitter> emitters_;
};
using HostPtr = std::shared_ptr<const Host>;

/// Whether a pass that simulates counts: those that are killed, or whose places are clamped.
bool counts_in_simulation(const Host& host, const HostEmitter& of);

/// How many ticks the shortest-lived particle lives at least, as the layout stores its time: it may die that many
/// frames after its birth. Nothing: it never dies.
std::optional<std::size_t> dying_age(const Settings& settings, float shortest);

} // namespace lockstep::lifecycle
