#include "gpu/probe/rows.hpp"
#include "gpu/probe/vertex_stage.hpp"

namespace lockstep::probing {

void measure_order(Rows& rows) {
    constexpr std::size_t points = 65536;
    const VertexStage stage("probe/order", {}, {{"a_Index", 1}}, {{"out_Index", GL_FLOAT}}, true);
    Floats in_order(points);
    for (std::size_t i = 0; i < points; ++i)
        in_order[i] = static_cast<float>(i);
    rows.push_back(judge("transform feedback order", stage.run(points, {{"a_Index", 1, in_order.data()}}, "out_Index"),
                         {{"as drawn", in_order}}));
}

} // namespace lockstep::probing
