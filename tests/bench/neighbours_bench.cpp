// Exact neighbours of a million particles, uniformly random in the unit cube, each of them asked for: build included.
// The label is a hash of the answers: nanoflann gives ours where it computes in double. For a ratio on a busy machine:
//   lockstep_bench_neighbours --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "reference/collision/neighbours.hpp"
#include "tests/nanoflann_search.hpp"

namespace {

using namespace lockstep;

constexpr std::size_t particle_count = 1'000'000;

std::vector<glm::vec3> unit_cube() {
    std::mt19937 random(1);
    const auto coordinate = [&] { return static_cast<float>(random() >> 8U) * 0x1p-24F; };
    std::vector<glm::vec3> positions(particle_count);
    for (glm::vec3& p : positions)
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = coordinate();
    return positions;
}

float range_for(double mean_neighbours) {
    const double volume = mean_neighbours / static_cast<double>(particle_count);
    return static_cast<float>(std::cbrt(volume * 3.0 / (4.0 * std::numbers::pi)));
}

std::uint64_t answer_hash(const Neighbourhoods& answer) {
    std::uint64_t hash = 0;
    for (const Neighbourhood& n : answer.particle)
        for (const std::uint64_t word : {std::bit_cast<std::uint64_t>(n.squared_distance),
                                         std::uint64_t{n.count} << 32U | static_cast<std::uint32_t>(n.nearest)})
            hash = (hash ^ word) * 0x9e3779b97f4a7c15U;
    return hash;
}

template <Neighbourhoods search(std::span<const glm::vec3>, float)> void neighbours(benchmark::State& state) {
    static const std::vector<glm::vec3> positions = unit_cube();
    const float range = range_for(static_cast<double>(state.range(0)));
    Neighbourhoods answer;
    for (auto _ : state)
        benchmark::DoNotOptimize(answer = search(positions, range));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(particle_count));
    state.SetLabel(fmt::format("{:016x}", answer_hash(answer)));
}

BENCHMARK(neighbours<find_neighbourhoods>)->Name("lockstep")->ArgName("mean")->Arg(2)->Arg(8)->UseRealTime();
BENCHMARK(neighbours<test::nanoflann_neighbourhoods<double>>)
    ->Name("nanoflann_double")
    ->ArgName("mean")
    ->Arg(2)
    ->Arg(8)
    ->UseRealTime();
BENCHMARK(neighbours<test::nanoflann_neighbourhoods<float>>)
    ->Name("nanoflann_float")
    ->ArgName("mean")
    ->Arg(2)
    ->Arg(8)
    ->UseRealTime();

} // namespace

BENCHMARK_MAIN();
