#include "crosscheck/judge/legal.hpp"

namespace lockstep {

KnownOperations known_operations(Legal legal, const Profile& profile) {
    return legal == Legal::measured ? measured_operations(profile)
                                    : KnownOperations{.sums = legal == Legal::glsl, .converts = profile.converts};
}

std::string legal_option_text(Legal legal) {
    if (legal == Legal::measured)
        return "";
    return legal == Legal::glsl ? " --legal glsl" : " --legal any_order";
}

} // namespace lockstep
