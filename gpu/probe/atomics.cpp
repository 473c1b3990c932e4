#include <cstddef>

#include "gpu/probe/compute_stage.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"

namespace lockstep::probing {

void measure_atomics(Rows& rows) {
    const bool offered = gl::has_extension("GL_NV_shader_atomic_float");
    rows.push_back(judge("image: float atomics", Floats{offered ? 1.0F : 0.0F},
                         {{"not offered", Floats{0.0F}}, {"offered", Floats{1.0F}}}));
    constexpr std::size_t words = 64, addends = 16384;
    const Floats given = random_floats(addends, 95, {-6, 3, true});
    Floats in_order(words), backwards(words);
    for (std::size_t i = 0; i < addends; ++i) {
        in_order[i % words] += given[i];
        backwards[(addends - 1 - i) % words] += given[addends - 1 - i];
    }
    rows.push_back(judge("image: compare-and-swap, order", ComputeStage("probe/swap").run(given, words, addends),
                         {{"by invocation", in_order}, {"backwards", backwards}}));
}

} // namespace lockstep::probing
