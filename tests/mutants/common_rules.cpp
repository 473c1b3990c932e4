#include "tests/mutants/common_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "reference/model/collision/collision_state.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep::test {
namespace {

/// Whether `allows(reference, gpu)` holds for every float of two states. NaN is as NaN, and no number.
template <class Allows> bool every_float(const Particles& reference, const Particles& gpu, const Allows& allows) {
    const auto same = [&](float a, float b) {
        return std::isnan(a) || std::isnan(b) ? std::isnan(a) == std::isnan(b) : allows(a, b);
    };
    for (std::size_t i = 0; i < reference.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            if (!same(reference.position[i][c], gpu.position[i][c]) ||
                !same(reference.direction[i][c], gpu.direction[i][c]))
                return false;
        if (!same(reference.speed[i], gpu.speed[i]) || !same(reference.collide_time[i], gpu.collide_time[i]))
            return false;
    }
    return true;
}

template <int Exponent> bool within_absolute(const FinalState& reference, const FinalState& gpu) {
    const double most = std::pow(10.0, Exponent);
    return every_float(reference.particles, gpu.particles,
                       [&](float a, float b) { return std::abs(double{a} - double{b}) <= most; });
}

bool within_relative(const FinalState& reference, const FinalState& gpu) {
    return every_float(reference.particles, gpu.particles, [](float a, float b) {
        return std::abs(double{a} - double{b}) <= 1e-7 * std::max(std::abs(double{a}), std::abs(double{b}));
    });
}

bool within_rmse(const FinalState& reference, const FinalState& gpu) {
    double sum = 0.0;
    double count = 0.0;
    const bool same_nan = every_float(reference.particles, gpu.particles, [&](float a, float b) {
        sum += (double{a} - double{b}) * (double{a} - double{b});
        count += 1.0;
        return true;
    });
    return same_nan && std::sqrt(sum / std::max(count, 1.0)) <= 1e-5;
}

bool near(Rgba8 a, Rgba8 b) {
    const auto apart = [](std::uint8_t x, std::uint8_t y) { return std::abs(int{x} - int{y}); };
    return std::max({apart(a.r, b.r), apart(a.g, b.g), apart(a.b, b.b), apart(a.a, b.a)}) <= 4;
}

/// Pixels of `a` that no pixel of the 3 x 3 round the same place in `b` is near to.
std::size_t without_match(const ColorImage& a, const ColorImage& b) {
    std::size_t count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            bool matched = false;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, a.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, a.width - 1); ++u)
                    matched = matched || near(a.at(x, y), b.at(u, v));
            count += matched ? 0 : 1;
        }
    return count;
}

bool pictures_alike(const FinalState& reference, const FinalState& gpu) {
    const std::size_t bad =
        without_match(reference.picture, gpu.picture) + without_match(gpu.picture, reference.picture);
    return 1000 * bad <= reference.picture.texels.size();
}

bool same_hash(const FinalState& reference, const FinalState& gpu) {
    return state_hash(reference.particles, reference.cdt) == state_hash(gpu.particles, gpu.cdt);
}

} // namespace

const std::array<CommonRule, common_rule_count>& common_rules() {
    static const std::array<CommonRule, common_rule_count> rules{{
        {"abs 1e-3", "no float of a particle is off by more than 1e-3", within_absolute<-3>},
        {"abs 1e-5", "no float of a particle is off by more than 1e-5", within_absolute<-5>},
        {"rel 1e-7", "no float of a particle is off by more than 1e-7 of the larger of both", within_relative},
        {"RMSE 1e-5", "the root of the mean squared difference of all particles' floats is at most 1e-5", within_rmse},
        {"image",
         "in the rendered frames at most 1 pixel in 1,000 has no match within 4/255 in the 3 x 3 pixels round its "
         "place in the other",
         pictures_alike},
        {"hash", "the hashes of particles and CDT are equal", same_hash},
    }};
    return rules;
}

} // namespace lockstep::test
