#pragma once
#include "reference/lifecycle/graphs.hpp"
#include "reference/system/turns.hpp"

namespace lockstep::lifecycle {

/// What a particle is born with. Twin of shaders/lifecycle/emission.glsl.
template <class R> class Emission {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    Emission(R& reading, const Host& host, const HostEmitter& of, const StageGraph& graph, int frame)
        : r(reading), host_(host), of_(of), graph_(graph), at_(of.settings()), frame_(frame) {}

    /// Particle `k` of this frame's `emitted`, in a slot of the emitter.
    ItemWords<R> particle(std::size_t slot, std::uint32_t serial, std::uint32_t k, std::uint32_t emitted) const {
        const std::optional<StageRun<R>> graph = run(serial, k, emitted);
        const auto real = [&](const char* name, const auto& own) {
            const auto made = graph ? graph->real(name) : std::nullopt;
            return made ? *made : own();
        };
        const auto vec3 = [&](const char* name, const auto& own) {
            const auto made = graph ? graph->vec3(name) : std::nullopt;
            return made ? *made : own();
        };
        Particle<R> born(r, host_);
        born.at(slot, frame_);
        born.set_position(r.note(site::position, vec3("position", [&] { return place(serial, k, emitted); })));
        born.set_velocity(r.note(site::velocity, vec3("velocity", [&] { return velocity(serial); })));
        born.set_acceleration(r.note(site::acceleration, vec3("acceleration", [&] {
                                         return r.uniform(site::born_acceleration, at_.acceleration);
                                     })));
        born.set_birth(within_lifetimes(real("lifetime", [&] { return life(serial); })),
                       r.uniform(site::time, host_.time(frame_)), k);
        const Real size = real("initial_size", [&] { return r.uniform(site::initial_size, at_.size[0]); });
        born.set_sizes(size, real("end_size", [&] { return r.uniform(site::end_size, at_.size[1]); }));
        for (const bool end : {false, true}) {
            const auto made = graph ? graph->number(end ? "end_color" : "initial_color") : std::nullopt;
            const glm::vec4& own = at_.color[end ? 1 : 0];
            if (made)
                born.set_color(end, {made->x[0], made->x[1], made->x[2]}, made->x[3]);
            else
                born.set_color(end, r.uniform(end ? site::end_color : site::initial_color, glm::vec3(own)),
                               r.uniform(end ? site::end_opacity : site::initial_opacity, own.a));
        }
        return born.record();
    }
    /// Whether the place of such a particle is clamped.
    bool clamps(std::size_t slot, std::uint32_t serial, std::uint32_t k, std::uint32_t emitted) const {
        Particle<R> born(r, host_);
        born.at(slot, frame_);
        const std::optional<StageRun<R>> graph = run(serial, k, emitted);
        const auto made = graph ? graph->vec3("position") : std::nullopt;
        born.set_position(made ? *made : place(serial, k, emitted));
        return born.was_clamped();
    }

  private:
    /// Of a channel, in [0, 1).
    Vec3 random(std::uint32_t serial, int channel, At place = site::channel) const {
        const auto ch = static_cast<int>(r.note(place, typename R::Int(channel)));
        const Bits3 bits = pcg3d({serial, of_.seed, static_cast<std::uint32_t>(ch)});
        return r.note(site::random, unit_numbers<R>(bits));
    }
    static Real symmetric(const Real& u) { return u * 2.0F - 1.0F; }

    Vec3 place(std::uint32_t serial, std::uint32_t k, std::uint32_t emitted) const {
        const Vec3 low = r.uniform(site::shape_low, at_.min);
        Vec3 p = low;
        if (at_.shape == Emitter::Shape::box) {
            const Vec3 u = random(serial, 0);
            p = low + u * r.uniform(site::shape_size, at_.max - at_.min);
        } else if (at_.shape == Emitter::Shape::sphere) {
            const Vec3 u = random(serial, 0);
            p = low + on_circle(r, symmetric(u.x), u.y) * r.uniform(site::radius, at_.radius);
        }
        p = r.note(site::shape_place, p);
        const Vec3 now = r.uniform(site::origin, of_.origin(frame_));
        if (host_.switches().spawn_spread == SpawnSpread::point)
            return p + now;
        const Vec3 last = r.uniform(site::last_origin, of_.origin(frame_ - 1));
        const Real share = r.note(site::share, r.divide(site::share, R::real(k) + Real(0.5F), R::real(emitted)));
        return p + r.note(site::place_of_emitter, last + (now - last) * share);
    }

    Vec3 velocity(std::uint32_t serial) const {
        const Vec3 u = random(serial, 1);
        const Vec3 ahead = r.uniform(site::direction, of_.basis.ahead);
        Vec3 way;
        if (at_.cone >= 0.0F) {
            const Vec3 local = on_circle(r, Real(1.0F) - u.x * r.uniform(site::cone_depth, of_.cone_depth), u.y);
            way = (r.uniform(site::side, of_.basis.side) * local.x + r.uniform(site::up, of_.basis.up) * local.y) +
                  ahead * local.z;
        } else {
            const Real jitter = r.uniform(site::jitter, at_.direction_jitter);
            way = ahead + Vec3{symmetric(u.x) * jitter, symmetric(u.y) * jitter, symmetric(u.z) * jitter};
        }
        const Real more = symmetric(random(serial, 2).x) * r.uniform(site::speed_jitter, at_.speed_jitter);
        const Real speed = r.note(site::speed_of_birth, r.uniform(site::speed, at_.speed) * (Real(1.0F) + more));
        return r.note(site::direction_of_birth, way) * speed;
    }

    Real life(std::uint32_t serial) const {
        const Real shortest = r.uniform(site::shortest, at_.lifetime[0]);
        const Real longest = r.uniform(site::longest, at_.lifetime[1]);
        const Vec3 share = r.note(site::random_of_life, random(serial, 2, site::channel_of_life));
        return r.note(site::share_of_life, shortest + share.y * (longest - shortest));
    }

    /// Whatever a graph says; of NaN the shortest.
    Real within_lifetimes(Real life) const {
        const Real shortest = r.uniform(site::shortest, at_.lifetime[0]);
        const Real longest = r.uniform(site::longest, at_.lifetime[1]);
        if (!r.decide(site::long_enough, life > shortest))
            life = shortest;
        if (r.decide(site::too_long, life > longest))
            life = longest;
        return life;
    }

    /// Of the graph, where there is one.
    std::optional<StageRun<R>> run(std::uint32_t serial, std::uint32_t k, std::uint32_t emitted) const {
        if (!graph_)
            return {};
        return StageRun<R>(r, host_, of_, graph_, [&](std::string_view name) {
            if (name == "time")
                return graph_number<R>(r.uniform(site::time, host_.time(frame_)));
            if (name == "emitter_position")
                return graph_number<R>(r.uniform(site::origin, of_.origin(frame_)));
            if (name == "emitter_velocity")
                return graph_number<R>(r.uniform(site::origin_velocity, of_.origin_velocity(frame_)));
            return graph_number<R>(name == "serial"           ? serial
                                   : name == "order_in_frame" ? k
                                   : name == "emitted"        ? emitted
                                                              : static_cast<std::uint32_t>(frame_));
        });
    }

    R& r;
    const Host& host_;
    const HostEmitter& of_;
    const StageGraph& graph_;
    const Emitter& at_;
    int frame_;
};

} // namespace lockstep::lifecycle
