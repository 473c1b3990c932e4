#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/record/hdf5.hpp"

namespace lockstep {

/// A recording's HDF5 file while it grows: H5MD, a chunk a row, shuffled, deflated, each with a Fletcher-32 checksum;
/// room for the seal before it (seal.hpp). The same calls leave the same bytes. Every function throws Error.
class GrowingFile {
  public:
    /// `name`: how errors begin. `deflate`: zlib's level, 0 to 9.
    GrowingFile(const std::filesystem::path& temporary, std::string name, int deflate);
    void finish();

  protected:
    /// A dataset that gets row after row.
    struct Rows {
        hdf5::Id set;
        hdf5::Extents extents;
        hsize_t count = 0;
    };

    [[nodiscard]] hdf5::Id dataset_creation() const;
    [[nodiscard]] hdf5::Id make_group(const std::string& path) const;
    void write_text(const std::string& path, const std::string& text) const;
    void write_attribute(hid_t object, const char* name, const std::string& text) const;
    void write_attribute(hid_t object, const char* name, hid_t type, const std::vector<int>& values) const;
    template <class Value> void write_array(const std::string& path, hid_t type, const hdf5::Extents& extents,
                                            const std::vector<Value>& values) const {
        write_array(path, type, extents, static_cast<const void*>(values.data()));
    }
    void write_array(const std::string& path, hid_t type, const hdf5::Extents& extents, const void* values) const;
    [[nodiscard]] Rows make_rows(const std::string& path, hid_t type, const hdf5::Extents& extents,
                                 hsize_t rows_a_chunk) const;
    void append(Rows& rows, hid_t memory_type, const void* values) const;
    /// What H5MD asks of every file.
    void write_head() const;

    std::string name_; ///< to complain about
    int deflate_;
    hdf5::Id links_; ///< makes the groups on the way to a new object
    hdf5::Id file_;
};

} // namespace lockstep
