#pragma once
/// A system of one's own (docs/own_system.md): what its state is (Schema), the twin of each pass (values.hpp has the
/// words of a twin), and the shaders that a GL context runs. check() compares and judges, explain_item() looks into one
/// item.
#include <string>

#include "crosscheck/judge/system.hpp"
#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/record/item_capsule.hpp"
#include "crosscheck/report/item_text.hpp"
#include "crosscheck/report/power_text.hpp"
#include "crosscheck/report/report.hpp"
#include "gpu/gl_system.hpp"
#include "lockstep/lockstep.hpp"
#include "reference/system/item_twin.hpp"

namespace lockstep {

/// A system's passes on a context's GL; its profile is the context's, as measured for shaders that say `precise`, or
/// for some that do not.
class GlSystemSide final : public SystemSide {
  public:
    /// `gl` and `system` outlive this. `shaders`: the folder of the passes' files. Throws Error for what is wrong with
    /// one.
    GlSystemSide(const Gl& gl, const System& system, std::vector<GlPass> passes, const std::string& shaders,
                 ArithmeticSwitch arithmetic = ArithmeticSwitch::plain);

    [[nodiscard]] SideDescription describe() const override;
    void upload(const SystemView& state) override { system_.upload(state); }
    void step(std::size_t pass, int frame) override { system_.step(pass, frame); }
    void read(SystemState& state) const override { system_.read(state); }
    [[nodiscard]] std::optional<bool> holds(const View& state) const override { return system_.holds(state); }
    [[nodiscard]] std::optional<bool> left(const View& before) const override { return system_.left(before); }
    [[nodiscard]] bool reaches(std::size_t pass, FieldId field) const override { return system_.reaches(pass, field); }
    [[nodiscard]] std::optional<std::uint64_t> ran_over() const override { return system_.ran_over(); }
    [[nodiscard]] bool repeats() const override { return true; }
    void lay_canary(std::size_t pass) override { system_.lay_canary(pass); }
    void repeat_step(std::size_t pass, int frame) override { system_.repeat_step(pass, frame); }
    [[nodiscard]] ColorImage picture(std::size_t pass, int frame, const GlPicture& how) {
        return system_.picture(pass, frame, how);
    }
    [[nodiscard]] const std::vector<GlPass>& passes() const { return passes_; }
    [[nodiscard]] const std::string& shaders() const { return shaders_; } ///< the folder of the passes' files
    [[nodiscard]] ArithmeticSwitch arithmetic() const { return arithmetic_; }
    void time_steps(bool on) { system_.time_steps(on); }
    [[nodiscard]] GlSystem::Seconds seconds() const { return system_.seconds(); }
    std::vector<CapturedVertex> trace(std::size_t pass, int frame, std::size_t item) override {
        return system_.trace(pass, frame, item);
    }

  private:
    const Gl& gl_;
    std::vector<GlPass> passes_;
    std::string shaders_;
    ArithmeticSwitch arithmetic_;
    std::vector<ShaderWarning> warnings_;
    GlSystem system_;
};

/// How a side is compared with a system's twins; as the options of `lockstep check` of the same names.
struct SystemMatchOptions {
    int frames = 60; ///< from the system's start
    CheckMode mode = CheckMode::resync;
    Legal legal = Legal::measured;
    bool allow_undefined = false; ///< pass what rests on what GL leaves open
    double power_at_least = 0.0;  ///< fail a run that would have shown a smaller share of the mistakes with names
    std::string repeat = {};      ///< the command that repeats it; empty: this program's own command line
    /// A folder of texts that do what the passes have to do, as for passes_by_text (shader_text.hpp): notes name the
    /// line of a DIVERGENT shader that has no counterpart there. The system's passes stay the reference.
    std::string reference = {};
};

/// Runs both sides for `frames` frames; what check() found, with the heading of a report. Of shaders on GL, what their
/// texts leave open is legal, and notes say what runs of the texts find (docs/shader_text.md).
MatchResult match_system(SystemSide& gpu, const System& system, const SystemMatchOptions& options = {});

} // namespace lockstep
