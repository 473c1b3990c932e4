#include "gpu/syscall_fence.hpp"

#include <cerrno>
#include <cstring>
#include <initializer_list>
#include <memory>

#include <fcntl.h>
#include <seccomp.h>
#include <sys/mman.h>

namespace lockstep {
namespace {

/// What allocation, reading, sanitizers and the end of a process need in any C library; a name that this machine's
/// kernel or libseccomp does not know is passed over.
constexpr std::initializer_list<const char*> always = {
    "read",         "readv",           "pread64",       "preadv",       "lseek",      "_llseek",         "fstat",
    "fstat64",      "newfstatat",      "fstatat64",     "statx",        "close",      "flock",           "recvfrom",
    "recv",         "recvmsg",         "brk",           "munmap",       "mremap",     "madvise",         "futex",
    "futex_time64", "getrandom",       "clock_gettime", "gettimeofday", "time",       "clock_gettime64", "getrusage",
    "getpid",       "gettid",          "getrlimit",     "ugetrlimit",   "setrlimit",  "rt_sigprocmask",  "rt_sigreturn",
    "sigreturn",    "restart_syscall", "sched_yield",   "exit",         "exit_group", "sigaltstack"};

/// libhdf5 looks at a name before and after it opens it; then the next fence is put up.
constexpr std::initializer_list<const char*> while_opening = {
    "stat",   "stat64",   "lstat",      "lstat64", "access",  "faccessat", "faccessat2",
    "getcwd", "readlink", "readlinkat", "fcntl",   "fcntl64", "seccomp",   "prctl"};

using Filter = std::unique_ptr<void, void (*)(scmp_filter_ctx)>;

bool allow(const Filter& filter, const char* name, std::initializer_list<scmp_arg_cmp> conditions = {}) {
    const int number = seccomp_syscall_resolve_name(name);
    if (number == __NR_SCMP_ERROR)
        return true;
    const int failed = seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, number,
                                              static_cast<unsigned>(conditions.size()), conditions.begin());
    return failed == 0 || failed == -EDOM; // not on this architecture
}

scmp_arg_cmp without(unsigned argument, scmp_datum_t flags) { return {argument, SCMP_CMP_MASKED_EQ, flags, 0}; }

bool add_rules(const Filter& filter, Fence fence, int writable) {
    bool added = true;
    for (const char* name : always)
        added = allow(filter, name) && added;
    for (const char* name : {"write", "writev"})
        added = allow(filter, name, {{0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(writable), 0}}) && added;
    for (const char* name : {"mmap", "mmap2", "mprotect"})
        added = allow(filter, name, {without(2, PROT_EXEC)}) && added;
    added = allow(filter, "prlimit64", {{0, SCMP_CMP_EQ, 0, 0}}) && added; // its own
    if (fence == Fence::reading)
        return added;
    constexpr scmp_datum_t writing = O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND;
    static_assert(O_RDONLY == 0);
    for (const char* name : while_opening)
        added = allow(filter, name) && added;
    return allow(filter, "open", {without(1, writing)}) && allow(filter, "openat", {without(2, writing)}) && added;
}

} // namespace

std::string put_up_fence(Fence fence, int writable) {
    const Filter filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release);
    if (!filter || !add_rules(filter, fence, writable))
        return "libseccomp refuses its rules";
    const int failed = seccomp_load(filter.get());
    return failed == 0 ? "" : std::strerror(-failed);
}

} // namespace lockstep
