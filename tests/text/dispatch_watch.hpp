#pragma once
#include <map>
#include <string>
#include <utility>

#include "crosscheck/text/stage_capture.hpp"
#include "reference/text/dispatch.hpp"
#include "tests/text/stage_names.hpp"

namespace lockstep::test {

/// Runs the text of each compute shader that is dispatched, whichever host does it: from what GL has bound before the
/// dispatch, and holds what the text makes of it against what the dispatch left.
class DispatchWatch {
  public:
    struct Row {
        std::size_t dispatches = 0, words = 0, changed = 0, differing = 0, findings = 0;
        std::string refused = {};
    };
    explicit DispatchWatch(Profile profile)
        : profile_(std::move(profile)),
          capture_({.program =
                        [this](Stage stage, const std::string& text) {
                            return stage == Stage::compute ? &names_.decoded(stage, text) : nullptr;
                        },
                    .take = [this](const std::string& text, CapturedStage stage) { compare(text, std::move(stage)); },
                    .refuse = [this](const std::string& text,
                                     const std::string& why) { rows_[names_.name_of(text)].refused = why; }},
                   0) {}

    /// By what the shader's first comment says.
    [[nodiscard]] const std::map<std::string, Row>& rows() const { return rows_; }

  private:
    void compare(const std::string& text, CapturedStage stage) {
        const auto before = stage.words;
        text::Findings findings;
        text::run_dispatch(*stage.program, {.groups = stage.groups}, stage.bindings, profile_, findings);
        Row& row = rows_[names_.name_of(text)];
        ++row.dispatches;
        row.findings += findings.all().size();
        for (std::size_t b = 0; b < stage.after.size(); ++b) {
            row.words += stage.after[b].size();
            for (std::size_t w = 0; w < stage.after[b].size(); ++w) {
                row.changed += stage.after[b][w] != before[b][w] ? 1 : 0;
                row.differing += stage.after[b][w] != stage.words[b][w] ? 1 : 0;
            }
        }
    }

    Profile profile_;
    StageNames names_;
    std::map<std::string, Row> rows_;
    StageCapture capture_;
};

} // namespace lockstep::test
