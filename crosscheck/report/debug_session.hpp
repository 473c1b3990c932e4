#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/report/debug_condition.hpp"
#include "crosscheck/report/debug_lines.hpp"
#include "crosscheck/report/debug_run.hpp"

namespace lockstep {

/// What a session starts from.
struct DebugSetup {
    /// A run with these `name=value` changes on top of what the command line asked for; throws Error.
    std::function<std::unique_ptr<DebugRun>(const std::vector<std::string>& changes)> start;
    int frames = 60;                     ///< how far `next` and `continue` look
    std::optional<int> recorded = {};    ///< frames that there are; none: as many as one likes
    std::string unchangeable = {};       ///< why nothing can be `set`; empty: it can
    std::vector<std::string> names = {}; ///< that `set` changes, for completion
    NumberFormat format = NumberFormat::decimal;
    /// Whether to stop what takes long: Ctrl-C. May be empty.
    std::function<bool()> stop = {};
    std::string heading = {}; ///< scene, switches and driver, whole lines
    /// Gets what each command of a file says, as soon as it is done. Empty: they say it together.
    std::function<void(const std::string& lines)> say = {};
};

/// Both sides of one item at a time, walked through by commands (docs/explain.md). A command that cannot be done throws
/// Error and leaves the session where it was; one that is stopped throws it, too, and leaves the session in the frame
/// that was reached.
class DebugSession {
  public:
    explicit DebugSession(DebugSetup setup);

    /// What runs, where the session begins and what can be typed.
    [[nodiscard]] std::string opening() const;

    /// Obeys one line; gives what it has to say, whole lines.
    std::string obey(const std::string& line);

    [[nodiscard]] bool ended() const { return ended_; }

    /// How the last word of a line can end, whole words.
    [[nodiscard]] std::vector<std::string> completions(const std::string& line) const;

  private:
    struct Command {
        std::string_view name, letter, argument, meaning;
        std::string (DebugSession::*obey)(const std::string& argument);
    };
    static const std::vector<Command>& commands();

    std::string frame(const std::string& argument);
    std::string show(const std::string& argument);
    std::string step(const std::string& argument);
    std::string back(const std::string& argument);
    std::string line(const std::string& argument);
    std::string next(const std::string& argument);
    std::string why(const std::string& argument);
    std::string print(const std::string& argument);
    std::string history(const std::string& argument);
    std::string stop_where(const std::string& argument);
    std::string go_on(const std::string& argument);
    std::string set(const std::string& argument);
    std::string list(const std::string& argument);
    std::string source(const std::string& argument);
    std::string help(const std::string& argument);
    std::string quit(const std::string& argument);

    using Wanted = std::function<bool(const StepRow&)>;

    [[nodiscard]] std::string answer(const std::string& name, const std::string& argument);
    [[nodiscard]] bool stopped() const { return setup_.stop && setup_.stop(); }
    void go_on() const {
        if (stopped())
            throw Stopped();
    }
    void run_to(int frame);
    void look_at(DebugItem item);
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] std::string place() const;
    [[nodiscard]] std::string frame_summary();
    std::string move_by(std::ptrdiff_t rows);
    bool find_row(const Wanted& wanted);
    /// Stops at the next wanted row: in this table, of the items that `items` gives for this frame after this one, then
    /// of those of the frames that follow.
    std::string find(const std::string& what, const Wanted& wanted,
                     const std::function<std::vector<DebugItem>()>& items);
    /// Works on what is told anew in each frame after this one until it gives a text; without one the session stays.
    std::string find_frame(const std::string& what, const std::function<std::string()>& work);
    /// DebugRun::verdicts, unless the session is to stop.
    [[nodiscard]] std::vector<ItemVerdict> verdicts(std::size_t group);
    [[nodiscard]] std::vector<DebugItem> of_class(DifferenceClass least);
    [[nodiscard]] std::vector<DebugItem> with_nan();

    DebugSetup setup_;
    std::vector<std::string> changes_;
    std::vector<DebugCondition> conditions_;
    std::vector<std::string> lines_to_stop_at_; ///< FILE:LINE
    std::unique_ptr<DebugRun> run_;
    DebugItem item_;
    std::vector<StepRow> rows_;
    std::optional<std::size_t> row_;  ///< the row the session stands at; none: before the first
    std::vector<DebugLine> lines_;    ///< that the item comes to; empty: nobody asked
    std::optional<std::size_t> line_; ///< the line the session stands at; none: before the first
    int sourced_ = 0;                 ///< how many files of commands are being obeyed, one from within the other
    bool ended_ = false;
};

} // namespace lockstep
