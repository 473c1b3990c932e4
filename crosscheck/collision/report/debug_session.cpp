#include "crosscheck/collision/report/debug_session.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/collision/judge/texel_table.hpp"
#include "crosscheck/collision/report/named_items.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr int most_frames = 100'000'000;

std::string trimmed(std::string_view text) {
    constexpr std::string_view white_space = " \t\r";
    const std::size_t first = text.find_first_not_of(white_space);
    if (first == std::string_view::npos)
        return "";
    return std::string(text.substr(first, text.find_last_not_of(white_space) + 1 - first));
}

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

} // namespace

const std::vector<DebugSession::Command>& DebugSession::commands() {
    static const std::vector<Command> all{
        {"frame", "F", "go to frame F, counted from 0", &DebugSession::frame},
        {"particle", "I", "look at particle I", &DebugSession::particle},
        {"texel", "X,Y", "look at a texel of the CDT", &DebugSession::texel},
        {"show", "", "the whole table, the neighbourhood and the verdict", &DebugSession::show},
        {"step", "[N]", "the next row of the table, or N rows on", &DebugSession::step},
        {"back", "[N]", "the row before, or N rows back", &DebugSession::back},
        {"next", "fetch|difference|divergence|nan",
         "the next texel fetch of this particle; the next row with a difference, a divergence or a NaN, if need be of "
         "another particle or a later frame",
         &DebugSession::next},
        {"why", "", "the reasoning behind the verdict", &DebugSession::why},
        {"set", "NAME=VALUE", "change a switch or constant and run again to this frame", &DebugSession::set},
        {"list", "divergent|undefined|tie|rounding", "what differs in this frame", &DebugSession::list},
        {"help", "", "these lines", &DebugSession::help},
        {"quit", "", "end; so does the end of the input", &DebugSession::quit},
    };
    return all;
}

DebugSession::DebugSession(DebugSetup setup) : setup_(std::move(setup)), run_(setup_.start(setup_.load({}))) {
    go_to(0);
}

std::string DebugSession::obey(const std::string& line) {
    const std::string text = trimmed(line.substr(0, line.find('#')));
    if (text.empty())
        return "";
    const std::size_t end = text.find_first_of(" \t");
    const std::string name = text.substr(0, end);
    const std::string argument = end == std::string::npos ? "" : trimmed(text.substr(end));
    std::vector<std::string_view> names;
    for (const Command& command : commands()) {
        if (command.name == name) {
            if (command.argument.empty() && !argument.empty())
                throw Error(fmt::format("{}: takes no argument, not '{}'", name, argument));
            return (this->*command.obey)(argument);
        }
        names.push_back(command.name);
    }
    throw Error(fmt::format("unknown command '{}'; the commands are {}", name, fmt::join(names, ", ")));
}

void DebugSession::go_to(int frame) {
    run_->go_to(frame);
    look_at(item_);
}

void DebugSession::look_at(Item item) {
    table_.reset();
    if (item.is_texel) {
        rows_ = texel_table(*run_, item.index).rows;
    } else {
        table_ = step_table(*run_, item.index);
        rows_ = table_->rows;
    }
    item_ = item;
    row_.reset();
}

std::string DebugSession::name_of(Item item) const {
    const auto width = static_cast<std::size_t>(run_->scene().width);
    return item.is_texel ? fmt::format("texel {},{}", item.index % width, item.index / width)
                         : fmt::format("particle {}", item.index);
}

std::string DebugSession::place() const { return fmt::format("frame {} {}", run_->frame(), name_of(item_)); }

std::string DebugSession::frame_summary() {
    const FrameVerdicts& verdicts = run_->verdicts();
    const auto counts = [](const std::vector<ItemVerdict>& items) {
        std::array<std::size_t, class_names.size()> of{};
        for (const ItemVerdict& item : items)
            ++of[static_cast<std::size_t>(item.kind)];
        std::string text;
        for (std::size_t k = 0; k < of.size(); ++k)
            if (of[k] > 0)
                text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(of[k]), class_names[k]);
        return text.empty() ? std::string("none differ") : text;
    };
    return fmt::format("frame {}: particles: {}; texels: {}\n", run_->frame(), counts(verdicts.particles),
                       counts(verdicts.texels));
}

std::string DebugSession::frame(const std::string& argument) {
    go_to(number_in("frame", argument, 0, most_frames));
    return frame_summary();
}

std::string DebugSession::particle(const std::string& argument) {
    look_at({false, particle_named(argument, run_->scene())});
    return particle_head(*table_, setup_.format);
}

std::string DebugSession::texel(const std::string& argument) {
    look_at({true, texel_named(argument, run_->scene())});
    return place() + "\n";
}

std::string DebugSession::show(const std::string&) {
    return item_.is_texel ? explain_texel(*run_, item_.index, setup_.format)
                          : explain_particle(*run_, item_.index, setup_.format);
}

std::string DebugSession::step(const std::string& argument) {
    return move_by(number_in("step", argument, 1, 1'000'000, 1));
}

std::string DebugSession::back(const std::string& argument) {
    return move_by(-number_in("back", argument, 1, 1'000'000, 1));
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
                               const std::function<std::vector<Item>()>& items) {
    if (find_row(wanted))
        return row_text(rows_[*row_], setup_.format);
    const Item start = item_;
    const int start_frame = run_->frame();
    const std::optional<std::size_t> start_row = row_;
    const auto after = [&](Item item) {
        return run_->frame() > start_frame ||
               std::pair(item.is_texel, item.index) > std::pair(start.is_texel, start.index);
    };
    for (;;) {
        for (const Item item : items())
            if (after(item)) {
                look_at(item);
                if (find_row(wanted))
                    return place() + "\n" + row_text(rows_[*row_], setup_.format);
            }
        if (run_->frame() + 1 >= setup_.frames)
            break;
        run_->go_to(run_->frame() + 1);
    }
    run_->go_to(start_frame);
    look_at(start);
    row_ = start_row;
    throw Error(fmt::format("{}: no further {} up to frame {}; --frames sets how far is looked", place(), what,
                            std::max(setup_.frames - 1, start_frame)));
}

std::vector<DebugSession::Item> DebugSession::of_class(DifferenceClass least) {
    std::vector<Item> items;
    for (const ItemVerdict& verdict : run_->verdicts().particles)
        if (verdict.kind >= least)
            items.push_back({false, verdict.index});
    for (const ItemVerdict& verdict : run_->verdicts().texels)
        if (verdict.kind >= least)
            items.push_back({true, verdict.index});
    return items;
}

std::vector<DebugSession::Item> DebugSession::with_nan() const {
    const JudgedFrame frame = run_->judged();
    const View gpu = view(frame.gpu);
    const View reference = view(frame.reference);
    std::vector<Item> items;
    for (std::size_t i = 0; i < gpu.count(); ++i)
        if (has_nan(gpu, i) || has_nan(reference, i))
            items.push_back({false, i});
    return items;
}

std::string DebugSession::why(const std::string&) {
    std::string text = item_.is_texel ? why_texel(*run_, item_.index) : why_particle(*run_, item_.index);
    if (row_ && !rows_[*row_].reason.empty())
        text += fmt::format("  {}: {}\n", rows_[*row_].label, rows_[*row_].reason);
    return text;
}

std::string DebugSession::set(const std::string& argument) {
    if (argument.find('=') == std::string::npos)
        throw Error(fmt::format("set: '{}' is not NAME=VALUE", argument));
    std::vector<std::string> changes = changes_;
    changes.push_back(argument);
    Scene scene = setup_.load(changes);
    std::unique_ptr<FrameRun> run = setup_.start(std::move(scene));
    const int frame = run_->frame();
    run->go_to(frame);
    run_ = std::move(run);
    changes_ = std::move(changes);
    look_at(item_);
    return frame_summary();
}

std::string DebugSession::list(const std::string& argument) {
    const auto* const kind = std::find(class_names.begin(), class_names.end(), argument);
    if (kind == class_names.end())
        throw Error(fmt::format("list: '{}' is not one of {}", argument, fmt::join(class_names, ", ")));
    constexpr std::size_t most = 20;
    std::string text;
    std::size_t count = 0;
    const auto add = [&](const std::vector<ItemVerdict>& verdicts, bool is_texel) {
        for (const ItemVerdict& verdict : verdicts)
            if (class_names[static_cast<std::size_t>(verdict.kind)] == argument && ++count <= most)
                text += name_of({is_texel, verdict.index}) + "\n";
    };
    add(run_->verdicts().particles, false);
    add(run_->verdicts().texels, true);
    if (count > most)
        text += fmt::format("and {} more\n", grouped(count - most));
    return count == 0 ? fmt::format("nothing {} in frame {}\n", argument, run_->frame()) : text;
}

std::string DebugSession::help(const std::string&) {
    std::string text;
    for (const Command& command : commands())
        text += fmt::format("{:<42} {}\n", fmt::format("{} {}", command.name, command.argument), command.meaning);
    return text;
}

std::string DebugSession::quit(const std::string&) {
    ended_ = true;
    return "";
}

} // namespace lockstep
