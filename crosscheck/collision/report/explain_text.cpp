#include "crosscheck/collision/report/explain_text.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "crosscheck/collision/judge/diagnosis.hpp"
#include "crosscheck/collision/judge/neighbourhood.hpp"
#include "crosscheck/collision/judge/step_judge.hpp"
#include "crosscheck/collision/judge/texel_table.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/wrong_step.hpp"
#include "crosscheck/report/item_text.hpp"
#include "crosscheck/report/value_text.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

std::string vector_text(glm::vec3 v, NumberFormat format) {
    return fmt::format("({}, {}, {})", number_text(v.x, format), number_text(v.y, format), number_text(v.z, format));
}

std::string rows_text(const std::vector<StepRow>& rows, NumberFormat format) {
    std::string text;
    for (const StepRow& row : rows)
        text += row_text(row, format);
    return text;
}

const ItemVerdict* verdict_on(const std::vector<ItemVerdict>& verdicts, std::size_t index) {
    const auto found =
        std::find_if(verdicts.begin(), verdicts.end(), [&](const ItemVerdict& v) { return v.index == index; });
    return found == verdicts.end() ? nullptr : &*found;
}

std::string class_text(const ItemVerdict* verdict) {
    if (verdict == nullptr)
        return "every bit agrees";
    std::string text(class_names[static_cast<std::size_t>(verdict->kind)]);
    if (verdict->tie)
        text += fmt::format(": {}, margin {:.3g} {}", verdict->tie->kind.name, verdict->tie->margin,
                            verdict->tie->kind.unit);
    if (verdict->undefined != Undefined::none)
        text += fmt::format(": {}", undefined_name(verdict->undefined));
    if (verdict->follows_particle)
        text += ", as a particle that is drawn there";
    return text;
}

std::string wrong_text(const WrongStep& wrong) {
    return fmt::format("  step {}: {}\n  {}{}{}\n", wrong.step, wrong_step_text(wrong),
                       difference_text(collision_schema(), wrong.difference), wrong.margin.empty() ? "" : "; ",
                       wrong.margin);
}

std::string interval_text(const Interval& set, NumberFormat format) {
    if (set.any)
        return "any";
    const std::string low = number_text(static_cast<float>(set.low), format);
    return set.low == set.high ? low : fmt::format("{} to {}", low, number_text(static_cast<float>(set.high), format));
}

std::string interval_text(const Interval3& set, NumberFormat format) {
    return fmt::format("({}, {}, {})", interval_text(set[0], format), interval_text(set[1], format),
                       interval_text(set[2], format));
}

std::string outcome_text(const LegalOutcome& o, NumberFormat format) {
    std::string text = o.hit ? fmt::format("a hit with texel ({}, {}) around ({}, {})", o.neighbour.x, o.neighbour.y,
                                           o.base.x, o.base.y)
                             : std::string("no hit");
    if (o.undefined != Undefined::none)
        text += fmt::format(", open: {}", undefined_name(o.undefined));
    for (const Tie& tie : o.ties)
        text += fmt::format(", tie of {} ({:.3g} {})", tie.kind.name, tie.margin, tie.kind.unit);
    return text + fmt::format("\n    speed {}, collide time {}\n    direction {}\n    position {}\n",
                              interval_text(o.speed, format), interval_text(o.collide_time, format),
                              interval_text(o.direction, format), interval_text(o.position, format));
}

std::string agrees_text(const LegalOutcome& o, const ParticleState& gpu) {
    if (o.contains(gpu))
        return "the GPU is in it";
    std::string outside;
    const auto note = [&](bool in, std::string_view field) {
        if (!in)
            outside += fmt::format("{}{}", outside.empty() ? "" : ", ", field);
    };
    const auto holds = [](const Interval3& set, glm::vec3 v) {
        return set[0].contains(v.x) && set[1].contains(v.y) && set[2].contains(v.z);
    };
    note(o.collide_time.contains(gpu.collide_time), "collide time");
    note(o.speed.contains(gpu.speed), "speed");
    note(holds(o.direction, gpu.direction), "direction");
    note(holds(o.position, gpu.position), "position");
    return "the GPU is not: " + outside;
}

/// The same of a step that its twin alone judges.
std::string why_item(const JudgedPass& pass, std::size_t item, const std::string& name) {
    const bool differs = !same_item(pass.reference, pass.gpu, item);
    const ItemVerdict verdict = judge_item(pass, item);
    std::string text = fmt::format("{}: {}\n", name, class_text(differs ? &verdict : nullptr));
    const auto outcomes = pass.on_input().outcomes(pass.input(), item, pass.profile, pass.known, &pass.gpu);
    for (std::size_t i = 0; i < outcomes.size(); ++i)
        text += fmt::format("  legal outcome {} of {}, {}: {}\n", i + 1, outcomes.size(),
                            outcomes[i].contains(pass.gpu, item) ? "the GPU is in it" : "the GPU is not",
                            outcome_text(outcomes[i], pass.gpu.about()));
    if (differs && verdict.kind >= DifferenceClass::undefined)
        text += wrong_text(wrong_step_of_item(pass, item));
    return text;
}

} // namespace

std::string particle_head(const StepTable& table, NumberFormat format) {
    const ParticleState& s = table.reference.before;
    std::string text =
        fmt::format("particle {} in frame {}\n  before  position {}\n          direction {}\n"
                    "          speed {}, collide time {}\n",
                    table.particle, table.frame, vector_text(s.position, format), vector_text(s.direction, format),
                    number_text(s.speed, format), number_text(s.collide_time, format));
    if (!table.warning.empty())
        text += fmt::format("  warning {}\n", table.warning);
    if (table.gpu.vertex.outputs.empty())
        text += "  note    the vertex stage has no trace_* outputs, so intermediate values are the reference's alone\n";
    return text;
}

std::string neighbourhood_picture(const JudgedFrame& frame, const StepTable& table) {
    const std::optional<SearchedTexels> round = neighbourhood(table, frame.params.constants.texel_collide_range);
    if (!round)
        return "";
    const auto& [low, high, base, gpu_base, pick, gpu_pick] = *round;

    std::string text = fmt::format("  texels {} to {} across, {} at the top\n", low.x, high.x, high.y);
    for (int y = high.y; y >= low.y; --y) {
        text += fmt::format("  {:>5} ", y);
        for (int x = low.x; x <= high.x; ++x) {
            const glm::ivec2 texel(x, y);
            char what = ' ';
            if (frame.cdt.contains(x, y))
                what = frame.cdt.at(x, y).a != 0.0F ? 'o' : '.';
            if (texel == pick && texel == gpu_pick)
                what = 'B';
            else if (texel == pick)
                what = 'R';
            else if (texel == gpu_pick)
                what = 'G';
            const bool of_reference = texel == base;
            const bool of_gpu = texel == gpu_base;
            text += of_reference ? '[' : of_gpu ? '{' : ' ';
            text += what;
            text += of_reference ? (of_gpu ? ']' : ')') : of_gpu ? '}' : ' ';
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
    }
    text += "  . empty  o holds a position  [ ] base texel of both";
    if (base != gpu_base)
        text += ", here [ ) the reference's, { } the GPU's";
    return text + "\n  R the reference's nearest, G the GPU's, B both sides'\n";
}

std::string why_particle(FrameRun& run, std::size_t particle, NumberFormat format) {
    return why_particle(run.judged(), particle, fmt::format("particle {} in frame {}", particle, run.frame()), format);
}

std::string why_particle(const JudgedFrame& frame, std::size_t particle, const std::string& name, NumberFormat format) {
    if (!is_listing(frame.params.switches))
        return with_step_pass(frame, [&](const JudgedPass& pass) { return why_item(pass, particle, name); });
    const ParticleState gpu = frame.gpu[particle];
    const bool differs = !same_bits(frame.reference[particle], gpu);
    const ItemVerdict verdict = judge_particle(frame, particle);
    std::string text = fmt::format("{}: {}\n", name, class_text(differs ? &verdict : nullptr));
    const std::vector<LegalOutcome> outcomes =
        legal_outcomes(frame.before[particle], frame.cdt, frame.params, frame.profile, frame.known, &gpu);
    for (std::size_t i = 0; i < outcomes.size(); ++i)
        text += fmt::format("  legal outcome {} of {}, {}: {}", i + 1, outcomes.size(), agrees_text(outcomes[i], gpu),
                            outcome_text(outcomes[i], format));
    if (differs && verdict.kind >= DifferenceClass::undefined)
        text += wrong_text(wrong_step_of_particle(frame, particle));
    return text;
}

std::string why_texel(FrameRun& run, std::size_t texel) {
    const JudgedFrame frame = run.judged();
    const ItemVerdict* verdict = verdict_on(run.verdicts().texels, texel);
    const auto width = static_cast<std::size_t>(frame.params.width);
    std::string text =
        fmt::format("texel ({}, {}) in frame {}: {}\n", texel % width, texel / width, run.frame(), class_text(verdict));
    if (verdict != nullptr && verdict->kind >= DifferenceClass::undefined)
        text += wrong_text(wrong_step_of_texel(frame, texel));
    return text;
}

std::string table_text(const JudgedFrame& frame, const StepTable& table, NumberFormat format) {
    return particle_head(table, format) + "\n" + head_text(frame.profile) + rows_text(table.rows, format) + "\n" +
           neighbourhood_picture(frame, table) + "\n";
}

std::string first_divergent_text(const StepTable& table) {
    const StepRow* first = table.first_divergent();
    return first == nullptr ? "" : fmt::format("first     {}: {}\n", first->label, first->reason);
}

std::string explain_particle(FrameRun& run, std::size_t particle, NumberFormat format) {
    const StepTable table = step_table(run, particle);
    return table_text(run.judged(), table, format) + why_particle(run, particle, format) + first_divergent_text(table);
}

std::string explain_texel(FrameRun& run, std::size_t texel, NumberFormat format) {
    const TexelTable table = texel_table(run, texel);
    const auto width = static_cast<std::size_t>(run.scene().width);
    std::string text = fmt::format("texel ({}, {}) in frame {}\n\n", texel % width, texel / width, run.frame()) +
                       head_text(run.profile()) + rows_text(table.rows, format) + "\n" + why_texel(run, texel);
    for (const std::size_t particle : table.particles)
        text.append("\n").append(explain_particle(run, particle, format));
    return text;
}

} // namespace lockstep
