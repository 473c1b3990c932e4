#include "gpu/gl.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"

namespace lockstep::probing {

void measure_atomics(Rows& rows) {
    const bool offered = gl::has_extension("GL_NV_shader_atomic_float");
    rows.push_back(judge("image: float atomics", Floats{offered ? 1.0F : 0.0F},
                         {{"not offered", Floats{0.0F}}, {"offered", Floats{1.0F}}}));
}

} // namespace lockstep::probing
