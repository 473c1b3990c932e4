#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/collision/judge/frame_run.hpp"
#include "crosscheck/collision/judge/step_table.hpp"
#include "crosscheck/collision/report/explain_text.hpp"

namespace lockstep {

/// What a session starts from.
struct DebugSetup {
    /// The scene with these `name=value` changes on top of what the command line asked for; throws Error.
    std::function<Scene(const std::vector<std::string>& changes)> load;
    /// A run of a scene in the current context.
    std::function<std::unique_ptr<FrameRun>(Scene scene)> start;
    int frames = 60; ///< how far `next` looks
    NumberFormat format = NumberFormat::decimal;
};

/// Both sides of one particle or texel at a time, walked through by commands (docs/explain.md). A command that cannot
/// be done throws Error and leaves the session where it was.
class DebugSession {
  public:
    explicit DebugSession(DebugSetup setup);

    /// Obeys one line; gives what it has to say, whole lines.
    std::string obey(const std::string& line);

    [[nodiscard]] bool ended() const { return ended_; }

  private:
    struct Command {
        std::string_view name;
        std::string_view argument;
        std::string_view meaning;
        std::string (DebugSession::*obey)(const std::string& argument);
    };
    static const std::vector<Command>& commands();

    std::string frame(const std::string& argument);
    std::string particle(const std::string& argument);
    std::string texel(const std::string& argument);
    std::string show(const std::string& argument);
    std::string step(const std::string& argument);
    std::string back(const std::string& argument);
    std::string next(const std::string& argument);
    std::string why(const std::string& argument);
    std::string set(const std::string& argument);
    std::string list(const std::string& argument);
    std::string help(const std::string& argument);
    std::string quit(const std::string& argument);

    /// A particle, or a texel.
    struct Item {
        bool is_texel = false;
        std::size_t index = 0;
    };
    using Wanted = std::function<bool(const StepRow&)>;

    void go_to(int frame);
    void look_at(Item item);
    [[nodiscard]] std::string name_of(Item item) const;
    [[nodiscard]] std::string place() const;
    [[nodiscard]] std::string frame_summary();
    std::string move_by(std::ptrdiff_t rows);
    bool find_row(const Wanted& wanted);
    /// Stops at the next wanted row: in this table, of the items that `items` gives for this frame after this one, then
    /// of those of the frames that follow.
    std::string find(const std::string& what, const Wanted& wanted, const std::function<std::vector<Item>()>& items);
    [[nodiscard]] std::vector<Item> of_class(DifferenceClass least);
    [[nodiscard]] std::vector<Item> with_nan() const;

    DebugSetup setup_;
    std::vector<std::string> changes_;
    std::unique_ptr<FrameRun> run_;
    Item item_;
    std::vector<StepRow> rows_;
    std::optional<StepTable> table_; ///< of a particle
    std::optional<std::size_t> row_; ///< the row the session stands at; none: before the first
    bool ended_ = false;
};

} // namespace lockstep
