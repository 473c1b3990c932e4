#include "reference/readings/exact_floats.hpp"

#include <string>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Constant-initialised: there before any source notes itself.
constinit std::string_view fused_source;

} // namespace

bool note_roundings(float fused_is_zero, std::string_view source) {
    if (fused_is_zero != 0.0F)
        fused_source = source;
    return fused_is_zero == 0.0F;
}

void require_two_roundings() {
    if (!fused_source.empty())
        throw Error(std::string(fused_source) +
                    ": compiled so that a * b + c rounds once; a twin needs -ffp-contract=off");
}

} // namespace lockstep
