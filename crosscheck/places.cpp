#include "crosscheck/places.hpp"

#include <charconv>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::optional<std::int64_t> integer(std::string_view text) {
    std::int64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, status] = std::from_chars(text.data(), end, value);
    return status == std::errc{} && rest == end ? std::optional(value) : std::nullopt;
}

} // namespace

std::size_t particle_named(std::string_view text, const Scene& scene) {
    const auto particle = integer(text);
    const auto count = static_cast<std::int64_t>(scene.start.size());
    if (!particle || *particle < 0 || *particle >= count)
        throw Error(fmt::format("there is no particle '{}'; {} has 0 to {}", text, scene.name, count - 1));
    return static_cast<std::size_t>(*particle);
}

std::size_t texel_named(std::string_view text, const Scene& scene) {
    const std::size_t comma = text.find(',');
    const auto x = integer(text.substr(0, comma));
    const auto y = comma == std::string_view::npos ? std::nullopt : integer(text.substr(comma + 1));
    if (!x || !y || *x < 0 || *y < 0 || *x >= scene.width || *y >= scene.height)
        throw Error(
            fmt::format("there is no texel '{}'; the CDT has 0,0 to {},{}", text, scene.width - 1, scene.height - 1));
    return static_cast<std::size_t>(*y) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(*x);
}

} // namespace lockstep
