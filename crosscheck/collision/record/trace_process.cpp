#include "crosscheck/collision/record/trace_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "crosscheck/collision/record/trace_messages.hpp"
#include "crosscheck/record/root_offsets.hpp"
#include "crosscheck/record/syscall_fence.hpp"
#include "crosscheck/record/trace_file.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::size_t opening_memory = std::size_t{1} << 30U; // bytes, to look at a file and read its small parts
constexpr rlim_t seconds_a_request = 60;                      // of processor time

/// Bytes of address space in use.
std::size_t address_space() {
    std::size_t pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%zu", &pages) != 1)
            pages = 0;
        std::fclose(file);
    }
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

template <class Resource> void limit(Resource resource, rlim_t value) {
    rlimit limits{};
    getrlimit(resource, &limits);
    limits.rlim_cur = std::min(value, limits.rlim_max); // RLIM_INFINITY is the largest
    setrlimit(resource, &limits);
}

template <class Resource> void limit_for_good(Resource resource, rlim_t value) {
    const rlimit limits{value, value};
    setrlimit(resource, &limits);
}

/// So much processor time from now on.
void limit_time() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    limit(RLIMIT_CPU, static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1 + seconds_a_request);
}

/// The asking process's handlers are not to run here, and Ctrl-C is its alone.
void default_signals() {
    for (int signal = 1; signal < NSIG; ++signal)
        std::signal(signal, signal == SIGINT ? SIG_IGN : SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Descriptors of the reading process; nothing else that the asking process has open is open there.
constexpr int requests_from = 3, answers_to = 4, the_file = 5;

void keep_descriptors(int requests, int answers) {
    const int above = std::max({requests, answers, the_file}) + 1; // not to overwrite one with the other
    const int kept_requests = fcntl(requests, F_DUPFD, above);
    const int kept_answers = fcntl(answers, F_DUPFD, above);
    const int null = open("/dev/null", O_RDWR);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        dup2(null, standard);
    dup2(kept_requests, requests_from);
    dup2(kept_answers, answers_to);
    close_range(the_file, ~0U, 0);
}

/// What is left to a process that reads one file. `memory`: bytes of address space. Gives why the kernel puts up no
/// fence of its own, or an empty text.
std::string fence(std::size_t memory) {
    default_signals();
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    limit_for_good(RLIMIT_CORE, 0);
    limit_for_good(RLIMIT_FSIZE, 0);
    limit_for_good(RLIMIT_NPROC, 0);
    limit_for_good(RLIMIT_NOFILE, the_file + 1);
    limit(RLIMIT_AS, memory);
    limit_time();
    return put_up_fence(Fence::opening, answers_to);
}

/// The reading process's work.
class Reader {
  public:
    explicit Reader(const OpenedFile& file) : file_(file, collision_schema().resources[collision::particles]) {}

    /// `memory`: what opening the file may take.
    void run(std::size_t memory, std::string unfenced) {
        if (unfenced.empty())
            unfenced = put_up_fence(Fence::reading, answers_to);
        file_.look_at_contents();
        warnings_ = file_.warnings();
        if (!unfenced.empty())
            warnings_.push_back(fmt::format("the kernel puts up no seccomp filter ({}): the process that reads the "
                                            "trace is held by its limits alone",
                                            unfenced));
        limit(RLIMIT_AS, memory + 2 * (file_.particle_bytes() + file_.cdt_bytes()));
        send_contents();
        Request request;
        while (recv(requests_from, &request, sizeof request, MSG_WAITALL) == sizeof request) {
            limit_time();
            serve(request);
        }
    }

    static void send_error(const std::string& text) { send({MessageKind::error, 0, text.size()}, text.data()); }

  private:
    /// One state, read before it is asked for.
    struct Prepared {
        std::size_t index = SIZE_MAX;
        std::vector<std::byte> bytes;
    };

    static void write_all(const void* bytes, std::size_t count) {
        const char* at = static_cast<const char*>(bytes);
        while (count > 0) {
            const ssize_t written = write(answers_to, at, count);
            if (written < 0 && errno == EINTR)
                continue;
            if (written <= 0)
                _exit(0);
            at += written;
            count -= static_cast<std::size_t>(written);
        }
    }

    static void send(const MessageHead& head, const void* bytes) {
        write_all(&head, sizeof head);
        write_all(bytes, head.bytes);
    }

    template <class Value> static void send(MessageKind kind, const std::vector<Value>& values) {
        send({kind, 0, values.size() * sizeof(Value)}, values.data());
    }

    void send_contents() {
        const auto positions = file_.obstacle_positions();
        const auto triangles = file_.obstacle_triangles();
        const auto reciprocals = file_.root_offsets(layout::reciprocals, reciprocal_count);
        const auto inverse_sqrts = file_.root_offsets(layout::inverse_sqrts, inverse_sqrt_count);
        const bool has_roots = !reciprocals.empty() && !inverse_sqrts.empty();
        nlohmann::json json{{"rows", file_.rows()},
                            {"particles", file_.particles()},
                            {"has_cdt", file_.has_cdt() ? 1 : 0},
                            {"has_obstacles", triangles.empty() ? 0 : 1},
                            {"has_roots", has_roots ? 1 : 0},
                            {"scene", file_.text(layout::scene)},
                            {"name", file_.text(layout::name)},
                            {"profile", file_.text(layout::profile)},
                            {"renderer", file_.text(layout::renderer)},
                            {"settings", file_.text(layout::settings)},
                            {"shaders", file_.text(layout::shaders)},
                            {"probe", file_.text(layout::probe)},
                            {"program", file_.program()},
                            {"warnings", warnings_}};
        if (file_.has_cdt()) {
            json["cdt_height"] = file_.cdt_extents()[0];
            json["cdt_width"] = file_.cdt_extents()[1];
        }
        const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        send({MessageKind::contents, 0, text.size()}, text.data());
        if (!triangles.empty()) {
            send(MessageKind::positions, positions);
            send(MessageKind::triangles, triangles);
        }
        if (has_roots) {
            send(MessageKind::reciprocals, reciprocals);
            send(MessageKind::inverse_sqrts, inverse_sqrts);
        }
        serve({MessageKind::particles, 0});
    }

    void prepare(MessageKind kind, std::size_t index) {
        const bool cdt = kind == MessageKind::cdt;
        Prepared& prepared = cdt ? cdt_ : particles_;
        if (prepared.index == index)
            return;
        prepared.index = SIZE_MAX;
        prepared.bytes.resize(cdt ? file_.cdt_bytes() : file_.particle_bytes());
        if (cdt)
            file_.read_cdt(index, prepared.bytes.data());
        else
            file_.read_particles(index, prepared.bytes.data());
        prepared.index = index;
    }

    /// Answers, then reads ahead while the asking process works.
    void serve(const Request& request) {
        const bool cdt = request.kind == MessageKind::cdt;
        if (request.index >= file_.rows() - (cdt ? 1 : 0) || (cdt && !file_.has_cdt()))
            throw Error(fmt::format("row {} was asked for, there are {}", request.index, file_.rows()));
        prepare(request.kind, request.index);
        const std::vector<std::byte>& bytes = (cdt ? cdt_ : particles_).bytes;
        send({request.kind, request.index, bytes.size()}, bytes.data());
        const std::size_t row = request.index + (cdt ? 2U : 1U);
        if (cdt != file_.has_cdt() && request.index != 0)
            return; // the CDT of this row is asked for next
        if (row < file_.rows()) {
            prepare(MessageKind::particles, row);
            if (file_.has_cdt())
                prepare(MessageKind::cdt, row - 1);
        }
    }

    TraceFile file_;
    std::vector<std::string> warnings_;
    Prepared particles_, cdt_;
};

[[noreturn]] void read_trace(const OpenedFile& file, int requests, int answers) {
    keep_descriptors(requests, answers);
    const std::size_t memory = address_space() + opening_memory;
    const std::string unfenced = fence(memory);
    try {
        Reader(file).run(memory, unfenced);
    } catch (const std::bad_alloc&) {
        Reader::send_error("needs more memory than a trace of its size may");
    } catch (const std::exception& error) {
        Reader::send_error(error.what());
    }
    _exit(0);
}

} // namespace

TraceProcess start_trace_process(const OpenedFile& file) {
    const auto fail = [&] {
        throw Error(
            fmt::format("{}: no process to read it can be started: {}", file.path().string(), std::strerror(errno)));
    };
    std::array<int, 2> requests{}, answers{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, requests.data()) != 0)
        fail();
    if (pipe2(answers.data(), O_CLOEXEC) != 0) {
        close(requests[0]);
        close(requests[1]);
        fail();
    }
    fcntl(answers[1], F_SETPIPE_SZ, 1 << 20);
    const pid_t pid = fork();
    if (pid == 0) {
        close(requests[0]);
        close(answers[0]);
        read_trace(file, requests[1], answers[1]);
    }
    close(requests[1]);
    close(answers[1]);
    if (pid < 0) {
        close(requests[0]);
        close(answers[0]);
        fail();
    }
    return {pid, requests[0], answers[0]};
}

int end_trace_process(TraceProcess& process, std::chrono::milliseconds grace) {
    if (process.pid < 0)
        return 0;
    close(std::exchange(process.requests, -1));
    close(std::exchange(process.answers, -1));
    const int pid = std::exchange(process.pid, -1);
    int status = 0;
    pid_t reaped = 0;
    for (const auto end = std::chrono::steady_clock::now() + grace;
         (reaped = waitpid(pid, &status, WNOHANG)) == 0 && std::chrono::steady_clock::now() < end;)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (reaped == pid)
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    return 0;
}

} // namespace lockstep
