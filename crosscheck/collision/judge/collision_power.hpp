#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "crosscheck/judge/power.hpp"
#include "crosscheck/judge/power_summary.hpp"
#include "reference/collision/deviating_pass.hpp"
#include "reference/collision/deviation.hpp"
#include "reference/collision/situations.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// A frame that the reference made, and what it started from.
struct PowerFrame {
    int number = 0;
    const FrameInputs& inputs; ///< its drawn_cdt the reference's
    const Particles& after;
};

/// Which of the named deviations (reference/deviation.hpp) a run of the listing's passes would have shown: each is made
/// on the run's own states, on particles that met something in the search and on others from everywhere; and drawn.
class CollisionPower {
  public:
    CollisionPower(const Scene& scene, const Profile& profile, const KnownOperations& known);

    void add(const PowerFrame& frame);

    /// To be concluded.
    [[nodiscard]] PowerSummary summary() const;

  private:
    struct Tried {
        bool is_mistake = true; ///< with the switches at hand
        bool changes = false;
        int first_frame = -1;
    };
    [[nodiscard]] std::vector<Deviation> unseen(bool of_drawing) const;
    void try_steps(const PowerFrame& frame, const Situations& found);
    void try_drawing(const PowerFrame& frame);
    [[nodiscard]] std::vector<std::string> reasons(Deviation deviation) const;

    const Scene& scene_;
    const Profile& profile_;
    KnownOperations known_;
    bool camera_moves_ = false;
    std::array<Tried, deviation_count> tried_;
    Situations met_;
};

/// Whether a deviation is what the switches, or the driver, do anyway.
bool is_no_mistake(Deviation deviation, const Switches& switches, const Profile& profile);

} // namespace lockstep
