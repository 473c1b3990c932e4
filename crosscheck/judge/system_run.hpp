#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "crosscheck/judge/system.hpp"

namespace lockstep {

class SystemSide;

/// Of all buffers and images.
std::uint64_t state_hash(const SystemState& state);

/// What the GPU's last pass told of an item, and what it wrote there.
std::vector<ToldValue> told_of(SystemSide& gpu, std::size_t pass, const JudgedPass& judged, std::size_t item);

/// The reference alone, from the start. Needs no GL.
class ReferenceRun {
  public:
    /// `system` outlives this. Throws Error as check() does for a system that cannot be run.
    ReferenceRun(const System& system, Profile profile);
    /// Frame `frame`; frames come in order, from 0.
    void step(int frame);
    /// One pass of it; passes come in order.
    void step_pass(std::size_t pass, int frame);
    [[nodiscard]] const SystemState& state() const { return state_; }
    /// Of all buffers and images.
    [[nodiscard]] std::uint64_t hash() const;

  private:
    const System& system_;
    std::vector<std::shared_ptr<const ItemPass>> passes_; ///< the system's, as images store what they make
    Profile profile_;
    SystemState state_, next_;
};

/// What a run of both sides came to in one pass of one frame, for a look into it.
class SystemRun {
  public:
    /// Before its first frame. `system` and `gpu` outlive this.
    SystemRun(const System& system, SystemSide& gpu, const KnownOperations& known);
    /// Runs to pass `pass` of frame `frame`.
    SystemRun(const System& system, SystemSide& gpu, const KnownOperations& known, int frame, std::size_t pass);

    /// Runs on to pass `pass` of frame `frame`; to one that lies behind again from the start. Throws Error where there
    /// is no such pass, or it does not run in that frame.
    /// `on_frame` is called with each frame that is begun.
    void go_to(int frame, std::size_t pass, const std::function<void(int frame)>& on_frame = {});

    [[nodiscard]] JudgedPass judged() const;
    [[nodiscard]] std::size_t pass() const { return pass_; }
    [[nodiscard]] const System& system() const { return system_; }
    [[nodiscard]] const Profile& profile() const { return profile_; }
    /// What the GPU's pass told of an item, where it can.
    [[nodiscard]] std::vector<ToldValue> told(std::size_t item);

  private:
    void start_again();
    void step(int frame, std::size_t pass);

    const System& system_;
    SystemSide& gpu_;
    std::vector<std::shared_ptr<const ItemPass>> passes_; ///< as in ReferenceRun
    Profile profile_;
    KnownOperations known_;
    int frame_ = -1; ///< -1: nothing has run
    std::size_t pass_ = 0;
    SystemState before_, reference_, now_;
    SystemState right_;            ///< of buffers that are derived
    std::set<std::uint8_t> wrong_; ///< which of them the GPU made otherwise
    struct Started {
        int frame = -1;
        SystemState state;
    };
    std::vector<Started> started_; ///< what each pass started from in the last two frames, as far as it was kept
    std::optional<SystemState> earlier_;
    SystemView before_view_, earlier_view_;
    View reference_view_, gpu_view_;
};

} // namespace lockstep
