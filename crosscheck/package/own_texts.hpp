#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/system.hpp"
#include "crosscheck/package/shader_findings.hpp"
#include "crosscheck/package/text_passes.hpp"
#include "crosscheck/report/report.hpp"
#include "lockstep/system.hpp"

namespace lockstep {

/// A system of which passes may become others': its own ask those of `system`, which outlives it.
System beside(const System& system);

/// The texts of a system of one's own: of shaders that are the references of its passes, and of those that GL runs.
class SystemTexts {
  public:
    /// Changes the passes of `system`, which outlives this, as do `passes`.
    SystemTexts(System& system, const std::vector<GlPass>& passes,
                ArithmeticSwitch arithmetic = ArithmeticSwitch::plain)
        : of_{system, passes, arithmetic} {}

    /// The shaders of `folder` become the references of their passes. `gpu`: where the GPU's are, if that is known.
    /// Throws Error where none is a pass's, or one is not interpreted.
    void take_references(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& gpu,
                         UnusedShaders unused = UnusedShaders::refused);
    /// What the texts in `folder`, which GL runs, leave open is legal. `reference`: where the reference's texts are.
    void take_shaders(const std::filesystem::path& folder, const std::filesystem::path& reference);

    /// What they say of a check.
    [[nodiscard]] TextNotes notes(SystemSide& side, const KnownOperations& known, CheckReport& report,
                                  CoveredRuns covered = CoveredRuns::watched) const;

  private:
    ShadedSystem of_;
    References references_;
    std::optional<OwnShaders> own_;
};

} // namespace lockstep
