#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/record/chunk.hpp"
#include "crosscheck/record/hdf5.hpp"
#include "reference/model/schema.hpp"

namespace lockstep {

/// A recording seen through libhdf5, read only. That library is known to break on files made to break it, so this lives
/// in a process of its own (reading_process.hpp). Every function throws Error: `DATASET: what is wrong; what would be
/// right`.
class RecordedFile {
  public:
    /// libhdf5 opens files by name: throws where the name is another file's by now.
    explicit RecordedFile(const OpenedFile& file);

    /// A text, or nothing where there is none.
    [[nodiscard]] std::string text(const char* path) const;
    [[nodiscard]] std::string program() const;

    [[nodiscard]] std::vector<std::int8_t> root_offsets(const char* path, std::size_t count) const;
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  protected:
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
    void find_head();
    void read_row(const Dataset& dataset, std::size_t row, std::byte* into);
    /// All values of a dataset of int32 with one extent; missing: an error.
    [[nodiscard]] std::vector<std::int32_t> integers(const std::string& path) const;

    hdf5::Id file_;
    ChunkReader chunks_;
    std::vector<std::string> warnings_;
};

namespace hdf5 {

// What readers of a recording ask of HDF5's objects, and how their errors begin.
[[noreturn]] void fail(const std::string& path, const std::string& what);
std::string type_name(hid_t type);
bool is_float32(hid_t type);
bool is_integer(hid_t type, std::size_t bytes, H5T_sign_t sign);
Extents extents_of(hid_t set, const std::string& path);
/// "float32 [60][2000][3]"
std::string shape(const std::string& type, const Extents& extents);
/// Data lies in this file, and all of it was written: else a few bytes could claim to be gigabytes of zeros.
void expect_stored(hid_t set, const Extents& extents, std::size_t value_bytes, const std::string& path);

} // namespace hdf5
} // namespace lockstep
