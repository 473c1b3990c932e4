#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "crosscheck/files/opened_file.hpp"

namespace lockstep {

/// The seal of a trace: the first 512 bytes of the file, which HDF5 calls the user block and leaves alone. It is text,
/// filled up with zero bytes:
///
///     lockstep trace 1
///     bytes SIZE-OF-THE-WHOLE-FILE
///     sha256 OF-WHAT-COMES-AFTER-THE-USER-BLOCK
///     xxh128 OF-THE-SAME
///
/// The last line may be missing. Where it is there, the file is held against it alone, which takes a fifth of the time;
/// the SHA-256 then is the name by which parts of a check know their recording.
///
/// That of a recording of any other system than the one whose traces these are begins with two lines of its own:
///
///     lockstep recording 1
///     system NAME
///
/// It finds what was cut off, damaged, or is something else, before a library that parses the bytes sees them. It is
/// no defence against a file that was made to do harm: such a file has a good seal.
inline constexpr std::size_t seal_size = 512;

struct Seal {
    std::uint64_t bytes = 0;
    std::string sha256;      ///< 64 hexadecimal digits
    std::string xxh128 = {}; ///< 32 hexadecimal digits; empty: not said
    std::string system = {}; ///< empty: of a trace
};

std::string seal_text(const Seal& seal);

/// Throws Error, `NAME: what`, if these are not the first bytes of a sealed file.
Seal parse_seal(std::string_view first_bytes, const std::string& name);

/// Writes the seal of a finished file into its user block. Throws Error naming the path.
void seal_file(const std::filesystem::path& file, const std::string& system = {});

/// The system that the seal names; empty: a trace's. Throws Error where there is no seal.
std::string sealed_system(const OpenedFile& file);

/// Throws Error naming the path if the file is cut off, longer than it was, damaged, or not sealed, or is of another
/// system. Gives the seal.
Seal check_seal(const OpenedFile& file, const std::string& system = {});

} // namespace lockstep
