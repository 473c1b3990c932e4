#include "gpu/collision/particle_groups.hpp"

#include <array>

#include <fmt/format.h>

#include "gpu/gl.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

std::size_t group_size(const Program& program, std::size_t particles) {
    std::array<GLint, 3> size{};
    gl::GetProgramiv(program.id(), GL_COMPUTE_WORK_GROUP_SIZE, size.data());
    if (size[1] != 1 || size[2] != 1)
        throw Error(fmt::format("{}: local_size_y is {} and local_size_z {}; particles are counted along x, so both "
                                "must be 1",
                                program.name(), size[1], size[2]));
    const auto along = static_cast<std::size_t>(size[0]);
    GLint most = 0;
    gl::GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &most);
    if (particles > along * static_cast<std::size_t>(most))
        throw Error(fmt::format("{}: {} particles are more than {} groups of {}, which is what this context takes; a "
                                "larger local_size_x is needed",
                                program.name(), particles, most, along));
    return along;
}

void dispatch_particles(const Program& program, std::size_t particles, std::size_t group) {
    program.use();
    gl::DispatchCompute(static_cast<GLuint>((particles + group - 1) / group), 1, 1);
}

} // namespace lockstep
