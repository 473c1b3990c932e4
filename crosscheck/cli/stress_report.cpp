#include "crosscheck/cli/stress_report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/report/power_text.hpp"

namespace lockstep {

using nlohmann::json;

/// A mistake shows where it shows in one of the runs; of the others the first says why not.
PowerSummary StressReport::power() const {
    PowerSummary all;
    for (const StressScene& scene : scenes)
        for (const PowerSummary::Mistake& mistake : scene.power.mistakes) {
            const auto known = std::find_if(all.mistakes.begin(), all.mistakes.end(),
                                            [&](const auto& m) { return m.name == mistake.name; });
            if (known == all.mistakes.end())
                all.mistakes.push_back(mistake);
            else if (mistake.first_frame && (!known->first_frame || *mistake.first_frame < *known->first_frame))
                *known = mistake;
        }
    for (const StressScene& scene : scenes)
        for (const PowerSummary::Situation& situation : scene.power.situations) {
            const auto known = std::find_if(all.situations.begin(), all.situations.end(),
                                            [&](const auto& s) { return s.name == situation.name; });
            if (known == all.situations.end())
                all.situations.push_back(situation);
            else
                known->count += situation.count;
        }
    return all;
}

bool StressReport::has_enough_power() const { return !is_whole() || power().share() >= power_at_least; }

bool StressReport::passes() const {
    return has_enough_power() &&
           std::all_of(scenes.begin(), scenes.end(), [](const StressScene& scene) { return scene.passes; });
}

std::string stress_head() {
    return fmt::format("{:<16} {:>9}  {:<18} {}\n", "scene", "particles", "would have shown", "verdict");
}

std::string stress_line(const StressScene& scene, bool is_first_failure) {
    return fmt::format("{:<16} {:>9}  {:<18} {}\n", scene.name, scene.particles,
                       fmt::format("{} of {}", scene.power.seen(), scene.power.mistakes.size()), scene.verdict) +
           (is_first_failure ? "\n" + plain_text(scene.text) + "\n" : "");
}

std::string stress_end(const StressReport& report, bool lists_power) {
    const PowerSummary power = report.power();
    std::string text = fmt::format("\ntogether  {}\n", power_line(power));
    const auto failed = std::count_if(report.scenes.begin(), report.scenes.end(),
                                      [](const StressScene& scene) { return !scene.passes; });
    if (!report.is_whole())
        text += fmt::format("part      {} of {} scenes{}{}; lockstep merge joins the parts' JSON\n",
                            report.scenes.size(), report.of, report.part_by.empty() ? "" : ", by ", report.part_by);
    text += "verdict   ";
    if (!report.has_enough_power())
        text += fmt::format("FAILED: the scenes would have shown {} of {} known mistakes ({:.1f} %), expected at least "
                            "{:.4g} %; ",
                            power.seen(), power.mistakes.size(), 100.0 * power.share(), 100.0 * report.power_at_least);
    const std::string all = fmt::format("{} scenes{}", report.scenes.size(), report.is_whole() ? "" : " of this part");
    text += failed == 0 ? fmt::format("all {} pass\n", all) : fmt::format("{} of {} do not pass\n", failed, all);
    return text + (lists_power ? power_text(power) : std::string());
}

json stress_json(const StressReport& report) {
    json all{{"scenes", json::array()}, {"power", power_json(report.power())}};
    for (const StressScene& scene : report.scenes)
        all["scenes"].push_back(scene.report);
    all["inputs"] = inputs_json(report.inputs);
    return all;
}

json stress_part_json(const StressReport& report) {
    json scenes = json::array();
    for (const StressScene& scene : report.scenes) {
        json mistakes = json::array(), situations = json::array();
        for (const PowerSummary::Mistake& m : scene.power.mistakes)
            mistakes.push_back({{"name", m.name},
                                {"meaning", m.meaning},
                                {"frame", m.first_frame ? json(*m.first_frame) : json()},
                                {"why_not", m.why_not}});
        for (const PowerSummary::Situation& s : scene.power.situations)
            situations.push_back({{"name", s.name}, {"count", s.count}});
        scenes.push_back({{"index", scene.index},
                          {"name", scene.name},
                          {"particles", scene.particles},
                          {"mistakes", mistakes},
                          {"situations", situations},
                          {"verdict", scene.verdict},
                          {"passes", scene.passes ? 1 : 0},
                          {"text", scene.text},
                          {"report", scene.report}});
    }
    return {{"of", report.of},
            {"asked", report.asked},
            {"profile", report.profile},
            {"inputs", report.inputs},
            {"power_at_least", fmt::format("{}", report.power_at_least)},
            {"scenes", scenes}};
}

StressReport read_stress_part(const JsonValue& value, const json& document) {
    value.check_keys({"of", "asked", "profile", "inputs", "power_at_least", "scenes"});
    StressReport report;
    report.of = static_cast<std::size_t>(value.at("of").integer(1, 1'000'000));
    report.asked = value.at("asked").text();
    report.profile = value.at("profile").text();
    const JsonValue inputs = value.at("inputs");
    for (const std::string& name : inputs.keys())
        report.inputs[name] = inputs.at(name).text();
    const std::string share = value.at("power_at_least").text();
    if (const std::string problem = share_option("", report.power_at_least, "").keep({&share, 1}); !problem.empty())
        value.at("power_at_least").fail(problem);
    for (const JsonValue& one : value.at("scenes").items()) {
        one.check_keys({"index", "name", "particles", "mistakes", "situations", "verdict", "passes", "text", "report"});
        StressScene& scene = report.scenes.emplace_back();
        scene.index = static_cast<std::size_t>(one.at("index").integer(0, static_cast<std::int64_t>(report.of) - 1));
        scene.name = one.at("name").label();
        scene.particles = static_cast<std::size_t>(one.at("particles").integer(0, UINT32_MAX));
        for (const JsonValue& m : one.at("mistakes").items()) {
            m.check_keys({"name", "meaning", "frame", "why_not"});
            PowerSummary::Mistake& mistake = scene.power.mistakes.emplace_back();
            mistake.name = m.at("name").label();
            mistake.meaning = m.at("meaning").label();
            if (!m.at("frame").is_null())
                mistake.first_frame = static_cast<int>(m.at("frame").integer(0, INT32_MAX));
            mistake.why_not = m.at("why_not").label();
        }
        for (const JsonValue& s : one.at("situations").items()) {
            s.check_keys({"name", "count"});
            scene.power.situations.push_back(
                {s.at("name").label(), static_cast<std::uint64_t>(s.at("count").integer(0, INT64_MAX >> 16))});
        }
        scene.verdict = one.at("verdict").label();
        scene.passes = one.at("passes").integer(0, 1) == 1;
        scene.text = one.at("text").text();
        static_cast<void>(one.at("report"));
        scene.report = document.at("scenes").at(report.scenes.size() - 1).at("report");
    }
    return report;
}

} // namespace lockstep
