#include "crosscheck/record/seal.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <xxhash.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/sha256.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::string_view first_line = "lockstep trace 1\n", of_systems = "lockstep recording 1\n";
constexpr std::size_t longest_name = 100;

class Xxh128 {
  public:
    Xxh128() { XXH3_128bits_reset(state_.get()); }
    void add(std::span<const std::byte> bytes) { XXH3_128bits_update(state_.get(), bytes.data(), bytes.size()); }
    std::string digits() {
        const XXH128_hash_t digest = XXH3_128bits_digest(state_.get());
        return fmt::format("{:016x}{:016x}", digest.high64, digest.low64);
    }

  private:
    std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_{XXH3_createState(), XXH3_freeState};
};

/// Adds what comes after the user block. Gives the size of the whole file.
template <class... Digests> std::uint64_t read_into(const OpenedFile& file, Digests&... digests) {
    std::vector<std::byte> block(std::size_t{1} << 18U); // stays in the cache
    std::uint64_t bytes = seal_size;
    while (const std::size_t count = file.read(bytes, std::span(block))) {
        (digests.add(std::span(block).first(count)), ...);
        bytes += count;
    }
    return bytes;
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

bool hexadecimal(std::string_view text, std::size_t digits) {
    return text.size() == digits && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

} // namespace

std::string seal_text(const Seal& seal) {
    const std::string first =
        seal.system.empty() ? std::string(first_line) : fmt::format("{}system {}\n", of_systems, seal.system);
    std::string text = fmt::format("{}bytes {}\nsha256 {}\n", first, seal.bytes, seal.sha256);
    if (!seal.xxh128.empty())
        text += fmt::format("xxh128 {}\n", seal.xxh128);
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
    if (!hexadecimal(seal.sha256, 2 * SHA256_DIGEST_SIZE))
        throw Error(fmt::format("{}: damaged: its {} line is not \"sha256 \" and 64 hexadecimal digits", name,
                                has_system ? "fourth" : "third"));
    if (text.starts_with("xxh128 ")) {
        seal.xxh128 = take(text, "xxh128 ");
        if (!hexadecimal(seal.xxh128, 32))
            throw Error(fmt::format("{}: damaged: its {} line is not \"xxh128 \" and 32 hexadecimal digits", name,
                                    has_system ? "fifth" : "fourth"));
    }
    if (text.find_first_not_of('\0') != std::string_view::npos)
        throw Error(fmt::format("{}: damaged: something other than zero bytes follows its seal", name));
    return seal;
}

void seal_file(const std::filesystem::path& path, const std::string& system) {
    Sha256 sha256;
    Xxh128 xxh128;
    const std::uint64_t bytes = read_into(OpenedFile(path, "trace"), sha256, xxh128);
    const Seal seal{bytes, sha256.digits(), xxh128.digits(), system};
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
    const auto hold = [&](const char* name, auto digest, const std::string& sealed) {
        const std::uint64_t bytes = read_into(file, digest);
        const std::string found = digest.digits();
        if (bytes != told.bytes || found != sealed)
            throw Error(fmt::format("{}: damaged: its {} is {}, sealed was {}", path, name, found, sealed));
    };
    if (told.xxh128.empty())
        hold("SHA-256", Sha256(), told.sha256);
    else
        hold("XXH128", Xxh128(), told.xxh128);
    return told;
}

} // namespace lockstep
