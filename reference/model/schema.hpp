#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// What one 32-bit word of a state is.
enum class Scalar : std::uint8_t { float32, int32, uint32 };

/// Part of a packed word, as GLSL's unpack functions and shifts take it out: `bits` of it from `shift` upwards.
struct Packed {
    enum class Code : std::uint8_t { uint, unorm, half };
    std::string name;
    int shift = 0;
    int bits = 32;
    Code code = Code::uint;
};

/// What every item of a resource has. Stored as 32-bit words, `components` an item.
struct Field {
    std::string name; ///< unique in its schema
    Scalar scalar = Scalar::float32;
    int components = 1;              ///< 1 to 4
    std::string unit = {};           ///< empty: none
    std::vector<Packed> packed = {}; ///< of a single uint32 that holds several values
    /// The storage block that compute shaders find it in, and change in place; the fields of one block are a record.
    /// Empty: the resource has two copies, one to read and one to write.
    std::string block = {};
    /// The word of a record in a storage block at which it lies; nothing: behind the field before.
    std::optional<std::uint32_t> at = {};
};

/// A buffer of items, one after the other, or an image of texels. Storage is a struct of arrays: all values of a field
/// lie together.
struct Resource {
    std::string name;  ///< "particles"
    std::string item;  ///< one of them: "particle", "texel"
    std::string title; ///< as a sentence has it: "the particles", "the CDT"
    std::vector<Field> fields;
    int dimensions = 1;      ///< 1: a buffer; 2 or 3: an image, which has one field
    std::string format = {}; ///< of an image, as GL names it: "rgba32f"
    bool counted = false;    ///< the number of items may change from frame to frame
    /// Of a buffer, words from one record to the next in storage blocks; nothing: as many as its fields have.
    std::optional<std::uint32_t> record_words = {};
};

/// A field by its place in a schema.
struct FieldId {
    std::uint8_t resource = 0;
    std::uint8_t field = 0;
    auto operator<=>(const FieldId&) const = default;
};

/// What the state of a system is: all that one frame hands to the next, and all that is compared.
struct Schema {
    std::string system;
    std::vector<Resource> resources; ///< buffers and images, in the order in which they are compared

    [[nodiscard]] const Field& operator[](FieldId id) const { return resources[id.resource].fields[id.field]; }

    /// How many fields come before it, over all resources.
    [[nodiscard]] std::size_t column(FieldId id) const;
};

/// The same, once its names are known to be unique and no longer than words: letters, digits and _. Throws Error naming
/// what is wrong.
Schema checked(Schema schema);

/// "position.x", "speed".
std::string component_name(const Field& field, int component);

/// "float", "ivec3", "uvec2".
std::string glsl_type(const Field& field);

/// Bytes of one item.
std::size_t item_bytes(const Resource& resource);

} // namespace lockstep
