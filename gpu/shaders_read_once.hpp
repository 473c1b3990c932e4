#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lockstep {

/// While one lives, every shader file is read once, or found missing once: a run, its report and its capsule are of the
/// same text, whatever is saved meanwhile. At most one at a time.
class ShadersReadOnce {
  public:
    ShadersReadOnce();
    ~ShadersReadOnce();
    ShadersReadOnce(const ShadersReadOnce&) = delete;
    ShadersReadOnce& operator=(const ShadersReadOnce&) = delete;
};

/// What it has read so far, with bindings.json and what stages include; no text: a file that was looked for and is
/// absent. Empty where none lives.
std::vector<std::pair<std::filesystem::path, std::optional<std::string>>> shaders_read();

} // namespace lockstep
