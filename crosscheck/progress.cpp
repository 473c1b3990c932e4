#include "crosscheck/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace lockstep {

Progress::Progress(std::string what, int total, bool wanted)
    : what_(std::move(what)), total_(std::max(total, 1)), active_(wanted && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (active_)
        fmt::print(stderr, "\r\033[K");
}

void Progress::show(int done) {
    const auto now = std::chrono::steady_clock::now();
    if (!active_ || now - drawn_ < std::chrono::milliseconds(100))
        return;
    drawn_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const int filled = 30 * done / total_;
    fmt::print(stderr, "\r\033[K{} [{:#<{}}{:.<{}}] {}/{} {:.1f} frames/s", what_, "", filled, "", 30 - filled, done,
               total_, seconds > 0.0 ? done / seconds : 0.0);
    std::fflush(stderr);
}

} // namespace lockstep
