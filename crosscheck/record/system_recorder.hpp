#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "crosscheck/files/atomic_file.hpp"
#include "crosscheck/judge/system.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What a recording of a system says of its run besides the states.
struct SystemRunInfo {
    std::string name = {}; ///< the run's
    /// Of a scene file, and what was changed in it; null of a program that has its system built in.
    nlohmann::json scene = {}, options = {};
    std::string settings = {}, renderer = {}, shaders = {}; ///< as reports tell them
    Profile profile = {};
    int frames = 0;
};

/// Writes a recording of any system's run (docs/traces.md): of each buffer and image the start, and what each pass left
/// there. The file gets its name at commit(), or goes away. Every function throws Error naming the path.
class SystemRecorder {
  public:
    /// `system` outlives this.
    SystemRecorder(std::filesystem::path path, const System& system, const SystemRunInfo& info, int deflate = 1);
    ~SystemRecorder();
    SystemRecorder(const SystemRecorder&) = delete;
    SystemRecorder& operator=(const SystemRecorder&) = delete;

    /// What the dispatch of pass `pass` left of its buffers and images.
    void add(std::size_t pass, int frame, const SystemState& state);
    void commit();

  private:
    class File;

    const System& system_;
    AtomicFile target_;
    std::filesystem::path temporary_;
    std::unique_ptr<File> file_;
};

} // namespace lockstep
