#include "crosscheck/package/item_steps.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/text/bound_stage.hpp"
#include "crosscheck/text/stage_text.hpp"
#include "crosscheck/text/text_pass.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// What glslang calls its own variables: copies of arguments, and of what an index goes into.
constexpr std::array<std::string_view, 3> made_by_glslang{"param", "indexable", "ref"};

/// A variable that the text itself has; null: it is glslang's, or the cell is none of a variable.
const text::NamedCells* variable_at(const text::Program& program, std::uint32_t cell) {
    for (const text::NamedCells& one : program.names)
        if (cell >= one.first && cell < one.first + one.count)
            return std::ranges::find(made_by_glslang, one.name) == made_by_glslang.end() ? &one : nullptr;
    return nullptr;
}

/// "286.110199 <= 0.0100000007"; a comparison that has no sign of its own is its operands.
std::string compared(const text::Trace& trace, const text::TraceRow& row) {
    const auto sign = [&]() -> std::string_view {
        switch (row.op) {
        case spv::OpIEqual:
        case spv::OpFOrdEqual:
        case spv::OpFUnordEqual:
            return "==";
        case spv::OpINotEqual:
        case spv::OpFOrdNotEqual:
        case spv::OpFUnordNotEqual:
            return "!=";
        case spv::OpUGreaterThan:
        case spv::OpSGreaterThan:
        case spv::OpFOrdGreaterThan:
        case spv::OpFUnordGreaterThan:
            return ">";
        case spv::OpUGreaterThanEqual:
        case spv::OpSGreaterThanEqual:
        case spv::OpFOrdGreaterThanEqual:
        case spv::OpFUnordGreaterThanEqual:
            return ">=";
        case spv::OpULessThan:
        case spv::OpSLessThan:
        case spv::OpFOrdLessThan:
        case spv::OpFUnordLessThan:
            return "<";
        case spv::OpULessThanEqual:
        case spv::OpSLessThanEqual:
        case spv::OpFOrdLessThanEqual:
        case spv::OpFUnordLessThanEqual:
            return "<=";
        default:
            return "";
        }
    }();
    std::string words;
    for (const text::TraceOperand& operand : trace.of(row))
        words += (words.empty()  ? ""
                  : sign.empty() ? " and "
                                 : fmt::format(" {} ", sign)) +
                 text::value_text(operand.bits, row.is_real);
    return words;
}

/// Makes steps of a trace: rows, and settings of variables, in their order. What is set of a row is one step with it.
class StepMaker {
  public:
    StepMaker(const text::Program& program, const text::Trace& trace) : program_(program), trace_(trace) {}

    std::vector<TextStep> operator()() {
        for (std::uint32_t k = 0; k < trace_.rows.size(); ++k) {
            settings_until(k);
            const text::TraceRow& row = trace_.rows[k];
            if (row.kind == text::TraceRow::Kind::comparison)
                steps_.push_back({where(row.step), compared(trace_, row), row.bits, row.is_real, false, true, true});
            else if (row.kind != text::TraceRow::Kind::store && !is_set_next(row, k))
                steps_.push_back({where(row.step), {}, row.bits, row.is_real});
        }
        settings_until(static_cast<std::uint32_t>(trace_.rows.size()));
        return std::move(steps_);
    }
    /// That steps stand at.
    [[nodiscard]] const std::set<std::uint32_t>& lines() const { return lines_; }

  private:
    [[nodiscard]] std::string where(std::uint32_t step) {
        const std::uint32_t line = shown_line(program_, step).line;
        lines_.insert(line);
        return program_.line_name(line);
    }
    [[nodiscard]] const text::NamedCells* variable_of(const text::TraceSetting& one) const {
        return shown_line(program_, one.step).is_call ? nullptr : variable_at(program_, one.cell);
    }
    void settings_until(std::uint32_t rows) {
        for (; next_ < trace_.settings.size() && trace_.settings[next_].rows <= rows; ++next_)
            set(trace_.settings[next_]);
    }
    void set(const text::TraceSetting& one) {
        const text::NamedCells* variable = variable_of(one);
        if (variable == nullptr)
            return;
        // A structure that is copied as a whole: what stays as it was says nothing.
        constexpr std::uint32_t most_of_vector = 4;
        const auto [held, is_new] = held_.try_emplace(one.cell, one.bits);
        if (!is_new && variable->count > most_of_vector && held->second == one.bits)
            return;
        held->second = one.bits;
        const std::uint32_t part = one.cell - variable->first;
        const text::NamedCells::Part of =
            part < variable->parts.size() ? variable->parts[part] : text::NamedCells::Part{fmt::format("[{}]", part)};
        steps_.push_back(
            {where(one.step), variable->name + of.name, one.bits, of.is_real, of.is_boolean, of.is_signed});
    }
    [[nodiscard]] bool is_set_next(const text::TraceRow& row, std::uint32_t number) const {
        const auto& all = trace_.settings;
        return next_ < all.size() && all[next_].rows == number + 1 && all[next_].step == row.step &&
               variable_of(all[next_]) != nullptr;
    }

    const text::Program& program_;
    const text::Trace& trace_;
    std::size_t next_ = 0; ///< setting
    std::map<std::uint32_t, std::uint32_t> held_;
    std::set<std::uint32_t> lines_;
    std::vector<TextStep> steps_;
};

ItemSteps steps_made(const PassText& text, const text::Trace& trace, std::vector<std::uint32_t> made) {
    StepMaker maker(text.program(), trace);
    ItemSteps all{.file = text.source().files.front(), .steps = maker(), .made = std::move(made)};
    for (const std::uint32_t line : maker.lines())
        all.lines.emplace(text.program().line_name(line), line_text(text.source(), line));
    return all;
}

class StepsOfText final : public PassSteps {
  public:
    StepsOfText(std::uint8_t resource, std::function<std::shared_ptr<const PassText>()> text)
        : resource_(resource), text_of_(std::move(text)) {}

    [[nodiscard]] ItemSteps of(const PassInput& in, std::size_t item, const Profile& profile) const override try {
        const PassText& text = this->text();
        const TextDispatch dispatch(text, in, profile);
        const View& before = in.before[resource_];
        const BoundStage stage{text.program(), dispatch.input().bindings, profile, dispatch.input().groups,
                               text.is_per_item() ? &dispatch.input().stage : nullptr};
        const std::optional<std::uint32_t> at = dispatch.invocation_at(resource_, item);
        text::Trace trace;
        trace.notes_settings = true;
        if (at)
            if (auto made = dispatch.words_by(before, resource_, item, trace_alone(stage, *at, trace)))
                return steps_made(text, trace, std::move(*made));
        // Another writes it, or none: all are run to see.
        const std::optional<std::uint32_t> by = dispatch.writer(resource_, item);
        if (!by)
            return {.file = {}, .not_known = "several invocations write it, or none"};
        trace_alone(stage, *by, trace);
        return steps_made(text, trace, dispatch.words(before, resource_, item));
    } catch (const Error& error) {
        return {.file = {}, .not_known = error.what()};
    }

  private:
    const PassText& text() const {
        const std::scoped_lock lock(mutex_);
        if (!text_)
            text_ = text_of_();
        return *text_;
    }

    std::uint8_t resource_;
    std::function<std::shared_ptr<const PassText>()> text_of_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const PassText> text_;
};

} // namespace

std::shared_ptr<const PassSteps> steps_of_text(std::uint8_t resource,
                                               std::function<std::shared_ptr<const PassText>()> text) {
    return std::make_shared<StepsOfText>(resource, std::move(text));
}

} // namespace lockstep
