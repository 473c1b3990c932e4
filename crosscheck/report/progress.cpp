#include "crosscheck/report/progress.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace lockstep {

namespace {

/// Of the terminal; it may have changed.
int columns() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

} // namespace

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
    const std::string numbers =
        fmt::format("{}/{} {:.1f} frames/s", done, total_, seconds > 0.0 ? done / seconds : 0.0);
    // A line that is too long would scroll instead of being redrawn.
    const int room = columns() - 1 - static_cast<int>(what_.size() + numbers.size() + 4);
    const int length = std::clamp(room, 0, 30);
    const auto filled = static_cast<int>(std::int64_t{length} * done / total_);
    std::string line = fmt::format("{} [{:#<{}}{:.<{}}] {}", what_, "", filled, "", length - filled, numbers);
    line.resize(std::min(line.size(), static_cast<std::size_t>(columns() - 1)));
    fmt::print(stderr, "\r\033[K{}", line);
    std::fflush(stderr);
}

} // namespace lockstep
