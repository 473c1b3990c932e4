#include "tests/collision/deviating_step.hpp"

#include <bit>
#include <cstdint>
#include <vector>

#include "reference/collision/collision_mistakes.hpp"
#include "reference/collision/step_pass.hpp"

namespace lockstep::test {

ParticleState mistaken_step(const FrameInputs& inputs, std::size_t i, const Profile& profile,
                            std::span<const Mistake> mistakes) {
    const Mesh no_obstacles;
    const StepInputs step{*inputs.before, *inputs.cdt, no_obstacles, *inputs.params, &inputs};
    const SystemView before = step_state(step);
    const std::vector<std::uint32_t> w = step_pass(step)->mistaken({before, 0}, i, profile, mistakes);
    const auto real = [&](std::size_t at) { return std::bit_cast<float>(w[at]); };
    return {{real(0), real(1), real(2)}, {real(3), real(4), real(5)}, real(6), real(7)};
}

ParticleState deviating_step(const FrameInputs& inputs, std::size_t i, const Profile& profile,
                             const Deviations& deviations) {
    return mistaken_step(inputs, i, profile, mistakes_of(deviations, inputs.params->switches));
}

} // namespace lockstep::test
