#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "crosscheck/record/hdf5.hpp"

struct libdeflate_decompressor;

namespace lockstep {

/// Rows of float32 as `lockstep record` and h5py store them: little-endian, in chunks of one row or a part of it,
/// shuffled, deflated, perhaps with a Fletcher-32. Read as stored and undone here, three times as fast as libhdf5 does
/// it with zlib. The Fletcher-32 is not looked at: the seal says more.
class ChunkReader {
  public:
    ChunkReader();
    ~ChunkReader();
    ChunkReader(const ChunkReader&) = delete;
    ChunkReader& operator=(const ChunkReader&) = delete;

    /// Row `row` of `set`, whose rows have these extents. False, with `into` in any state, where the row is stored in
    /// another way or does not come out whole: libhdf5 is to read it, or to tell what is wrong.
    bool read(hid_t set, const hdf5::Extents& extents, hsize_t row, std::byte* into);

  private:
    bool read_chunk(hid_t set, const hdf5::Extents& offset, std::size_t chunk_bytes, bool has_checksum);

    libdeflate_decompressor* decompressor_;
    std::vector<std::byte> stored_, shuffled_;
};

} // namespace lockstep
