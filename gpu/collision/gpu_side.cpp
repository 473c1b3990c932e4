#include "gpu/collision/gpu_side.hpp"

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {

void GpuSide::repeat_step(const FrameParams& /*params*/) {
    throw Error(fmt::format("{}: says that it repeats a frame, but has no repeat_step", describe().name));
}

bool GpuSide::holds(const Particles& particles) const {
    Particles now;
    read(now);
    if (now.size() != particles.size() || now.direction.size() != particles.size() ||
        now.speed.size() != particles.size() || now.collide_time.size() != particles.size())
        return false;
    for (std::size_t i = 0; i < now.size(); ++i)
        if (!same_bits(now[i], particles[i]))
            return false;
    return true;
}

} // namespace lockstep
