#pragma once
#include <cstddef>
#include <string>

#include "gpu/probe/judge.hpp"
#include "gpu/program.hpp"

namespace lockstep::probing {

/// A program of one compute shader, `name`.comp, in groups of 64.
class ComputeStage {
  public:
    explicit ComputeStage(const std::string& name);

    [[nodiscard]] const Program& program() const { return program_; }

    /// What it writes into buffer 1, `results` floats, from what is given in buffer 0. `invocations`: a multiple of 64.
    [[nodiscard]] Floats run(const Floats& given, std::size_t results, std::size_t invocations) const;

    /// What it makes of buffer 0 in place.
    [[nodiscard]] Floats run(const Floats& values, std::size_t invocations) const;

  private:
    void dispatch(std::size_t invocations) const;

    Program program_;
};

} // namespace lockstep::probing
