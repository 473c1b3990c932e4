#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lockstep {

/// Bytes of a report page's binary data, as crosscheck/report_page/src/data.js reads them.
class Blob {
  public:
    void byte(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }

    /// Little endian.
    void word(std::uint32_t value);

    /// All lowest bytes first, then the next: so arranged, words that are near each other compress well.
    void words(std::span<const std::uint32_t> values);

    void bytes(std::span<const std::uint8_t> values);

    /// One bit a value, the lowest of each byte first.
    template <class Size, class Bit> void bits(Size count, const Bit& bit) {
        for (Size i = 0; i < count; i += 8) {
            unsigned packed = 0;
            for (Size k = i; k < count && k < i + 8; ++k)
                packed |= (bit(k) ? 1U : 0U) << (k - i);
            byte(static_cast<std::uint8_t>(packed));
        }
    }

    [[nodiscard]] const std::string& str() const { return bytes_; }

  private:
    std::string bytes_;
};

/// As a zlib stream, RFC 1950: the browser's DecompressionStream("deflate") takes it. Throws Error without memory.
std::string deflated(std::string_view bytes);

} // namespace lockstep
