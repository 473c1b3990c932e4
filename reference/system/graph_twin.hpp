#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "reference/model/graph.hpp"
#include "reference/readings/constant_divisor.hpp"
#include "reference/readings/site.hpp"
#include "reference/system/force_fields.hpp"
#include "reference/system/pcg3d.hpp"
#include "reference/system/turns.hpp"

/// A graph, interpreted: the twin of what gpu/graph_glsl.hpp makes of it.
namespace lockstep {

inline constexpr Site unnamed_node{"a node"};

/// A place that is known at run time alone. `label` outlives it.
inline Site site_named(std::string_view label) {
    Site site = unnamed_node;
    site.label = label;
    site.id = name_id(label);
    return site;
}

/// The sites of a graph: one a node, and one a number that is given at a port. Keeps their names.
class GraphSites {
  public:
    explicit GraphSites(const Graph& graph) {
        for (const GraphNode& node : graph.nodes) {
            names_.push_back("node " + node.id);
            names_.push_back("numbers of " + node.id);
        }
        sites_.reserve(names_.size());
        for (const std::string& name : names_)
            sites_.push_back(site_named(name));
    }
    GraphSites(const GraphSites&) = delete;
    GraphSites& operator=(const GraphSites&) = delete;
    ~GraphSites() = default;

    [[nodiscard]] const Site& of(std::size_t node) const { return sites_[2 * node]; }
    [[nodiscard]] const Site& numbers(std::size_t node) const { return sites_[2 * node + 1]; }

  private:
    std::vector<std::string> names_;
    std::vector<Site> sites_;
};

/// A value of a graph in a reading: floats, or a uint or truth.
template <class R> struct GraphNumber {
    std::array<typename R::Real, 4> x{};
    std::uint32_t whole = 0;
};

/// What a graph is evaluated for, besides its inputs.
struct GraphSurroundings {
    std::uint32_t seed = 1; ///< of random numbers
    bool difference_curl = false;
};

/// One invocation of a graph.
template <class R> class GraphRun {
    using Real = typename R::Real;
    using Vec3 = typename R::Vec3;
    using Number = GraphNumber<R>;

  public:
    GraphRun(R& reading, const Graph& graph, const GraphSites& sites, const GraphSurroundings& surroundings)
        : r(reading), graph_(graph), sites_(sites), around_(surroundings) {}

    /// `input(i)`: the stage's i-th. Afterwards `output` gives what the graph makes.
    template <class Input> void run(const Input& input) {
        values_.assign(graph_.nodes.size(), {});
        const auto& inputs = graph_.stage->inputs;
        for (std::size_t i = 0; i < inputs.size(); ++i)
            if (inputs[i].name == "serial")
                serial_ = input(i).whole;
        for (const std::size_t n : graph_.order)
            values_[n] = noted(n, graph_.nodes[n].kind == GraphKind::input ? input(graph_.nodes[n].of_stage) : made(n));
    }
    /// What node `n`, which is no input, makes of what `given(m)` says that each node m before it made.
    template <class Given> Number evaluated(std::size_t n, const Given& given) {
        values_.assign(graph_.nodes.size(), {});
        std::set<std::size_t> before;
        for (const GraphSource& source : graph_.nodes[n].inputs)
            if (source.node && before.insert(*source.node).second)
                values_[*source.node] = given(*source.node);
        return noted(n, made(n));
    }
    [[nodiscard]] Number output(const Graph::Output& output) const {
        const GraphType type = graph_.stage->outputs[output.of_stage].type;
        return value(output.source, type, output.source.node.value_or(0));
    }
    [[nodiscard]] const Number& node(std::size_t n) const { return values_[n]; }

  private:
    /// As the type that takes it; numbers belong to node `n`.
    [[nodiscard]] Number value(const GraphSource& source, GraphType type, std::size_t n) const {
        Number found;
        const std::size_t count = graph_components(type);
        if (!source.node) {
            found.whole = source.whole;
            for (std::size_t c = 0; c < count; ++c)
                found.x[c] = r.read(sites_.numbers(n), source.numbers[c]);
            return found;
        }
        found = values_[*source.node];
        if (source.part >= 0)
            found.x[0] = found.x[static_cast<std::size_t>(source.part)];
        if (source.type == GraphType::real)
            found.x.fill(Real(found.x[0]));
        return found;
    }

    Number noted(std::size_t n, Number made) const {
        const Site& site = sites_.of(n);
        switch (graph_.nodes[n].makes) {
        case GraphType::real:
            made.x[0] = r.note(site, made.x[0]);
            break;
        case GraphType::vec2: {
            const auto v = r.note(site, typename R::Vec2{made.x[0], made.x[1]});
            made.x = {v.x, v.y};
            break;
        }
        case GraphType::vec3: {
            const auto v = r.note(site, Vec3{made.x[0], made.x[1], made.x[2]});
            made.x = {v.x, v.y, v.z};
            break;
        }
        case GraphType::vec4: {
            const auto v = r.note(site, typename R::Vec4{made.x[0], made.x[1], made.x[2], made.x[3]});
            made.x = {v.x, v.y, v.z, v.w};
            break;
        }
        case GraphType::uint:
            made.whole = static_cast<std::uint32_t>(
                static_cast<int>(r.note(site, typename R::Int(static_cast<int>(made.whole)))));
            break;
        case GraphType::boolean:
            made.whole = r.decide(site, made.whole != 0) ? 1 : 0;
            break;
        }
        return made;
    }

    Number made(std::size_t n) const {
        using enum GraphKind;
        const GraphNode& node = graph_.nodes[n];
        const Site& site = sites_.of(n);
        const std::size_t count = graph_components(node.takes);
        const auto at = [&](std::size_t port, GraphType type) { return value(node.inputs[port], type, n); };
        const auto shared = [&](std::size_t port) { return at(port, node.takes); };
        const auto each = [&](const auto& make) {
            Number all;
            for (std::size_t c = 0; c < count; ++c)
                all.x[c] = make(c);
            return all;
        };
        const auto truth = [](bool yes) { return Number{{}, yes ? 1U : 0U}; };
        const auto vec3 = [&](std::size_t port) {
            const Number v = at(port, GraphType::vec3);
            return Vec3{v.x[0], v.x[1], v.x[2]};
        };
        const auto real = [&](std::size_t port) { return at(port, GraphType::real).x[0]; };
        const auto of_vec3 = [](const Vec3& v) { return Number{{v.x, v.y, v.z}, 0}; };
        const auto of_real = [](const Real& x) { return Number{{x}, 0}; };
        const auto smaller = [&](const Real& a, const Real& b) { return r.decide(site, a < b) ? a : b; };
        const auto greater = [&](const Real& a, const Real& b) { return r.decide(site, b < a) ? a : b; };
        switch (node.kind) {
        case constant:
        case parameter:
            return value(node.value, node.makes, n);
        case input:
            break;
        case add: {
            const Number a = shared(0), b = shared(1);
            return each([&](std::size_t c) { return a.x[c] + b.x[c]; });
        }
        case subtract: {
            const Number a = shared(0), b = shared(1);
            return each([&](std::size_t c) { return a.x[c] - b.x[c]; });
        }
        case multiply: {
            const Number a = shared(0), b = shared(1);
            return each([&](std::size_t c) { return a.x[c] * b.x[c]; });
        }
        case divide: {
            const Number a = shared(0), b = shared(1);
            return each([&](std::size_t c) {
                return quotient_of(r, site, a.x[c], b.x[c], graph_constant(graph_, node.inputs[1], c));
            });
        }
        case negate: {
            const Number a = shared(0);
            return each([&](std::size_t c) { return Real(0.0F) - a.x[c]; });
        }
        case abs: {
            const Number a = shared(0);
            return each([&](std::size_t c) { return r.abs(a.x[c]); });
        }
        case floor: {
            const Number a = shared(0);
            return each([&](std::size_t c) { return r.floor(a.x[c]); });
        }
        case fract: {
            const Number a = shared(0);
            return each([&](std::size_t c) { return a.x[c] - r.floor(a.x[c]); });
        }
        case min: {
            const Number a = shared(0), b = shared(1);
            return each([&](std::size_t c) { return smaller(a.x[c], b.x[c]); });
        }
        case max: {
            const Number a = shared(0), b = shared(1);
            return each([&](std::size_t c) { return greater(a.x[c], b.x[c]); });
        }
        case clamp: {
            const Number a = shared(0), low = shared(1), high = shared(2);
            return each([&](std::size_t c) { return smaller(greater(a.x[c], low.x[c]), high.x[c]); });
        }
        case mix: {
            const Number a = shared(0), b = shared(1), t = at(2, GraphType::real);
            return each([&](std::size_t c) { return a.x[c] + t.x[0] * (b.x[c] - a.x[c]); });
        }
        case step: {
            const Number edge = shared(0), a = shared(1);
            return each([&](std::size_t c) { return Real(r.decide(site, a.x[c] < edge.x[c]) ? 0.0F : 1.0F); });
        }
        case smoothstep: {
            const Number low = shared(0), high = shared(1), a = shared(2);
            return each([&](std::size_t c) {
                const auto known = [&](std::size_t port) { return graph_constant(graph_, node.inputs[port], c); };
                const Real share =
                    quotient_of(r, site, a.x[c] - low.x[c], high.x[c] - low.x[c],
                                known(0) && known(1) ? std::optional(*known(1) - *known(0)) : std::nullopt);
                const Real t = smaller(greater(share, Real(0.0F)), Real(1.0F));
                return (t * t) * (Real(3.0F) - t * Real(2.0F));
            });
        }
        case sqrt: {
            const Number a = shared(0);
            return each([&](std::size_t c) { return r.sqrt(site, a.x[c]); });
        }
        case dot:
            return of_real(r.dot(site, vec3(0), vec3(1)));
        case cross: {
            const Vec3 a = vec3(0), b = vec3(1);
            return of_vec3({a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x});
        }
        case length:
            return of_real(r.length(site, vec3(0)));
        case normalize:
            return of_vec3(r.normalize(site, vec3(0)));
        case compose: {
            Number all;
            for (std::size_t c = 0; c < node.inputs.size(); ++c)
                all.x[c] = at(c, GraphType::real).x[0];
            return all;
        }
        case split:
            return at(0, node.makes);
        case less:
            return truth(r.decide(site, at(0, GraphType::real).x[0] < at(1, GraphType::real).x[0]));
        case equal: {
            const Number a = shared(0), b = shared(1);
            bool same = node.takes != GraphType::uint || a.whole == b.whole;
            for (std::size_t c = 0; c < count; ++c)
                same = r.decide(site, a.x[c] == b.x[c]) && same;
            return truth(same);
        }
        case logical_and:
            return truth(at(0, GraphType::boolean).whole != 0 && at(1, GraphType::boolean).whole != 0);
        case logical_or:
            return truth(at(0, GraphType::boolean).whole != 0 || at(1, GraphType::boolean).whole != 0);
        case logical_not:
            return truth(at(0, GraphType::boolean).whole == 0);
        case select:
            return at(0, GraphType::boolean).whole != 0 ? shared(1) : shared(2);
        case sin_turns: {
            const Number a = shared(0);
            return each([&](std::size_t c) { return sine_cosine(r, a.x[c]).first; });
        }
        case cos_turns: {
            const Number a = shared(0);
            return each([&](std::size_t c) { return sine_cosine(r, a.x[c]).second; });
        }
        case random:
            return of_vec3(unit_numbers<R>(pcg3d({serial_, around_.seed, node.options.channel})));
        case noise:
        case noise_gradient: {
            const Vec3 x = vec3(0);
            if (!in_noise(r, x))
                return {};
            const Noise<R> of_seed(r, node.options.seed);
            if (node.kind == noise)
                return of_vec3(of_seed.potentials(x));
            return of_vec3(of_seed.all(x)[static_cast<std::size_t>(node.options.potential - 1)].gradient);
        }
        case curl_noise:
            return of_vec3(lockstep::curl_noise(r, vec3(0) * real(1) + vec3(2), real(3), node.options.seed,
                                                around_.difference_curl));
        case drag:
            return of_vec3(Vec3{} - vec3(0) * real(1));
        case vortex: {
            const Vec3 p = vec3(0);
            const Vortex<R> one{vec3(2), r.normalize(site, vec3(1)), real(3), real(4), real(5), node.options.falloff};
            return of_vec3(one.added(r, Vec3{}, p));
        }
        case point_attraction: {
            const Vec3 way = vec3(1) - vec3(0);
            const Real l = r.length(site, way), softening = real(4);
            const Attraction<R> one{real(2), real(3), softening * softening, node.options.falloff,
                                    node.options.inverse_square};
            return of_vec3(one.added(r, Vec3{}, way, l));
        }
        case point:
            return of_vec3(vec3(0));
        case box: {
            const Vec3 low = vec3(1);
            return of_vec3(low + vec3(0) * (vec3(2) - low));
        }
        case sphere: {
            const Vec3 u = vec3(0);
            return of_vec3(vec3(1) + on_circle(r, u.x * 2.0F - 1.0F, u.y) * real(2));
        }
        case cone: {
            const Vec3 u = vec3(0);
            const auto given = [&](const glm::vec3& v) { return r.read(sites_.numbers(n), v); };
            const Real depth = r.read(sites_.numbers(n), node.options.cone_depth);
            const Vec3 local = on_circle(r, Real(1.0F) - u.x * depth, u.y);
            const Basis& basis = node.options.basis;
            return of_vec3((given(basis.side) * local.x + given(basis.up) * local.y) + given(basis.ahead) * local.z);
        }
        case curve:
            return of_real(curve_at(node, site, n, at(0, GraphType::real).x[0]));
        }
        return {};
    }

    Real curve_at(const GraphNode& node, const Site& site, std::size_t n, const Real& t) const {
        const auto number = [&](float x) { return r.read(sites_.numbers(n), x); };
        const auto& keys = node.keys;
        if (!r.decide(site, number(keys.front()[0]) < t))
            return number(keys.front()[1]);
        for (std::size_t k = 1; k < keys.size(); ++k)
            if (r.decide(site, t < number(keys[k][0]))) {
                const Real share = quotient_of(r, site, t - number(keys[k - 1][0]), number(keys[k][0] - keys[k - 1][0]),
                                               std::optional(keys[k][0] - keys[k - 1][0]));
                return number(keys[k - 1][1]) + share * number(keys[k][1] - keys[k - 1][1]);
            }
        return number(keys.back()[1]);
    }

    R& r;
    const Graph& graph_;
    const GraphSites& sites_;
    GraphSurroundings around_;
    std::uint32_t serial_ = 0; ///< of stages that have one
    std::vector<Number> values_;
};

} // namespace lockstep
