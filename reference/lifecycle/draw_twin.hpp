#pragma once
#include <algorithm>
#include <cstring>
#include <optional>
#include <tuple>
#include <vector>

#include "reference/lifecycle/draw_sites.hpp"
#include "reference/lifecycle/graphs.hpp"
#include "reference/model/lifecycle/drawing.hpp"

namespace lockstep::lifecycle {

/// A corner of a sprite, which faces the camera, or of a ribbon's segment. Twin of shaders/lifecycle/draw.vert.
struct DrawTwin {
    HostPtr host;
    Drawing drawing;
    std::vector<StageGraph> graphs; ///< of the rendering, one an emitter

    template <class R> struct Corner {
        typename R::Vec4 clip, tint;
        std::uint32_t drawn = 0;
        typename R::Vec2 texel_place;
        auto fields() const { return std::tie(clip, tint, drawn, texel_place); }
    };

    template <class R> Corner<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Real = typename R::Real;
        using Vec3 = typename R::Vec3;
        const std::size_t each = corners_each(*host), quad = item / each, corner = item % each;
        const DrawnFields fields = drawn_fields(host->switches());
        const Particle<R> particle(r, *host, particle_words(in.before, quad));
        std::uint32_t kind = in.before.word(fields.kind, quad);
        Vec3 seen;
        const std::vector<glm::vec2>& corners = host->sprite_corners();
        const glm::vec2 at = corners.empty() ? glm::vec2(0.0F) : corners[std::min(corner, corners.size() - 1)];
        Real u = r.read(site::corner_of_sprite, at.x), v = r.read(site::corner_of_sprite, at.y);
        if (kind == 2) {
            const std::size_t of_segment = segment_corner(*host, corner);
            const bool right = (of_segment & 1U) != 0, next = (of_segment & 2U) != 0;
            const FieldId edge =
                next ? (right ? fields.next_right : fields.next_left) : (right ? fields.right : fields.left);
            seen = r.read(site::seen_point, in.before.vec3(edge, quad));
            u = r.read(site::first_u, in.before.real(fields.u, quad, next ? 1 : 0));
            v = Real(right ? 1.0F : 0.0F);
        }
        const std::optional<StageRun<R>> look = looks(r, particle, quad, u, v);
        if (kind != 2) {
            const auto centre = r.transform(site::view, r.uniform(site::view, drawing.view), particle.position());
            const auto size = look ? look->real("size") : std::nullopt;
            const Real reach = r.note(site::half_width, (size ? *size : size_of(r, particle)) * 0.5F);
            const Real two(2.0F), one(1.0F);
            const auto way = r.note(site::way_to_corner, typename R::Vec2{two * u - one, two * v - one});
            seen = {centre.x + way.x * reach, centre.y + way.y * reach, centre.z};
            if (host->switches().expired == Expired::hidden && !r.decide(site::is_visible, particle.remaining() > 0.0F))
                kind = 0;
        }
        const auto clip = r.transform(site::projection, r.uniform(site::projection, drawing.projection),
                                      r.note(site::seen_corner, seen));
        const auto drawn = r.note(site::drawn, typename R::Int(static_cast<int>(kind)));
        return {r.note(site::clip, clip), tint_of(r, particle, look),
                static_cast<std::uint32_t>(static_cast<int>(drawn)), r.note(site::texel_place, typename R::Vec2{u, v})};
    }

  private:
    /// The graph of the quad's emitter, if it has one.
    template <class R> std::optional<StageRun<R>> looks(R& r, const Particle<R>& particle, std::size_t quad,
                                                        const typename R::Real& u, const typename R::Real& v) const {
        for (const HostEmitter& of : host->emitters())
            if (graphs[of.number] && quad >= of.base && quad - of.base < of.slots)
                return StageRun<R>(r, *host, of, graphs[of.number], [&](std::string_view name) {
                    return value_of(r, *host, particle, drawing.time, name, u, v);
                });
        return {};
    }

    template <class R>
    typename R::Vec4 tint_of(R& r, const Particle<R>& particle, const std::optional<StageRun<R>>& look) const {
        const auto made = look ? look->number("color") : std::nullopt;
        if (!made)
            return color_of(r, particle);
        return r.note(site::tint, typename R::Vec4{made->x[0], made->x[1], made->x[2], made->x[3]});
    }

    [[nodiscard]] RawWords particle_words(const SystemView& state, std::size_t quad) const {
        static_cast<void>(state.value({quad_buffer, 0}, quad));
        const View& view = state[quad_buffer];
        const std::size_t words = plan_of(host->switches().layout).words;
        RawWords raw{};
        for (std::size_t w = 0, f = 0; w < words; ++f) {
            const auto n = static_cast<std::size_t>(view.fields()[f].components);
            std::memcpy(raw.data() + w, view.columns[f] + quad * n * sizeof(std::uint32_t), n * sizeof(std::uint32_t));
            w += n;
        }
        return raw;
    }
};

} // namespace lockstep::lifecycle
