#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gpu/captured_vertex.hpp"
#include "gpu/program.hpp"
#include "gpu/record_buffer.hpp"

namespace lockstep {

/// Stages whose outputs are captured while one item is drawn by itself: those that one draw can capture.
class VertexCapture {
  public:
    VertexCapture(const std::string& name, std::span<const ShaderSource> stages, std::vector<Capture> captured);

    /// Its uniforms are the caller's to set.
    [[nodiscard]] const Program& program() const { return program_; }

    /// Draws item `item` of `from`, `instances` times: a vertex each.
    [[nodiscard]] std::vector<CapturedVertex> run(const RecordBuffer& from, std::size_t item, int instances) const;

  private:
    std::vector<Capture> captured_;
    Program program_;
};

/// As many as `captured` outputs take. Throws Error for one that cannot be captured.
std::vector<VertexCapture> vertex_captures(const std::string& name, std::span<const ShaderSource> stages,
                                           std::span<const Capture> captured);

} // namespace lockstep
