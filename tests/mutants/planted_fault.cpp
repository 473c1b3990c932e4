#include "tests/mutants/planted_fault.hpp"

#include <bit>
#include <cstdint>

#include "gpu/collision/particle_buffer.hpp"
#include "gpu/gl.hpp"

namespace lockstep::test {
namespace {

/// GL functions take no context of ours.
struct State {
    Fault fault;
    int repeated_frames = 0;
    int runs = 0; ///< of the collision pass
    float before = 0.0F;
    float after = 0.0F;
    decltype(gl::EndTransformFeedback) real = nullptr;
};
State state;

int frame_of_run(int run) { return run < 2 * state.repeated_frames ? run / 2 : run - state.repeated_frames; }

float changed(float value, int ulps) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return std::bit_cast<float>(ulps == 0 ? bits ^ 0x80000000U : bits + static_cast<std::uint32_t>(ulps));
}

void end_and_plant() {
    state.real();
    if (frame_of_run(state.runs++) != state.fault.frame)
        return;
    const auto offset = static_cast<GLintptr>(state.fault.particle * particle_records().bytes() +
                                              static_cast<std::size_t>(state.fault.component) * sizeof(float));
    gl::GetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, offset, sizeof(float), &state.before);
    state.after = changed(state.before, state.fault.ulps);
    gl::BufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, offset, sizeof(float), &state.after);
}

} // namespace

PlantedFault::PlantedFault(const Fault& fault, int repeated_frames) {
    state = {fault, repeated_frames, 0, 0.0F, 0.0F, gl::EndTransformFeedback};
    gl::EndTransformFeedback = end_and_plant;
}

PlantedFault::~PlantedFault() { gl::EndTransformFeedback = state.real; }

float PlantedFault::before() const { return state.before; }

float PlantedFault::after() const { return state.after; }

} // namespace lockstep::test
