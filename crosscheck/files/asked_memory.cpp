#include "crosscheck/files/asked_memory.hpp"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t gib = std::uint64_t{1} << 30U;

// Both sides' state of this frame and of the one before, and what comparing them keeps.
constexpr std::uint64_t bytes_a_texel = 100;
constexpr std::uint64_t bytes_a_particle = 200;

double in_gib(std::uint64_t bytes) { return static_cast<double>(bytes) / static_cast<double>(gib); }

} // namespace

void expect_affordable(const Asked& asked, std::uint64_t file_bytes, const std::string& file) {
    std::uint64_t allowed = std::max(2 * gib, 64 * file_bytes);
    if (const char* set = std::getenv("LOCKSTEP_FILE_MEMORY"); set != nullptr && *set != '\0')
        allowed = std::strtoull(set, nullptr, 10) * gib;
    const std::uint64_t needed = asked.texels * bytes_a_texel + asked.particles * bytes_a_particle;
    if (needed > allowed)
        throw Error(fmt::format("{}: asks for about {:.1f} GiB of memory, for {} texels and {} particles; a file of {} "
                                "bytes may ask for {:.1f} (LOCKSTEP_FILE_MEMORY=GIB allows more)",
                                file, in_gib(needed), asked.texels, asked.particles, file_bytes, in_gib(allowed)));
}

} // namespace lockstep
