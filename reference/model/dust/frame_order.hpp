#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "reference/model/dust/host.hpp"

namespace lockstep::dust {

/// A kernel by its shader's name; of those that explode, which ball of the frame it is for.
struct Kernel {
    std::string_view name;
    std::size_t ball = 0;
};

/// The kernels of a frame in their order: those that run in some frame.
std::vector<Kernel> frame_order(const Host& host);

/// Whether a kernel is dispatched in a frame.
bool runs(const Host& host, const Kernel& kernel, int frame);

} // namespace lockstep::dust
