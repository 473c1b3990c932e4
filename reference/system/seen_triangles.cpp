#include "reference/system/seen_triangles.hpp"

#include <cstring>
#include <optional>
#include <utility>

#include "reference/parallel_blocks.hpp"
#include "reference/subnormal_mode.hpp"
#include "reference/subnormals.hpp"
#include "reference/system/tile_rows.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep {
namespace {

/// A row of tiles.
template <class F> void see(const F& fp, const TriangleScene& scene, std::size_t tiles, SeenTriangles& seen) {
    using R = Lanes<F>;
    struct Row {
        IntLanes triangle;
        FloatLanes second, third, depth;
    };
    R reading(fp, every_lane);
    const DrawnTriangles<R> triangles(reading, scene);
    draw_rows(
        scene.boxes, scene.width, scene.height, tiles, in_their_order,
        [](const Pixel&) {
            return Row{lanes::all(-1), lanes::all(0.0F), lanes::all(0.0F), lanes::all(1.0F)};
        },
        [&](std::uint32_t i, const Pixel&, const auto& /*rows*/) {
            return std::optional(triangles.projected(static_cast<int>(i)));
        },
        [&](Row& row, const auto& triangle, const LanePixel& pixel, const LaneMask& inside) {
            triangles.offer(triangle, pixel, [&](const LaneMask& covered, const TriangleHit<R>& hit) {
                const IntLanes nearer = inside.v & covered.v & (hit.depth.v < row.depth);
                row.triangle = nearer ? lanes::all(hit.triangle) : row.triangle;
                row.second = nearer ? hit.second.v : row.second;
                row.third = nearer ? hit.third.v : row.third;
                row.depth = nearer ? hit.depth.v : row.depth;
            });
        },
        [&](const Row& row, const Pixel& place, int count) {
            const std::size_t at = item_of(place.x, place.y, scene.width), bytes = sizeof(float) * std::size_t(count);
            std::memcpy(seen.triangle.data() + at, &row.triangle, bytes);
            std::memcpy(seen.second.data() + at, &row.second, bytes);
            std::memcpy(seen.third.data() + at, &row.third, bytes);
            std::memcpy(seen.depth.data() + at, &row.depth, bytes);
        });
}

LOCKSTEP_VECTOR_CLONES void see_row(const PlainLanes& fp, const TriangleScene& scene, std::size_t tiles,
                                    SeenTriangles& seen) {
    see(fp, scene, tiles, seen);
}
LOCKSTEP_VECTOR_CLONES void see_row(const PortableLanes& fp, const TriangleScene& scene, std::size_t tiles,
                                    SeenTriangles& seen) {
    see(fp, scene, tiles, seen);
}

std::vector<std::byte> bytes_of(const View& view) {
    std::vector<std::byte> all;
    for (std::size_t f = 0; f < view.columns.size(); ++f) {
        const std::byte* column = view.columns[f];
        all.insert(all.end(), column,
                   column + view.count() * static_cast<std::size_t>(view.fields()[f].components) * sizeof(float));
    }
    return all;
}

} // namespace

TriangleView::TriangleView(const TriangleCamera& camera, const SystemView& state)
    : camera_(camera),
      boxes_(triangle_boxes({glm::dmat4(camera.to_clip), camera.width, camera.height}, state, camera.corners),
             camera.width, camera.height) {}

std::shared_ptr<const SeenTriangles> TriangleView::seen(const SystemView& state) const {
    const std::lock_guard lock(mutex_);
    const SubnormalMode mode = subnormal_mode();
    auto& found = by_mode_[(mode.flush_operands ? 2U : 0U) + (mode.flush_results ? 1U : 0U)];
    if (found == nullptr) {
        const std::size_t pixels = item_of(0, camera_.height, camera_.width) + lane_count;
        SeenTriangles seen{std::vector<std::int32_t>(pixels, -1), std::vector<float>(pixels),
                           std::vector<float>(pixels), std::vector<float>(pixels)};
        const TriangleScene scene{state, camera_.corners, camera_.to_clip, camera_.width, camera_.height, boxes_};
        parallel_blocks(static_cast<std::ptrdiff_t>(boxes_.rows()), [&](std::ptrdiff_t row) {
            const FlushSubnormals guard(mode.flush_operands, mode.flush_results);
            if (camera_.arithmetic == ArithmeticSwitch::exact)
                see_row(PortableLanes{}, scene, static_cast<std::size_t>(row), seen);
            else
                see_row(PlainLanes{}, scene, static_cast<std::size_t>(row), seen);
        });
        found = std::make_shared<const SeenTriangles>(std::move(seen));
    }
    return found;
}

std::shared_ptr<const TriangleView> LatestTriangles::of(const SystemView& state) const {
    const std::lock_guard lock(mutex_);
    std::vector<std::byte> corners = bytes_of(state[camera_.corners.resource]);
    if (view_ == nullptr || corners != corners_) {
        view_ = std::make_shared<const TriangleView>(camera_, state);
        corners_ = std::move(corners);
    }
    return view_;
}

} // namespace lockstep
