#include "crosscheck/record/recorded_file.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/model/error.hpp"

namespace lockstep {

using hdf5::expect;
using hdf5::Extents;
using hdf5::Id;

namespace {

using hdf5::is_float32;
using hdf5::is_integer;

constexpr hsize_t most_rows = 100'000'001;
constexpr std::size_t longest_text = 16U << 20U; // bytes
constexpr hsize_t densest = 1100;                // deflate makes no more of a byte

constexpr const char* scalar_name(Scalar scalar) {
    constexpr const char* names[] = {"float32", "int32", "uint32"};
    return names[static_cast<std::size_t>(scalar)];
}

bool is_of(Scalar scalar, hid_t type) {
    return scalar == Scalar::float32 ? is_float32(type)
                                     : is_integer(type, 4, scalar == Scalar::int32 ? H5T_SGN_2 : H5T_SGN_NONE);
}

} // namespace

namespace hdf5 {

void fail(const std::string& path, const std::string& what) { throw Error(fmt::format("{}: {}", path, what)); }

std::string type_name(hid_t type) {
    const std::size_t bits = H5Tget_size(type) * 8;
    switch (H5Tget_class(type)) {
    case H5T_FLOAT:
        return fmt::format("float{}", bits);
    case H5T_INTEGER:
        return fmt::format("{}int{}", H5Tget_sign(type) == H5T_SGN_NONE ? "u" : "", bits);
    case H5T_STRING:
        return "text";
    default:
        return "of another type";
    }
}

bool is_float32(hid_t type) {
    return H5Tget_class(type) == H5T_FLOAT &&
           (H5Tequal(type, H5T_IEEE_F32LE) > 0 || H5Tequal(type, H5T_IEEE_F32BE) > 0);
}

bool is_integer(hid_t type, std::size_t bytes, H5T_sign_t sign) {
    return H5Tget_class(type) == H5T_INTEGER && H5Tget_size(type) == bytes && H5Tget_sign(type) == sign;
}

Extents extents_of(hid_t set, const std::string& path) {
    const Id space(H5Dget_space(set), H5Sclose, path);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 0 || H5Sget_simple_extent_type(space.get()) == H5S_NULL)
        fail(path, "holds no array");
    Extents extents(static_cast<std::size_t>(rank));
    if (rank > 0)
        H5Sget_simple_extent_dims(space.get(), extents.data(), nullptr);
    return extents;
}

std::string shape(const std::string& type, const Extents& extents) {
    return extents.empty() ? type + " scalar" : fmt::format("{} [{}]", type, fmt::join(extents, "]["));
}

void expect_stored(hid_t set, const Extents& extents, std::size_t value_bytes, const std::string& path) {
    const Id creation(H5Dget_create_plist(set), H5Pclose, path);
    const H5D_layout_t layout = H5Pget_layout(creation.get());
    if (layout == H5D_VIRTUAL || H5Pget_external_count(creation.get()) > 0)
        fail(path, "its values lie in another file; all of a trace is in one");
    hsize_t values = 1;
    for (const hsize_t extent : extents)
        values *= extent;
    hsize_t chunks = 0;
    if (layout == H5D_CHUNKED) {
        Extents chunk(extents.size());
        H5Pget_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
        hsize_t expected = 1;
        for (std::size_t i = 0; i < extents.size(); ++i)
            expected *= chunk[i] == 0 ? 0 : (extents[i] + chunk[i] - 1) / chunk[i];
        const Id space(H5Dget_space(set), H5Sclose, path);
        expect(H5Dget_num_chunks(set, space.get(), &chunks), path);
        if (chunks < expected)
            fail(path, fmt::format("only {} of its {} chunks were written", chunks, expected));
    }
    const hsize_t stored = H5Dget_storage_size(set);
    const Id file(H5Iget_file_id(set), H5Fclose, path);
    hsize_t file_size = 0;
    expect(H5Fget_filesize(file.get(), &file_size), path);
    if ((values * value_bytes + densest - 1) / densest > stored || stored > file_size)
        fail(path, fmt::format("claims {} values in {} bytes of a file of {}", values, stored, file_size));
}

} // namespace hdf5

using hdf5::expect_stored;
using hdf5::extents_of;
using hdf5::fail;
using hdf5::shape;
using hdf5::type_name;

RecordedFile::RecordedFile(const OpenedFile& file) {
    hdf5::quieten();
    H5PLset_loading_state(0);
    file_ = Id(H5Fopen(file.path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "HDF5");
    void* descriptor = nullptr;
    expect(H5Fget_vfd_handle(file_.get(), H5P_DEFAULT, &descriptor), "HDF5");
    if (descriptor == nullptr || !file.is(*static_cast<int*>(descriptor)))
        throw Error("another file took its name while it was read");
}

bool RecordedFile::exists(const std::string& path) const {
    for (std::size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
        if (H5Lexists(file_.get(), path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0)
            return false;
    return H5Lexists(file_.get(), path.c_str(), H5P_DEFAULT) > 0;
}

Id RecordedFile::open_dataset(const std::string& path) const {
    for (std::size_t end = path.find('/'); end != std::string::npos + 1;
         end = end == std::string::npos ? end + 1 : path.find('/', end + 1)) {
        H5L_info_t link{};
        const std::string part = path.substr(0, end);
        expect(H5Lget_info(file_.get(), part.c_str(), &link, H5P_DEFAULT), part);
        if (link.type != H5L_TYPE_HARD && link.type != H5L_TYPE_SOFT)
            fail(part, "a link to another file; all of a trace is in one");
    }
    return {H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose, path};
}

void RecordedFile::find_head() {
    if (!exists("h5md"))
        warnings_.emplace_back("h5md: missing, so other programs will not know this for H5MD");
}

/// A dataset of such values with rows whose last extents are `last`; `right` says what shape it is to be.
RecordedFile::Dataset RecordedFile::values(const std::string& path, Scalar scalar, const std::string& right,
                                           const Extents& last) const {
    if (!exists(path))
        fail(path, fmt::format("missing; right is {} {}", scalar_name(scalar), right));
    Dataset dataset{open_dataset(path), {}, path, 0, {}, hdf5::memory_type(scalar)};
    dataset.type = Id(H5Dget_type(dataset.set.get()), H5Tclose, path);
    Extents extents = extents_of(dataset.set.get(), path);
    const bool shaped = extents.size() == 2 + last.size() &&
                        std::equal(last.begin(), last.end(), extents.end() - static_cast<std::ptrdiff_t>(last.size()));
    if (!is_of(scalar, dataset.type.get()) || !shaped)
        fail(path, fmt::format("is {}; right is {} {}", shape(type_name(dataset.type.get()), extents),
                               scalar_name(scalar), right));
    dataset.rows = extents.front();
    dataset.extents.assign(extents.begin() + 1, extents.end());
    if (dataset.rows > most_rows)
        fail(path, fmt::format("has {} rows; a trace has at most {}", dataset.rows, most_rows));
    return dataset;
}

void RecordedFile::read_row(const Dataset& dataset, std::size_t row, std::byte* into) {
    if (chunks_.read(dataset.set.get(), dataset.extents, row, into))
        return;
    Extents start(dataset.extents.size() + 1, 0), block{1};
    start[0] = row;
    block.insert(block.end(), dataset.extents.begin(), dataset.extents.end());
    const Id file_space(H5Dget_space(dataset.set.get()), H5Sclose, dataset.path);
    expect(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr),
           dataset.path);
    const Id memory_space(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose,
                          dataset.path);
    expect(H5Dread(dataset.set.get(), dataset.memory, memory_space.get(), file_space.get(), H5P_DEFAULT, into),
           fmt::format("{}: row {}", dataset.path, row));
}

std::string RecordedFile::text(const char* path) const {
    if (!exists(path))
        return "";
    const Id set = open_dataset(path);
    const Id type(H5Dget_type(set.get()), H5Tclose, path);
    const Extents extents = extents_of(set.get(), path);
    if (H5Tget_class(type.get()) != H5T_STRING || !extents.empty())
        fail(path, fmt::format("is {}; right is one text, UTF-8", shape(type_name(type.get()), extents)));
    const Id memory(H5Tcopy(type.get()), H5Tclose, path);
    if (H5Tis_variable_str(type.get()) > 0) {
        char* text = nullptr;
        expect(H5Dread(set.get(), memory.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &text), path);
        std::string copy = text == nullptr ? "" : text;
        H5free_memory(text);
        return copy;
    }
    const std::size_t size = H5Tget_size(type.get());
    if (size > longest_text)
        fail(path, fmt::format("is a text of {} bytes; right is at most {}", size, longest_text));
    std::string text(size, '\0');
    expect(H5Dread(set.get(), memory.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), path);
    text.erase(text.find_last_not_of('\0') + 1);
    return text;
}

std::string RecordedFile::program() const {
    std::string words;
    for (const char* name : {"name", "version"}) {
        if (!exists("h5md/creator") || H5Aexists_by_name(file_.get(), "h5md/creator", name, H5P_DEFAULT) <= 0)
            continue;
        const Id attribute(H5Aopen_by_name(file_.get(), "h5md/creator", name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                           "h5md/creator");
        const Id type(H5Aget_type(attribute.get()), H5Tclose, "h5md/creator");
        const std::size_t size = H5Tget_size(type.get());
        std::string text;
        if (H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) > 0) {
            char* read = nullptr;
            expect(H5Aread(attribute.get(), type.get(), static_cast<void*>(&read)), "h5md/creator");
            text = read == nullptr ? "" : read;
            H5free_memory(read);
        } else if (H5Tget_class(type.get()) == H5T_STRING && size <= 1024 &&
                   H5Aget_storage_size(attribute.get()) == size) {
            text.resize(size);
            expect(H5Aread(attribute.get(), type.get(), text.data()), "h5md/creator");
            text.erase(text.find_last_not_of('\0') + 1);
        }
        words += (words.empty() ? "" : " ") + text;
    }
    return words;
}

std::vector<std::int8_t> RecordedFile::root_offsets(const char* path, std::size_t count) const {
    if (!exists(path))
        return {};
    const Id set = open_dataset(path);
    const Id type(H5Dget_type(set.get()), H5Tclose, path);
    const Extents extents = extents_of(set.get(), path);
    if (!is_integer(type.get(), 1, H5T_SGN_2) || extents != Extents{count})
        fail(path, fmt::format("is {}; right is int8 [{}]", shape(type_name(type.get()), extents), count));
    expect_stored(set.get(), extents, 1, path);
    return hdf5::read_all<std::int8_t>(set.get(), H5T_NATIVE_INT8, count, path);
}

std::vector<std::int32_t> RecordedFile::integers(const std::string& path) const {
    if (!exists(path))
        fail(path, "missing; right is int32 [rows]");
    const Id set = open_dataset(path);
    const Id type(H5Dget_type(set.get()), H5Tclose, path);
    const Extents extents = extents_of(set.get(), path);
    if (!is_integer(type.get(), 4, H5T_SGN_2) || extents.size() != 1 || extents[0] > most_rows)
        fail(path, fmt::format("is {}; right is int32 [rows]", shape(type_name(type.get()), extents)));
    if (extents[0] > 0)
        expect_stored(set.get(), extents, sizeof(std::int32_t), path);
    return hdf5::read_all<std::int32_t>(set.get(), H5T_NATIVE_INT32, extents[0], path);
}

} // namespace lockstep
