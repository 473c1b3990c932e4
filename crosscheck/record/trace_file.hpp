#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/record/chunk.hpp"
#include "crosscheck/record/hdf5.hpp"
#include "crosscheck/record/layout.hpp"

namespace lockstep {

/// A trace seen through libhdf5, read only. That library is known to break on files made to break it, so this lives in
/// a process of its own (trace_process.hpp). Every function throws Error: `DATASET: what is wrong; what would be
/// right`.
class TraceFile {
  public:
    /// `buffer`: what its particles have; outlives this. libhdf5 opens files by name: throws too where the name is
    /// another file's by now.
    TraceFile(const OpenedFile& file, const Resource& buffer);

    /// The shape and type of everything in it, but no values. Comes before all that follows.
    void look_at_contents();

    [[nodiscard]] std::size_t rows() const { return rows_; } ///< states: the start, and one a whole frame
    [[nodiscard]] std::size_t particles() const { return particles_; }
    [[nodiscard]] bool has_cdt() const { return cdt_.set.get() >= 0; }
    [[nodiscard]] const hdf5::Extents& cdt_extents() const { return cdt_.extents; } ///< height, width, 4
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// Bytes of one state.
    [[nodiscard]] std::size_t particle_bytes() const { return particles_ * item_bytes(*buffer_); }
    [[nodiscard]] std::size_t cdt_bytes() const;

    /// All values of the buffer's first field, then of the second, and so on.
    void read_particles(std::size_t row, std::byte* into);
    void read_cdt(std::size_t frame, std::byte* into);

    /// A text, or nothing where there is none.
    [[nodiscard]] std::string text(const char* path) const;
    [[nodiscard]] std::string program() const;

    /// Values of a small dataset, or nothing where there is none.
    [[nodiscard]] std::vector<float> obstacle_positions() const;
    [[nodiscard]] std::vector<std::uint32_t> obstacle_triangles() const;
    [[nodiscard]] std::vector<std::int8_t> root_offsets(const char* path, std::size_t count) const;

  private:
    struct Dataset {
        hdf5::Id set;
        hdf5::Id type;
        std::string path;
        hsize_t rows = 0;
        hdf5::Extents extents; ///< of a row
        hid_t memory = -1;     ///< what its values are read as
    };

    [[nodiscard]] bool exists(const std::string& path) const;
    [[nodiscard]] hdf5::Id open_dataset(const std::string& path) const;
    [[nodiscard]] Dataset values(const std::string& path, Scalar scalar, const std::string& right,
                                 const hdf5::Extents& last) const;
    std::size_t find_particles();
    void find_cdt(std::size_t rows_of_particles);
    void find_head();
    void read_row(const Dataset& dataset, std::size_t row, std::byte* into);

    hdf5::Id file_;
    ChunkReader chunks_;
    const Resource* buffer_; ///< that its particles are
    std::vector<Dataset> fields_;
    Dataset cdt_;
    std::size_t rows_ = 0;
    std::size_t particles_ = 0;
    std::vector<std::string> warnings_;
};

} // namespace lockstep
