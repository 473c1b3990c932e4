#pragma once
/// A system of one's own: grains that fall, are blown about, bounce off a sphere and lie on the ground.
#include <lockstep/system.hpp>

namespace grains {

using namespace lockstep;

inline constexpr FieldId position{0, 0}, velocity{0, 1}, bounces{0, 2};

inline const Schema& schema() {
    static const Schema all = checked({"grains",
                                       {{.name = "grains",
                                         .item = "grain",
                                         .title = "the grains",
                                         .fields = {{"position", Scalar::float32, 3, "m"},
                                                    {"velocity", Scalar::float32, 3, "m/s"},
                                                    {"bounces", Scalar::int32}}}}});
    return all;
}

struct Constants {
    float tick = 0.02F, drag = 0.1F, elasticity = 0.5F, radius = 1.0F;
    glm::vec3 gravity{0.0F, -9.81F, 0.0F}, centre{0.0F, 1.0F, 0.0F};
};

namespace site {
inline constexpr Site start{"position before"}, speed{"velocity before"}, tick{"u_Tick"}, drag{"u_Drag"};
inline constexpr Site gravity{"u_Gravity"}, centre{"u_Centre"}, radius{"u_Radius"}, elasticity{"u_Elasticity"};
inline constexpr Site acceleration{"acceleration", "trace_acceleration"}, falling{"falling", "trace_falling"};
inline constexpr Site moved{"moved", "trace_moved"}, away{"away"}, distance{"distance", "trace_distance"};
inline constexpr Site inside{"inside the sphere", "trace_inside", "m"}, normal{"normal", "trace_normal"};
inline constexpr Site into{"speed into the sphere", "trace_into"}, underground{"underground", {}, "m"};
inline constexpr Site position{"position", "position"}, velocity{"velocity", "velocity"}, bounces{"bounces"};
} // namespace site

template <class R> struct Grain {
    typename R::Vec3 position, velocity;
    typename R::Int bounces{};
    auto fields() const { return std::tie(position, velocity, bounces); }
};

/// One grain's step. Twin of shaders/grains_step.vert.
struct Step {
    Constants c;

    template <class R> Grain<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        using Vec3 = typename R::Vec3;
        const auto p = r.read(site::start, in.before.vec3(grains::position, item));
        const auto v = r.read(site::speed, in.before.vec3(grains::velocity, item));
        const auto tick = r.uniform(site::tick, c.tick);
        Grain<R> g;
        g.bounces = r.uniform(site::bounces, in.before.integer(grains::bounces, item));
        const Vec3 acceleration =
            r.note(site::acceleration, r.uniform(site::gravity, c.gravity) - v * r.uniform(site::drag, c.drag));
        g.velocity = r.note(site::falling, v + acceleration * tick);
        g.position = r.note(site::moved, p + g.velocity * tick);
        const Vec3 centre = r.uniform(site::centre, c.centre);
        const Vec3 away = r.note(site::away, g.position - centre);
        const auto radius = r.uniform(site::radius, c.radius);
        if (r.decide(site::inside, r.note(site::distance, r.length(site::distance, away)) < radius)) {
            const Vec3 normal = r.note(site::normal, r.normalize(site::normal, away));
            const auto into = r.note(site::into, r.dot(site::into, g.velocity, normal));
            g.velocity = g.velocity - normal * (into * (1.0F + r.uniform(site::elasticity, c.elasticity)));
            g.position = centre + normal * radius;
            g.bounces = g.bounces + 1;
        }
        if (r.decide(site::underground, g.position.y < 0.0F)) {
            g.position.y = 0.0F;
            g.velocity = Vec3{};
        }
        g.position = r.note(site::position, g.position);
        g.velocity = r.note(site::velocity, g.velocity);
        return g;
    }
};

/// What the host hands the shader.
inline Uniforms uniforms(int /*frame*/) {
    const Constants c;
    return {{"u_Tick", c.tick},     {"u_Drag", c.drag},       {"u_Elasticity", c.elasticity},
            {"u_Radius", c.radius}, {"u_Gravity", c.gravity}, {"u_Centre", c.centre}};
}

inline std::vector<GlPass> passes() {
    return {{.name = "grains_step", .stage = Stage::vertex, .resource = 0, .uniforms = uniforms}};
}

/// `count` grains over the sphere.
inline System system(std::size_t count, const Constants& constants = {}) {
    System grains{.name = "grains",
                  .schema = schema(),
                  .passes = {},
                  .mistakes = {},
                  .start = {schema(), {{count}}},
                  .settings = {}};
    grains.passes.push_back(item_pass({.name = "grains_step"}, Step{constants}));
    grains.mistakes = {
        {"gravity_missing", "gravity is not added", "grains_step", mistake_at(site::gravity, Change::zero)},
        {"normal_not_normalised", "the sphere's normal is not normalised", "grains_step",
         mistake_at(site::normal, Change::not_done)}};
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = [&](std::uint32_t k) { // in [-1, 1), the same everywhere
            std::uint32_t h = static_cast<std::uint32_t>(i) * 2654435761U + k * 2246822519U;
            h = (h ^ (h >> 15U)) * 2246822519U;
            return static_cast<float>(h >> 8U) * 0x1p-23F - 1.0F;
        };
        grains.start.set(position, i, glm::vec3(at(1), 3.0F + at(2), at(3)));
        grains.start.set(velocity, i, glm::vec3(at(4), at(5), at(6)));
    }
    return grains;
}

} // namespace grains
