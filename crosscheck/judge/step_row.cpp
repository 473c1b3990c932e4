#include "crosscheck/judge/step_row.hpp"

#include <cmath>

#include "reference/model/ulp.hpp"

namespace lockstep {

std::int64_t StepRow::ulp() const {
    return reference.number && gpu.number ? ulp_distance(*reference.number, *gpu.number) : 0;
}

bool StepRow::has_nan() const {
    for (const Cell* cell : {&strict, &reference, &gpu})
        if (cell->number && std::isnan(*cell->number))
            return true;
    return false;
}

} // namespace lockstep
