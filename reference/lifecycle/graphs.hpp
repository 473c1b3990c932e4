#pragma once
#include <memory>
#include <optional>
#include <string_view>

#include "reference/lifecycle/appearance.hpp"
#include "reference/system/graph_twin.hpp"

/// What an emitter's graphs make of its particles. Twin of what gpu/lifecycle/graphs.hpp writes.
namespace lockstep::lifecycle {

/// A graph with its sites; null: the emitter has none for the stage.
struct StageGraph {
    GraphPtr graph;
    std::shared_ptr<const GraphSites> sites;
    explicit operator bool() const { return graph != nullptr; }
};

inline StageGraph stage_graph(const GraphPtr& graph) {
    return {graph, graph ? std::make_shared<const GraphSites>(*graph) : nullptr};
}

template <class R> GraphNumber<R> graph_number(const typename R::Real& x) { return {{x}, 0}; }
template <class R> GraphNumber<R> graph_number(const typename R::Vec3& v) { return {{v.x, v.y, v.z}, 0}; }
template <class R> GraphNumber<R> graph_number(std::uint32_t whole) { return {{}, whole}; }

/// One invocation, and what it makes: nothing where the graph has no such output.
template <class R> class StageRun {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;

  public:
    /// `input(name)`: what the stage hands it.
    template <class Input>
    StageRun(R& reading, const Host& host, const HostEmitter& of, const StageGraph& stage, const Input& input)
        : stage_(stage), run_(reading, *stage.graph, *stage.sites,
                              {of.seed, host.switches().curl_derivative == CurlDerivative::difference}) {
        const auto& inputs = stage.graph->stage->inputs;
        run_.run([&](std::size_t i) { return input(inputs[i].name); });
    }
    [[nodiscard]] std::optional<GraphNumber<R>> number(std::string_view name) const {
        const Graph::Output* const output = output_named(*stage_.graph, name);
        return output != nullptr ? std::optional(run_.output(*output)) : std::nullopt;
    }
    [[nodiscard]] std::optional<Real> real(std::string_view name) const {
        const auto x = number(name);
        return x ? std::optional(x->x[0]) : std::nullopt;
    }
    [[nodiscard]] std::optional<Vec3> vec3(std::string_view name) const {
        const auto x = number(name);
        return x ? std::optional(Vec3{x->x[0], x->x[1], x->x[2]}) : std::nullopt;
    }

  private:
    const StageGraph& stage_;
    GraphRun<R> run_;
};

/// What a particle hands the graph of its simulation or rendering; `u` and `v`: of rendering.
template <class R> GraphNumber<R> value_of(R& r, const Host& host, const Particle<R>& particle, float time,
                                           std::string_view name, const typename R::Real& u = 0.0F,
                                           const typename R::Real& v = 0.0F) {
    using Real = typename R::Real;
    const float tick = host.settings().tick;
    const auto seconds = [&](const Real& t) { return particle.counts_ticks() ? t * r.uniform(site::tick, tick) : t; };
    const auto color = [&](bool end) {
        const auto c = particle.color(end);
        return GraphNumber<R>{{c[0], c[1], c[2], c[3]}, 0};
    };
    if (name == "position")
        return graph_number<R>(particle.position());
    if (name == "velocity")
        return graph_number<R>(particle.velocity());
    if (name == "acceleration")
        return graph_number<R>(particle.acceleration());
    if (name == "remaining")
        return graph_number<R>(seconds(particle.remaining()));
    if (name == "lifetime")
        return graph_number<R>(seconds(particle.lifetime()));
    if (name == "t")
        return graph_number<R>(age_of(r, particle));
    if (name == "spawn_time")
        return graph_number<R>(seconds(particle.spawn_time()));
    if (name == "time")
        return graph_number<R>(r.uniform(site::time, time));
    if (name == "tick")
        return graph_number<R>(r.uniform(site::tick, tick));
    if (name == "initial_size" || name == "end_size")
        return graph_number<R>(particle.sizes()[name == "end_size" ? 1 : 0]);
    if (name == "initial_color" || name == "end_color")
        return color(name == "end_color");
    return graph_number<R>(name == "u" ? u : v);
}

} // namespace lockstep::lifecycle
