#include "crosscheck/collision/report/named_items.hpp"

#include <charconv>
#include <cstdint>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// A number from 0 up; -1 for anything else.
std::int64_t integer(std::string_view text) {
    std::int64_t value = -1;
    const char* const end = text.data() + text.size();
    const auto [rest, status] = std::from_chars(text.data(), end, value);
    return status == std::errc{} && rest == end ? value : -1;
}

} // namespace

std::size_t particle_named(std::string_view text, const Scene& scene) {
    const std::int64_t particle = integer(text);
    const auto count = static_cast<std::int64_t>(scene.start.size());
    if (particle < 0 || particle >= count)
        throw Error(fmt::format("there is no particle '{}'; {} has 0 to {}", text, scene.name, count - 1));
    return static_cast<std::size_t>(particle);
}

std::size_t texel_named(std::string_view text, const Scene& scene) {
    const std::size_t comma = text.find(',');
    const std::int64_t x = integer(text.substr(0, comma));
    const std::int64_t y = comma == std::string_view::npos ? -1 : integer(text.substr(comma + 1));
    if (x < 0 || y < 0 || x >= scene.width || y >= scene.height)
        throw Error(
            fmt::format("there is no texel '{}'; the CDT has 0,0 to {},{}", text, scene.width - 1, scene.height - 1));
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(x);
}

} // namespace lockstep
