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

} // namespace lockstep
