#include "gpu/collision/particle_buffer.hpp"

#include "reference/model/collision/collision_state.hpp"

namespace lockstep {

const RecordLayout& particle_records() {
    static const RecordLayout layout{&collision_schema(),
                                     collision::particles,
                                     {{collision::position.field, "Position"},
                                      {collision::speed.field, "Speed"},
                                      {collision::direction.field, "Dir"},
                                      {collision::collide_time.field, "CollideTime"}}};
    return layout;
}

void ParticleBuffer::upload(const Particles& particles) { RecordBuffer::upload(view(particles)); }

void ParticleBuffer::read(Particles& particles) const {
    particles.resize(size());
    RecordBuffer::read(view(particles));
}

bool ParticleBuffer::holds(const Particles& particles) const { return RecordBuffer::holds(view(particles)); }

} // namespace lockstep
