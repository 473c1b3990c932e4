#pragma once
#include <memory>
#include <string>
#include <utility>

#include "reference/model/lights/host.hpp"
#include "reference/system/pass_by_driver.hpp"

namespace lockstep::lights {

// Rows of the probe on which values of switches rest.
inline constexpr const char* const filter_row = "image: linear filter";
inline constexpr const char* const black_filter_row = "image: linear filter, border of 0";
inline constexpr const char* const aligned_filter_row = "image: linear filter, aligned";
inline constexpr const char* const black_aligned_filter_row = "image: linear filter, aligned, border of 0";
inline constexpr const char* const float_blend_row = "image: blend rgba32f";
inline constexpr const char* const half_blend_row = "image: blend rgba16f";
inline constexpr const char* const srgb_row = "image: sRGB store";

/// A pass that rests on the probe's row: `made(host)` by a host that follows the driver, and by one that does not.
template <class Made> std::unique_ptr<ItemPass> by_driver(const char* row, const HostPtr& host, const Made& made) {
    const auto open = std::make_shared<const Host>(host->settings(), Driver::open);
    return std::make_unique<PassByDriver>(row, made(host), made(open));
}

/// The same of a pass that filters textures, which knows two ways of it.
template <class Made> std::unique_ptr<ItemPass> by_filter(const HostPtr& host, const Made& made) {
    const bool black = host->switches().outside == Outside::black;
    const auto with = [&](Driver driver) { return made(std::make_shared<const Host>(host->settings(), driver)); };
    return std::make_unique<PassByDriver>(
        black ? black_filter_row : filter_row, made(host),
        std::make_unique<PassByDriver>(black ? black_aligned_filter_row : aligned_filter_row,
                                       with(Driver::aligned_filter), with(Driver::open)));
}

} // namespace lockstep::lights
