#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/judge/agreeing_frames.hpp"

namespace lockstep::test::agreeing_frames_test {

namespace {

using Shown = PowerSummary::Mistake;

Shown shown(std::string name, std::string pass, std::optional<int> first_frame) {
    Shown mistake{.name = std::move(name), .meaning = {}, .first_frame = first_frame};
    mistake.refutes = true;
    mistake.pass = std::move(pass);
    return mistake;
}

/// The causes that are left where frame 7 is the first that diverges.
std::vector<std::string> left(std::vector<Shown> mistakes) {
    CheckReport report;
    report.power.mistakes = std::move(mistakes);
    VerdictSummary verdicts{Schema{"drops", {{"drops", "drop", "the drops", {{"height"}}}}}};
    verdicts.first.emplace();
    verdicts.first->place.frame = 7;
    verdicts.first->verdict.kind = DifferenceClass::divergent;
    verdicts.causes.at(0).best = {{.mistakes = {"too_far"}, .meaning = {}}, {.mistakes = {"too_late"}, .meaning = {}}};
    report.verdicts = std::move(verdicts);
    refute_causes(report);
    std::vector<std::string> names;
    for (const Cause& cause : report.verdicts->causes.at(0).best)
        names.push_back(cause.name());
    return names;
}

} // namespace

TEST_CASE("agreeing frames: a mistake that would have shown in one of them is no cause") {
    CHECK(left({shown("too_far", "fall", 3)}) == std::vector<std::string>{"too_late"});
    CHECK(left({shown("too_far", "fall", 7)}).size() == 2);
    CHECK(left({shown("too_far", "fall", std::nullopt)}).size() == 2);
}

TEST_CASE("agreeing frames: of passes with mistakes of one name each has to have shown its own") {
    CHECK(left({shown("too_far", "fall", 3), shown("too_far", "rise", 9)}).size() == 2);
    CHECK(left({shown("too_far", "fall", 3), shown("too_far", "rise", 4)}) == std::vector<std::string>{"too_late"});
    Shown silent = shown("too_far", "fall", 3);
    silent.refutes = false;
    CHECK(left({silent}).size() == 2);
}

} // namespace lockstep::test::agreeing_frames_test
