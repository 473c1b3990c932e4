#include "crosscheck/collision/record/trace_side.hpp"

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

void TraceSide::upload(const Particles& /*particles*/, const CollisionImage& /*cdt*/) { frame_ = -1; }

void TraceSide::step(const FrameParams& /*params*/) {
    if (frame_ + 1 >= trace_.info().frames)
        throw Error(fmt::format("{}: holds {} frames, and no more", trace_.info().file, trace_.info().frames));
    ++frame_;
}

std::size_t TraceSide::present(int frame) const {
    const std::vector<std::uint32_t>& counts = trace_.info().counts;
    return counts.empty() ? GpuSide::present(frame) : counts.at(static_cast<std::size_t>(frame));
}

} // namespace lockstep
