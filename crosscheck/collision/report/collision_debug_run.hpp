#pragma once
#include <memory>
#include <optional>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/judge/step_table.hpp"
#include "crosscheck/report/debug_run.hpp"

namespace lockstep {

/// Particles, and texels of the CDT.
class CollisionDebugRun final : public DebugRun {
  public:
    explicit CollisionDebugRun(std::unique_ptr<FrameRun> run);

    void go_to(int frame) override;
    [[nodiscard]] int frame() const override { return run_->frame(); }
    [[nodiscard]] std::vector<std::string> groups() const override;
    [[nodiscard]] std::vector<DebugSelector> selectors() const override;
    [[nodiscard]] DebugItem select(std::size_t selector, const std::string& argument, DebugItem now) override;
    [[nodiscard]] std::string name(DebugItem item) const override;
    [[nodiscard]] std::string head(DebugItem item, NumberFormat format) override;
    [[nodiscard]] std::string show(DebugItem item, NumberFormat format) override;
    [[nodiscard]] std::string why(DebugItem item, NumberFormat format) override;
    [[nodiscard]] std::vector<StepRow> rows(DebugItem item) override;
    [[nodiscard]] std::vector<ItemVerdict> verdicts(std::size_t group) override;
    [[nodiscard]] States states(std::size_t group) override;

  private:
    std::unique_ptr<FrameRun> run_;
    std::optional<StepTable> table_; ///< of the particle that was looked at last
};

} // namespace lockstep
