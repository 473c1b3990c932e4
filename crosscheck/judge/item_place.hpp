#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "reference/model/schema.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// An item of a buffer by its number, of an image by column, row from the bottom, and layer: "grain 17", "texel (3,
/// 4)".
std::string item_name(const Resource& resource, const Extent& extent, std::size_t item);

/// What data call an item: "texel"; where items of another buffer or image are called so, too, "light_texel".
std::string item_key(const Schema& schema, std::uint8_t resource);

/// The same as an option takes it: "17", "3,4".
std::string item_argument(const Resource& resource, const Extent& extent, std::size_t item);

/// The item by such a text, or by its number where it is an image's, too. Throws Error with what `owner` has.
std::size_t item_named(std::string_view text, const Resource& resource, const Extent& extent, std::string_view owner);

} // namespace lockstep
