#include "crosscheck/report/item_text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "crosscheck/report/row_text.hpp"
#include "crosscheck/report/shader_notes.hpp"
#include "crosscheck/report/text_steps_text.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "reference/model/error.hpp"
#include "reference/model/ulp.hpp"

namespace lockstep {
std::string outcome_text(const ItemOutcome& outcome, const Resource& about) {
    std::string text;
    std::size_t at = 0;
    for (const Component& c : components(about)) {
        const Field& field = about.fields[c.field];
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", component_name(field, c.component),
                            legal_text(outcome.values[at++], field.scalar));
    }
    for (const OpenSite& open : outcome.open)
        text +=
            fmt::format(", tie of {} ({:.3g}{}{})", open.site, open.margin, open.unit.empty() ? "" : " ", open.unit);
    if (outcome.undefined != Undefined::none)
        text += fmt::format(", left open by GL: {}", undefined_name(outcome.undefined));
    return text;
}

std::string explain_item(SystemRun& run, std::size_t item, NumberFormat format) {
    const std::size_t count = run.judged().gpu.count();
    if (item >= count)
        throw Error(fmt::format("there is no {} {}; {} has 0 to {}", run.judged().gpu.about().item, item,
                                run.system().name, count - 1));
    return explain_item(run.judged(), item, run.told(item), format);
}

std::string explain_item(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told,
                         NumberFormat format) {
    const Resource& about = pass.gpu.about();
    std::string text =
        fmt::format("{} in frame {}, pass {}\n", item_name(about, pass.gpu.extent, item), pass.frame, pass.pass.name());
    const std::optional<ItemSteps> steps = steps_of_item(pass, item);
    const std::vector<StepRow> rows = item_rows(pass, item, told, steps);
    std::size_t width = narrowest_label;
    for (const StepRow& row : rows)
        width = std::max(width, row.label.size());
    text.append("\n").append(head_text(pass.profile, width));
    for (const StepRow& row : rows)
        text += row_text(row, format, width);
    text += "\n" + item_verdict_text(pass, item, rows);
    return steps ? text + text_steps_text(pass, item, *steps, format) : text;
}

std::string item_verdict_text(const JudgedPass& pass, std::size_t item, const std::vector<StepRow>& rows) {
    if (same_item(pass.reference, pass.gpu, item))
        return "verdict   every bit agrees\n";
    const ItemVerdict verdict = judge_item(pass, item);
    std::string text = fmt::format("verdict   {}", class_names[static_cast<std::size_t>(verdict.kind)]);
    if (verdict.tie)
        text +=
            fmt::format(": {}, margin {:.3g} {}", verdict.tie->kind.name, verdict.tie->margin, verdict.tie->kind.unit);
    if (verdict.undefined != Undefined::none)
        text += fmt::format(": {}", undefined_name(verdict.undefined));
    text += "\n";
    const auto first =
        std::find_if(rows.begin(), rows.end(), [](const StepRow& row) { return row.verdict == RowVerdict::divergent; });
    if (first != rows.end())
        text += fmt::format("first     {}: {}\n", first->label, first->reason);
    const auto outcomes = pass.on_input().outcomes(pass.input(), item, pass.profile, pass.known, &pass.gpu);
    for (const ItemOutcome& outcome : outcomes)
        text += fmt::format("legal     {}\n", outcome_text(outcome, pass.gpu.about()));
    return text;
}

RunDescription describe_run(const System& system, const SideDescription& side, const CheckOptions& options,
                            const std::string& repeat) {
    RunDescription run;
    run.scene =
        system.name == system.schema.system ? system.name : fmt::format("{} ({})", system.name, system.schema.system);
    run.context = side.name;
    run.profile = describe(side.profile);
    run.settings = system.settings.empty() ? "none" : system.settings;
    run.mode = options.mode == CheckMode::free ? "free" : "resync";
    run.draws = false;
    run.repeat = repeat;
    run.shaders = side.shaders;
    run.notes = warning_notes(side.warnings);
    std::string passes;
    for (const auto& pass : system.passes)
        passes += fmt::format("{}{}", passes.empty() ? "" : ", ", pass->name());
    run.shaders_untold = "the system's own: " + passes;
    return run;
}

} // namespace lockstep
