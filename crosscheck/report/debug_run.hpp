#pragma once
#include <compare>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/step_row.hpp"
#include "crosscheck/judge/text_steps.hpp"
#include "crosscheck/report/value_text.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// One item of a frame: of which group (DebugRun::groups), and its number there.
struct DebugItem {
    std::size_t group = 0, index = 0;
    auto operator<=>(const DebugItem&) const = default;
};

/// A command that chooses an item: "particle I".
struct DebugSelector {
    std::string_view name, argument, meaning;
};

/// Thrown by a run that was asked to stop (DebugRun::stop_when); it stands in frame(), on the way to where it was sent.
struct Stopped {};

/// Both sides of a run in resync, one frame at a time, as a debugging session walks through it. What is judged together
/// is a group of items: the particles, the texels, or what one pass wrote. Every function throws Error where the run
/// cannot be made, and those that run frames throw Stopped.
class DebugRun {
  public:
    DebugRun() = default;
    virtual ~DebugRun() = default;
    DebugRun(const DebugRun&) = delete;
    DebugRun& operator=(const DebugRun&) = delete;

    /// What takes long ends, with Stopped, once `stop` is true. Without: never.
    void stop_when(std::function<bool()> stop) { stop_ = std::move(stop); }

    /// Runs to the end of frame `frame`, counted from 0; back ones from the start again.
    virtual void go_to(int frame) = 0;
    [[nodiscard]] virtual int frame() const = 0;

    /// Their names, in the order in which a frame makes them.
    [[nodiscard]] virtual std::vector<std::string> groups() const = 0;
    [[nodiscard]] virtual std::vector<DebugSelector> selectors() const = 0;
    /// The item that selectors()[selector] chooses where `now` was looked at. Throws Error where there is none.
    [[nodiscard]] virtual DebugItem select(std::size_t selector, const std::string& argument, DebugItem now) = 0;
    /// The item itself, or the first of the next group that this frame makes.
    [[nodiscard]] virtual DebugItem nearest(DebugItem item) { return item; }

    /// "particle 17", "update, grain 17"
    [[nodiscard]] virtual std::string name(DebugItem item) const = 0;
    /// What is told when a session comes to it, whole lines.
    [[nodiscard]] virtual std::string head(DebugItem item, NumberFormat format) = 0;
    [[nodiscard]] virtual std::string show(DebugItem item, NumberFormat format) = 0;
    [[nodiscard]] virtual std::string why(DebugItem item, NumberFormat format) = 0;
    [[nodiscard]] virtual std::vector<StepRow> rows(DebugItem item) = 0;
    /// What the shader's text computes for it; ItemSteps::not_known where there is none.
    [[nodiscard]] virtual ItemSteps text(DebugItem /*item*/) {
        return {.file = {}, .not_known = "this pass has no text that is run"};
    }

    /// On what differs in this frame, in order; empty for a group that it does not make.
    [[nodiscard]] virtual std::vector<ItemVerdict> verdicts(std::size_t group) = 0;

    struct States {
        View reference, gpu;
    };
    /// What both sides made of a group in this frame; of no items where it does not make it. Views end with the next
    /// call.
    [[nodiscard]] virtual States states(std::size_t group) = 0;

  protected:
    /// Called in between by what takes long.
    void go_on() const {
        if (stop_ && stop_())
            throw Stopped();
    }

  private:
    std::function<bool()> stop_;
};

} // namespace lockstep
