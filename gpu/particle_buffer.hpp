#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "reference/model/particles.hpp"

namespace lockstep {

/// One particle as transform feedback writes it: 32 bytes, no gaps, the order of the captured outputs
/// out_Position, out_Speed, out_Dir, out_CollideTime (spec, "Names a foreign shader must use").
struct ParticleRecord {
    glm::vec3 position;
    float speed;
    glm::vec3 direction;
    float collide_time;
};
static_assert(sizeof(ParticleRecord) == 32);

/// What a program that writes a ParticleBuffer captures.
const std::array<Capture, 4>& particle_captures();

/// `count` particles in GL memory; particle i at byte 32 i. Contents are undefined at first.
class ParticleBuffer {
  public:
    /// Throws Error if GL has not the memory.
    explicit ParticleBuffer(std::size_t count);

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] GLuint id() const { return buffer_.id(); }

    /// Bit for bit; `particles` has size() of them.
    void upload(const Particles& particles);
    void read(Particles& particles) const;

    /// Whether it has exactly these bits, without a copy.
    [[nodiscard]] bool holds(const Particles& particles) const;

    /// Every 32-bit word becomes `word`: what a pass did not write then shows.
    void fill(std::uint32_t word);

    /// Binds the buffer as what transform feedback writes to.
    void bind_capture() const;

  private:
    GlBuffer buffer_;
    std::size_t count_;
};

/// Feeds a_Position, a_Dir, a_Speed and a_CollideTime of `program` from `buffer`. Throws Error if one has a wrong type.
GlVertexArray particle_vertex_array(const ParticleBuffer& buffer, const Program& program);

} // namespace lockstep
