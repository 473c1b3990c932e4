#include "crosscheck/collision/report/named_items.hpp"

#include <charconv>
#include <cstdint>

#include <fmt/format.h>
#include <glm/vec2.hpp>

#include "reference/model/collision/layered_cdt.hpp"
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

std::size_t place_named(std::string_view text, glm::ivec2 size, std::string_view item, std::string_view image) {
    const std::size_t comma = text.find(',');
    const std::int64_t x = integer(text.substr(0, comma));
    const std::int64_t y = comma == std::string_view::npos ? -1 : integer(text.substr(comma + 1));
    if (x < 0 || y < 0 || x >= size.x || y >= size.y)
        throw Error(
            fmt::format("there is no {} '{}'; the {} has 0,0 to {},{}", item, text, image, size.x - 1, size.y - 1));
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
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
    return place_named(text, {scene.width, cdt_height(scene)}, "texel", "CDT");
}

std::size_t pixel_named(std::string_view text, const Scene& scene) {
    return place_named(text, {scene.render_width, scene.render_height}, "pixel", "rendered frame");
}

} // namespace lockstep
