#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "reference/lights/contribution.hpp"
#include "reference/lights/made_on_asking.hpp"
#include "reference/model/lights/host.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep::lights {

/// The order in which a voxel meets the lights that reach it, non-finite ones left out: by index; by cell, cells z, y,
/// x ascending, then by index (gather); or cells descending, then by index (blending, whose instances are the offsets
/// from a light's cell, ascending).
std::vector<std::uint32_t> light_order(const Host& host, const SystemView& state);

/// What a light's place among the cells is; and what it is by mistake: y and z are taken for each other, the cell is
/// that of the nearest corner.
enum class CellBy : std::uint8_t { place, y_first, nearest_corner };

/// By clamped cell, ascending, then by index: what the pass light_sort_pass makes.
std::vector<std::uint32_t> by_cell(const Host& host, const SystemView& state, CellBy by = CellBy::place);

/// The lights by cell, how many each cell has, and where they begin.
struct CellLists {
    std::vector<std::uint32_t> order, counts, starts;
};
CellLists cell_lists(const Host& host, const SystemView& state, CellBy by);

class SortedCells {
  public:
    [[nodiscard]] const CellLists& of(CellBy by, const Host& host, const SystemView& state) const {
        return by_place_.of(static_cast<std::size_t>(by), [&] { return cell_lists(host, state, by); });
    }

  private:
    MadeOnAsking<CellLists, 3> by_place_;
};
CellBy sorted_by(std::span<const Mistake> made);

/// The voxels at which the shader tries a light, of the grid or beside it, and the light's cell.
struct TriedVoxels {
    VoxelBox box;
    Voxel cell;
};

/// Fewer of them or others, by mistake: the parts of Change::handed_over.
enum class WronglyTried {
    two_short,
    two_late,
    own_column,
    next_rows,
    next_layers,
    next_cells,
    lower_half,
    upper_half,
    own_layer,
    last_layer,          ///< the grid's last voxels along z
    last_layer_of_cells, ///< the lights of its last cells along z
    last_cells_of_rows,  ///< the same along x
    from_world_origin    ///< where they would be if the grid began there
};

/// The voxels of each light of an order: around its cell (gather, blending) or its ball.
class TriedLights {
  public:
    TriedLights() = default;
    TriedLights(const Host& host, const SystemView& state, const std::vector<std::uint32_t>& order);
    /// The row of cells of a light.
    [[nodiscard]] int row(std::size_t k) const {
        const Voxel& cell = (*voxels_)[k].cell;
        return cell.z * grid_.y + cell.y;
    }
    [[nodiscard]] TriedLights mistaken(std::span<const Mistake> made) const;

    /// Calls `visit` with the place in the order of each light that is tried at the voxel, of those in `range`.
    template <class Range, class Visit> void for_each(const Range& range, const Voxel& v, const Visit& visit) const {
        const std::span<const std::uint32_t> near = near_to(v);
        const auto visit_one = [&](std::uint32_t k) {
            const int from_first = static_cast<int>(k) - range.first, to_last = range.last - static_cast<int>(k);
            const bool between = range.step > 0 ? from_first >= 0 && to_last >= 0 : from_first <= 0 && to_last <= 0;
            if (between && from_first % range.step == 0 && (*voxels_)[k].box.has(v))
                visit(k);
        };
        if (range.step > 0)
            std::for_each(near.begin(), near.end(), visit_one);
        else
            std::for_each(near.rbegin(), near.rend(), visit_one);
    }

  private:
    /// Lights by blocks of voxels that they are tried at.
    struct Blocks {
        glm::ivec3 count{0};
        std::vector<std::size_t> starts; ///< of each block in `lights`, and the end
        std::vector<std::uint32_t> lights;
    };
    struct MadeOnce {
        std::once_flag once, moved_once;
        Blocks blocks;
        std::unique_ptr<const TriedLights> moved; ///< from the world's origin
    };
    [[nodiscard]] const Blocks& made_blocks() const;
    [[nodiscard]] const TriedLights& moved() const;
    /// All that may be tried at a voxel of the grid, ascending.
    [[nodiscard]] std::span<const std::uint32_t> near_to(const Voxel& v) const;
    [[nodiscard]] Blocks blocks() const;

    glm::ivec3 grid_{0}, origin_{0}; ///< voxels
    std::shared_ptr<const std::vector<TriedVoxels>> voxels_;
    std::shared_ptr<MadeOnce> made_once_; ///< before any mistake
};

} // namespace lockstep::lights
