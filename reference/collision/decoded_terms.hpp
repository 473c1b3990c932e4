#pragma once
#include <array>

#include "reference/legal_arithmetic.hpp"
#include "reference/model/collision/scene.hpp"

namespace lockstep {

/// The terms whose sum a texel of an rgba8 CDT decodes to, in sets: the box's low corner, and the code times the step.
template <class A> std::array<Interval3, 2> decoded_terms(const LegalArithmetic<A>& arithmetic, glm::vec4 stored,
                                                          const FrameParams& params) {
    const glm::vec3 step = (params.cdt_box.max - params.cdt_box.min) / 255.0F;
    std::array<Interval3, 2> terms;
    for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        terms[0][k] = arithmetic.read(params.cdt_box.min[c]);
        terms[1][k] = arithmetic.product(arithmetic.read(stored[c]), arithmetic.read(step[c]));
    }
    return terms;
}

} // namespace lockstep
