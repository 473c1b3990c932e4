#include "reference/model/lifecycle/drawing.hpp"

#include <cstring>
#include <map>
#include <tuple>
#include <utility>

#include "reference/model/lifecycle/schema.hpp"

namespace lockstep::lifecycle {

const Schema& drawn_schema(const Switches& s) {
    static std::map<std::tuple<Layout, TimeCode, PositionCode, ColorCode>, Schema> all;
    const std::tuple key(s.layout, s.time_code, s.position_code, s.color_code);
    if (const auto known = all.find(key); known != all.end())
        return known->second;
    Resource quads = schema(s).resources[particle_buffer];
    quads.name = "quads";
    quads.item = "quad";
    quads.title = "the quads";
    quads.fields.push_back({.name = "kind", .scalar = Scalar::uint32});
    for (const char* const edge : {"left", "right", "next_left", "next_right"})
        quads.fields.push_back({.name = edge, .components = 3});
    quads.fields.push_back({.name = "u", .components = 2});
    Resource corners{.name = "corners",
                     .item = "corner",
                     .title = "the corners",
                     .fields = {{.name = "clip", .components = 4},
                                {.name = "tint", .components = 4},
                                {.name = "drawn", .scalar = Scalar::uint32},
                                {.name = "texel_place", .components = 2}}};
    return all.emplace(key, checked({"lifecycle", {std::move(quads), std::move(corners)}})).first->second;
}

DrawnFields drawn_fields(const Switches& s) {
    const auto first = static_cast<int>(schema(s).resources[particle_buffer].fields.size());
    const auto at = [&](int k) { return FieldId{quad_buffer, static_cast<std::uint8_t>(first + k)}; };
    return {at(0), at(1), at(2), at(3), at(4), at(5)};
}

namespace {

/// Of the particle that is drawn `place`-th; of a ribbon its point.
std::size_t slot_of(const Host& host, const HostEmitter& of, const SystemView& state, std::size_t place) {
    if (!host.lists())
        return place;
    if (of.keys > 0)
        return state.word({key_buffer, 2}, of.first_key + place);
    const std::uint32_t list = state.word({counter_buffer, counter::list}, of.number) & 1U;
    return state.word({survivor_buffer, 0}, 2 * of.base + list * of.slots + place);
}

} // namespace

SystemState quads_of(const Host& host, const SystemState& state) {
    const std::size_t slots = host.slots();
    SystemState quads(drawn_schema(host.switches()), {{slots}, {4 * slots}});
    const View from = state[particle_buffer];
    const WritableView to = quads[quad_buffer];
    for (std::size_t f = 0; f < from.columns.size(); ++f)
        std::memcpy(to.columns[f], from.columns[f],
                    slots * static_cast<std::size_t>(from.fields()[f].components) * sizeof(std::uint32_t));
    const DrawnFields fields = drawn_fields(host.switches());
    constexpr FieldId left{point_buffer, 0}, right{point_buffer, 1}, u{point_buffer, 2};
    const SystemView view = state.view();
    for (const HostEmitter& of : host.emitters()) {
        const std::size_t alive = view.word({counter_buffer, counter::alive}, of.number);
        const bool ribbon = of.settings().draw == Emitter::Draw::ribbon;
        for (std::size_t i = 0; i < alive; ++i) {
            const std::size_t quad = of.base + slot_of(host, of, view, i), point = of.base + i;
            if (!ribbon) {
                quads.set(fields.kind, quad, std::uint32_t{1});
            } else if (i + 1 < alive) {
                quads.set(fields.kind, quad, std::uint32_t{2});
                quads.set(fields.left, quad, view.vec3(left, point));
                quads.set(fields.right, quad, view.vec3(right, point));
                quads.set(fields.next_left, quad, view.vec3(left, point + 1));
                quads.set(fields.next_right, quad, view.vec3(right, point + 1));
                quads.set(fields.u, quad, view.vec2(u, point));
            }
        }
    }
    return quads;
}

Drawing drawing(const Host& host, float aspect, int frame) {
    const Camera& camera = host.settings().camera;
    return {view_matrix(camera), projection_matrix(camera, aspect), host.time(frame)};
}

} // namespace lockstep::lifecycle
