#include "reference/model/profile.hpp"

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

Profile named_profile(std::string_view name) {
    Profile profile;
    profile.name = name;
    if (name == "strict")
        return profile;
    if (name == "llvmpipe") {
        profile.dot = DotOrder::right_to_left;
        return profile;
    }
    if (name == "nvidia") {
        profile.dot = DotOrder::fused_chain;
        return profile;
    }
    throw Error(fmt::format("unknown profile '{}'; the profiles are strict, llvmpipe, nvidia", name));
}

} // namespace lockstep
