#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/record/reading_process.hpp"
#include "crosscheck/record/recorded_file.hpp"
#include "reference/model/system_state.hpp"

namespace lockstep {

/// What any recording says in texts and tables.
class RecordedTexts : public RecordedFile {
  public:
    using RecordedFile::program;
    using RecordedFile::RecordedFile;
    using RecordedFile::root_offsets;
    using RecordedFile::text;
};

/// The states of a recorded run of a system, in the reading process.
class SystemFile : public RecordedFile {
  public:
    /// `state`: whose schema and sizes they have to have; outlives this.
    SystemFile(const OpenedFile& file, const SystemState& state) : RecordedFile(file), state_(state) {}

    /// Tells the contents: warnings, and of each buffer and image the frame and pass of each row. Then a row a request.
    void serve(ReadingEnd& end);

  private:
    /// Of a buffer or image.
    struct Columns {
        std::vector<Dataset> fields;
        std::vector<std::int32_t> frames, passes;
    };
    [[nodiscard]] Columns columns(std::uint8_t resource);

    const SystemState& state_;
    std::vector<Columns> resources_;
};

} // namespace lockstep
