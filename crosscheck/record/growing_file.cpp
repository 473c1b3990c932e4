#include "crosscheck/record/growing_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/record/seal.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

using hdf5::expect;
using hdf5::Extents;
using hdf5::Id;

namespace {

constexpr hsize_t largest_chunk = hsize_t{4} << 20U; // bytes
constexpr std::size_t first_blocks = 4096;           // bytes, of what HDF5 writes when it creates a file

/// Whether there is room for a file's first blocks. HDF5 2 ends the program where there is none.
void check_room(const std::filesystem::path& file, const std::string& name) {
    std::ofstream stream(file, std::ios::binary);
    errno = 0;
    if (!stream.write(std::string(first_blocks, '\0').data(), first_blocks).flush())
        throw Error(fmt::format("{}: {}", name, std::strerror(errno)));
}

} // namespace

GrowingFile::GrowingFile(const std::filesystem::path& temporary, std::string name, int deflate)
    : name_(std::move(name)), deflate_(deflate) {
    hdf5::quieten();
    const Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, name_);
    expect(H5Pset_userblock(creation.get(), seal_size), name_);
    links_ = Id(H5Pcreate(H5P_LINK_CREATE), H5Pclose, name_);
    expect(H5Pset_create_intermediate_group(links_.get(), 1), name_);
    // As HDF5 before 2.0 has it: the newer forms keep the time at which a group was made.
    const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, name_);
    expect(H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), name_);
    check_room(temporary, name_);
    file_ = Id(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose, name_);
}

/// What H5MD asks of every file.
void GrowingFile::write_head() const {
    const Id h5md = make_group("h5md");
    write_attribute(h5md.get(), "version", H5T_STD_I32LE, {1, 1});
    const Id author = make_group("h5md/author");
    write_attribute(author.get(), "name", "unknown");
    const Id creator = make_group("h5md/creator");
    write_attribute(creator.get(), "name", "lockstep");
    write_attribute(creator.get(), "version", LOCKSTEP_VERSION);
}

/// The same run is the same file, whenever it is written.
Id GrowingFile::dataset_creation() const {
    Id creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name_);
    expect(H5Pset_obj_track_times(creation.get(), 0), name_);
    return creation;
}

Id GrowingFile::make_group(const std::string& path) const {
    return {H5Gcreate2(file_.get(), path.c_str(), links_.get(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name_};
}

void GrowingFile::write_text(const std::string& path, const std::string& text) const {
    const Id type(H5Tcopy(H5T_C_S1), H5Tclose, name_);
    expect(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)), name_);
    expect(H5Tset_cset(type.get(), H5T_CSET_UTF8), name_);
    const Id space(H5Screate(H5S_SCALAR), H5Sclose, name_);
    const Id set(H5Dcreate2(file_.get(), path.c_str(), type.get(), space.get(), links_.get(), dataset_creation().get(),
                            H5P_DEFAULT),
                 H5Dclose, name_);
    expect(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), name_);
}

void GrowingFile::write_attribute(hid_t object, const char* name, const std::string& text) const {
    const Id type(H5Tcopy(H5T_C_S1), H5Tclose, name_);
    expect(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)), name_);
    const Id space(H5Screate(H5S_SCALAR), H5Sclose, name_);
    const Id attribute(H5Acreate2(object, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name_);
    expect(H5Awrite(attribute.get(), type.get(), text.c_str()), name_);
}

void GrowingFile::write_attribute(hid_t object, const char* name, hid_t type, const std::vector<int>& values) const {
    const hsize_t count = values.size();
    const Id space(values.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose, name_);
    const Id attribute(H5Acreate2(object, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name_);
    expect(H5Awrite(attribute.get(), H5T_NATIVE_INT, values.data()), name_);
}

GrowingFile::Rows GrowingFile::make_rows(const std::string& path, hid_t type, const Extents& extents,
                                         hsize_t rows_a_chunk) const {
    Extents start{0}, most{H5S_UNLIMITED}, chunk{rows_a_chunk};
    start.insert(start.end(), extents.begin(), extents.end());
    most.insert(most.end(), extents.begin(), extents.end());
    chunk.insert(chunk.end(), extents.begin(), extents.end());
    hsize_t bytes = H5Tget_size(type);
    for (std::size_t i = 1; i < chunk.size(); ++i)
        bytes *= chunk[i];
    if (bytes > largest_chunk && chunk.size() > 1)
        chunk[1] = std::max<hsize_t>(1, chunk[1] * largest_chunk / bytes);

    const Id space(H5Screate_simple(static_cast<int>(start.size()), start.data(), most.data()), H5Sclose, name_);
    const Id creation = dataset_creation();
    expect(H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data()), name_);
    expect(H5Pset_shuffle(creation.get()), name_);
    expect(H5Pset_deflate(creation.get(), static_cast<unsigned>(deflate_)), name_);
    expect(H5Pset_fletcher32(creation.get()), name_);
    return {{H5Dcreate2(file_.get(), path.c_str(), type, space.get(), links_.get(), creation.get(), H5P_DEFAULT),
             H5Dclose, name_},
            extents};
}

void GrowingFile::append(Rows& rows, hid_t memory_type, const void* values) const {
    Extents whole{rows.count + 1}, start(rows.extents.size() + 1, 0), block{1};
    whole.insert(whole.end(), rows.extents.begin(), rows.extents.end());
    block.insert(block.end(), rows.extents.begin(), rows.extents.end());
    start[0] = rows.count;
    expect(H5Dset_extent(rows.set.get(), whole.data()), name_);
    const Id file_space(H5Dget_space(rows.set.get()), H5Sclose, name_);
    expect(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), name_);
    const Id memory_space(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose, name_);
    expect(H5Dwrite(rows.set.get(), memory_type, memory_space.get(), file_space.get(), H5P_DEFAULT, values), name_);
    ++rows.count;
}

void GrowingFile::write_array(const std::string& path, hid_t type, const Extents& extents, const void* values) const {
    const Id space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose, name_);
    const Id creation = dataset_creation();
    Extents chunk = extents;
    chunk[0] = std::min<hsize_t>(chunk[0], largest_chunk / 16);
    expect(H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data()), name_);
    expect(H5Pset_shuffle(creation.get()), name_);
    expect(H5Pset_deflate(creation.get(), static_cast<unsigned>(deflate_)), name_);
    expect(H5Pset_fletcher32(creation.get()), name_);
    const Id set(H5Dcreate2(file_.get(), path.c_str(), type, space.get(), links_.get(), creation.get(), H5P_DEFAULT),
                 H5Dclose, name_);
    const hid_t memory = H5Tequal(type, H5T_IEEE_F32LE) > 0  ? H5T_NATIVE_FLOAT
                         : H5Tequal(type, H5T_STD_U32LE) > 0 ? H5T_NATIVE_UINT32
                                                             : type;
    expect(H5Dwrite(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name_);
}

void GrowingFile::finish() { expect(H5Fflush(file_.get(), H5F_SCOPE_LOCAL), name_); }

} // namespace lockstep
