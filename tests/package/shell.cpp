#include "tests/package/shell.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

#include <sys/wait.h>

namespace lockstep::test {

ShellOutcome run_in_shell(const std::string& command) {
    const std::string line = "exec 2>&1; PATH='" LOCKSTEP_PROGRAM_FOLDER "':\"$PATH\"; " + command;
    std::FILE* pipe = popen(line.c_str(), "r");
    if (pipe == nullptr)
        throw std::runtime_error("popen failed");
    ShellOutcome outcome;
    std::array<char, 4096> chunk{};
    while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), pipe))
        outcome.out.append(chunk.data(), count);
    const int status = pclose(pipe);
    if (WIFEXITED(status))
        outcome.status = WEXITSTATUS(status);
    return outcome;
}

} // namespace lockstep::test
