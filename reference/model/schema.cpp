#include "reference/model/schema.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

bool is_word(std::string_view name) {
    constexpr std::string_view characters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return !name.empty() && name.find_first_not_of(characters) == std::string_view::npos;
}

class Checker {
  public:
    explicit Checker(const Schema& schema) : schema_(schema) {}

    void check() {
        if (schema_.resources.empty() || schema_.resources.size() > 255)
            fail(fmt::format("{} buffers and images; right is 1 to 255", schema_.resources.size()));
        for (const Resource& resource : schema_.resources)
            check(resource);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("schema of {}: {}", schema_.system, what));
    }

    void name(std::set<std::string>& taken, const std::string& kind, const std::string& name) {
        if (!is_word(name))
            fail(fmt::format("{} '{}'; right is a name of letters, digits and _", kind, name));
        if (!taken.insert(name).second)
            fail(fmt::format("{} '{}' stands there twice", kind, name));
    }

    void check(const Resource& resource) {
        name(resources_, "buffer or image", resource.name);
        if (resource.fields.empty() || resource.fields.size() > 255)
            fail(fmt::format("'{}' has {} fields; right is 1 to 255", resource.name, resource.fields.size()));
        if (resource.dimensions < 1 || resource.dimensions > 3)
            fail(fmt::format("'{}' has {} dimensions; right is 1 for a buffer, 2 or 3 for an image", resource.name,
                             resource.dimensions));
        if (resource.dimensions > 1 && (resource.fields.size() != 1 || resource.counted))
            fail(fmt::format("image '{}' has {} fields{}; right is one, and as many texels in every frame",
                             resource.name, resource.fields.size(), resource.counted ? " and is counted" : ""));
        for (const Field& field : resource.fields)
            check(field);
        check_blocks(resource);
    }

    void check_blocks(const Resource& resource) {
        std::set<std::string> own;
        for (const Field& field : resource.fields) {
            if (field.block.empty() != resource.fields.front().block.empty())
                fail(fmt::format("'{}': some fields have a storage block and others none; right is all or none",
                                 resource.name));
            if (!field.block.empty() && own.insert(field.block).second)
                name(blocks_, "storage block", field.block);
        }
        if (!own.empty() && resource.dimensions > 1)
            fail(fmt::format("image '{}' has a storage block; right is none", resource.name));
    }

    void check(const Field& field) {
        name(fields_, "field", field.name);
        if (field.components < 1 || field.components > 4)
            fail(fmt::format("field '{}' has {} components; right is 1 to 4", field.name, field.components));
        if (!field.packed.empty() && (field.scalar != Scalar::uint32 || field.components != 1))
            fail(fmt::format("packed field '{}' is {}; right is uint", field.name, glsl_type(field)));
        std::uint32_t used = 0;
        for (const Packed& part : field.packed) {
            if (part.shift < 0 || part.bits < 1 || part.shift + part.bits > 32)
                fail(fmt::format("field '{}': '{}' has bits {} to {}; right is 0 to 31", field.name, part.name,
                                 part.shift, part.shift + part.bits - 1));
            if (part.code == Packed::Code::half && part.bits != 16)
                fail(fmt::format("field '{}': '{}' is a half of {} bits; right is 16", field.name, part.name,
                                 part.bits));
            const auto mask = static_cast<std::uint32_t>(((std::uint64_t{1} << part.bits) - 1) << part.shift);
            if ((used & mask) != 0)
                fail(fmt::format("field '{}': '{}' shares bits with another part", field.name, part.name));
            used |= mask;
        }
    }

    const Schema& schema_;
    std::set<std::string> resources_, fields_, blocks_;
};

} // namespace

std::size_t Schema::column(FieldId id) const {
    std::size_t before = id.field;
    for (std::size_t r = 0; r < id.resource; ++r)
        before += resources[r].fields.size();
    return before;
}

Schema checked(Schema schema) {
    Checker(schema).check();
    return schema;
}

std::string component_name(const Field& field, int component) {
    return field.components == 1 ? field.name : fmt::format("{}.{}", field.name, "xyzw"[component]);
}

std::string glsl_type(const Field& field) {
    constexpr std::string_view scalars[] = {"float", "int", "uint"};
    constexpr std::string_view prefixes[] = {"", "i", "u"};
    const auto kind = static_cast<std::size_t>(field.scalar);
    return field.components == 1 ? std::string(scalars[kind])
                                 : fmt::format("{}vec{}", prefixes[kind], field.components);
}

std::size_t item_bytes(const Resource& resource) {
    std::size_t words = 0;
    for (const Field& field : resource.fields)
        words += static_cast<std::size_t>(field.components);
    return words * sizeof(std::uint32_t);
}

} // namespace lockstep
