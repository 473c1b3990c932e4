#pragma once
#include <array>
#include <string_view>

#include "reference/model/collision/particles.hpp"
#include "reference/model/image.hpp"

namespace lockstep::test {

/// What is left of one side after a run: its particles, its CDT, and the frame rendered of the particles.
struct FinalState {
    Particles particles;
    CollisionImage cdt;
    ColorImage picture;
};

/// How others decide whether a GPU computes as a CPU does: both run by themselves from the same start, and what they
/// end with is compared once.
struct CommonRule {
    std::string_view name;
    std::string_view meaning;
    bool (*accepts)(const FinalState& reference, const FinalState& gpu);
};

inline constexpr std::size_t common_rule_count = 6;

const std::array<CommonRule, common_rule_count>& common_rules();

} // namespace lockstep::test
