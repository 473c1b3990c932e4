#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/judge/system.hpp"
#include "crosscheck/record/reading_process.hpp"
#include "crosscheck/record/system_recorder.hpp"
#include "gpu/system_side.hpp"

namespace lockstep {

/// The system that a recording's seal names; empty: a trace, of a scene without "system". Throws Error where the file
/// is neither.
std::string recorded_system(const std::filesystem::path& file);

/// A recorded run of a system. The seal is checked first, then processes of their own read the same file
/// (reading_process.hpp): what its run was, then its states. Nothing they tell is believed. Every function throws Error
/// naming the file.
class SystemRecording {
  public:
    /// `system`: its schema's name, which the seal has to have.
    SystemRecording(const std::filesystem::path& file, const std::string& system);

    /// What the file says of its run, before the system is known.
    [[nodiscard]] const SystemRunInfo& info() const { return info_; }
    [[nodiscard]] std::string file() const { return file_.path().string(); }
    [[nodiscard]] const std::string& program() const { return program_; }

    /// Opens the states, for a system of the recorded schema, sizes and start. Once, before what follows. `system`
    /// outlives this.
    void open(const System& system);
    [[nodiscard]] int frames() const { return frames_; } ///< whole ones
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// A row of a buffer or image: 0 the start, then one for each dispatch that wrote it.
    void read(std::uint8_t resource, std::size_t row, const WritableView& into);

  private:
    void read_info(const std::string& system);
    void expect_schedule(const System& system, const std::vector<std::vector<std::int32_t>>& frames,
                         const std::vector<std::vector<std::int32_t>>& passes);

    OpenedFile file_;
    SystemRunInfo info_;
    std::string program_;
    nlohmann::json schema_;
    std::unique_ptr<ReadingProcess> process_;
    int frames_ = 0;
    std::vector<std::string> warnings_;
};

/// The GPU's side of a run that was recorded: what each pass left, in order from the start.
class RecordedSide final : public SystemSide {
  public:
    /// Both outlive this; `recording` is open for `system`.
    RecordedSide(SystemRecording& recording, const System& system)
        : recording_(recording), system_(system), state_(system.start), next_(system.schema.resources.size(), 1) {}

    /// Starts again; `state` is the recorded start, as the system's is.
    void upload(const SystemView& state) override;
    void step(std::size_t pass, int frame) override;
    void read(SystemState& state) const override { state = state_; }
    [[nodiscard]] SideDescription describe() const override;

  private:
    SystemRecording& recording_;
    const System& system_;
    SystemState state_;
    std::vector<std::size_t> next_; ///< row of each buffer and image
};

} // namespace lockstep
