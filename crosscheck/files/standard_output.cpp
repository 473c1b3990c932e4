#include "crosscheck/files/standard_output.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "crosscheck/files/output_files.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

int failure = 0; ///< errno of the first write that failed

void nobody_reads() {
    if (OutputFiles::any_expected())
        return;
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
}

/// Takes everything, so that printing never throws.
ssize_t take(void*, const char* text, std::size_t size) {
    for (std::size_t done = 0; done < size && failure == 0;) {
        const ssize_t written = write(STDOUT_FILENO, text + done, size - done);
        if (written >= 0) {
            done += static_cast<std::size_t>(written);
        } else if (errno == EPIPE) {
            failure = EPIPE;
            nobody_reads();
        } else if (errno != EINTR) {
            failure = errno;
        }
    }
    return static_cast<ssize_t>(size);
}

} // namespace

void own_standard_output() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) == -1)
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY); // so that using it fails, as it did
    std::FILE* stream = fopencookie(nullptr, "w", {nullptr, take, nullptr, nullptr});
    if (stream == nullptr)
        return;
    std::setvbuf(stream, nullptr, isatty(STDOUT_FILENO) == 1 ? _IOLBF : _IOFBF, BUFSIZ);
    stdout = stream;
}

void finish_standard_output() {
    std::fflush(stdout);
    if (failure != 0 && failure != EPIPE)
        throw Error(fmt::format("standard output: cannot be written: {}", std::strerror(failure)));
}

} // namespace lockstep
