#include "gpu/environment.hpp"

#include <algorithm>
#include <cstdlib>
#include <latch>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pthread.h>
#include <sys/resource.h>

namespace lockstep {
namespace {

/// Variables with which a user chooses a driver that the library then cannot give, or chooses a library.
constexpr std::initializer_list<const char*> choosers = {
    "GALLIUM_DRIVER",         "MESA_LOADER_DRIVER_OVERRIDE", "LIBGL_ALWAYS_SOFTWARE",          "LIBGL_DRIVERS_PATH",
    "EGL_PLATFORM",           "__EGL_VENDOR_LIBRARY_DIRS",   "__EGL_VENDOR_LIBRARY_FILENAMES", "LOCKSTEP_EGL_LIBRARY",
    "LOCKSTEP_OSMESA_LIBRARY"};

rlim_t limit_of(decltype(RLIMIT_AS) resource) {
    rlimit limits{};
    return getrlimit(resource, &limits) == 0 ? limits.rlim_cur : RLIM_INFINITY;
}

/// ": 100"; empty: there is none, and a container has set its own.
std::string process_limit() {
    const rlim_t processes = limit_of(RLIMIT_NPROC);
    return processes == RLIM_INFINITY ? "" : fmt::format(": {}", processes);
}

} // namespace

std::string tight_limits() {
    constexpr rlim_t few_files = 64, small_stack = rlim_t{1} << 20U;
    std::vector<std::string> clauses;
    for (const auto& [resource, letter] : {std::pair{RLIMIT_AS, 'v'}, {RLIMIT_DATA, 'd'}})
        if (const rlim_t bytes = limit_of(resource); bytes != RLIM_INFINITY)
            clauses.push_back(fmt::format("memory is limited to {} KiB (ulimit -{})", bytes >> 10U, letter));
    if (const rlim_t bytes = limit_of(RLIMIT_STACK); bytes < small_stack)
        clauses.push_back(fmt::format("the stack is limited to {} KiB (ulimit -s)", bytes >> 10U));
    if (const rlim_t files = limit_of(RLIMIT_NOFILE); files < few_files)
        clauses.push_back(fmt::format("open files are limited to {} (ulimit -n)", files));
    return fmt::format("{}", fmt::join(clauses, ", "));
}

bool can_start_driver_threads() {
    constexpr unsigned most_rasterisers = 32, besides = 4; // of llvmpipe; its queues
    const unsigned wanted = std::clamp(std::thread::hardware_concurrency(), 1U, most_rasterisers) + besides;
    std::latch all_were_tried{1};
    // No std::thread, which frees memory: that reserves an arena of the heap for each.
    const auto wait = [](void* latch) -> void* {
        static_cast<std::latch*>(latch)->wait();
        return nullptr;
    };
    std::vector<pthread_t> threads;
    for (pthread_t thread{}; threads.size() < wanted && pthread_create(&thread, nullptr, wait, &all_were_tried) == 0;)
        threads.push_back(thread);
    all_were_tried.count_down();
    for (const pthread_t thread : threads)
        pthread_join(thread, nullptr);
    return threads.size() == wanted;
}

std::string prepare_for_driver() {
    constexpr std::size_t longest = 60;
    std::vector<std::string> clauses;
    for (const char* name : choosers)
        if (const char* value = std::getenv(name); value != nullptr && *value != '\0')
            clauses.push_back(fmt::format("{} is {}", name, std::string_view(value).substr(0, longest)));
    if (std::string limits = tight_limits(); !limits.empty())
        clauses.push_back(std::move(limits));
    if (!can_start_driver_threads()) {
        setenv("LP_NUM_THREADS", "0", 0);
        clauses.push_back(fmt::format("no further threads can be started (ulimit -u{})", process_limit()));
    }
    return fmt::format("{}", fmt::join(clauses, ", "));
}

} // namespace lockstep
