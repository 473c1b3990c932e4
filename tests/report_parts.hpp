#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/report/junit.hpp"
#include "crosscheck/report/report.hpp"

/// What every report has to say of one item of each class, whatever the system: tests plant the item, and hold text,
/// JSON, JUnit and page to it.
namespace lockstep::test {

/// One word for each component of an item.
using Words = std::vector<std::uint32_t>;

inline void put_words(const WritableView& state, std::size_t item, const Words& words) {
    std::size_t at = 0;
    for (std::size_t f = 0; f < state.columns.size(); ++f) {
        const auto components = static_cast<std::size_t>(state.fields()[f].components);
        std::memcpy(state.columns[f] + item * components * sizeof(std::uint32_t), words.data() + at,
                    components * sizeof(std::uint32_t));
        at += components;
    }
}

/// Words that an item might have instead of the reference's: a bit more or less in each float, what other outcomes
/// hold, and what none does.
inline std::vector<Words> other_words(const std::vector<ItemOutcome>& outcomes, const Words& reference,
                                      const Resource& about) {
    const std::vector<Component> parts = components(about);
    const auto is_float = [&](std::size_t w) { return about.fields[parts[w].field].scalar == Scalar::float32; };
    std::vector<Words> all;
    for (std::size_t w = 0; w < reference.size(); ++w)
        for (const float towards : {HUGE_VALF, -HUGE_VALF})
            if (is_float(w)) {
                Words& words = all.emplace_back(reference);
                words[w] = std::bit_cast<std::uint32_t>(std::nextafter(std::bit_cast<float>(words[w]), towards));
            }
    for (const ItemOutcome& outcome : outcomes) {
        Words& words = all.emplace_back(reference);
        for (std::size_t w = 0; w < reference.size(); ++w) {
            const Interval& set = outcome.values[w];
            const double middle = set.any                             ? 0.5
                                  : std::isfinite(set.low + set.high) ? (set.low + set.high) / 2
                                                                      : set.low;
            words[w] = is_float(w) ? std::bit_cast<std::uint32_t>(static_cast<float>(middle))
                                   : static_cast<std::uint32_t>(static_cast<std::int64_t>(middle));
        }
    }
    Words& far = all.emplace_back(reference);
    far[0] = is_float(0) ? std::bit_cast<std::uint32_t>(1234.5F) : far[0] ^ 0x10U;
    return all;
}

/// An item's words by the class that the judge gives them: for each class the first that are found. `gpu`: the state
/// that `pass` calls the GPU's, which is the reference's and becomes so again.
inline std::map<DifferenceClass, Words> words_by_class(const JudgedPass& pass, std::size_t item,
                                                       const WritableView& gpu) {
    const auto outcomes = pass.pass.outcomes(pass.input(), item, pass.profile, pass.known, nullptr);
    const Words reference = item_words(pass.reference, item);
    std::map<DifferenceClass, Words> found;
    for (const Words& words : other_words(outcomes, reference, pass.reference.about())) {
        put_words(gpu, item, words);
        if (!same_item(pass.reference, pass.gpu, item))
            found.try_emplace(judge_item(pass, item).kind, words);
    }
    put_words(gpu, item, reference);
    return found;
}

inline Verdict verdict_of(DifferenceClass kind) {
    return kind == DifferenceClass::divergent   ? Verdict::divergent
           : kind == DifferenceClass::undefined ? Verdict::undefined
                                                : Verdict::legal;
}

/// The names of a resource's fields.
inline std::vector<std::string> field_names(const Resource& about) {
    std::vector<std::string> names;
    for (const Field& field : about.fields)
        names.push_back(field.name);
    return names;
}

/// What a run says in which one item of one resource differs, by this class, in frame `frame`: `report` is the whole
/// run's, and other resources have no item of the class. `has_sets`: its legal sets are known.
inline void check_report(const CheckReport& report, std::uint8_t resource, std::size_t item, int frame,
                         DifferenceClass kind, bool has_sets) {
    const Resource& about = report.schema.resources[resource];
    const std::string class_name(class_names[static_cast<std::size_t>(kind)]), key = item_key(report.schema, resource);
    const RunDescription run{"planted", "", "", "", "resync", "again", ""};
    const std::string text = report_text(report, run);
    const nlohmann::json json = report_json(report, run);
    INFO(text);
    const auto fields = field_names(about);
    const auto is_field = [&](const nlohmann::json& name) {
        return std::find(fields.begin(), fields.end(), name.get<std::string>()) != fields.end();
    };
    const Extent extent = report.total.resources[resource].extent;
    const std::string name = item_name(about, extent, item), place = fmt::format("frame {} {}", frame, name);
    const nlohmann::json argument = nlohmann::json::parse(fmt::format("[{}]", item_argument(about, extent, item)));
    const nlohmann::json at{{"frame", frame}, {key, argument.size() == 1 ? argument[0] : argument}};

    CHECK(report.verdict == verdict_of(kind));
    CHECK_THAT(text, Catch::Contains(fmt::format("verdict   {}", verdict_name(verdict_of(kind)))));
    CHECK_THAT(text, Catch::Contains(fmt::format(": 1 {}", class_name)));
    const nlohmann::json& verdicts = json.at("verdicts");
    CHECK(verdicts.at(key + "s").at(class_name) == 1);
    CHECK(is_field(json.at("worst").at(0).at("field")));

    const nlohmann::json& leeway = verdicts.at(key + "_leeway");
    const std::string leeway_line = fmt::format("leeway    {}: ", about.title);
    if (kind <= DifferenceClass::tie && has_sets) {
        REQUIRE_FALSE(leeway.is_null());
        CHECK(is_field(leeway.at("field")));
        const FieldId field{resource, static_cast<std::uint8_t>(std::find(fields.begin(), fields.end(),
                                                                          leeway.at("field").get<std::string>()) -
                                                                fields.begin())};
        CHECK(leeway.at("component").get<int>() < report.schema[field].components);
        CHECK(leeway.at("place") == at);
        CHECK_THAT(text, Catch::Contains(leeway_line) && Catch::Contains(", " + place + "\n"));
        const LegalFloats& widest = report.verdicts->widths[resource].widest()->floats;
        CHECK(widest.field == field);
    } else if (kind > DifferenceClass::tie) {
        CHECK(leeway.is_null());
        CHECK_THAT(text, !Catch::Contains(leeway_line));
    }
    if (kind == DifferenceClass::tie)
        for (const auto& [tie, count] : report.verdicts->ties)
            CHECK_THAT(text, Catch::Contains(fmt::format("{}: ", tie.name)) && Catch::Contains("; closest frame"));
    if (kind >= DifferenceClass::undefined) {
        REQUIRE(report.verdicts->first);
        const nlohmann::json& first = verdicts.at("first");
        CHECK(first.at("class") == class_name);
        if (report.verdicts->first->place.resource == resource) {
            CHECK(first.at("place") == at);
            CHECK(is_field(first.at("field")));
            CHECK_THAT(text, Catch::Contains(fmt::format("first     {}, {}, step ", place, class_name)));
        }
    } else {
        CHECK(verdicts.at("first").is_null());
    }
    if (kind == DifferenceClass::undefined)
        CHECK_THAT(text, Catch::Contains("left open by GL: ") && Catch::Contains("undefined "));
    CHECK(verdicts.at(key + "_cause").at("divergent") == (kind == DifferenceClass::divergent ? 1 : 0));

    const bool pass = passes(report);
    const std::string junit = junit_text(report, run, pass);
    CHECK(pass == (kind <= DifferenceClass::tie));
    CHECK_THAT(junit,
               Catch::Contains(fmt::format("<property name=\"verdict\" value=\"{}", verdict_name(report.verdict))));
    CHECK((junit.find("<failure") == std::string::npos) == pass);
    if (!pass)
        CHECK_THAT(junit, Catch::Contains(place));
}

/// The head of a page.
inline nlohmann::json page_head_of(const std::string& page) {
    const std::string begin = "id=\"lockstep-head\">", end = "</script>";
    const std::size_t from = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(from, page.find(end, from) - from));
}

} // namespace lockstep::test
