#pragma once
#include <string>
#include <utility>
#include <vector>

#include <hdf5.h>

#include "reference/model/schema.hpp"

namespace lockstep::hdf5 {

/// An open HDF5 object; closed when it dies, but not on the way of an exception: some builds of the library end the
/// program where a file is closed that could not be written.
class Id {
  public:
    using Close = herr_t (*)(hid_t);

    Id() = default;
    /// Throws Error, `WHAT: the library's reason`, where `id` says that opening failed.
    Id(hid_t id, Close close, const std::string& what);
    ~Id();
    Id(Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Id& operator=(Id&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }

    [[nodiscard]] hid_t get() const { return id_; }

  private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

/// What a dataset has a row of: the extents after the first, which counts rows.
using Extents = std::vector<hsize_t>;

/// Throws Error like Id where the library says that something failed.
void expect(herr_t status, const std::string& what);

/// The `count` values of a data set. Throws Error.
template <class Value>
std::vector<Value> read_all(hid_t set, hid_t memory_type, std::size_t count, const std::string& path) {
    std::vector<Value> values(count);
    expect(H5Dread(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
    return values;
}

/// What words of a state are in a file, and here.
hid_t file_type(Scalar scalar);
hid_t memory_type(Scalar scalar);

/// Before the library is used: it is not to print its own error stack, nor to write to its files once more when the
/// program ends, which crashes where a full disk kept one from being closed.
void quieten();

} // namespace lockstep::hdf5
