#include "reference/model/system_state.hpp"

#include <algorithm>
#include <bit>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

template <class Byte, class Columns>
BasicView<Byte> view_of(const Schema& schema, std::uint8_t resource, Extent extent, Columns& columns) {
    BasicView<Byte> view{&schema, resource, extent, {}};
    const std::size_t first = schema.column({resource, 0});
    for (std::size_t f = 0; f < schema.resources[resource].fields.size(); ++f)
        view.columns.push_back(columns[first + f].bytes());
    return view;
}

/// Why `schema`'s state has no such component.
[[noreturn]] void throw_outside_of(const Schema& schema, std::size_t items, FieldId id, std::size_t item,
                                   int component) {
    if (id.resource >= schema.resources.size())
        throw OutsideState(fmt::format("{} has no buffer or image {}; it has 0 to {}", schema.system, id.resource,
                                       schema.resources.size() - 1));
    const Resource& about = schema.resources[id.resource];
    if (id.field >= about.fields.size())
        throw OutsideState(
            fmt::format("'{}' has no field {}; it has 0 to {}", about.name, id.field, about.fields.size() - 1));
    const Field& field = about.fields[id.field];
    if (component < 0 || component >= field.components)
        throw OutsideState(fmt::format("{} of a {} has type {}; there is no component {}", field.name, about.item,
                                       glsl_type(field), component));
    if (items == 0)
        throw OutsideState(fmt::format("{} of {} {} is asked for; there are none", field.name, about.item, item));
    throw OutsideState(fmt::format("{} of {} {} is asked for; there are {} 0 to {}", field.name, about.item,
                                   static_cast<std::ptrdiff_t>(item), about.name, items - 1));
}

} // namespace

void SystemView::throw_outside(FieldId field, std::size_t item, int component) const {
    if (resources.empty())
        throw OutsideState("a state of nothing is read");
    throw_outside_of(*resources.front().schema,
                     field.resource < resources.size() ? resources[field.resource].count() : 0, field, item, component);
}

void SystemView::throw_first_outside(FieldId field, std::size_t item, int components) const {
    int first = 0;
    while (first + 1 < components && has(field, item, first))
        ++first;
    throw_outside(field, item, first);
}

std::uint32_t SystemView::total(FieldId field, int component) const {
    const std::size_t items = field.resource < resources.size() ? resources[field.resource].count() : 0;
    if (items == 0)
        return 0;
    if (!has(field, items - 1, component))
        throw_outside(field, items - 1, component);
    for (std::size_t i = 0; read != nullptr && i < items; ++i)
        read->insert({field.resource, i});
    const View& view = resources[field.resource];
    const auto stride = static_cast<std::size_t>(view.fields()[field.field].components);
    const std::byte* words = view.columns[field.field] + static_cast<std::size_t>(component) * sizeof(std::uint32_t);
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < items; ++i) {
        std::uint32_t word = 0;
        std::memcpy(&word, words + i * stride * sizeof word, sizeof word);
        sum += word;
    }
    return sum;
}

/// Arrays of one size. Columns of several threads may ask at once.
class SystemState::Column::Spares {
  public:
    /// Of any words.
    static std::shared_ptr<std::uint32_t[]> take(const std::shared_ptr<Spares>& from, std::size_t size) {
        return {from->take(size).release(), [from](std::uint32_t* words) { from->give_back(Words(words)); }};
    }

  private:
    using Words = std::unique_ptr<std::uint32_t[]>;
    static constexpr std::size_t most = 2;

    Words take(std::size_t size) {
        const std::scoped_lock lock(mutex_);
        if (waiting_.empty())
            return std::make_unique_for_overwrite<std::uint32_t[]>(size);
        Words words = std::move(waiting_.back());
        waiting_.pop_back();
        return words;
    }
    void give_back(Words words) {
        const std::scoped_lock lock(mutex_);
        if (waiting_.size() < most)
            waiting_.push_back(std::move(words));
    }

    std::mutex mutex_;
    std::vector<Words> waiting_;
};

SystemState::Column::Column(std::size_t size)
    : size_(size), spares_(std::make_shared<Spares>()), words_(Spares::take(spares_, size)) {
    std::fill_n(words_.get(), size, 0U);
}

SystemState::Column::Column(const Column& other)
    : size_(other.size_), spares_(other.spares_), words_(Spares::take(spares_, size_)) {
    std::copy_n(other.words_.get(), size_, words_.get());
}

SystemState::Column& SystemState::Column::operator=(const Column& other) {
    if (this == &other || words_ == other.words_)
        return *this;
    if (size_ != other.size_)
        return *this = Column(other);
    std::copy_n(other.words_.get(), size_, reinterpret_cast<std::uint32_t*>(new_bytes()));
    return *this;
}

void SystemState::Column::swap(Column& other) noexcept { std::swap(*this, other); }

std::byte* SystemState::Column::bytes() {
    if (words_.use_count() > 1)
        *this = Column(*this);
    return reinterpret_cast<std::byte*>(words_.get());
}

std::byte* SystemState::Column::new_bytes() {
    if (words_.use_count() > 1)
        words_ = Spares::take(spares_, size_);
    return reinterpret_cast<std::byte*>(words_.get());
}

SystemState::SystemState(const Schema& schema, std::vector<Extent> extents)
    : schema_(&schema), extents_(std::move(extents)) {
    if (extents_.size() != schema.resources.size())
        throw Error(fmt::format("state of {}: {} sizes for {} buffers and images", schema.system, extents_.size(),
                                schema.resources.size()));
    for (std::size_t r = 0; r < extents_.size(); ++r) {
        const Resource& resource = schema.resources[r];
        const Extent& extent = extents_[r];
        if ((resource.dimensions < 2 && extent.height != 1) || (resource.dimensions < 3 && extent.depth != 1))
            throw Error(fmt::format("state of {}: '{}' is {} x {} x {}; it has {} dimension{}", schema.system,
                                    resource.name, extent.width, extent.height, extent.depth, resource.dimensions,
                                    resource.dimensions == 1 ? "" : "s"));
        for (const Field& field : resource.fields)
            columns_.emplace_back(extent.count() * static_cast<std::size_t>(field.components));
    }
}

WritableView SystemState::operator[](std::uint8_t resource) {
    return view_of<std::byte>(*schema_, resource, extents_[resource], columns_);
}

View SystemState::operator[](std::uint8_t resource) const {
    return view_of<const std::byte>(*schema_, resource, extents_[resource], columns_);
}

SystemView SystemState::view() const {
    SystemView all;
    for (std::size_t r = 0; r < extents_.size(); ++r)
        all.resources.push_back((*this)[static_cast<std::uint8_t>(r)]);
    return all;
}

WritableView SystemState::all_but(std::span<const std::uint8_t> kept, std::uint8_t resource) {
    WritableView view{schema_, resource, extents_[resource], {}};
    for (std::uint8_t f = 0; f < schema_->resources[resource].fields.size(); ++f)
        view.columns.push_back(
            std::ranges::find(kept, f) != kept.end() ? nullptr : columns_[schema_->column({resource, f})].new_bytes());
    return view;
}

void SystemState::share(FieldId field, const SystemState& other) {
    columns_[schema_->column(field)].share(other.columns_[other.schema_->column(field)]);
}

void SystemState::take(std::uint8_t resource, const SystemState& other) {
    for (std::uint8_t f = 0; f < schema_->resources[resource].fields.size(); ++f)
        columns_[schema_->column({resource, f})] = other.columns_[other.schema_->column({resource, f})];
}

void SystemState::swap(std::uint8_t resource, SystemState& other) {
    for (std::uint8_t f = 0; f < schema_->resources[resource].fields.size(); ++f)
        columns_[schema_->column({resource, f})].swap(other.columns_[other.schema_->column({resource, f})]);
}

bool SystemState::is_of(const Schema& schema) const {
    if (schema_ == &schema || schema_ == nullptr || schema_->resources.size() != schema.resources.size())
        return schema_ == &schema;
    for (std::size_t r = 0; r < schema.resources.size(); ++r) {
        const Resource &mine = schema_->resources[r], &other = schema.resources[r];
        const bool same =
            std::equal(mine.fields.begin(), mine.fields.end(), other.fields.begin(), other.fields.end(),
                       [](const Field& a, const Field& b) {
                           return a.name == b.name && a.scalar == b.scalar && a.components == b.components;
                       });
        if (!same || mine.name != other.name || mine.dimensions != other.dimensions)
            return false;
    }
    return true;
}

void SystemState::set(FieldId field, std::size_t item, std::uint32_t value, int component) {
    if (schema_ == nullptr)
        throw OutsideState("a state of nothing is written; right is a SystemState of a schema");
    const bool known =
        field.resource < extents_.size() && field.field < schema_->resources[field.resource].fields.size();
    const std::size_t items = field.resource < extents_.size() ? extents_[field.resource].count() : 0;
    if (!known || item >= items || component < 0 || component >= (*schema_)[field].components)
        throw_outside_of(*schema_, items, field, item, component);
    const auto components = static_cast<std::size_t>((*schema_)[field].components);
    const std::size_t word = item * components + static_cast<std::size_t>(component);
    std::memcpy(columns_[schema_->column(field)].bytes() + word * sizeof value, &value, sizeof value);
}

void SystemState::set(FieldId field, std::size_t item, std::int32_t value, int component) {
    set(field, item, std::bit_cast<std::uint32_t>(value), component);
}

void SystemState::set(FieldId field, std::size_t item, float value, int component) {
    set(field, item, std::bit_cast<std::uint32_t>(value), component);
}

void SystemState::set(FieldId field, std::size_t item, glm::vec2 value) {
    for (int c = 0; c < 2; ++c)
        set(field, item, value[c], c);
}

void SystemState::set(FieldId field, std::size_t item, glm::vec3 value) {
    for (int c = 0; c < 3; ++c)
        set(field, item, value[c], c);
}

void SystemState::set(FieldId field, std::size_t item, glm::vec4 value) {
    for (int c = 0; c < 4; ++c)
        set(field, item, value[c], c);
}

FieldId field_named(const Schema& schema, std::string_view name) {
    std::string all;
    for (std::size_t r = 0; r < schema.resources.size(); ++r)
        for (std::size_t f = 0; f < schema.resources[r].fields.size(); ++f) {
            const std::string& field = schema.resources[r].fields[f].name;
            if (field == name)
                return {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(f)};
            all += (all.empty() ? "" : ", ") + field;
        }
    throw Error(fmt::format("{} has no field '{}'; there are {}", schema.system, name, all));
}

} // namespace lockstep
