#include "crosscheck/files/read_files.hpp"

#include <mutex>
#include <span>

#include "crosscheck/files/sha256.hpp"

namespace lockstep {
namespace {

struct Noted {
    std::mutex mutex;
    std::map<std::filesystem::path, std::string> digests;
};

Noted& noted() {
    static Noted all;
    return all;
}

} // namespace

void note_read(const std::filesystem::path& file, std::string_view bytes) {
    const std::lock_guard lock(noted().mutex);
    if (std::string& known = noted().digests[file]; known.empty())
        known = sha256_of(std::as_bytes(std::span(bytes)));
}

void note_opened(const std::filesystem::path& file) {
    const std::lock_guard lock(noted().mutex);
    noted().digests.try_emplace(file);
}

std::map<std::filesystem::path, std::string> noted_files() {
    const std::lock_guard lock(noted().mutex);
    return noted().digests;
}

} // namespace lockstep
