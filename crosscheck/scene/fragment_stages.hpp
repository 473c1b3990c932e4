#pragma once
#include <filesystem>
#include <string_view>

#include "gpu/probe.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What the fragment stage of a pass of `shaders` leaves to the driver, by its text.
struct FragmentStage {
    bool encodes = true;       ///< it calls the encoder (collision_code.glsl), which leaves no rounding open
    bool packs = false;        ///< it calls packHalf2x16 or its kind, whose rounding GL leaves open
    bool interpolates = false; ///< it reads floats that the driver interpolates
};
FragmentStage fragment_stage(const std::filesystem::path& shaders, std::string_view pass);

/// `profile`, for a run of `scene` with `shaders`: a fragment stage that was found to round to the CDT's format itself
/// leaves the driver nothing to convert. It is drawn once into floats to see that; a context is current.
Profile with_written_codes(Profile profile, const Scene& scene, const std::filesystem::path& shaders);

/// measured_profile (profiles.hpp) for a run of `scene`.
Profile measured_profile(const Context& context, const Scene& scene, const std::filesystem::path& shaders);

} // namespace lockstep
