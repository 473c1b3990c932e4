#include "crosscheck/judge/legal.hpp"

namespace lockstep {

KnownOperations known_operations(Legal legal, const Profile& profile) {
    return legal == Legal::measured || legal == Legal::by_text
               ? measured_operations(profile)
               : KnownOperations{.sums = legal == Legal::glsl, .converts = profile.converts};
}

std::string legal_option_text(Legal legal) {
    switch (legal) {
    case Legal::measured:
        return " --legal measured";
    case Legal::glsl:
        return " --legal glsl";
    case Legal::any_order:
        return " --legal any_order";
    case Legal::by_text:
        break;
    }
    return "";
}

} // namespace lockstep
