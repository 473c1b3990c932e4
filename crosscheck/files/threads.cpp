#include "crosscheck/files/threads.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <mutex>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lockstep {
namespace {

/// All threads in one region; one without a body would be compiled away.
void meet() {
    std::atomic<int> present{0};
#pragma omp parallel
    ++present;
}

/// Tried in a child process, which OpenMP ends where it cannot.
bool can_start(int threads) {
    const pid_t child = fork();
    if (child < 0)
        return false;
    if (child == 0) {
        const int null = open("/dev/null", O_WRONLY);
        dup2(null, STDOUT_FILENO);
        dup2(null, STDERR_FILENO);
        omp_set_num_threads(threads);
        meet();
        _exit(0);
    }
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

} // namespace

std::string stack_problem() {
    constexpr rlim_t least = rlim_t{256} << 10U; // twice what the smallest run on llvmpipe was seen to need
    rlimit limit{};
    if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= least)
        return "";
    return fmt::format("the stack is limited to {} KiB (ulimit -s), too little to run in; {} KiB and more are enough",
                       limit.rlim_cur >> 10U, least >> 10U);
}

void let_waiting_threads_sleep(char** argv) {
    if (std::getenv("OMP_WAIT_POLICY") != nullptr || setenv("OMP_WAIT_POLICY", "passive", 1) != 0)
        return;
    setenv("GOMP_SPINCOUNT", "1000", 0); // without it, waits in vain are only slower
    execv("/proc/self/exe", argv);       // returns only where it failed: then they spin
}

void have_waiting_threads_sleep_soon() {
    static std::once_flag once;
    if (std::getenv("OMP_WAIT_POLICY") != nullptr)
        return;
    std::call_once(once, [] {
        std::promise<void> pool_is_there;
        std::thread([&pool_is_there] {
            std::atomic<int> present{0};
#pragma omp parallel num_threads(2)
            ++present;
            pool_is_there.set_value();
            for (;;)
                pause(); // a pool ends with the thread that made it
        }).detach();
        pool_is_there.get_future().wait();
    });
}

void start_threads(int wanted) {
    static int started = 0;
    const int asked = std::clamp(wanted > 0 ? wanted : omp_get_max_threads(), 1, most_threads);
    if (started > 0)
        return omp_set_num_threads(wanted > 0 ? std::min(asked, started) : started);
    started = asked;
    while (started > 1 && !can_start(started))
        started /= 2;
    if (started < asked)
        fmt::print(stderr, "lockstep: note: {} threads cannot be started here; the reference runs on {}\n", asked,
                   started);
    omp_set_num_threads(started);
    meet();
}

} // namespace lockstep
