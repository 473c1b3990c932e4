#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/text/stage_capture.hpp"
#include "reference/model/error.hpp"
#include "tests/text/stage_names.hpp"

namespace lockstep::test {

/// Runs the text of each vertex, geometry and fragment stage that is drawn with, whichever host does it, on the inputs
/// that the GPU's invocations had, and holds what it makes against what they made.
class DrawWatch {
  public:
    struct Row {
        std::size_t draws = 0, invocations = 0, words = 0, discarded = 0, vertices = 0, differing = 0;
        std::string first = {}, finding = {}, refused = {};
    };
    /// `most`: invocations of a draw that are kept; `most_draws`: of one stage that are looked at.
    explicit DrawWatch(Profile profile, std::size_t most = 16384, std::size_t most_draws = 4)
        : profile_(std::move(profile)), most_draws_(most_draws),
          capture_(
              {.program = [this](Stage stage, const std::string& text) { return wanted(stage, text); },
               .take = [this](const std::string& text,
                              CapturedStage stage) { compare(std::move(stage), *row_of_.at(text)); },
               .refuse = [this](const std::string& text, const std::string& why) { row_of_.at(text)->refused = why; }},
              most) {}

    /// By the stage and what its first comment says.
    [[nodiscard]] const std::map<std::string, Row>& rows() const { return rows_; }

  private:
    const text::Program* wanted(Stage stage, const std::string& text) {
        if (stage == Stage::compute)
            return nullptr;
        Row& row = rows_[fmt::format("{}: {}", extension(stage).substr(1), names_.name_of(text))];
        row_of_[text] = &row;
        if (row.draws >= most_draws_ || !row.refused.empty())
            return nullptr;
        try {
            return &names_.decoded(stage, text);
        } catch (const Error& error) {
            row.refused = error.what();
            return nullptr;
        }
    }

    void compare(CapturedStage stage, Row& row) {
        ++row.draws;
        if (stage.run.invocations == 0)
            return;
        text::Findings findings;
        stage.run.is_watched = row.draws == 1;
        const text::StageResult made = text::run_stage(*stage.program, stage.run, stage.bindings, profile_, findings);
        for (const text::Finding& one : findings.all())
            row.finding = fmt::format("{}: {}: {}", stage.program->line_name(one.place.line), one.rule, one.what);
        row.invocations += stage.run.invocations;
        row.vertices += made.vertices;
        const auto differs = [&](const std::string& what) {
            if (++row.differing == 1)
                row.first = what;
        };
        for (std::uint32_t i = 0; i < stage.run.invocations; ++i) {
            row.discarded += stage.made.is_discarded[i] != 0 ? 1 : 0;
            if ((stage.made.is_discarded[i] != 0) != (made.is_discarded[i] != 0))
                differs(fmt::format("invocation {}: discarded: text {}, GPU {}", i, made.is_discarded[i],
                                    stage.made.is_discarded[i]));
        }
        if (strips(made) != strips(stage.made))
            return differs(fmt::format("vertices: text {}, GPU {}", made.vertices, stage.made.vertices));
        for (const auto& [name, words] : stage.made.outputs) {
            const std::vector<std::uint32_t>& own = made.outputs.at(name);
            const std::size_t cells = words.size() / stage.made.vertices;
            for (std::size_t w = 0; w < words.size(); ++w) {
                const std::size_t vertex = w / cells;
                if (stage.program->stage == spv::ExecutionModelFragment && stage.made.is_discarded[vertex] != 0)
                    continue;
                ++row.words;
                if (own[w] != words[w])
                    differs(fmt::format("vertex {}: {}[{}]: text {:08x}, GPU {:08x}", vertex, name, w % cells, own[w],
                                        words[w]));
            }
        }
    }
    /// Without those that have no vertex.
    static std::vector<std::pair<std::uint32_t, std::uint32_t>> strips(const text::StageResult& made) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
        for (const text::StageResult::Strip& strip : made.strips)
            if (strip.count > 0)
                all.emplace_back(strip.invocation, strip.count);
        return all;
    }

    Profile profile_;
    std::size_t most_draws_;
    StageNames names_;
    std::map<std::string, Row> rows_;
    std::map<std::string, Row*> row_of_; ///< by text
    StageCapture capture_;
};

} // namespace lockstep::test
