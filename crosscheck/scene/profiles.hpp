#pragma once
#include <filesystem>
#include <string>

#include "gpu/probe.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What the reference has to do to follow a measured driver: the rows with `precise`, and what those without it found
/// beside (OtherOrders). Its name is `llvmpipe` or `nvidia` when it computes as
/// that one was measured to, whatever the driver calls itself, and `generic` otherwise. Errors are those measured.
/// Throws Error if a row of the probe is missing.
Profile profile_from(const ProbeResult& result);

/// Whether division, square root and normalize were found to be made of the driver's own 1/x and inversesqrt.
bool built_from_driver_roots(const ProbeResult& result);

/// Measures the current context (gpu/probe.hpp): the profile that matches it, for passes of `shaders`.
Profile measured_profile(const Context& context, const std::filesystem::path& shaders = {});

/// The same of what a probe of the current context found; measures the driver's tables where it has some.
Profile measured_profile(const ProbeResult& result, const std::filesystem::path& shaders = {});

/// `profile`, for passes of `shaders`: where their collision pass has no geometry stage, points are placed as the rows
/// without one say; where a fragment stage stores plain floats, the driver converts them.
Profile with_shaders(Profile profile, const ProbeResult& result, const std::filesystem::path& shaders);

/// `profile`, for stages of which one says `precise` of nothing: their sums may be taken in any order where the driver
/// fuses them. Where it does not, and none of them says it, the sums are those without it.
Profile without_precise(Profile profile, const ProbeResult& result, bool said_elsewhere = false);

} // namespace lockstep
