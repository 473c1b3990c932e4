#pragma once
#include <filesystem>
#include <memory>

#include "crosscheck/collision/record/trace_info.hpp"
#include "crosscheck/files/atomic_file.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// Writes a trace (docs/traces.md): H5MD 1.1, a chunk a frame and field, shuffled, deflated, each with a Fletcher-32
/// checksum, the whole sealed (seal.hpp). The file gets its name at commit(), or goes away.
/// Every function throws Error naming the path.
class TraceWriter {
  public:
    /// Writes everything but the states; row 0 of the particles is info.scene.start.
    /// `deflate`: zlib's level, 0 to 9.
    TraceWriter(std::filesystem::path path, const TraceInfo& info, int deflate = 1);
    ~TraceWriter();
    TraceWriter(const TraceWriter&) = delete;
    TraceWriter& operator=(const TraceWriter&) = delete;

    /// The state after the next frame. `cdt`: null if info.has_cdt is not set.
    void add(const Particles& particles, const CollisionImage* cdt);

    void commit();

  private:
    class File;

    AtomicFile target_;
    std::filesystem::path temporary_;
    std::unique_ptr<File> file_;
};

} // namespace lockstep
