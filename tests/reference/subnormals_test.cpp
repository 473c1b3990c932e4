#include <catch2/catch.hpp>

#include <limits>
#include <vector>

#include <omp.h>

#include "reference/collision/obstacle_pass.hpp"
#include "reference/subnormals.hpp"

namespace lockstep::test::subnormals_test {

namespace {

volatile float smallest_normal = std::numeric_limits<float>::min();
volatile float subnormal = 1e-40F;
volatile float big = 0x1p60F;

} // namespace

TEST_CASE("subnormals: operands and results are zero while the guard lives, and kept before and after") {
    CHECK(smallest_normal * 0.5F > 0.0F);
    // Computed under the guard, and looked at without it: under it a subnormal equals 0.
    volatile float result, operand, normal;
    volatile bool negative;
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

TEST_CASE("subnormals: one guard inside another says what holds, and restores the outer") {
    const FlushSubnormals keep(false);
    CHECK(subnormal * big > 0.0F);
    volatile float inside, after;
    {
        const FlushSubnormals outer(true);
        {
            const FlushSubnormals inner(false);
            inside = subnormal * big;
        }
        after = subnormal * big;
    }
    CHECK(inside > 0.0F);
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

TEST_CASE("subnormals: threads that start while obstacles are drawn keep them afterwards") {
    Mesh triangle{{{-1.0F, -1.0F, 0.0F}, {1.0F, -1.0F, 0.0F}, {0.0F, 1.0F, 0.0F}}, {0, 1, 2}};
    FrameParams params;
    params.width = params.height = 64;
    CollisionImage cdt(64, 64);
    DepthImage depth(64, 64, 1.0F);
    constexpr int threads = 9; // more than any test before this one had
    const int usual = omp_get_max_threads();
    omp_set_num_threads(threads);
    obstacle_pass(triangle, params, Profile{}, cdt, depth);
    std::vector<float> products(threads, -1.0F);
#pragma omp parallel num_threads(threads)
    products[static_cast<std::size_t>(omp_get_thread_num())] = subnormal * big;
    omp_set_num_threads(usual);
    for (const float product : products)
        CHECK(product > 0.0F);
}

} // namespace lockstep::test::subnormals_test
