#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "reference/model/lights/host.hpp"
#include "reference/model/system_state.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/readings/values.hpp"

namespace lockstep::lights {

/// What a light adds to voxels of a row along x: contribution() of each, on vectors, in the same bits. Of readings that
/// compute; with the switch `influence` radius.
template <class R> class LightRow {
  public:
    using Real = typename R::Real;
    /// More than the longest range reaches (settings.cpp), and one to each side.
    static constexpr std::size_t most = 40;

    LightRow(const R& r, const Host& host);

    /// From here on of this light.
    void take(const SystemView& state, std::size_t light);
    /// Voxels first to last of row y, z. Whether any of them may be reached.
    bool fill(int first, int last, int y, int z);

    [[nodiscard]] bool reaches(std::size_t i) const { return squared_[i] <= range2_; }
    [[nodiscard]] typename R::Vec3 colour(std::size_t i) const { return {colour_[0][i], colour_[1][i], colour_[2][i]}; }
    [[nodiscard]] typename R::Vec3 direction(std::size_t i) const { return {way_[0][i], way_[1][i], way_[2][i]}; }
    [[nodiscard]] Real weight(std::size_t i) const { return weight_[i]; }

  private:
    using Row = std::array<Real, most>;
    void attenuate(std::size_t count);
    void direct(std::size_t count);

    R r_;
    Switches on_;
    std::array<std::vector<Real>, 3> point_; ///< of voxels, along each axis
    std::array<Real, 3> light_{}, light_colour_{};
    Real range2_{}, inv_range2_{};
    Row squared_{}, weight_{};
    std::array<Row, 3> colour_{}, way_{};
};

extern template class LightRow<Values<PlainArithmetic>>;
extern template class LightRow<Values<Portable>>;

} // namespace lockstep::lights
