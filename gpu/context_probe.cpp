#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gpu/context.hpp"
#include "gpu/context_backend.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr int probe_milliseconds = 20000;

/// Everything the child wrote before it ended, or before the time was up.
std::string read_all(int file, bool& in_time) {
    std::string text;
    char chunk[4096];
    for (;;) {
        pollfd ready{file, POLLIN, 0};
        in_time = poll(&ready, 1, probe_milliseconds) > 0;
        const ssize_t count = in_time ? read(file, chunk, sizeof chunk) : 0;
        if (count <= 0)
            return text;
        text.append(chunk, static_cast<std::size_t>(count));
    }
}

/// Runs `work` in a child process and returns the JSON it gives. Throws Error if the child dies or hangs.
template <class Work> nlohmann::json in_child(const Work& work) {
    int ends[2];
    if (pipe(ends) != 0)
        throw Error("cannot make a pipe for a child process");
    const pid_t child = fork();
    if (child < 0)
        throw Error("cannot start a child process");
    if (child == 0) {
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        // Drivers print to the terminal what the Error says anyway.
        if (const int null = ::open("/dev/null", O_WRONLY); null >= 0) {
            dup2(null, STDOUT_FILENO);
            dup2(null, STDERR_FILENO);
        }
        const std::string text = work().dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        const bool written = write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    bool in_time = true;
    const std::string text = read_all(ends[0], in_time);
    close(ends[0]);
    if (!in_time)
        kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    if (!in_time)
        throw Error(fmt::format("the driver did not answer within {} s", probe_milliseconds / 1000));
    if (WIFSIGNALED(status))
        throw Error(fmt::format("the driver crashed with signal {}", WTERMSIG(status)));
    const nlohmann::json answer = nlohmann::json::parse(text, nullptr, false);
    if (answer.is_discarded())
        throw Error("the driver ended the process");
    return answer;
}

ContextProbe probe(const ContextRequest& request) {
    ContextProbe result{request, {}, {}};
    try {
        const nlohmann::json answer = in_child([&]() -> nlohmann::json {
            try {
                return Context(request).describe();
            } catch (const std::exception& error) {
                return std::string(error.what());
            }
        });
        if (answer.is_string())
            result.error = answer.get<std::string>();
        else
            result.info = answer.get<ContextInfo>();
    } catch (const Error& error) {
        result.error = fmt::format("{}: {}", context_request_text(request), error.what());
    }
    return result;
}

} // namespace

std::vector<ContextProbe> available_contexts() {
    using Backend = ContextRequest::Backend;
    std::vector<ContextProbe> probes{probe({Backend::osmesa, 0}), probe({Backend::egl, 0})};
    int devices = 0;
    try {
        devices = in_child([]() -> nlohmann::json { return egl_device_count(); }).get<int>();
    } catch (const Error& error) {
        probes.push_back({{Backend::egl_device, 0}, {}, fmt::format("EGL devices: {}", error.what())});
    }
    for (int device = 0; device < devices; ++device)
        probes.push_back(probe({Backend::egl_device, device}));
    return probes;
}

} // namespace lockstep
