#include <catch2/catch.hpp>

#include <limits>
#include <vector>

#include <omp.h>

#include "reference/subnormals.hpp"

using namespace lockstep;

namespace {

volatile float smallest_normal = std::numeric_limits<float>::min();
volatile float subnormal = 1e-40F;
volatile float big = 0x1p60F;

} // namespace

TEST_CASE("subnormals: operands and results are zero while the guard lives, and kept before and after") {
    CHECK(smallest_normal * 0.5F > 0.0F);
    float result, operand, normal; // looked at without the guard, under which a subnormal equals 0
    bool negative;
    {
        const FlushSubnormals guard(true);
        result = smallest_normal * 0.5F;
        operand = subnormal * big;
        normal = smallest_normal * 1.5F;
        negative = -subnormal < 0.0F;
    }
    CHECK(result == 0.0F);
    CHECK(operand == 0.0F);
    CHECK(normal > smallest_normal);
    CHECK_FALSE(negative);
    CHECK(smallest_normal * 0.5F > 0.0F);
    CHECK(subnormal * big > 0.0F);
}

TEST_CASE("subnormals: a guard told not to flush keeps them, one inside another restores the outer") {
    const FlushSubnormals keep(false);
    CHECK(subnormal * big > 0.0F);
    const FlushSubnormals outer(true);
    {
        const FlushSubnormals inner(false);
        const float still = subnormal * big;
        CHECK(still == 0.0F);
    }
    const float after = subnormal * big;
    CHECK(after == 0.0F);
}

TEST_CASE("subnormals: a guard holds for its own thread only") {
    std::vector<float> guarded(4, -1.0F), open(4, -1.0F);
#pragma omp parallel num_threads(4)
    {
        const auto thread = static_cast<std::size_t>(omp_get_thread_num());
        const FlushSubnormals guard(thread % 2 == 0);
        const float product = subnormal * big;
        (thread % 2 == 0 ? guarded : open)[thread] = product;
    }
    for (std::size_t thread = 0; thread < 4; ++thread) {
        INFO("thread " << thread);
        if (thread % 2 == 0)
            CHECK(guarded[thread] == 0.0F);
        else
            CHECK(open[thread] > 0.0F);
    }
}
