#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/model/error.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// An item by its buffer or image, and its number there.
struct ItemId {
    std::uint8_t resource = 0;
    std::size_t item = 0;
    auto operator<=>(const ItemId&) const = default;
};

/// A read or write of what a state does not have: another item, field or component.
class OutsideState : public Error {
  public:
    using Error::Error;
};

/// A system's whole state, wherever it lies: a view of each buffer and image, in the schema's order.
struct SystemView {
    std::vector<View> resources;
    std::set<ItemId>* read = nullptr; ///< not null: gathers the items that are read

    [[nodiscard]] const View& operator[](std::uint8_t resource) const { return resources[resource]; }

    // Components of an item's field. Floats and integers are read as their field has them. Throw OutsideState.
    [[nodiscard]] Value value(FieldId field, std::size_t item, int component = 0) const {
        if (!has(field, item, component))
            throw_outside(field, item, component);
        if (read != nullptr)
            read->insert({field.resource, item});
        return resources[field.resource].value(field.field, item, component);
    }
    [[nodiscard]] float real(FieldId field, std::size_t item, int component = 0) const {
        return value(field, item, component).real();
    }
    [[nodiscard]] std::int32_t integer(FieldId field, std::size_t item, int component = 0) const {
        return static_cast<std::int32_t>(value(field, item, component).bits);
    }
    [[nodiscard]] std::uint32_t word(FieldId field, std::size_t item, int component = 0) const {
        return value(field, item, component).bits;
    }
    [[nodiscard]] glm::vec2 vec2(FieldId field, std::size_t item) const { return vector<glm::vec2>(field, item); }
    [[nodiscard]] glm::vec3 vec3(FieldId field, std::size_t item) const { return vector<glm::vec3>(field, item); }
    [[nodiscard]] glm::vec4 vec4(FieldId field, std::size_t item) const { return vector<glm::vec4>(field, item); }

    /// The sum of a component over all items, modulo 2^32.
    [[nodiscard]] std::uint32_t total(FieldId field, int component = 0) const;

  private:
    [[nodiscard]] bool has(FieldId field, std::size_t item, int component) const {
        if (field.resource >= resources.size())
            return false;
        const View& view = resources[field.resource];
        return field.field < view.columns.size() && item < view.count() && component >= 0 &&
               component < view.fields()[field.field].components;
    }
    template <class Vector> [[nodiscard]] Vector vector(FieldId field, std::size_t item) const {
        constexpr int length = Vector::length();
        if (!has(field, item, length - 1))
            throw_first_outside(field, item, length);
        if (read != nullptr)
            read->insert({field.resource, item});
        const View& view = resources[field.resource];
        Vector found;
        std::memcpy(&found,
                    view.columns[field.field] +
                        item * static_cast<std::size_t>(view.fields()[field.field].components) * sizeof(float),
                    sizeof found);
        return found;
    }
    [[noreturn]] void throw_first_outside(FieldId field, std::size_t item, int components) const;
    [[noreturn]] void throw_outside(FieldId field, std::size_t item, int component) const;
};

/// A state of its own: of each field an array of 32-bit words, zero at first.
class SystemState {
  public:
    SystemState() = default;
    /// `extents`: one a resource. `schema` outlives this. Throws Error where their number is another, or a buffer has a
    /// second dimension.
    SystemState(const Schema& schema, std::vector<Extent> extents);

    [[nodiscard]] const Schema& schema() const { return *schema_; }
    /// Whether it is a state of `schema`, or of an equal one.
    [[nodiscard]] bool is_of(const Schema& schema) const;
    [[nodiscard]] Extent extent(std::uint8_t resource) const { return extents_[resource]; }
    [[nodiscard]] WritableView operator[](std::uint8_t resource);
    [[nodiscard]] View operator[](std::uint8_t resource) const;
    [[nodiscard]] SystemView view() const;
    /// To write every item of a resource anew, in all fields but those of `kept`, whose columns are null.
    [[nodiscard]] WritableView all_but(std::span<const std::uint8_t> kept, std::uint8_t resource);

    /// One field as `other` has it, without a copy until one of the two is written.
    void share(FieldId field, const SystemState& other);
    /// What `other`, a state of the same schema and extents, has of a resource.
    void take(std::uint8_t resource, const SystemState& other);
    /// The same, both ways and without a copy. Views of the resource then show the other's.
    void swap(std::uint8_t resource, SystemState& other);

    // Throw OutsideState.
    void set(FieldId field, std::size_t item, float value, int component = 0);
    void set(FieldId field, std::size_t item, std::int32_t value, int component = 0);
    void set(FieldId field, std::size_t item, std::uint32_t value, int component = 0);
    void set(FieldId field, std::size_t item, glm::vec2 value);
    void set(FieldId field, std::size_t item, glm::vec3 value);
    void set(FieldId field, std::size_t item, glm::vec4 value);

  private:
    /// The words of one field. Two may share them until one is written. Words that no column has any more wait for the
    /// next that needs some: large arrays are slow to get from the system.
    class Column {
      public:
        explicit Column(std::size_t size); ///< of zeros
        ~Column() = default;
        Column(const Column& other);
        Column(Column&&) noexcept = default;
        Column& operator=(const Column& other);
        Column& operator=(Column&&) noexcept = default;

        void share(const Column& other) { words_ = other.words_; }
        void swap(Column& other) noexcept;
        [[nodiscard]] const std::byte* bytes() const { return reinterpret_cast<const std::byte*>(words_.get()); }
        [[nodiscard]] std::byte* bytes();
        /// For who writes every word: those that were shared are not copied.
        [[nodiscard]] std::byte* new_bytes();

      private:
        class Spares;
        std::size_t size_;
        std::shared_ptr<Spares> spares_; ///< of all copies of a column
        std::shared_ptr<std::uint32_t[]> words_;
    };

    const Schema* schema_ = nullptr;
    std::vector<Extent> extents_;
    std::vector<Column> columns_; ///< Schema::column
};

/// The place of a field by its name. Throws Error naming those there are.
FieldId field_named(const Schema& schema, std::string_view name);

} // namespace lockstep
