#pragma once
#include <memory>

#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/report/debug_run.hpp"

namespace lockstep {

/// Of any system: the items of each pass.
class SystemDebugRun final : public DebugRun {
  public:
    SystemDebugRun(std::shared_ptr<const System> system, std::shared_ptr<SystemSide> gpu, const KnownOperations& known);

    void go_to(int frame) override;
    [[nodiscard]] int frame() const override { return frame_; }
    [[nodiscard]] std::vector<std::string> groups() const override;
    [[nodiscard]] std::vector<DebugSelector> selectors() const override;
    [[nodiscard]] DebugItem select(std::size_t selector, const std::string& argument, DebugItem now) override;
    [[nodiscard]] DebugItem nearest(DebugItem item) override;
    [[nodiscard]] std::string name(DebugItem item) const override;
    [[nodiscard]] std::string head(DebugItem item, NumberFormat format) override;
    [[nodiscard]] std::string show(DebugItem item, NumberFormat format) override;
    [[nodiscard]] std::string why(DebugItem item, NumberFormat format) override;
    [[nodiscard]] std::vector<StepRow> rows(DebugItem item) override;
    [[nodiscard]] ItemSteps text(DebugItem item) override;
    [[nodiscard]] std::vector<ItemVerdict> verdicts(std::size_t group) override;
    [[nodiscard]] States states(std::size_t group) override;

  private:
    /// To a pass of this frame.
    void come_to(std::size_t pass);
    [[nodiscard]] bool runs(std::size_t pass) const { return system_->passes[pass]->runs(frame_); }
    [[nodiscard]] Extent extent(std::size_t pass) const;

    std::shared_ptr<const System> system_;
    std::shared_ptr<SystemSide> gpu_;
    SystemRun run_;
    int frame_ = 0;
};

} // namespace lockstep
