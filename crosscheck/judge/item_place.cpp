#include "crosscheck/judge/item_place.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Column, row and layer, as many as the resource has dimensions.
std::vector<std::size_t> coordinates(const Resource& resource, const Extent& extent, std::size_t item) {
    if (resource.dimensions == 1 || extent.width == 0 || extent.height == 0)
        return {item};
    std::vector<std::size_t> at{item % extent.width, item / extent.width};
    if (resource.dimensions == 3)
        at = {at[0], at[1] % extent.height, at[1] / extent.height};
    return at;
}

/// Whole numbers from 0 up with commas between them; nothing of other texts.
std::vector<std::size_t> numbers(std::string_view text) {
    std::vector<std::size_t> found;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        std::size_t value = 0;
        const auto [rest, status] = std::from_chars(at, end, value);
        if (status != std::errc{} || (rest != end && *rest != ','))
            return {};
        found.push_back(value);
        if (rest == end)
            return found;
        at = rest + 1;
    }
}

} // namespace

std::string item_name(const Resource& resource, const Extent& extent, std::size_t item) {
    const auto at = coordinates(resource, extent, item);
    return at.size() == 1 ? fmt::format("{} {}", resource.item, item)
                          : fmt::format("{} ({})", resource.item, fmt::join(at, ", "));
}

std::string item_key(const Schema& schema, std::uint8_t resource) {
    const Resource& about = schema.resources[resource];
    const auto same = std::count_if(schema.resources.begin(), schema.resources.end(),
                                    [&](const Resource& other) { return other.item == about.item; });
    return same > 1 ? fmt::format("{}_{}", about.name, about.item) : about.item;
}

std::string item_argument(const Resource& resource, const Extent& extent, std::size_t item) {
    return fmt::format("{}", fmt::join(coordinates(resource, extent, item), ","));
}

std::size_t item_named(std::string_view text, const Resource& resource, const Extent& extent, std::string_view owner) {
    const std::vector<std::size_t> at = numbers(text);
    const std::array<std::size_t, 3> size{extent.width, extent.height, extent.depth};
    std::optional<std::size_t> item;
    if (at.size() == 1 && at[0] < extent.count())
        item = at[0];
    if (at.size() > 1 && at.size() == static_cast<std::size_t>(resource.dimensions)) {
        item = 0;
        for (std::size_t axis = at.size(); axis-- > 0;)
            item = item && at[axis] < size[axis] ? std::optional(*item * size[axis] + at[axis]) : std::nullopt;
    }
    if (item)
        return *item;
    const std::size_t last = extent.count() - 1;
    if (extent.count() == 0)
        throw Error(fmt::format("there is no {} '{}'; {} has none", resource.item, text, owner));
    if (resource.dimensions == 1)
        throw Error(fmt::format("there is no {} '{}'; {} has 0 to {}", resource.item, text, owner, last));
    throw Error(fmt::format("there is no {} '{}'; {} has {} to {}", resource.item, text, owner,
                            item_argument(resource, extent, 0), item_argument(resource, extent, last)));
}

} // namespace lockstep
