#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/judge/verdict.hpp"
#include "crosscheck/judge/compare.hpp"
#include "reference/collision/simulation.hpp"

namespace lockstep {

/// The difference of every frame, in both modes: the mode that is not the check's own is run beside it, from the first
/// difference on.
class DifferenceSeries {
  public:
    DifferenceSeries(const Scene& scene, Profile profile, CheckMode mode);

    /// `before`: the GPU's state that the frame started from.
    void add(const ComparedFrame& frame, const Particles& before, const CollisionImage& cdt_before,
             const FrameParams& params);

    /// Columns. At most `most_points` of them: more frames share one, which has the largest of each number.
    [[nodiscard]] nlohmann::json json() const;
    static constexpr std::size_t most_points = 4096;

  private:
    struct Amount {
        std::uint64_t particles = 0;
        std::uint64_t texels = 0;
        std::int64_t worst_ulp = 0; ///< of the particles and texels; INT64_MAX: NaN against a number
    };
    struct Point {
        int frame = 0; ///< the first it stands for
        Amount own, other;
        std::array<std::uint64_t, class_names.size()> particles{}, texels{}; ///< by class
    };
    static Amount amount(const Comparison& comparison);
    static void merge(Amount& a, const Amount& b);
    void append(const Point& point);

    CheckMode mode_;
    ReferenceSimulation other_;
    bool differed_ = false;
    int stride_ = 1; ///< frames a point
    std::vector<Point> points_;
};

} // namespace lockstep
