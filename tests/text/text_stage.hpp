#pragma once
#include <string>
#include <vector>

#include "reference/text/stage_run.hpp"
#include "tests/text/text_kernel.hpp"

namespace lockstep::test {

struct TextStage : BoundText {
    TextStage(Stage stage, const std::string& text) : BoundText(stage, text, "stage") {}

    text::StageResult run(std::uint32_t invocations) {
        text::StageRun run{invocations, inputs, are_quads, is_watched, most_branches, subgroup_size};
        run.coverage = coverage;
        return text::run_stage(program, run, bindings(), named_profile("llvmpipe"), findings);
    }
    /// "LINE rule", and what it is of.
    [[nodiscard]] std::vector<std::string> found() const {
        std::vector<std::string> all;
        for (const text::Finding& one : findings.all())
            all.push_back(std::to_string(one.place.line - 1) + " " + one.rule.substr(0, one.rule.find(" (")) + ": " +
                          one.what);
        return all;
    }

    text::StageWords inputs;
    bool are_quads = false;
};

} // namespace lockstep::test
