#include "crosscheck/report/item_text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "reference/model/error.hpp"
#include "reference/model/ulp.hpp"

namespace lockstep {
namespace {

/// A site's values on one side, in the order in which it was come by.
using Occurrences = std::map<std::pair<std::uint32_t, int>, RecordedRow>;

Occurrences by_site(const std::vector<RecordedRow>& rows) {
    Occurrences found;
    std::map<std::uint32_t, int> seen;
    for (const RecordedRow& row : rows)
        if (row.kind == RecordedRow::Kind::value || row.kind == RecordedRow::Kind::decision)
            found.emplace(std::pair{row.site->id, seen[row.site->id]++}, row);
    return found;
}

std::string number_text(float x, NumberFormat format) {
    return format == NumberFormat::hexadecimal ? fmt::format("{:a}", x) : fmt::format("{}", x);
}

/// One line of the table.
class ItemTable {
  public:
    ItemTable(const JudgedPass& pass, std::size_t item, NumberFormat format)
        : strict_(by_site(pass.pass.record(pass.input(), item, named_profile("strict")))),
          reference_(by_site(pass.pass.record(pass.input(), item, pass.profile))), format_(format) {}

    void add(const ReadingRow& row) {
        for (int c = 0; c < row.size; ++c) {
            std::string label(row.site->label);
            if (row.occurrence > 0)
                label += fmt::format(" [{}]", row.occurrence);
            if (row.size > 1)
                label += fmt::format(".{}", "xyzw"[c]);
            const std::string strict = text(strict_, row, c), reference = text(reference_, row, c);
            const std::string told = row.is_told ? cell(row.told[static_cast<std::size_t>(c)], row.is_integer) : "";
            std::string verdict;
            if (row.is_told) {
                const Interval& legal = row.legal[static_cast<std::size_t>(c)];
                const float gpu = row.told[static_cast<std::size_t>(c)];
                const std::optional<float> expected = value(reference_, row, c);
                if (expected && same_bits(*expected, gpu))
                    verdict = "same";
                else if (!legal.contains(gpu))
                    verdict =
                        fmt::format("DIVERGENT: {} to {} would be legal ({}:{})", legal.low, legal.high,
                                    std::filesystem::path(row.where.file_name()).filename().string(), row.where.line());
                else
                    verdict = legal.any ? "undefined" : row.is_integer ? "tie" : "rounding";
                if (verdict.starts_with("DIVERGENT") && first_.empty())
                    first_ = label;
            }
            lines_ += fmt::format("  {:<24} {:>18} {:>18} {:>18}  {}\n", label, strict, reference, told, verdict);
        }
    }

    [[nodiscard]] const std::string& lines() const { return lines_; }
    [[nodiscard]] const std::string& first() const { return first_; } ///< the first value that no legal run gives

  private:
    [[nodiscard]] std::string cell(float x, bool integer) const {
        return integer ? fmt::format("{}", static_cast<long>(x)) : number_text(x, format_);
    }
    [[nodiscard]] static std::optional<float> value(const Occurrences& side, const ReadingRow& row, int c) {
        const auto found = side.find({row.site->id, row.occurrence});
        return found == side.end() || c >= found->second.size
                   ? std::nullopt
                   : std::optional(found->second.values[static_cast<std::size_t>(c)]);
    }
    [[nodiscard]] std::string text(const Occurrences& side, const ReadingRow& row, int c) const {
        const auto found = value(side, row, c);
        return found ? cell(*found, row.is_integer) : std::string();
    }

    Occurrences strict_, reference_;
    NumberFormat format_;
    std::string lines_, first_;
};

bool same_item(const View& a, const View& b, std::size_t item) {
    const std::vector<Component> parts = components(a.about());
    return std::all_of(parts.begin(), parts.end(), [&](const Component& c) {
        return same_bits(a.value(c.field, item, c.component), b.value(c.field, item, c.component));
    });
}

std::string outcome_text(const ItemOutcome& outcome, const Resource& about) {
    std::string text;
    std::size_t at = 0;
    for (const Component& c : components(about)) {
        const Interval& legal = outcome.values[at++];
        text += fmt::format("{}{} ", text.empty() ? "" : ", ", component_name(about.fields[c.field], c.component));
        text += legal.any                 ? "anything"
                : legal.low == legal.high ? fmt::format("{:.9g}", legal.low)
                                          : fmt::format("{:.9g} to {:.9g}", legal.low, legal.high);
    }
    for (const OpenSite& open : outcome.open)
        text +=
            fmt::format(", tie of {} ({:.3g}{}{})", open.site, open.margin, open.unit.empty() ? "" : " ", open.unit);
    if (outcome.undefined != Undefined::none)
        text += fmt::format(", left open by GL: {}", undefined_name(outcome.undefined));
    return text;
}

} // namespace

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
    std::string text = fmt::format("{} {} in frame {}, pass {}\n", about.item, item, pass.frame, pass.pass.name());
    text += fmt::format("  {:<24} {:>18} {:>18} {:>18}\n", "", "strict", "reference", "GPU");
    ItemTable table(pass, item, format);
    const FollowedStep followed = pass.pass.follow(pass.input(), item, pass.profile, pass.known, told);
    for (const ReadingRow& row : followed.rows)
        table.add(row);
    text += table.lines();
    if (same_item(pass.reference, pass.gpu, item))
        return text + "verdict   every bit agrees\n";
    const ItemVerdict verdict = judge_item(pass, item);
    text += fmt::format("verdict   {}", class_names[static_cast<std::size_t>(verdict.kind)]);
    if (verdict.tie)
        text +=
            fmt::format(": {}, margin {:.3g} {}", verdict.tie->kind.name, verdict.tie->margin, verdict.tie->kind.unit);
    if (verdict.undefined != Undefined::none)
        text += fmt::format(": {}", undefined_name(verdict.undefined));
    text += "\n";
    if (!table.first().empty())
        text += fmt::format("first     {}: it does not follow from the GPU's own values above\n", table.first());
    const auto outcomes = pass.pass.outcomes(pass.input(), item, pass.profile, pass.known, &pass.gpu);
    for (const ItemOutcome& outcome : outcomes)
        text += fmt::format("legal     {}\n", outcome_text(outcome, about));
    return text;
}

RunDescription describe_run(const System& system, const SideDescription& side, const CheckOptions& options,
                            const std::string& repeat) {
    RunDescription run;
    run.scene = fmt::format("{} ({})", system.name, system.schema.system);
    run.context = side.name;
    run.profile = describe(side.profile);
    run.settings = system.settings;
    run.mode = options.mode == CheckMode::free ? "free" : "resync";
    run.width = 1;
    run.repeat = repeat;
    run.shaders = side.shaders;
    return run;
}

} // namespace lockstep
