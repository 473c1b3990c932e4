#include "crosscheck/lights/left_open.hpp"

#include <fmt/format.h>

#include "reference/lights/by_driver.hpp"

namespace lockstep::lights {

std::vector<std::string> left_open(const Switches& on, const Profile& profile) {
    std::vector<std::string> lines;
    const auto rests = [&](bool used, const char* value, const char* row, const char* legal, const char* portable) {
        if (used && !profile.follows(row))
            lines.push_back(
                fmt::format("{}: this driver is not followed in it (probe: {}), so legal is {}; {} promises "
                            "bits",
                            value, row, legal, portable));
    };
    const bool black = on.outside == Outside::black;
    rests(on.interpolation == Interpolation::trilinear_hw &&
              !profile.follows(black ? black_aligned_filter_row : aligned_filter_row),
          "interpolation=trilinear_hw", black ? black_filter_row : filter_row,
          "what places and weights of 8 fraction bits give", "interpolation=trilinear");
    const bool halves = on.volume_format == Format::rgba16f;
    rests(on.accumulate == Accumulate::blend && !halves, "accumulate=blend", float_blend_row,
          "what any order of the sums gives", "accumulate=gather");
    rests(blends(on.accumulate) && halves, "accumulate=blend of halves", half_blend_row,
          "either neighbour of every sum", "accumulate=gather");
    rests(on.glow == OffOn::on, "glow=on", float_blend_row, "what any order of the sums gives", "glow=off");
    rests(on.encoding == Encoding::srgb_hw, "encoding=srgb_hw", srgb_row, "either code next to the curve",
          "encoding=srgb_table");
    if (adds_floats(on.accumulate))
        lines.push_back(fmt::format("{}: floats are added in an order that nothing fixes, so legal is {}; "
                                    "accumulate=gather and fixed64 promise bits",
                                    on.accumulate == Accumulate::racing ? "accumulate=racing" : "float atomics",
                                    on.accumulate == Accumulate::racing ? "the sum of any of the lights, and so is none"
                                                                        : "what any order gives"));
    return lines;
}

} // namespace lockstep::lights
