#pragma once
#include <filesystem>
#include <memory>

#include "crosscheck/collision/record/trace_info.hpp"
#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/record/reading_process.hpp"
#include "crosscheck/record/seal.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// A trace, open for reading. The seal is checked first (seal.hpp), then a process of its own reads the same file
/// (reading_process.hpp), one frame ahead of what is asked for. Every function throws Error naming the file, also where
/// somebody writes it meanwhile.
class TraceReader {
  public:
    explicit TraceReader(const std::filesystem::path& file);
    ~TraceReader();
    TraceReader(const TraceReader&) = delete;
    TraceReader& operator=(const TraceReader&) = delete;

    [[nodiscard]] const TraceInfo& info() const { return info_; }
    [[nodiscard]] const Seal& seal() const { return seal_; }

    /// The state after `frame`, counted from 0; -1: the start. Frames in order are read ahead, others take longer.
    void read(int frame, Particles& particles);
    void read(int frame, CollisionImage& cdt); ///< needs info().has_cdt

  private:
    OpenedFile file_;
    Seal seal_;
    std::unique_ptr<ReadingProcess> process_;
    TraceInfo info_;
};

} // namespace lockstep
