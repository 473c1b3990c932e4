#include "crosscheck/report/debug_session.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/report/row_text.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

constexpr int most_frames = 100'000'000;
constexpr int most_sourced = 16;
constexpr std::uint64_t most_bytes_of_commands = 1'000'000;

int number_in(std::string_view command, const std::string& text, int least, int most,
              std::optional<int> otherwise = {}) {
    if (text.empty() && otherwise)
        return *otherwise;
    int value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, status] = std::from_chars(text.data(), end, value);
    if (status != std::errc{} || rest != end || value < least || value > most)
        throw Error(fmt::format("{}: '{}' is not an integer from {} to {}", command, text, least, most));
    return value;
}

/// What begins so; the last word of a line is being typed.
std::vector<std::string> beginning(const std::string& word, const std::vector<std::string>& all) {
    std::vector<std::string> found;
    for (const std::string& one : all)
        if (one.starts_with(word) && std::find(found.begin(), found.end(), one) == found.end())
            found.push_back(one);
    return found;
}

/// Counts what lasts as long as it does.
class Counted {
  public:
    explicit Counted(int& count) : count_(count) { ++count_; }
    ~Counted() { --count_; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;

  private:
    int& count_;
};

std::vector<std::string> words_of(std::string_view choices) {
    std::vector<std::string> words(1);
    for (const char c : choices)
        if (c == '|')
            words.emplace_back();
        else
            words.back() += c;
    return words;
}

} // namespace

const std::vector<DebugSession::Command>& DebugSession::commands() {
    static const std::vector<Command> all{
        {"frame", "f", "F", "go to frame F, counted from 0", &DebugSession::frame},
        {"show", "", "", "the whole table and the verdict", &DebugSession::show},
        {"step", "s", "[N]", "the next row of the table, or N rows on", &DebugSession::step},
        {"back", "", "[N]", "the row before, or N rows back", &DebugSession::back},
        {"line", ".", "[N]",
         "the next line of the shader's text that this item comes to, or N lines on, and what it sets",
         &DebugSession::line},
        {"next", "n", "fetch|difference|divergence|nan",
         "the next texel fetch of this item; the next row with a difference, a divergence or a NaN, if need be of "
         "another item or a later frame",
         &DebugSession::next},
        {"why", "w", "", "the reasoning behind the verdict", &DebugSession::why},
        {"print", "p", "NAME", "the rows of that name, or of its components", &DebugSession::print},
        {"history", "", "[NAME]", "this item after each frame up to this one, both sides", &DebugSession::history},
        {"break", "b", "[NAME < NUMBER | FILE:LINE]",
         "where `continue` stops, by a row of this item or a line that it comes to; alone, list the breaks",
         &DebugSession::stop_where},
        {"continue", "c", "", "on to the next frame in which a `break` holds", &DebugSession::go_on},
        {"set", "", "NAME=VALUE", "change a switch or constant and run again to this frame", &DebugSession::set},
        {"list", "l", "divergent|undefined|tie|rounding", "what differs in this frame", &DebugSession::list},
        {"source", "", "FILE", "obey the commands in FILE, one a line", &DebugSession::source},
        {"help", "h", "", "these lines", &DebugSession::help},
        {"quit", "q", "", "end; so does the end of the input", &DebugSession::quit},
    };
    return all;
}

DebugSession::DebugSession(DebugSetup setup) : setup_(std::move(setup)), run_(setup_.start({})) {
    run_->go_to(0);
    look_at(item_);
    run_->stop_when(setup_.stop);
}

std::string DebugSession::opening() const {
    std::string selectors;
    for (const DebugSelector& selector : run_->selectors())
        selectors += fmt::format("`{} {}`, ", selector.name, selector.argument);
    return fmt::format("{}at        {}\n"
                       "type      `next divergence` to find the first fault; `frame F`, {}`show` to look at a step;\n"
                       "          `help` for all commands; `quit` to end\n",
                       setup_.heading, place(), selectors);
}

std::string DebugSession::obey(const std::string& line) {
    std::string text = trimmed(line.substr(0, line.find('#')));
    if (text.empty())
        return "";
    if (text.find('\0') != std::string::npos) // where an error's text would end
        text = plain_line(text);
    const std::size_t end = text.find_first_of(" \t");
    const std::string name = text.substr(0, end);
    try {
        return answer(name, end == std::string::npos ? "" : trimmed(text.substr(end)));
    } catch (const Stopped&) {
        look_at(item_);
        throw Error(fmt::format("stopped in frame {}", run_->frame()));
    }
}

std::string DebugSession::answer(const std::string& name, const std::string& argument) {
    for (const Command& command : commands())
        if (command.name == name || (!command.letter.empty() && command.letter == name)) {
            if (command.argument.empty() && !argument.empty())
                throw Error(fmt::format("{}: takes no argument, not '{}'", command.name, argument));
            return (this->*command.obey)(argument);
        }
    const std::vector<DebugSelector> selectors = run_->selectors();
    for (std::size_t s = 0; s < selectors.size(); ++s)
        if (selectors[s].name == name) {
            look_at(run_->select(s, argument, item_));
            return run_->head(item_, setup_.format);
        }
    throw Error(fmt::format("unknown command '{}'; the commands are {}{}", name, fmt::join(names(), ", "),
                            did_you_mean(name, names())));
}

std::vector<std::string> DebugSession::names() const {
    std::vector<std::string> all;
    for (const Command& command : commands()) {
        all.emplace_back(command.name);
        if (command.name == "frame")
            for (const DebugSelector& selector : run_->selectors())
                all.emplace_back(selector.name);
    }
    return all;
}

std::vector<std::string> DebugSession::completions(const std::string& line) const {
    const std::size_t last = line.find_last_of(" \t");
    const std::string word = last == std::string::npos ? line : line.substr(last + 1);
    const std::string before = last == std::string::npos ? "" : trimmed(line.substr(0, last));
    if (before.empty())
        return beginning(word, names());
    for (const Command& command : commands()) {
        if (command.name != before && command.letter != before)
            continue;
        if (command.name == "set")
            return beginning(word, setup_.names);
        if (command.name == "print" || command.name == "break" || command.name == "history") {
            std::vector<std::string> labels;
            for (const StepRow& row : rows_)
                labels.push_back(row.label);
            return beginning(word, labels);
        }
        if (command.argument.find('|') != std::string_view::npos)
            return beginning(word, words_of(command.argument));
    }
    if (before == "pass")
        return beginning(word, run_->groups());
    return {};
}

void DebugSession::run_to(int frame) {
    if (setup_.recorded && frame >= *setup_.recorded)
        throw Error(fmt::format("frame {}: the recording holds frames 0 to {}", frame, *setup_.recorded - 1));
    run_->go_to(frame);
}

void DebugSession::look_at(DebugItem item) {
    item = run_->nearest(item);
    rows_ = run_->rows(item);
    item_ = item;
    row_.reset();
    lines_.clear();
    line_.reset();
}

std::string DebugSession::place() const { return fmt::format("frame {} {}", run_->frame(), run_->name(item_)); }

std::string DebugSession::frame_summary() {
    const std::vector<std::string> groups = run_->groups();
    std::string text;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (run_->states(g).gpu.columns.empty())
            continue;
        std::array<std::size_t, class_names.size()> of{};
        for (const ItemVerdict& item : verdicts(g))
            ++of[static_cast<std::size_t>(item.kind)];
        if (g == item_.group)
            look_at(item_); // on the way: a group that lies behind takes the run from its start
        std::string counts;
        for (std::size_t k = 0; k < of.size(); ++k)
            if (of[k] > 0)
                counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", grouped(of[k]), class_names[k]);
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", groups[g], counts.empty() ? "none differ" : counts);
    }
    return fmt::format("frame {}: {}\n", run_->frame(), text.empty() ? "no pass runs" : text);
}

std::string DebugSession::frame(const std::string& argument) {
    run_to(number_in("frame", argument, 0, most_frames));
    item_ = run_->nearest(item_);
    return frame_summary();
}

std::string DebugSession::show(const std::string&) { return run_->show(item_, setup_.format); }

std::string DebugSession::step(const std::string& argument) {
    return move_by(number_in("step", argument, 1, 1'000'000, 1));
}

std::string DebugSession::back(const std::string& argument) {
    return move_by(-number_in("back", argument, 1, 1'000'000, 1));
}

std::string DebugSession::line(const std::string& argument) {
    const auto lines = static_cast<std::size_t>(number_in("line", argument, 1, 1'000'000, 1));
    if (lines_.empty())
        lines_ = debug_lines(run_->text(item_), setup_.format);
    const std::size_t next = line_ ? *line_ + lines : lines - 1;
    if (lines_.empty() || next >= lines_.size())
        throw Error(fmt::format("{}: no further line", place()));
    line_ = next;
    return debug_line_text(lines_[next]);
}

std::string DebugSession::move_by(std::ptrdiff_t rows) {
    const std::ptrdiff_t now = row_ ? static_cast<std::ptrdiff_t>(*row_) : -1;
    const auto last = static_cast<std::ptrdiff_t>(rows_.size()) - 1;
    if (rows > 0 ? now == last : now <= 0)
        throw Error(
            now < 0 ? fmt::format("{}: no row yet to go back from", place())
                    : fmt::format("{}: {} is the {} row", place(), rows_[*row_].label, rows > 0 ? "last" : "first"));
    row_ = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(now + rows, 0, last));
    return row_text(rows_[*row_], setup_.format);
}

bool DebugSession::find_row(const Wanted& wanted) {
    const auto from = rows_.begin() + static_cast<std::ptrdiff_t>(row_ ? *row_ + 1 : 0);
    const auto found = std::find_if(from, rows_.end(), wanted);
    if (found == rows_.end())
        return false;
    row_ = static_cast<std::size_t>(found - rows_.begin());
    return true;
}

std::string DebugSession::next(const std::string& argument) {
    if (argument == "fetch") {
        if (!find_row([](const StepRow& row) { return row.is_fetch; }))
            throw Error(fmt::format("{}: no further fetch", place()));
        return row_text(rows_[*row_], setup_.format);
    }
    if (argument == "difference")
        return find(
            argument, [](const StepRow& row) { return row.differs(); },
            [this] { return of_class(DifferenceClass::rounding); });
    if (argument == "divergence")
        return find(
            argument, [](const StepRow& row) { return row.verdict == RowVerdict::divergent; },
            [this] { return of_class(DifferenceClass::divergent); });
    if (argument == "nan")
        return find(
            argument, [](const StepRow& row) { return row.has_nan(); }, [this] { return with_nan(); });
    throw Error(fmt::format("next: '{}' is not one of fetch, difference, divergence, nan", argument));
}

std::string DebugSession::find(const std::string& what, const Wanted& wanted,
                               const std::function<std::vector<DebugItem>()>& items) {
    if (find_row(wanted))
        return row_text(rows_[*row_], setup_.format);
    const auto in_this_frame = [&](const std::function<bool(DebugItem)>& after) -> std::string {
        for (const DebugItem item : items())
            if (after(item)) {
                go_on();
                look_at(item);
                if (find_row(wanted))
                    return place() + "\n" + row_text(rows_[*row_], setup_.format);
            }
        return "";
    };
    const DebugItem start = item_;
    const std::optional<std::size_t> start_row = row_;
    if (std::string found = in_this_frame([&](DebugItem item) { return item > start; }); !found.empty())
        return found;
    look_at(start);
    row_ = start_row;
    return find_frame(what, [&] { return in_this_frame([](DebugItem) { return true; }); });
}

std::string DebugSession::find_frame(const std::string& what, const std::function<std::string()>& work) {
    const DebugItem start = item_;
    const int start_frame = run_->frame();
    const std::optional<std::size_t> start_row = row_;
    const int frames = std::min(setup_.frames, setup_.recorded.value_or(setup_.frames));
    try {
        while (run_->frame() + 1 < frames) {
            go_on();
            run_->go_to(run_->frame() + 1);
            if (std::string found = work(); !found.empty())
                return found;
        }
        run_->go_to(start_frame);
    } catch (const Stopped&) {
        look_at(start);
        throw Error(fmt::format("stopped in frame {}; no further {} up to there", run_->frame(), what));
    }
    look_at(start);
    row_ = start_row;
    throw Error(fmt::format("{}: no further {} up to frame {}; --frames sets how far is looked", place(), what,
                            std::max(frames - 1, start_frame)));
}

std::vector<ItemVerdict> DebugSession::verdicts(std::size_t group) {
    go_on();
    return run_->verdicts(group);
}

std::vector<DebugItem> DebugSession::of_class(DifferenceClass least) {
    std::vector<DebugItem> items;
    for (std::size_t g = 0; g < run_->groups().size(); ++g)
        for (const ItemVerdict& verdict : verdicts(g))
            if (verdict.kind >= least)
                items.push_back({g, verdict.index});
    return items;
}

std::vector<DebugItem> DebugSession::with_nan() {
    std::vector<DebugItem> items;
    for (std::size_t g = 0; g < run_->groups().size(); ++g) {
        go_on();
        const DebugRun::States states = run_->states(g);
        if (states.gpu.columns.empty())
            continue;
        for (std::size_t i = 0; i < std::min(states.gpu.count(), states.reference.count()); ++i)
            if (has_nan(states.gpu, i) || has_nan(states.reference, i))
                items.push_back({g, i});
    }
    return items;
}

std::string DebugSession::why(const std::string&) {
    std::string text = run_->why(item_, setup_.format);
    if (row_ && !rows_[*row_].reason.empty())
        text += fmt::format("  {}: {}\n", rows_[*row_].label, rows_[*row_].reason);
    return text;
}

std::string DebugSession::print(const std::string& argument) {
    if (argument.empty())
        throw Error("print: the name of a row is missing; `show` lists them");
    std::string text;
    std::vector<std::string> labels;
    for (const StepRow& row : rows_) {
        labels.push_back(row.label);
        if (row.label == argument || row.label.starts_with(argument + ".") || row.label.starts_with(argument + " ("))
            text += row_text(row, setup_.format);
    }
    if (text.empty())
        throw Error(fmt::format("print: {}: there is no row '{}'{}; `show` lists them", place(), argument,
                                did_you_mean(argument, labels)));
    return text;
}

std::string DebugSession::history(const std::string& argument) {
    const DebugRun::States now = run_->states(item_.group);
    const Resource& about = now.gpu.about();
    std::vector<Component> wanted;
    std::vector<std::string> labels;
    for (const Component& c : components(about)) {
        const std::string& field = about.fields[c.field].name;
        labels.push_back(component_name(about.fields[c.field], c.component));
        if (argument.empty() || argument == field || argument == labels.back())
            wanted.push_back(c);
    }
    if (wanted.empty())
        throw Error(fmt::format("history: {} has no '{}'; it has {}", about.item, argument, fmt::join(labels, ", ")));
    const int last = run_->frame();
    std::string text = fmt::format("{}: the GPU's values, and the reference's where they differ\n", run_->name(item_));
    for (int frame = 0; frame <= last; ++frame) {
        if (stopped()) {
            look_at(item_);
            return text + fmt::format("stopped in frame {}\n", run_->frame());
        }
        run_->go_to(frame);
        const DebugRun::States states = run_->states(item_.group);
        if (states.gpu.columns.empty() || item_.index >= states.gpu.count())
            continue;
        std::string line;
        for (const Component& c : wanted) {
            const Value gpu = states.gpu.value(c.field, item_.index, c.component);
            const Value reference = states.reference.value(c.field, item_.index, c.component);
            line += fmt::format("  {} {}", component_name(about.fields[c.field], c.component), decimal_text(gpu));
            if (!same_bits(gpu, reference))
                line += fmt::format(" (reference {})", decimal_text(reference));
        }
        text += fmt::format("{:6}{}\n", frame, line);
    }
    look_at(item_);
    return text;
}

std::string DebugSession::stop_where(const std::string& argument) {
    if (argument.empty()) {
        std::string text;
        for (const DebugCondition& condition : conditions_)
            text += condition_text(condition) + "\n";
        for (const std::string& where : lines_to_stop_at_)
            text += where + "\n";
        return text.empty() ? "no break\n" : text;
    }
    if (const std::optional<std::string> where = line_of_break(argument)) {
        static_cast<void>(debug_lines(run_->text(item_), setup_.format)); // or there is no text to stop in
        lines_to_stop_at_.push_back(*where);
        return fmt::format("break where this item comes to {}\n", *where);
    }
    DebugCondition condition = parse_condition(argument);
    std::vector<std::string> labels;
    for (const StepRow& row : rows_)
        labels.push_back(row.label);
    if (!value_of(condition.label, rows_))
        throw Error(fmt::format("break: {}: there is no row '{}' with a number{}; `show` lists them", place(),
                                condition.label, did_you_mean(condition.label, labels)));
    conditions_.push_back(std::move(condition));
    return fmt::format("break where {}\n", condition_text(conditions_.back()));
}

std::string DebugSession::go_on(const std::string&) {
    if (conditions_.empty() && lines_to_stop_at_.empty())
        throw Error("continue: there is no break; `break NAME < NUMBER` makes one");
    const DebugItem item = item_;
    return find_frame("break", [&]() -> std::string {
        if (run_->nearest(item) != item)
            return "";
        look_at(item);
        for (const DebugCondition& condition : conditions_)
            if (const std::optional<float> value = value_of(condition.label, rows_); value && holds(condition, *value))
                return fmt::format("{}\n{} holds: {:.9g}\n", place(), condition_text(condition), *value);
        if (!lines_to_stop_at_.empty())
            lines_ = debug_lines(run_->text(item), setup_.format);
        const auto stops = std::ranges::find_if(lines_, [&](const DebugLine& line) {
            return std::ranges::find(lines_to_stop_at_, line.where) != lines_to_stop_at_.end();
        });
        if (stops == lines_.end())
            return "";
        line_ = static_cast<std::size_t>(stops - lines_.begin());
        return place() + "\n" + debug_line_text(*stops);
    });
}

std::string DebugSession::set(const std::string& argument) {
    if (!setup_.unchangeable.empty())
        throw Error(fmt::format("set: {}", setup_.unchangeable));
    if (argument.find('=') == std::string::npos)
        throw Error(fmt::format("set: '{}' is not NAME=VALUE", argument));
    std::vector<std::string> changes = changes_;
    changes.push_back(argument);
    std::unique_ptr<DebugRun> run = setup_.start(changes);
    run->stop_when(setup_.stop);
    try {
        run->go_to(run_->frame());
    } catch (const Stopped&) {
        throw Error(fmt::format("set: stopped; {} is not changed", argument.substr(0, argument.find('='))));
    }
    run_ = std::move(run);
    changes_ = std::move(changes);
    item_ = run_->nearest(item_);
    return frame_summary();
}

std::string DebugSession::list(const std::string& argument) {
    const auto* const kind = std::find(class_names.begin(), class_names.end(), argument);
    if (kind == class_names.end())
        throw Error(fmt::format("list: '{}' is not one of {}", argument, fmt::join(class_names, ", ")));
    constexpr std::size_t most = 20;
    std::string text;
    std::size_t count = 0;
    for (std::size_t g = 0; g < run_->groups().size(); ++g)
        for (const ItemVerdict& verdict : verdicts(g))
            if (class_names[static_cast<std::size_t>(verdict.kind)] == argument && ++count <= most)
                text += run_->name({g, verdict.index}) + "\n";
    if (count > most)
        text += fmt::format("and {} more\n", grouped(count - most));
    return count == 0 ? fmt::format("nothing {} in frame {}\n", argument, run_->frame()) : text;
}

std::string DebugSession::source(const std::string& argument) {
    if (argument.empty())
        throw Error("source: the name of a file of commands is missing");
    if (sourced_ == most_sourced)
        throw Error(fmt::format("source: {}: more than {} files, one within the other", argument, most_sourced));
    const OpenedFile file(argument, "file of commands");
    if (file.size() > most_bytes_of_commands)
        throw Error(fmt::format("source: {}: {} bytes; expected at most {}", argument, grouped(file.size()),
                                grouped(most_bytes_of_commands)));
    std::istringstream lines(file.text());
    const Counted within(sourced_);
    std::string line, text;
    for (int number = 1; !ended_ && std::getline(lines, line); ++number)
        try {
            go_on();
            text += obey(line);
            if (setup_.say)
                setup_.say(std::exchange(text, ""));
        } catch (const Stopped&) { // between two commands
            look_at(item_);
            throw Error(fmt::format("{}:{}: stopped in frame {}", argument, number, run_->frame()));
        } catch (const Error& error) {
            throw Error(fmt::format("{}:{}: {}", argument, number, error.what()));
        }
    return text;
}

std::string DebugSession::help(const std::string&) {
    std::string text;
    const auto line = [&](std::string_view name, std::string_view letter, std::string_view argument,
                          std::string_view meaning) {
        text += fmt::format("{:<42} {}\n", fmt::format("{}{}{} {}", name, letter.empty() ? "" : ", ", letter, argument),
                            meaning);
    };
    for (const Command& command : commands()) {
        line(command.name, command.letter, command.argument, command.meaning);
        if (command.name == "frame")
            for (const DebugSelector& selector : run_->selectors())
                line(selector.name, "", selector.argument, selector.meaning);
    }
    return text;
}

std::string DebugSession::quit(const std::string&) {
    ended_ = true;
    return "";
}

} // namespace lockstep
