#include "reference/collision/measured_codes.hpp"

#include <algorithm>
#include <cmath>

#include "reference/collision/collision_code.hpp"
#include "reference/paired_rows.hpp"
#include "reference/stored_half.hpp"

namespace lockstep {
namespace {

/// What a component may be stored as whose value may lie anywhere between two.
struct CodeRange {
    float low, high;
};

/// A shader may compute the place in the box as (x - low) * scale or as x * scale - low * scale: each product, sum and
/// quotient errs by an ULP, which is at most 2^-23 of it, and so does the driver's by 255. What is not a number is
/// code 0.
CodeRange stored_unorm8(float low, float high, float box_low, float size, bool nearest) {
    if (low != low || high != high)
        return {0.0F, 0.0F};
    const double scale = 255.0 / static_cast<double>(size);
    const auto place = [&](float x, double sign) {
        const double at = (static_cast<double>(x) - static_cast<double>(box_low)) * scale;
        const double magnitude = (std::abs(static_cast<double>(x)) + std::abs(static_cast<double>(box_low))) * scale;
        return at + sign * 0x1p-23 * (5.0 * magnitude + std::abs(at));
    };
    const double least = place(low, -1.0), most = place(high, 1.0);
    const auto code = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 255.0)); };
    if (nearest)
        return {code(std::ceil(least - 0.5)), code(std::floor(most + 0.5))};
    return {code(std::floor(least)), code(std::floor(most))};
}

} // namespace

std::pair<glm::vec4, glm::vec4> measured_codes(const FrameParams& params, glm::vec3 low, glm::vec3 high,
                                               const Profile& profile) {
    auto codes = CollisionCode(params).driver_codes(low, high);
    const bool halves = params.switches.cdt_format == CdtFormat::rgba16f;
    const OfPair measured = measured_of(profile, halves ? drawn_half_rows : drawn_unorm8_rows);
    if (params.switches.cdt_format == CdtFormat::rgba32f || measured == OfPair::open)
        return codes;
    const glm::vec3 size = params.cdt_box.max - params.cdt_box.min;
    for (int c = 0; c < 3; ++c) {
        const CodeRange stored =
            halves ? CodeRange{stored_half(low[c], measured), stored_half(high[c], measured)}
                   : stored_unorm8(low[c], high[c], params.cdt_box.min[c], size[c], measured == OfPair::first);
        codes.first[c] = stored.low;
        codes.second[c] = stored.high;
    }
    return codes;
}

} // namespace lockstep
