#include "crosscheck/record/chunk.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include <libdeflate.h>

namespace lockstep {
namespace {

using hdf5::Extents;
using hdf5::Id;

/// The filters, in the order they were applied.
std::vector<H5Z_filter_t> filters_of(hid_t creation) {
    std::vector<H5Z_filter_t> filters;
    const int count = H5Pget_nfilters(creation);
    for (int i = 0; i < count; ++i) {
        std::size_t values = 0;
        unsigned flags = 0, config = 0;
        filters.push_back(
            H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, &config));
    }
    return filters;
}

std::size_t bytes_of(const Extents& extents) {
    std::size_t bytes = sizeof(float);
    for (const hsize_t extent : extents)
        bytes *= extent;
    return bytes;
}

/// The first bytes of all values, then the second ones, and so on, back to values.
void unshuffle(const std::byte* shuffled, std::size_t values, std::size_t wanted, std::byte* into) {
    for (std::size_t i = 0; i < wanted; ++i)
        for (std::size_t part = 0; part < sizeof(float); ++part)
            into[sizeof(float) * i + part] = shuffled[part * values + i];
}

/// A chunk as it lies in the file; `into` has its size, which HDF5 asks for since 2.0.
bool read_stored(hid_t set, const Extents& offset, std::uint32_t& skipped_filters, std::vector<std::byte>& into) {
#if H5_VERSION_GE(2, 0, 0)
    std::size_t size = into.size();
    return H5Dread_chunk2(set, H5P_DEFAULT, offset.data(), &skipped_filters, into.data(), &size) >= 0 &&
           size == into.size();
#else
    return H5Dread_chunk(set, H5P_DEFAULT, offset.data(), &skipped_filters, into.data()) >= 0;
#endif
}

} // namespace

ChunkReader::ChunkReader() : decompressor_(libdeflate_alloc_decompressor()) {}

ChunkReader::~ChunkReader() { libdeflate_free_decompressor(decompressor_); }

bool ChunkReader::read(hid_t set, const Extents& extents, hsize_t row, std::byte* into) {
    const Id creation(H5Dget_create_plist(set), H5Pclose, "HDF5");
    const std::vector<H5Z_filter_t> filters = filters_of(creation.get());
    const std::vector<H5Z_filter_t> plain{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE};
    const bool has_checksum = filters.size() == 3 && filters.back() == H5Z_FILTER_FLETCHER32;
    const Id type(H5Dget_type(set), H5Tclose, "HDF5");
    if (std::endian::native != std::endian::little || H5Tequal(type.get(), H5T_IEEE_F32LE) <= 0 ||
        H5Pget_layout(creation.get()) != H5D_CHUNKED || !(filters.size() == 2 || has_checksum) ||
        !std::equal(plain.begin(), plain.end(), filters.begin()))
        return false;
    Extents chunk(extents.size() + 1);
    H5Pget_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
    if (chunk[0] != 1 || !std::equal(chunk.begin() + 2, chunk.end(), extents.begin() + 1))
        return false;

    const std::size_t chunk_bytes = bytes_of(chunk);
    const std::size_t line_bytes = chunk_bytes / chunk[1];
    Extents offset(chunk.size(), 0);
    offset[0] = row;
    for (hsize_t first = 0; first < extents[0]; first += chunk[1]) {
        offset[1] = first;
        if (!read_chunk(set, offset, chunk_bytes, has_checksum))
            return false;
        const std::size_t wanted = std::min(chunk[1], extents[0] - first) * line_bytes;
        unshuffle(shuffled_.data(), chunk_bytes / sizeof(float), wanted / sizeof(float), into + first * line_bytes);
    }
    return true;
}

/// Leaves the shuffled bytes of a chunk in shuffled_.
bool ChunkReader::read_chunk(hid_t set, const Extents& offset, std::size_t chunk_bytes, bool has_checksum) {
    constexpr std::size_t checksum_bytes = 4;
    hsize_t stored = 0;
    std::uint32_t skipped_filters = 0;
    if (H5Dget_chunk_storage_size(set, offset.data(), &stored) < 0 || stored > chunk_bytes + (chunk_bytes >> 8U) + 1024)
        return false;
    stored_.resize(stored);
    if (!read_stored(set, offset, skipped_filters, stored_) || skipped_filters != 0)
        return false;
    if (has_checksum && stored < checksum_bytes)
        return false;
    shuffled_.resize(chunk_bytes);
    return libdeflate_zlib_decompress(decompressor_, stored_.data(), stored - (has_checksum ? checksum_bytes : 0),
                                      shuffled_.data(), shuffled_.size(), nullptr) == LIBDEFLATE_SUCCESS;
}

} // namespace lockstep
