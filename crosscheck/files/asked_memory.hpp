#pragma once
#include <cstdint>
#include <string>

namespace lockstep {

/// What a file from elsewhere says that there is: a few bytes can ask for any number of them.
struct Asked {
    std::uint64_t texels = 0; ///< of all planes of a CDT
    std::uint64_t particles = 0;
};

/// Throws Error, `FILE: ...`, where checking that takes more memory than a file of `file_bytes` may ask for: 2 GiB, or
/// 64 times its size, which nothing that was recorded comes near; LOCKSTEP_FILE_MEMORY sets another number of GiB.
void expect_affordable(const Asked& asked, std::uint64_t file_bytes, const std::string& file);

} // namespace lockstep
