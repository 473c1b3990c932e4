#include "crosscheck/record/seal.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nettle/sha2.h>

#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::string_view first_line = "lockstep trace 1\n", of_systems = "lockstep recording 1\n";
constexpr std::size_t longest_name = 100;

/// Of what comes after the user block. `read(offset, into)` gives the number of bytes it read.
template <class Read> Seal seal_of(const Read& read) {
    std::vector<std::byte> block(std::size_t{1} << 20U);
    sha256_ctx context;
    sha256_init(&context);
    std::uint64_t bytes = seal_size;
    while (const std::size_t count = read(bytes, std::span(block))) {
        sha256_update(&context, count, reinterpret_cast<const std::uint8_t*>(block.data()));
        bytes += count;
    }
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
    sha256_digest(&context, digest.size(), digest.data());
    return {bytes, fmt::format("{:02x}", fmt::join(digest, ""))};
}

Seal seal_of(const OpenedFile& file) {
    return seal_of([&](std::uint64_t offset, std::span<std::byte> into) { return file.read(offset, into); });
}

/// Takes `word` and the value after it off the front of `text`, to the end of the line.
std::string_view take(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word))
        return {};
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view value = text.substr(word.size(), end - word.size());
    text.remove_prefix(std::min(end + 1, text.size()));
    return value;
}

bool hexadecimal(std::string_view text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

} // namespace

std::string seal_text(const Seal& seal) {
    const std::string first =
        seal.system.empty() ? std::string(first_line) : fmt::format("{}system {}\n", of_systems, seal.system);
    std::string text = fmt::format("{}bytes {}\nsha256 {}\n", first, seal.bytes, seal.sha256);
    text.resize(seal_size, '\0');
    return text;
}

Seal parse_seal(std::string_view text, const std::string& name) {
    const bool has_system = text.starts_with(of_systems);
    if (!has_system && !text.starts_with(first_line))
        throw Error(fmt::format("{}: not a trace: its first line is not \"{}\"; docs/traces.md says how one is written",
                                name, first_line.substr(0, first_line.size() - 1)));
    text.remove_prefix(has_system ? of_systems.size() : first_line.size());
    Seal seal;
    if (has_system) {
        seal.system = take(text, "system ");
        if (seal.system.empty() || seal.system.size() > longest_name)
            throw Error(fmt::format("{}: damaged: its second line is not \"system NAME\"", name));
    }
    const std::string_view bytes = take(text, "bytes ");
    const auto [rest, status] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), seal.bytes);
    if (bytes.empty() || status != std::errc{} || rest != bytes.data() + bytes.size())
        throw Error(
            fmt::format("{}: damaged: its {} line is not \"bytes SIZE\"", name, has_system ? "third" : "second"));
    seal.sha256 = take(text, "sha256 ");
    if (seal.sha256.size() != 2 * SHA256_DIGEST_SIZE || !hexadecimal(seal.sha256))
        throw Error(fmt::format("{}: damaged: its {} line is not \"sha256 \" and 64 hexadecimal digits", name,
                                has_system ? "fourth" : "third"));
    if (text.find_first_not_of('\0') != std::string_view::npos)
        throw Error(fmt::format("{}: damaged: something other than zero bytes follows its seal", name));
    return seal;
}

void seal_file(const std::filesystem::path& path, const std::string& system) {
    Seal seal = seal_of(OpenedFile(path, "trace"));
    seal.system = system;
    const std::string text = seal_text(seal);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "r+b"), std::fclose);
    if (!file || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() || std::fflush(file.get()) != 0)
        throw Error(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
}

namespace {

Seal told_by(const OpenedFile& file) {
    const std::string path = file.path().string();
    std::string text(seal_size, '\0');
    text.resize(file.read(0, std::as_writable_bytes(std::span(text))));
    if (text.empty())
        throw Error(fmt::format("{}: empty; a trace begins with its seal", path));
    return parse_seal(text, path);
}

} // namespace

std::string sealed_system(const OpenedFile& file) { return told_by(file).system; }

Seal check_seal(const OpenedFile& file, const std::string& system) {
    const std::string path = file.path().string();
    const Seal told = told_by(file);
    if (told.system != system)
        throw Error(
            fmt::format("{}: a recording of {}; right is one of {}", path,
                        told.system.empty() ? "a scene without \"system\"" : "system " + plain_line(told.system),
                        system.empty() ? "a scene without \"system\"" : "system " + system));
    if (file.size() < told.bytes)
        throw Error(fmt::format("{}: cut off: {} of its {} bytes are here", path, file.size(), told.bytes));
    if (file.size() > told.bytes)
        throw Error(fmt::format("{}: damaged: {} bytes, but {} were sealed", path, file.size(), told.bytes));
    const Seal found = seal_of(file);
    if (found.bytes != told.bytes || found.sha256 != told.sha256)
        throw Error(fmt::format("{}: damaged: its SHA-256 is {}, sealed was {}", path, found.sha256, told.sha256));
    return told;
}

} // namespace lockstep
