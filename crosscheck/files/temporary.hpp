#pragma once
#include <filesystem>
#include <list>
#include <string>

namespace lockstep {

/// A file, or a folder that is empty by then, that goes away with this, and with the program when a signal ends it
/// (signals.hpp). Only SIGKILL leaves it behind.
class Temporary {
  public:
    Temporary() = default;
    /// Before anything is made of that name.
    explicit Temporary(std::filesystem::path path);
    ~Temporary();
    Temporary(Temporary&& other) noexcept;
    Temporary& operator=(Temporary&& other) noexcept;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] bool empty() const { return path_.empty(); }

    /// It stays, or has gone already.
    void keep();

  private:
    std::filesystem::path path_;
    std::list<std::string>::iterator entry_;
};

/// A name beside `file` that no other run uses.
std::filesystem::path temporary_name(const std::filesystem::path& file);

/// All of them, the last made first. For a signal handler.
void remove_temporaries();

} // namespace lockstep
