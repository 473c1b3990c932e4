#include "reference/model/lifecycle/drawing.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <tuple>
#include <utility>

#include "reference/model/lifecycle/schema.hpp"

namespace lockstep::lifecycle {

const Schema& drawn_schema(const Host& host) {
    static std::map<std::tuple<Layout, TimeCode, PositionCode, ColorCode, bool, bool>, Schema> all;
    const Switches& s = host.switches();
    const bool ribbons = host.has_ribbons(), textured = host.settings().sprite.texture.width > 0;
    const std::tuple key(s.layout, s.time_code, s.position_code, s.color_code, ribbons, textured);
    if (const auto known = all.find(key); known != all.end())
        return known->second;
    Resource quads = schema(s).resources[particle_buffer];
    quads.name = "quads";
    quads.item = "quad";
    quads.title = "the quads";
    quads.fields.push_back({.name = "kind", .scalar = Scalar::uint32});
    if (ribbons) {
        for (const char* const edge : {"left", "right", "next_left", "next_right"})
            quads.fields.push_back({.name = edge, .components = 3});
        quads.fields.push_back({.name = "u", .components = 2});
    }
    Resource corners{.name = "corners",
                     .item = "corner",
                     .title = "the corners",
                     .fields = {{.name = "clip", .components = 4},
                                {.name = "tint", .components = 4},
                                {.name = "drawn", .scalar = Scalar::uint32},
                                {.name = "texel_place", .components = 2}}};
    Schema made{"lifecycle", {std::move(quads), std::move(corners)}};
    if (textured)
        made.resources.push_back({.name = "sprite",
                                  .item = "texel",
                                  .title = "the texture",
                                  .fields = {{.name = "code", .scalar = Scalar::uint32, .components = 4}},
                                  .dimensions = 2,
                                  .format = "rgba8"});
    return all.emplace(key, checked(std::move(made))).first->second;
}

std::size_t corners_each(const Host& host) {
    return std::max<std::size_t>(host.sprite_corners().size(), host.has_ribbons() ? 4 : 3);
}

std::vector<std::uint32_t> triangles_each(const Host& host) {
    if (host.settings().sprite.polygon == 0)
        return {0, 1, 2, 2, 1, 3};
    std::vector<std::uint32_t> all;
    for (std::uint32_t c = 2; c < corners_each(host); ++c)
        all.insert(all.end(), {0, c - 1, c});
    return all;
}

std::size_t segment_corner(const Host& host, std::size_t corner) {
    if (host.settings().sprite.polygon == 0)
        return corner;
    const std::size_t last = std::min<std::size_t>(corner, 3);
    return last ^ (last >> 1U); // around
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
    const ColorImage& texture = host.settings().sprite.texture;
    std::vector<Extent> extents{{slots}, {corners_each(host) * slots}};
    if (texture.width > 0)
        extents.push_back({static_cast<std::size_t>(texture.width), static_cast<std::size_t>(texture.height)});
    SystemState quads(drawn_schema(host), std::move(extents));
    for (std::size_t t = 0; t < texture.texels.size(); ++t) {
        const Rgba8& texel = texture.texels[t];
        int channel = 0;
        for (const std::uint8_t code : {texel.r, texel.g, texel.b, texel.a})
            quads.set({texture_image, 0}, t, std::uint32_t{code}, channel++);
    }
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

std::vector<const HostEmitter*> drawing_order(const Host& host) {
    std::vector<const HostEmitter*> all;
    for (const HostEmitter& of : host.emitters())
        all.push_back(&of);
    std::stable_partition(all.begin(), all.end(),
                          [](const HostEmitter* of) { return of->settings().blend == Emitter::Blend::opaque; });
    return all;
}

Drawing drawing(const Host& host, float aspect, int frame) {
    const Camera& camera = host.settings().camera;
    return {view_matrix(camera), projection_matrix(camera, aspect), host.time(frame)};
}

} // namespace lockstep::lifecycle
