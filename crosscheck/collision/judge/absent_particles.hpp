#pragma once
#include <cstddef>

#include "reference/model/collision/particles.hpp"

namespace lockstep {

/// The particles of a state that are not there in a frame: those from a count on. While hidden they are NaN in every
/// field, so that nobody searches for them or draws them, and any of them equals any other.
class AbsentParticles {
  public:
    /// Those from `count` on.
    void hide(Particles& particles, std::size_t count);

    /// What hide() took, back where it was.
    void put_back(Particles& particles) const;

  private:
    Particles taken_;
};

} // namespace lockstep
