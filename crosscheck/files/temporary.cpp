#include "crosscheck/files/temporary.hpp"

#include <atomic>
#include <cerrno>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "crosscheck/files/signals.hpp"

namespace lockstep {
namespace {

/// Never destroyed: the program's last moments still need them.
std::list<std::string>& temporaries() {
    static auto* const all = new std::list<std::string>;
    return *all;
}

std::mutex changing;

void remove(const char* path) {
    if (unlink(path) != 0 && (errno == EISDIR || errno == EPERM))
        rmdir(path);
}

} // namespace

Temporary::Temporary(std::filesystem::path path) : path_(std::move(path)) {
    const SignalsWait wait;
    const std::lock_guard lock(changing);
    entry_ = temporaries().insert(temporaries().end(), path_.native());
}

Temporary::~Temporary() {
    if (empty())
        return;
    const SignalsWait wait;
    remove(path_.c_str());
    keep();
}

Temporary::Temporary(Temporary&& other) noexcept : path_(std::exchange(other.path_, {})), entry_(other.entry_) {}

Temporary& Temporary::operator=(Temporary&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(entry_, other.entry_);
    return *this;
}

void Temporary::keep() {
    if (empty())
        return;
    const SignalsWait wait;
    const std::lock_guard lock(changing);
    temporaries().erase(entry_);
    path_.clear();
}

std::filesystem::path temporary_name(const std::filesystem::path& file) {
    static std::atomic<int> count{0};
    return file.parent_path() / fmt::format("lockstep-{}-{}.part", getpid(), ++count);
}

void remove_temporaries() {
    std::list<std::string>& all = temporaries();
    for (auto path = all.rbegin(); path != all.rend(); ++path)
        remove(path->c_str());
}

} // namespace lockstep
