#include <cstdint>
#include <string>
#include <utility>

#include "gpu/gl.hpp"
#include "tests/dust/rooms.hpp"

namespace lockstep::test::barriers_test {

namespace dust = lockstep::dust;

namespace {

std::size_t barriers_left_out = 0;
bool leaves_out = false;
decltype(lockstep::gl::MemoryBarrier) right_barrier = nullptr;

void APIENTRY barrier_or_none(GLbitfield bits) {
    if (leaves_out)
        ++barriers_left_out;
    else
        right_barrier(bits);
}

/// The state after frames without a look at it, in which the host leaves out the barrier behind a kernel; "": behind
/// all.
std::uint64_t hash_without_barrier(const std::string& kernel, const dust::HostPtr& host) {
    const System system = dust::system(host);
    GlSystemSide side(lockstep::test::gl(), system, dust::passes(host), "shaders/dust", ArithmeticSwitch::exact);
    side.upload(system.start.view());
    right_barrier = std::exchange(lockstep::gl::MemoryBarrier, barrier_or_none);
    for (int frame = 0; frame < frames; ++frame)
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            leaves_out = kernel.empty() || system.passes[p]->name() == kernel;
            if (system.passes[p]->runs(frame) && !system.passes[p]->continues())
                side.step(p, frame);
        }
    lockstep::gl::MemoryBarrier = right_barrier;
    SystemState state = system.start;
    side.read(state);
    return state_hash(state);
}

} // namespace

TEST_CASE(
    "dust mutants: a barrier that the host leaves out is equivalent on llvmpipe, whose dispatches end one by one") {
    if (!lockstep::test::gl())
        return skip(lockstep::test::gl().missing());
    const dust::HostPtr host = host_of(in_exact(room(false)));
    const System system = dust::system(host);
    ReferenceRun reference(system, named_profile("strict"));
    for (int frame = 0; frame < frames; ++frame)
        reference.step(frame);
    const bool in_order = lockstep::test::gl().name().find("llvmpipe") != std::string::npos;
    for (const char* kernel : {"populate", "vacuum_up", "emit", "blow_wind", "explode", "update", ""}) {
        INFO(kernel);
        barriers_left_out = 0;
        const bool differs = hash_without_barrier(kernel, host) != reference.hash();
        CHECK(barriers_left_out > 0);
        if (in_order)
            CHECK_FALSE(differs);
    }
}

} // namespace lockstep::test::barriers_test
