#include "crosscheck/report/report.hpp"

#include <algorithm>
#include <bit>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/report/power_text.hpp"
#include "crosscheck/report/shader_diff.hpp"
#include "crosscheck/report/value_text.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

/// "frame 3 particle 17 position.x"; "frame 3 texel (31, 282).w".
std::string place(const CheckReport& r, const FrameDifference& d) {
    const FieldId id = d.difference.field;
    const Resource& resource = r.schema.resources[id.resource];
    const std::string component = component_name(r.schema[id], d.difference.component);
    return fmt::format("frame {} {}{}", d.frame,
                       item_name(resource, r.total.resources[id.resource].extent, d.difference.index),
                       resource.dimensions == 1 ? " " + component : component.substr(r.schema[id].name.size()));
}

std::vector<Extent> extents(const CheckReport& r) {
    std::vector<Extent> all;
    for (const auto& compared : r.total.resources)
        all.push_back(compared.extent);
    return all;
}

/// Whether a system has more than two buffers and images: texts then leave out those without a count, and name images.
bool has_many(const CheckReport& r) { return r.schema.resources.size() > 2; }

/// "5 particle states and 7 texels": of each buffer and image as many.
std::string items_text(const CheckReport& r, const std::vector<std::uint64_t>& counts, std::string_view state) {
    std::string text;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const Resource& resource = r.schema.resources[k];
        if (has_many(r) && counts[k] == 0)
            continue;
        const bool is_image = resource.dimensions > 1;
        text += fmt::format("{}{} {}{}{}{}{}", text.empty() ? "" : " and ", grouped(counts[k]), resource.item,
                            is_image ? "" : state, counts[k] == 1 ? "" : "s", has_many(r) && is_image ? " of " : "",
                            has_many(r) && is_image ? resource.title : "");
    }
    return text;
}

/// As many as differ.
std::string differing_text(const CheckReport& r, std::string_view state) {
    std::vector<std::uint64_t> differing;
    for (std::uint8_t k = 0; k < r.schema.resources.size(); ++k)
        differing.push_back(r.total.differing(k));
    return items_text(r, differing, state);
}

/// "12 floats of particles, 4 of texels".
std::string compared_text(const CheckReport& r) {
    std::string text;
    for (std::uint8_t k = 0; k < r.schema.resources.size(); ++k) {
        const Resource& resource = r.schema.resources[k];
        if (has_many(r) && r.total.compared(k) == 0)
            continue;
        const bool floats = std::all_of(resource.fields.begin(), resource.fields.end(),
                                        [](const Field& field) { return field.scalar == Scalar::float32; });
        const std::string_view what = !text.empty() ? "" : floats ? "floats " : "values ";
        text += fmt::format("{}{} {}of {}", text.empty() ? "" : ", ", grouped(r.total.compared(k)), what,
                            has_many(r) ? resource.title : resource.item + "s");
    }
    return text;
}

/// " and of the CDT": what was compared beside the first buffer.
std::string others_compared(const CheckReport& r) {
    std::string text;
    for (std::uint8_t k = 1; k < r.schema.resources.size(); ++k)
        if (r.total.compared(k) > 0)
            text += fmt::format(" and of {}", r.schema.resources[k].title);
    return text;
}

std::uint64_t nan_count(const Comparison& comparison) {
    std::uint64_t sum = 0;
    for (const ResourceCount& resource : comparison.resources)
        for (const FieldCount& field : resource.fields)
            sum += field.nan;
    return sum;
}

/// Calls `work(field, its counts)` for all fields of the schema.
template <class Work> void for_each_field(const CheckReport& r, const Work& work) {
    for (std::uint8_t k = 0; k < r.schema.resources.size(); ++k)
        for (std::uint8_t f = 0; f < r.schema.resources[k].fields.size(); ++f)
            work(r.schema[{k, f}], r.total[{k, f}]);
}

FrameTimes total_times(const CheckReport& r) {
    FrameTimes sum;
    for (const FrameTimes& t : r.times) {
        sum.gpu += t.gpu;
        sum.readback += t.readback;
        sum.reference += t.reference;
        sum.compare += t.compare;
        sum.judge += t.judge;
        sum.power += t.power;
    }
    return sum;
}

/// Frames at which growth is told: 0, 1, 2, 4, 8, ... and the last.
bool told(std::size_t i, std::size_t count) { return i == 0 || i + 1 == count || std::has_single_bit(i); }

std::string particles_text(const CheckReport& r) {
    return fmt::format("{} {}{}", grouped(r.particles), r.schema.resources.front().item, r.particles == 1 ? "" : "s");
}
std::string frames_text(const CheckReport& r) { return counted(static_cast<std::size_t>(r.frames), "frame"); }

std::string of_class(const CheckReport& r, DifferenceClass kind) {
    std::vector<std::uint64_t> items;
    for (const VerdictSummary::Counts& counts : r.verdicts->classes)
        items.push_back(counts[static_cast<std::size_t>(kind)]);
    return fmt::format("from frame {} on: {} in {}", r.verdicts->first->place.frame, items_text(r, items, " state"),
                       frames_text(r));
}

/// The same of the rendered frame.
std::string rendered_counts(const RenderVerdict& r) {
    const auto pixels = [&](DifferenceClass kind) {
        return fmt::format(" in the rendered frame: {} of {} pixels", grouped(r.count(kind)), grouped(r.pixels));
    };
    if (r.count(DifferenceClass::divergent) > 0)
        return pixels(DifferenceClass::divergent) + ", which no legal run explains";
    if (r.count(DifferenceClass::undefined) > 0)
        return pixels(DifferenceClass::undefined) + ", which rest on what GL leaves open";
    return fmt::format(" in the rendered frame: {} of {} pixels differ, as GL allows", grouped(r.differing),
                       grouped(r.pixels));
}

/// After the verdict's words; of all but the rendered frame.
std::string verdict_counts(const CheckReport& r) {
    switch (r.state_verdict.value_or(r.verdict)) {
    case Verdict::agree:
        return fmt::format(": every bit of {}{} in {}", particles_text(r), others_compared(r), frames_text(r));
    case Verdict::legal:
        return fmt::format(": {} differ in {}, as GL allows", differing_text(r, " state"), frames_text(r));
    case Verdict::undefined:
        return fmt::format(" {}, which rest on what GL leaves open", of_class(r, DifferenceClass::undefined));
    case Verdict::divergent:
        return fmt::format(" {}, which no legal run explains", of_class(r, DifferenceClass::divergent));
    case Verdict::differ:
        return fmt::format(" from frame {} on: {} in {}", *r.first_frame, differing_text(r, " state"), frames_text(r));
    case Verdict::nondeterministic:
        return fmt::format(": the GPU gave two answers to frame {}: {} differ between two runs of it", *r.first_frame,
                           differing_text(r, ""));
    }
    return "";
}

std::string verdict_line(const CheckReport& r) {
    const bool judged = r.verdicts || r.verdict == Verdict::nondeterministic;
    const std::string state = verdict_counts(r) + (judged ? "" : "; compared, not judged");
    if (!r.state_verdict)
        return verdict_words(r) + state;
    const std::string drawn = r.rendered ? rendered_counts(*r.rendered) : " in what the last frame draws";
    return fmt::format("{}{}; the state itself {}{}", verdict_words(r), drawn, verdict_name(*r.state_verdict), state);
}

std::string first_pixel_text(const RenderVerdict& r) {
    const auto width = static_cast<std::size_t>(r.width);
    return fmt::format("pixel ({}, {}): reference {} of {}, GPU {}", r.first->index % width, r.first->index / width,
                       color_text(r.first->reference), r.first->owner, color_text(r.first->gpu));
}

/// The lines under `render`: cause, and the first pixel.
std::vector<std::string> render_details(const RenderVerdict& r) {
    std::vector<std::string> lines;
    if (r.count(DifferenceClass::divergent) > 0 && r.causes.empty())
        lines.emplace_back("cause: no named mistake explains it");
    for (std::size_t i = 0; i < r.causes.size() && i < 3; ++i)
        lines.push_back(fmt::format("{}: {} ({})", i == 0 ? "cause" : "or", r.causes[i].name, r.causes[i].meaning));
    if (r.causes.size() > 3)
        lines.push_back(fmt::format("or one of {} more that draw the same here", r.causes.size() - 3));
    if (r.first)
        lines.push_back("first: " + first_pixel_text(r));
    return lines;
}

std::string growth_text(const CheckReport& r) {
    std::string text = "\n  growth: frame";
    for (const Resource& resource : r.schema.resources)
        text += fmt::format(", differing {}s", resource.item);
    text += ", worst ULP\n";
    for (std::size_t i = 0; i < r.counts.size(); ++i) {
        if (!told(i, r.counts.size()))
            continue;
        text += fmt::format("  {:>8}", r.counts[i].frame);
        for (const std::uint64_t items : r.counts[i].items)
            text += fmt::format(" {:>12}", grouped(items));
        text += fmt::format(" {:>16}\n", distance_text(r.counts[i].worst_ulp));
    }
    return text;
}

nlohmann::json counts_json(const CheckReport& r) {
    nlohmann::json columns{"frame"};
    for (std::uint8_t k = 0; k < r.schema.resources.size(); ++k)
        columns.push_back(item_key(r.schema, k) + "s");
    columns.push_back("worst_ulp");
    nlohmann::json rows = nlohmann::json::array();
    for (const FrameCount& count : r.counts) {
        nlohmann::json row{count.frame};
        for (const std::uint64_t items : count.items)
            row.push_back(items);
        row.push_back(count.worst_ulp);
        rows.push_back(row);
    }
    return {{"columns", columns}, {"rows", rows}};
}

} // namespace

std::string_view verdict_name(Verdict verdict) {
    switch (verdict) {
    case Verdict::agree:
        return "AGREE";
    case Verdict::legal:
        return "LEGAL";
    case Verdict::undefined:
        return "UNDEFINED";
    case Verdict::divergent:
        return "DIVERGENT";
    case Verdict::differ:
        return "DIFFER";
    case Verdict::nondeterministic:
        return "NONDETERMINISTIC";
    }
    return "";
}

std::string shaders_line(const RunDescription& run) {
    return run.shaders ? shaders_text(*run.shaders) : run.shaders_untold;
}

std::string render_line(const CheckReport& report, const RunDescription& run) {
    if (!report.rendered)
        return "the rendered frame was not compared" + run.render_hint;
    const RenderVerdict& r = *report.rendered;
    const std::string pixels = fmt::format("{} pixels of frame {}, {} of which show particles", grouped(r.pixels),
                                           r.frame, grouped(r.of_particles));
    const auto count = [&](DifferenceClass kind) { return grouped(r.count(kind)); };
    if (r.differing == 0)
        return fmt::format("AGREE: every one of {}", pixels);
    const std::string legal =
        fmt::format("{} rounding, {} tie", count(DifferenceClass::rounding), count(DifferenceClass::tie));
    if (r.count(DifferenceClass::divergent) > 0)
        return fmt::format("DIVERGENT: {} of {}; {}, {} undefined", count(DifferenceClass::divergent), pixels, legal,
                           count(DifferenceClass::undefined));
    if (r.count(DifferenceClass::undefined) > 0)
        return fmt::format("UNDEFINED: {} of {}; {}", count(DifferenceClass::undefined), pixels, legal);
    return fmt::format("LEGAL: {} of {}; {}", grouped(r.differing), pixels, legal);
}

std::string pass_options_text(const PassRules& rules) {
    const auto share = [](std::string_view option, double at_least) {
        return at_least > 0.0 ? fmt::format(" {} {}", option, at_least) : std::string();
    };
    return fmt::format("{}{}{}{}", rules.allow_undefined ? " --allow-undefined" : "",
                       rules.require_hits ? " --require-hits" : "", share("--power-at-least", rules.power_at_least),
                       share("--cover-at-least", rules.cover_at_least));
}

std::string verdict_words(const CheckReport& r) {
    std::string words;
    for (const std::string& failure : r.failures)
        words += fmt::format("{}{}", words.empty() ? "FAILED: " : "; ", failure);
    words += fmt::format("{}{}", words.empty() ? "" : "; ", verdict_name(r.verdict));
    if (!r.part.empty())
        words += fmt::format(" (part: {})", r.part);
    if (r.partial())
        words += fmt::format(" (partial: stopped after {} of {} frames{}{})", r.frames, r.frames_asked,
                             r.ended_by.empty() ? "" : ": ", r.ended_by);
    for (std::size_t i = 0; i < r.untried.size(); ++i)
        words += fmt::format("{}{}", i == 0 ? ", but " : ", and ", r.untried[i]);
    return words;
}

std::string report_text(const CheckReport& r, const RunDescription& run) {
    std::string out;
    const auto line = [&](std::string_view key, std::string_view text) { out += fmt::format("{:<10}{}\n", key, text); };
    line("scene", fmt::format("{}: {}, {}, {}", run.scene, particles_text(r), frames_text(r), run.mode));
    line("switches", run.settings);
    line("GL", run.context);
    line("shaders", shaders_line(run));
    line("profile", run.profile);
    const std::string hits = fmt::format("{} hits, {} texels drawn, ", grouped(r.hits), grouped(r.drawn_texels));
    line("compared",
         fmt::format("{}; {}{} NaN", compared_text(r), r.counts_hits ? hits : "", grouped(nan_count(r.total))));
    const FrameTimes seconds = total_times(r);
    if (run.timed)
        line("time", fmt::format("GL frames {:.2f} s, readback {:.2f} s, reference {:.2f} s, comparison {:.2f} s, "
                                 "verdicts {:.2f} s, power {:.2f} s",
                                 seconds.gpu, seconds.readback, seconds.reference, seconds.compare, seconds.judge,
                                 seconds.power));
    if (r.verdict != Verdict::nondeterministic)
        line("hash", r.reference_hash == r.gpu_hash
                         ? fmt::format("{} on both sides after the last frame{}", hash_text(r.gpu_hash),
                                       r.verdicts && !r.total.agree() ? ", which both made from the GPU's state" : "")
                         : fmt::format("reference {}, GPU {}", hash_text(r.reference_hash), hash_text(r.gpu_hash)));
    if (!r.power.mistakes.empty()) {
        const bool proves = r.verdict != Verdict::divergent; // else one mistake is enough to read about
        line("power", proves ? power_words(r.power) : power_line(r.power));
        if (!r.power.situations.empty())
            line("", situations_text(r.power));
        for (const std::string& reason : proves ? unseen_by_reason(r.power) : std::vector<std::string>())
            line("", reason);
    }
    if (r.rendered || run.draws)
        line("render", render_line(r, run));
    if (r.rendered)
        for (const std::string& detail : render_details(*r.rendered))
            line("", detail);
    if (!r.without_effect.empty())
        line("no effect", fmt::format("in {}: {}", frames_text(r), fmt::join(r.without_effect, ", ")));
    for (const TextCoverage& one : run.coverage)
        line("coverage", coverage_text(one));
    for (const std::string& note : run.notes)
        line("note", note);
    line("verdict", verdict_line(r));
    if (r.total.agree()) {
        if (!run.explain.empty())
            line("", fmt::format("again: {}", run.explain));
        return r.state_verdict ? out + fmt::format("\nrepeat    {}\n", run.repeat) : out;
    }
    if (r.verdict == Verdict::divergent && r.wider_rule && !(r.verdicts && names_cause(*r.verdicts)))
        line("hint",
             fmt::format(
                 "none of those that were tried is wrong by{}: the shader may be right and write the same in another "
                 "way, which rounds otherwise than what was measured, or be wrong by no more than that",
                 legal_option_text(*r.wider_rule)));
    if (r.verdicts)
        out += verdict_text(*r.verdicts, r.schema, extents(r));
    if (!run.explain.empty())
        line("", fmt::format("again: {}", run.explain));

    out += "\n  field         differing floats of compared\n";
    for_each_field(r, [&](const Field& field, const FieldCount& counts) {
        if (counts.differing > 0)
            out +=
                fmt::format("  {:<13} {:>16} of {}\n", field.name, grouped(counts.differing), grouped(counts.compared));
    });
    out += fmt::format("\n  worst of frame {}\n", *r.first_frame);
    const std::string_view second = r.verdict == Verdict::nondeterministic ? "second run" : "GPU";
    const std::string_view first = r.verdict == Verdict::nondeterministic ? "first run" : "reference";
    for (const FrameDifference& d : r.worst)
        out +=
            fmt::format("  {}: {} {}, {} {}, {}\n", place(r, d), first, value_text(d.difference.reference, run.numbers),
                        second, value_text(d.difference.gpu, run.numbers), distance_text(d.difference));
    if (run.mode == "free" && r.verdict == Verdict::differ) {
        out += growth_text(r);
    }
    out += fmt::format("\nrepeat    {}\n", run.repeat);
    return out;
}

namespace {

nlohmann::json changes_json(const UsedShader& used) {
    nlohmann::json changes = nlohmann::json::array();
    for (const ShaderChange& change : shader_changes(used))
        changes.push_back({{"line", change.line}, {"before", change.before}, {"now", change.now}});
    return changes;
}

nlohmann::json shaders_json(const RunDescription& run) {
    nlohmann::json files = nlohmann::json::array();
    if (run.shaders)
        for (const UsedShader& used : run.shaders->files)
            files.push_back(
                {{"file", used.file},
                 {"foreign", used.foreign.empty() ? nlohmann::json() : nlohmann::json(used.foreign.string())},
                 {"same_as_shipped", used.foreign.empty() || used.same_as_shipped},
                 {"left_out", used.leaves_out},
                 {"changes", changes_json(used)}});
    return {{"text", shaders_line(run)}, {"files", files}};
}

nlohmann::json render_json(const CheckReport& report, const RunDescription& run) {
    nlohmann::json json{{"text", render_line(report, run)}, {"compared", report.rendered.has_value()}};
    if (!report.rendered)
        return json;
    const RenderVerdict& r = *report.rendered;
    json.update({{"frame", r.frame},
                 {"pixels", r.pixels},
                 {"of_particles", r.of_particles},
                 {"differing", r.differing},
                 {"classes", nlohmann::json::object()},
                 {"causes", nlohmann::json::array()}});
    for (std::size_t kind = 0; kind < class_names.size(); ++kind)
        json["classes"][std::string(class_names[kind])] = r.classes[kind];
    for (const RenderCause& cause : r.causes)
        json["causes"].push_back({{"name", cause.name}, {"meaning", cause.meaning}});
    if (r.first)
        json["first"] = {{"text", first_pixel_text(r)},
                         {"x", r.first->index % static_cast<std::size_t>(r.width)},
                         {"y", r.first->index / static_cast<std::size_t>(r.width)}};
    return json;
}

} // namespace

nlohmann::json report_json(const CheckReport& r, const RunDescription& run) {
    using nlohmann::json;
    const FrameTimes seconds = total_times(r);
    json fields = json::object();
    for_each_field(r, [&](const Field& field, const FieldCount& counts) {
        fields[field.name] = {{"compared", counts.compared}, {"differing", counts.differing}, {"nan", counts.nan}};
    });
    json worst = json::array();
    for (const FrameDifference& d : r.worst)
        worst.push_back({{"frame", d.frame},
                         {"field", r.schema[d.difference.field].name},
                         {"index", d.difference.index},
                         {"component", d.difference.component},
                         {"reference", value_json(d.difference.reference)},
                         {"reference_hex", exact_text(d.difference.reference)},
                         {"gpu", value_json(d.difference.gpu)},
                         {"gpu_hex", exact_text(d.difference.gpu)},
                         {"ulp", d.difference.ulp}});
    json report{{"verdict", verdict_name(r.verdict)},
                {"verdict_line", verdict_line(r)},
                {"partial", r.partial()},
                {"ended_by", r.ended_by},
                {"judged", r.verdicts.has_value()},
                {"power", power_json(r.power)},
                {"legal_by", r.wider_rule ? json(legal_option_text(*r.wider_rule).substr(1)) : json()},
                {"untried", r.untried},
                {"failures", r.failures},
                {"part", r.part.empty() ? json() : json(r.part)},
                {"without_effect", r.without_effect},
                {"scene", run.scene},
                {"mode", run.mode},
                {"switches", run.settings},
                {"context", run.context},
                {"shaders", shaders_json(run)},
                {"render", render_json(r, run)},
                {"profile", run.profile},
                {"particles", r.particles},
                {"frames", r.frames},
                {"frames_asked", r.frames_asked},
                {"first_frame", r.first_frame ? json(*r.first_frame) : json()},
                {"hits", r.hits},
                {"drawn_texels", r.drawn_texels},
                {"fields", fields},
                {"worst", worst},
                {"counts", counts_json(r)},
                {"hash", {{"reference", hash_text(r.reference_hash)}, {"gpu", hash_text(r.gpu_hash)}}},
                {"verdicts", r.verdicts ? verdict_json(*r.verdicts, r.schema, extents(r)) : json()},
                {"repeat", run.repeat},
                {"coverage", coverage_json(run.coverage)},
                {"notes", run.notes},
                {"explain", run.explain.empty() ? json() : json(run.explain)}};
    if (run.timed)
        report["seconds"] = {
            {"gpu", seconds.gpu},         {"readback", seconds.readback}, {"reference", seconds.reference},
            {"compare", seconds.compare}, {"judge", seconds.judge},       {"power", seconds.power}};
    for (std::uint8_t k = 0; k < r.schema.resources.size(); ++k)
        report[fmt::format("differing_{}s", item_key(r.schema, k))] = r.total.differing(k);
    return report;
}

} // namespace lockstep
