#pragma once
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <vector>

#include "reference/model/image.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/value.hpp"

namespace lockstep {

/// How many items a resource has: of a buffer `width` alone, of an image texels along each axis.
struct Extent {
    std::size_t width = 0;
    std::size_t height = 1;
    std::size_t depth = 1;
    [[nodiscard]] std::size_t count() const { return width * height * depth; }
    bool operator==(const Extent&) const = default;
};

/// The values of one resource, wherever they lie: of each field an array of 32-bit words, item by item, the components
/// of an item together. Images go x first, then y from the bottom, then z.
template <class Byte> struct BasicView {
    const Schema* schema = nullptr;
    std::uint8_t resource = 0;
    Extent extent;
    std::vector<Byte*> columns; ///< one a field; null: left out, where a function says that it may be

    [[nodiscard]] const Resource& about() const { return schema->resources[resource]; }
    [[nodiscard]] const std::vector<Field>& fields() const { return about().fields; }
    [[nodiscard]] std::size_t count() const { return extent.count(); }

    [[nodiscard]] Value value(std::size_t field, std::size_t item, int component) const {
        const Field& of = fields()[field];
        const std::size_t word = item * static_cast<std::size_t>(of.components) + static_cast<std::size_t>(component);
        std::uint32_t bits = 0;
        std::memcpy(&bits, columns[field] + word * sizeof bits, sizeof bits);
        return {of.scalar, bits};
    }

    operator BasicView<const std::byte>() const requires(!std::is_const_v<Byte>) {
        return {schema, resource, extent, {columns.begin(), columns.end()}};
    }
};
using View = BasicView<const std::byte>;
using WritableView = BasicView<std::byte>;

/// The first item that has such a word in one of its fields; count() if none has.
std::size_t find_word(const View& state, std::uint32_t word);

/// Whether one of the item's floats is NaN.
bool has_nan(const View& state, std::size_t item);

/// One component of an item.
struct Component {
    std::uint8_t field = 0;
    int component = 0;
    bool operator==(const Component&) const = default;
};

/// In the place of one: a word between the fields of a record.
inline constexpr Component no_component{255, -1};

/// All of an item's, in the order of its fields.
std::vector<Component> components(const Resource& resource);

/// The item's words, in that order.
std::vector<std::uint32_t> item_words(const View& state, std::size_t item);

namespace state_view {

template <class Element> auto bytes(std::vector<Element>& values) {
    return reinterpret_cast<std::byte*>(values.data());
}
template <class Element> auto bytes(const std::vector<Element>& values) {
    return reinterpret_cast<const std::byte*>(values.data());
}
template <class Element> auto bytes(Element& value) {
    using Byte = std::conditional_t<std::is_const_v<Element>, const std::byte, std::byte>;
    return reinterpret_cast<Byte*>(&value);
}

/// What `ties` refer to, one a field and in its words.
template <class Byte, class... Values>
BasicView<Byte> of(const Schema& schema, std::uint8_t resource, Extent extent, const std::tuple<Values...>& ties) {
    assert(sizeof...(Values) == schema.resources[resource].fields.size());
    return {&schema, resource, extent,
            std::apply([](auto&... values) { return std::vector<Byte*>{bytes(values)...}; }, ties)};
}

} // namespace state_view

/// Of a 2D image whose texels are words.
template <class Texel> View view_of(const Schema& schema, std::uint8_t resource, const Image<Texel>& image) {
    static_assert(sizeof(Texel) % sizeof(std::uint32_t) == 0);
    return state_view::of<const std::byte>(
        schema, resource, {static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height), 1},
        std::tie(image.texels));
}

} // namespace lockstep
