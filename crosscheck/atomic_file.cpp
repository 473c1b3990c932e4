#include "crosscheck/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <unistd.h>

#include "reference/model/error.hpp"

namespace lockstep {

void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write) {
    std::filesystem::path temporary = path;
    temporary += fmt::format(".{}.part", getpid());
    std::error_code ignored;
    try {
        write(temporary);
    } catch (...) {
        std::filesystem::remove(temporary, ignored);
        throw;
    }
    std::error_code failed;
    std::filesystem::rename(temporary, path, failed);
    if (failed) {
        std::filesystem::remove(temporary, ignored);
        throw Error(fmt::format("{}: cannot be written: {}", path.string(), failed.message()));
    }
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
    write_atomically(path, [&](const std::filesystem::path& temporary) {
        std::FILE* file = std::fopen(temporary.c_str(), "wb");
        const auto fail = [&] {
            throw Error(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
        };
        if (file == nullptr)
            fail();
        const bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
        const int error = errno;
        if (std::fclose(file) != 0 || !whole) {
            if (!whole)
                errno = error;
            fail();
        }
    });
}

void make_output_directory(const std::filesystem::path& directory) {
    std::error_code failed;
    std::filesystem::create_directories(directory, failed);
    if (failed || !std::filesystem::is_directory(directory))
        throw Error(fmt::format("{}: cannot be made a directory: {}", directory.string(),
                                failed ? failed.message() : "a file of that name is in the way"));
    if (access(directory.c_str(), W_OK | X_OK) != 0)
        throw Error(fmt::format("{}: cannot be written to: {}", directory.string(), std::strerror(errno)));
}

} // namespace lockstep
