#include "reference/model/collision/collision_state.hpp"

#include <tuple>

namespace lockstep {
namespace {

/// In the schema's order; of one particle or of many.
template <class State> auto fields(State& state) {
    return std::tie(state.position, state.direction, state.speed, state.collide_time);
}

} // namespace

const Schema& collision_schema() {
    static const Schema schema = checked({"collision",
                                          {{.name = "particles",
                                            .item = "particle",
                                            .title = "the particles",
                                            .fields = {{"position", Scalar::float32, 3, "world units"},
                                                       {"direction", Scalar::float32, 3},
                                                       {"speed", Scalar::float32, 1, "world units a second"},
                                                       {"collide_time", Scalar::float32, 1, "seconds"}}},
                                           {.name = "cdt",
                                            .item = "texel",
                                            .title = "the CDT",
                                            .fields = {{"texel", Scalar::float32, 4, "stored codes"}},
                                            .dimensions = 2}}});
    return schema;
}

View view(const Particles& particles) {
    return state_view::of<const std::byte>(collision_schema(), collision::particles, {particles.size()},
                                           fields(particles));
}

WritableView view(Particles& particles) {
    return state_view::of<std::byte>(collision_schema(), collision::particles, {particles.size()}, fields(particles));
}

View view(const ParticleState& particle) {
    return state_view::of<const std::byte>(collision_schema(), collision::particles, {1}, fields(particle));
}

WritableView view(ParticleState& particle) {
    return state_view::of<std::byte>(collision_schema(), collision::particles, {1}, fields(particle));
}

View view(const CollisionImage& cdt) { return view_of(collision_schema(), collision::cdt, cdt); }

} // namespace lockstep
