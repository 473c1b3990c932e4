#pragma once
#include "gpu/gl.hpp"
#include "tests/gpu/any_context.hpp"

namespace lockstep::test {

/// Whether the software GL's shaders can read a clock, and so be made nondeterministic; if not, the test is skipped.
inline bool offers_shader_clock() {
    const auto context = open_context(software_gl());
    if (!context || gl::offers(9, 9, "GL_ARB_shader_clock"))
        return context.has_value();
    skip("no GL_ARB_shader_clock to make a shader nondeterministic with");
    return false;
}

} // namespace lockstep::test
