#pragma once
#include <chrono>
#include <string>

namespace lockstep {

/// A progress bar on standard error; silent unless that is a terminal. Redrawn at most ten times a second and wiped
/// when done.
class Progress {
  public:
    Progress(std::string what, int total, bool wanted);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void show(int done);

  private:
    std::string what_;
    int total_;
    bool active_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point drawn_{};
};

} // namespace lockstep
