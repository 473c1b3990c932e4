#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/record/hdf5.hpp"
#include "crosscheck/record/layout.hpp"
#include "crosscheck/record/recorded_file.hpp"

namespace lockstep {

/// A recording whose states are one buffer of particles and, perhaps, a CDT a frame.
class TraceFile : public RecordedFile {
  public:
    /// `buffer`: what its particles have; outlives this.
    TraceFile(const OpenedFile& file, const Resource& buffer);

    /// The shape and type of everything in it, but no values. Comes before all that follows.
    void look_at_contents();

    [[nodiscard]] std::size_t rows() const { return rows_; } ///< states: the start, and one a whole frame
    [[nodiscard]] std::size_t particles() const { return particles_; }
    [[nodiscard]] bool has_velocity() const { return has_velocity_; } ///< as directions; speeds are 1
    [[nodiscard]] bool has_cdt() const { return cdt_.set.get() >= 0; }
    [[nodiscard]] const hdf5::Extents& cdt_extents() const { return cdt_.extents; } ///< height, width, 4

    /// Bytes of one state.
    [[nodiscard]] std::size_t particle_bytes() const { return particles_ * item_bytes(*buffer_); }
    [[nodiscard]] std::size_t cdt_bytes() const;

    /// All values of the buffer's first field, then of the second, and so on.
    void read_particles(std::size_t row, std::byte* into);
    void read_cdt(std::size_t frame, std::byte* into);

    /// Values of a small dataset, or nothing where there is none.
    [[nodiscard]] std::vector<std::int32_t> counts() const;
    [[nodiscard]] std::vector<float> obstacle_positions() const;
    [[nodiscard]] std::vector<std::uint32_t> obstacle_triangles() const;

  private:
    std::size_t find_particles();
    void find_velocity();
    /// Where the values of a field are; empty: nowhere, they are 1.
    [[nodiscard]] std::string path_of(const Field& field) const;
    void find_cdt(std::size_t rows_of_particles);
    const Resource* buffer_;      ///< that its particles are
    std::vector<Dataset> fields_; ///< the buffer's; without a set where all values are 1
    bool has_velocity_ = false;
    Dataset cdt_;
    std::size_t rows_ = 0;
    std::size_t particles_ = 0;
};

} // namespace lockstep
