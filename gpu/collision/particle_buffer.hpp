#pragma once
#include <cstddef>

#include "gpu/record_buffer.hpp"
#include "reference/model/collision/particles.hpp"

namespace lockstep {

/// One particle as transform feedback writes it: 32 bytes, the order of the captured outputs out_Position, out_Speed,
/// out_Dir, out_CollideTime (docs/own_shader.md).
const RecordLayout& particle_records();

/// `count` particles in GL memory; particle i at byte 32 i.
class ParticleBuffer : public RecordBuffer {
  public:
    explicit ParticleBuffer(std::size_t count, std::size_t spare = 0)
        : RecordBuffer(particle_records(), count, spare) {}

    /// As RecordBuffer has them, of size() particles.
    void upload(const Particles& particles);
    void read(Particles& particles) const;
    [[nodiscard]] bool holds(const Particles& particles) const;
};

} // namespace lockstep
