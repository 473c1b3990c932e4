#pragma once
#include <cstddef>
#include <span>
#include <string>

#include <nettle/sha2.h>

namespace lockstep {

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
  public:
    Sha256();
    void add(std::span<const std::byte> bytes);
    std::string digits(); ///< 64 hexadecimal ones

  private:
    sha256_ctx context_{};
};

std::string sha256_of(std::span<const std::byte> bytes);

} // namespace lockstep
