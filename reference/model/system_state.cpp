#include "reference/model/system_state.hpp"

#include <bit>
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
        view.columns.push_back(state_view::bytes(columns[first + f]));
    return view;
}

} // namespace

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

void SystemState::set(FieldId field, std::size_t item, std::uint32_t value, int component) {
    const auto components = static_cast<std::size_t>((*schema_)[field].components);
    columns_[schema_->column(field)].at(item * components + static_cast<std::size_t>(component)) = value;
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
