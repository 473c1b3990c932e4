#pragma once
#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include <glm/mat4x4.hpp>

#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/system_state.hpp"
#include "reference/system/drawn_triangles.hpp"
#include "reference/system/pixel_boxes.hpp"

namespace lockstep {

/// A camera before which triangles are drawn.
struct TriangleCamera {
    FieldId corners; ///< vec3, m, three items a triangle
    glm::mat4 to_clip{1.0F};
    int width = 1, height = 1;
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain; ///< plain: of drivers without tables of roots
};

/// What drawing the triangles of a state shows, for all images that are drawn of them. Any number of threads may ask.
class TriangleView {
  public:
    TriangleView(const TriangleCamera& camera, const SystemView& state);
    [[nodiscard]] const BoxesByTile& boxes() const { return boxes_; }
    /// As this thread treats subnormals; found when it is first asked for. `state` has the triangles that the view is
    /// of.
    [[nodiscard]] std::shared_ptr<const SeenTriangles> seen(const SystemView& state) const;

  private:
    TriangleCamera camera_;
    BoxesByTile boxes_;
    mutable std::mutex mutex_;
    mutable std::array<std::shared_ptr<const SeenTriangles>, 4> by_mode_;
};

/// The view of the latest triangles, which is made again where these are others. Any number of threads may ask.
class LatestTriangles {
  public:
    explicit LatestTriangles(const TriangleCamera& camera) : camera_(camera) {}
    [[nodiscard]] std::shared_ptr<const TriangleView> of(const SystemView& state) const;

  private:
    TriangleCamera camera_;
    mutable std::mutex mutex_;
    mutable std::vector<std::byte> corners_;
    mutable std::shared_ptr<const TriangleView> view_;
};

} // namespace lockstep
