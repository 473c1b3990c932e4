#pragma once
#include "crosscheck/collision/record/trace_reader.hpp"
#include "gpu/collision/gpu_side.hpp"

namespace lockstep {

/// A recorded run in the GPU's place: gives back, frame after frame, what was recorded.
class TraceSide : public GpuSide {
  public:
    /// `trace` outlives this.
    explicit TraceSide(TraceReader& trace) : trace_(trace) {}

    /// Back to the start, whatever the state is: what was recorded stays what it is.
    void upload(const Particles& particles, const CollisionImage& cdt) override;
    void step(const FrameParams& params) override;
    void read(Particles& particles) const override { trace_.read(frame_, particles); }
    void read(CollisionImage& cdt) const override { trace_.read(frame_, cdt); }
    [[nodiscard]] std::size_t present(int frame) const override;
    [[nodiscard]] bool has_cdt() const override { return trace_.info().has_cdt; }

  private:
    TraceReader& trace_;
    int frame_ = -1; ///< the last one
};

} // namespace lockstep
