#pragma once
#include <vector>

#include "reference/text/program.hpp"

namespace lockstep::text {

/// Whether some step of a text reads a block or image, and whether one writes it. An atomic operation does both.
struct Access {
    bool is_read = false, is_written = false;
};

/// Of each block and each image of a program.
struct Accesses {
    std::vector<Access> blocks, images;
};

/// By the text alone: a step that never runs counts. Of an image that is chosen while it runs all count.
Accesses accesses_of(const Program& program);

} // namespace lockstep::text
