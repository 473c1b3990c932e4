#include "crosscheck/report/power_text.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/report/verdict_text.hpp"

namespace lockstep {

std::vector<std::string> unseen_by_reason(const PowerSummary& power) {
    std::vector<std::pair<std::string, std::string>> names; // by reason, in the order in which they come
    for (const PowerSummary::Mistake& mistake : power.mistakes) {
        if (mistake.first_frame)
            continue;
        const auto known =
            std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == mistake.why_not; });
        if (known == names.end())
            names.emplace_back(mistake.why_not, power.shown_name(mistake));
        else
            known->second += ", " + power.shown_name(mistake);
    }
    std::vector<std::string> lines;
    for (const auto& [reason, of] : names)
        lines.push_back(fmt::format("not: {} ({})", of, reason));
    return lines;
}

std::string situations_text(const PowerSummary& power) {
    std::string text;
    for (const PowerSummary::Situation& situation : power.situations)
        text += fmt::format("{}{} {}", text.empty() ? "" : "; ", situation.name, grouped(situation.count));
    return text;
}

std::string power_words(const PowerSummary& power) {
    return fmt::format("{} of {} mistakes with names would have shown", power.seen(), power.mistakes.size());
}

std::string power_line(const PowerSummary& power) {
    constexpr std::size_t most_named = 4;
    std::string text = power_words(power);
    std::size_t named = 0;
    for (const PowerSummary::Mistake& mistake : power.mistakes)
        if (!mistake.first_frame && named++ < most_named)
            text += fmt::format("{}{} ({})", named == 1 ? "; not: " : ", ", power.shown_name(mistake), mistake.why_not);
    if (named > most_named)
        text += fmt::format(" and {} more (--power lists them)", named - most_named);
    return text;
}

nlohmann::json power_json(const PowerSummary& power) {
    nlohmann::json unseen = nlohmann::json::array(), list = nlohmann::json::array(),
                   situations = nlohmann::json::object();
    for (const PowerSummary::Mistake& mistake : power.mistakes) {
        nlohmann::json entry{{"name", mistake.name}, {"meaning", mistake.meaning}};
        if (!mistake.pass.empty())
            entry["pass"] = mistake.pass;
        if (mistake.first_frame) {
            entry["frame"] = *mistake.first_frame;
        } else {
            entry["why_not"] = mistake.why_not;
            unseen.push_back(mistake.name);
        }
        list.push_back(std::move(entry));
    }
    for (const PowerSummary::Situation& situation : power.situations)
        situations[situation.name] = situation.count;
    return {{"mistakes", power.mistakes.size()}, {"seen", power.seen()},    {"share", power.share()},
            {"unseen", std::move(unseen)},       {"list", std::move(list)}, {"situations", std::move(situations)}};
}

std::string power_text(const PowerSummary& power) {
    std::string text = fmt::format("\n  {:<34} {:>11}\n", "mistake", "shows first");
    for (const PowerSummary::Mistake& mistake : power.mistakes)
        text += mistake.first_frame
                    ? fmt::format("  {:<34} {:>11}  {}\n", power.shown_name(mistake),
                                  fmt::format("frame {}", *mistake.first_frame), mistake.meaning)
                    : fmt::format("  {:<34} {:>11}  {}\n", power.shown_name(mistake), "not", mistake.why_not);
    return text;
}

} // namespace lockstep
