#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/run_inputs.hpp"
#include "crosscheck/judge/power_summary.hpp"

namespace lockstep {

/// What the check of one stress scene came to.
struct StressScene {
    std::size_t index = 0; ///< among all
    std::string name;
    std::size_t particles = 0;
    PowerSummary power;
    std::string verdict; ///< its words
    bool passes = false;
    std::string text;      ///< the report of one that does not pass
    nlohmann::json report; ///< without times
};

/// The scenes of a check --stress, or those of one of its parts.
struct StressReport {
    std::size_t of = 0;          ///< scenes there are
    std::string asked;           ///< renderer, options: the same in all parts of a run, as the next two
    std::string profile;         ///< that the reference follows, JSON
    InputDigests inputs;         ///< of all scenes
    double power_at_least = 0.0; ///< of all scenes together
    std::string part_by;         ///< what asked for some of the scenes: "--shard 2/3"; empty: unknown, or nothing did
    std::vector<StressScene> scenes;

    [[nodiscard]] bool is_whole() const { return scenes.size() == of; }
    [[nodiscard]] PowerSummary power() const;
    /// Whether all scenes together have the power that is asked for; of a part that is not asked.
    [[nodiscard]] bool has_enough_power() const;
    [[nodiscard]] bool passes() const;
};

std::string stress_head();
/// A scene's line; with the report of the first that does not pass.
std::string stress_line(const StressScene& scene, bool is_first_failure);
/// What comes after them. `lists_power`: with every mistake.
std::string stress_end(const StressReport& report, bool lists_power);
nlohmann::json stress_json(const StressReport& report);

/// All of it, to be read again from a part's file.
nlohmann::json stress_part_json(const StressReport& report);
/// `value` names places in `document` for errors.
StressReport read_stress_part(const JsonValue& value, const nlohmann::json& document);

} // namespace lockstep
