#include "crosscheck/report/page/blob.hpp"

#include <array>
#include <cstddef>

#include <zlib.h>

#include "reference/model/error.hpp"

namespace lockstep {

void Blob::word(std::uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        byte(static_cast<std::uint8_t>(value >> shift));
}

void Blob::words(std::span<const std::uint32_t> values) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        for (const std::uint32_t value : values)
            byte(static_cast<std::uint8_t>(value >> shift));
}

void Blob::bytes(std::span<const std::uint8_t> values) {
    for (const std::uint8_t value : values)
        byte(value);
}

std::string deflated(std::string_view bytes) {
    uLongf length = compressBound(static_cast<uLong>(bytes.size()));
    std::string out(length, '\0');
    const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &length,
                                 reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 9);
    if (status != Z_OK)
        throw Error("report: no memory to compress the page's data");
    out.resize(length);
    return out;
}

} // namespace lockstep
