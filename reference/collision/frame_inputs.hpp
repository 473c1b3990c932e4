#pragma once
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// What a frame starts from, and what a host that mixes up its buffers may take instead. Pointers may be null where
/// there is nothing (before the first frame): a deviation that needs it then changes nothing.
struct FrameInputs {
    const Particles* before = nullptr;
    const CollisionImage* cdt = nullptr;
    const FrameParams* params = nullptr;
    const Particles* earlier = nullptr;          ///< before the frame before
    const CollisionImage* earlier_cdt = nullptr; ///< read by the frame before
    const FrameParams* earlier_params = nullptr;
    const CollisionImage* drawn_cdt = nullptr; ///< drawn by this frame
};

} // namespace lockstep
