#pragma once
#include <cstddef>
#include <cstdint>

#include "gpu/side_description.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// Whatever computes the frames that a check holds against the reference: GpuSimulation runs them on GL, a trace gives
/// back what was recorded, and an engine of one's own is another by deriving from this.
class GpuSide {
  public:
    GpuSide() = default;
    virtual ~GpuSide() = default;
    GpuSide(const GpuSide&) = delete;
    GpuSide& operator=(const GpuSide&) = delete;

    /// The state the next frame starts from.
    virtual void upload(const Particles& particles, const CollisionImage& cdt) = 0;

    /// One frame. Returns when it is done.
    virtual void step(const FrameParams& params) = 0;

    /// Announces the next step(), so that it can run while the caller works on what it has read. Here it does nothing.
    /// Until that step() only read() is called, for the state after the last one, or upload(), which calls it off.
    virtual void begin_step(const FrameParams& /*params*/) {}

    /// The state after the last frame; `cdt` as stored codes, row 0 at the bottom.
    virtual void read(Particles& particles) const = 0;
    virtual void read(CollisionImage& cdt) const = 0;

    /// Whether there is a CDT to compare. If not, read(cdt) is never called, and the reference draws the CDT of the
    /// particles that were read.
    [[nodiscard]] virtual bool has_cdt() const { return true; }

    /// How many particles there are in a frame, from the first on; what the others hold is nobody's before a frame in
    /// which they are there.
    [[nodiscard]] virtual std::size_t present(int /*frame*/) const { return SIZE_MAX; }

    [[nodiscard]] virtual SideDescription describe() const { return {}; }

    /// Whether a frame can be run twice from one state, to prove that it repeats itself. What follows is called only
    /// then.
    [[nodiscard]] virtual bool repeats() const { return false; }

    /// Fills what the next frame writes with a pattern that no step computes, and looks for it in what was read back:
    /// throws Error when a buffer or the image was not really written.
    virtual void lay_canary() {}
    virtual void find_canary(const Particles& /*particles*/, const CollisionImage& /*cdt*/, int /*frame*/) const {}

    /// The last frame once more, from the same state. A side that repeats() overrides this: here it throws Error.
    virtual void repeat_step(const FrameParams& params);

    /// Whether read() would give exactly these bits; here it reads them. One that can tell without a copy overrides it.
    [[nodiscard]] virtual bool holds(const Particles& particles) const;
};

} // namespace lockstep
