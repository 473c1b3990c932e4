#include "crosscheck/collision/judge/step_table.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/collision/judge/drawn_rows.hpp"
#include "crosscheck/collision/judge/step_judge.hpp"
#include "crosscheck/collision/judge/told_step.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

/// Captured outputs of names that no row is made of.
void add_others(const StepCapture& capture, std::vector<StepRow>& rows) {
    static const std::set<std::string_view> known{
        "trace_clip",       "trace_ndc",      "trace_texture_coordinate", "trace_image_position",
        "trace_base_texel", "trace_searches", "trace_own_position",       "trace_neighbour_count",
        "trace_hit",        "trace_away",     "trace_velocity",           "trace_point_clip"};
    for (const CapturedVertex* vertex : {&capture.vertex, &capture.last})
        for (const CapturedOutput& output : vertex->outputs) {
            if (known.contains(output.name) && vertex == &capture.vertex)
                continue;
            const std::size_t size = output.words.size();
            for (std::size_t c = 0; c < size; ++c)
                rows.push_back({.label = size == 1  ? output.name
                                         : size < 5 ? fmt::format("{}.{}", output.name, "xyzw"[c])
                                                    : fmt::format("{}[{}]", output.name, c),
                                .gpu = output.is_float ? Cell{output.number(c), {}}
                                                       : Cell{{}, fmt::format("{}", output.integer(c))}});
        }
}

/// `run`: null where the particle is alone.
StepTable table_of(const JudgedFrame& frame, std::size_t particle, StepCapture capture, FrameRun* run) {
    StepTable table;
    table.particle = particle;
    table.gpu = std::move(capture);
    const bool draws = is_listing(frame.params.switches);
    table.rows = with_step_pass(frame, [&](const JudgedPass& pass) {
        return item_rows(pass, particle, told_by_capture(pass.pass, table.gpu, frame.gpu[particle]));
    });
    if (!same_bits(table.gpu.state, frame.gpu[particle]))
        table.warning =
            "the trace build's outputs are not those of the frame; the steps between may not be what happened";
    if (!draws) {
        table.reference.before = frame.before[particle];
        return table;
    }
    table.reference = trace_step(frame.before[particle], frame.cdt, frame.params, frame.profile);
    table.rows = with_drawn_rows(std::move(table.rows), frame, particle, table.gpu, table.reference, run);
    add_others(table.gpu, table.rows);
    return table;
}

} // namespace

const StepRow* StepTable::first_divergent() const {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [](const StepRow& row) { return row.verdict == RowVerdict::divergent; });
    return found == rows.end() ? nullptr : &*found;
}

StepTable step_table(FrameRun& run, std::size_t particle) {
    StepTable table = table_of(run.judged(), particle, run.capture(particle), &run);
    table.frame = run.frame();
    return table;
}

StepTable step_table(const JudgedFrame& frame, std::size_t particle, const StepCapture& capture) {
    return table_of(frame, particle, capture, nullptr);
}

} // namespace lockstep
