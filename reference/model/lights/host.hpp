#pragma once
#include <memory>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "reference/model/lights/settings.hpp"

namespace lockstep::lights {

/// Whether twins follow the driver in what GL leaves open, in all of it or in how it filters textures in fixed point,
/// or take for legal all that it allows.
enum class Driver { followed, aligned_filter, open };

/// What the host hands the passes: made in double, rounded once. Immutable.
class Host {
  public:
    /// Throws Error as check() does.
    explicit Host(Settings settings, Driver driver = Driver::followed);

    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] const Switches& switches() const { return settings_.switches; }
    [[nodiscard]] Driver driver() const { return driver_; }
    [[nodiscard]] bool follows_driver() const { return driver_ == Driver::followed; }
    [[nodiscard]] const Grid& grid() const { return settings_.grid; }
    [[nodiscard]] float inv_voxel() const { return 1.0F / settings_.grid.voxel; }
    /// The grid's far corner, m.
    [[nodiscard]] glm::vec3 end() const {
        return settings_.grid.origin + glm::vec3(settings_.grid.size) * settings_.grid.voxel;
    }
    /// In a grid whose voxels' points are its corners or centres: where voxel 0 has its own, voxels.
    [[nodiscard]] float point_offset() const { return switches().voxel_point == VoxelPoint::centre ? 0.5F : 0.0F; }
    [[nodiscard]] int fixed_bits() const { return settings_.fixed_bits.value_or(most_bits_); }
    /// Cells to look at to each side of a voxel's own: the longest range, and one more.
    [[nodiscard]] int reach() const { return reach_; }
    [[nodiscard]] const glm::mat4& view_projection() const { return view_projection_; }
    /// View to clip space.
    [[nodiscard]] glm::mat4 projection() const { return projection_matrix(settings_.camera, aspect_); }
    [[nodiscard]] float disc_scale() const { return disc_scale_; } ///< of a glow: pixels times w, its radius

  private:
    Settings settings_;
    Driver driver_;
    int most_bits_ = 0, reach_ = 1;
    glm::mat4 view_projection_{1.0F};
    float aspect_ = 1.0F, disc_scale_ = 1.0F;
};

using HostPtr = std::shared_ptr<const Host>;

} // namespace lockstep::lights
