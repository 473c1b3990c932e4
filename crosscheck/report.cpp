#include "crosscheck/report.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/verdict_text.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep {
namespace {

std::string ulp_text(std::int64_t ulp) {
    if (ulp == INT64_MAX)
        return "NaN on one side";
    return ulp == 0 ? "sign of zero" : grouped(static_cast<std::uint64_t>(ulp)) + " ULP";
}

std::string value_text(float value) { return fmt::format("{:.9g} ({:a})", value, value); }

std::string place(const FrameDifference& d, int width) {
    const char component = "xyzw"[d.difference.component];
    const auto index = static_cast<std::int64_t>(d.difference.index);
    switch (d.difference.field) {
    case Field::texel:
        return fmt::format("frame {} texel ({}, {}).{}", d.frame, index % width, index / width, component);
    case Field::speed:
    case Field::collide_time:
        return fmt::format("frame {} particle {} {}", d.frame, index,
                           field_names[static_cast<std::size_t>(d.difference.field)]);
    default:
        return fmt::format("frame {} particle {} {}.{}", d.frame, index,
                           field_names[static_cast<std::size_t>(d.difference.field)], component);
    }
}

FrameTimes total_times(const CheckReport& r) {
    FrameTimes sum;
    for (const FrameTimes& t : r.times) {
        sum.gpu += t.gpu;
        sum.readback += t.readback;
        sum.reference += t.reference;
        sum.compare += t.compare;
        sum.judge += t.judge;
    }
    return sum;
}

/// Frames at which growth is told: 0, 1, 2, 4, 8, ... and the last.
bool told(std::size_t i, std::size_t count) { return i == 0 || i + 1 == count || std::has_single_bit(i); }

std::string of_class(const CheckReport& r, DifferenceClass kind) {
    const auto k = static_cast<std::size_t>(kind);
    return fmt::format("from frame {} on: {} particle states and {} texels in {} frames",
                       r.verdicts->first->place.frame, grouped(r.verdicts->particles[k]),
                       grouped(r.verdicts->texels[k]), r.frames);
}

/// After the verdict's words.
std::string verdict_counts(const CheckReport& r) {
    switch (r.verdict) {
    case Verdict::agree:
        return fmt::format(": every bit of {} particles{} in {} frames", grouped(r.particles),
                           r.total[Field::texel].compared > 0 ? " and of the CDT" : "", r.frames);
    case Verdict::legal:
        return fmt::format(": {} particle states and {} texels differ in {} frames, as GL allows",
                           grouped(r.total.differing_particles), grouped(r.total.differing_texels), r.frames);
    case Verdict::undefined:
        return fmt::format(" {}, which rest on what GL leaves open", of_class(r, DifferenceClass::undefined));
    case Verdict::divergent:
        return fmt::format(" {}, which no legal run explains", of_class(r, DifferenceClass::divergent));
    case Verdict::differ:
        return fmt::format(" from frame {} on: {} particle states and {} texels in {} frames", *r.first_frame,
                           grouped(r.total.differing_particles), grouped(r.total.differing_texels), r.frames);
    case Verdict::nondeterministic:
        return fmt::format(": the GPU gave two answers to frame {}: {} particles and {} texels differ between two runs "
                           "of it",
                           *r.first_frame, grouped(r.total.differing_particles), grouped(r.total.differing_texels));
    }
    return "";
}

std::string verdict_line(const CheckReport& r) {
    const bool judged = r.verdicts || r.verdict == Verdict::nondeterministic;
    return verdict_words(r) + verdict_counts(r) + (judged ? "" : "; compared, not judged");
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

std::string render_line(const RunDescription& run) {
    if (!run.rendered)
        return "the rendered frame was not compared" + run.render_hint;
    const RenderComparison& r = *run.rendered;
    const std::string pixels = fmt::format("{} pixels of frame {}, {} of which show particles", grouped(r.pixels),
                                           r.frame, grouped(r.of_particles));
    return r.differing == 0 ? fmt::format("AGREE: every one of {}", pixels)
                            : fmt::format("DIFFER: {} of {}; compared, not judged", grouped(r.differing), pixels);
}

std::string pass_options_text(const PassRules& rules) {
    return fmt::format("{}{}", rules.allow_undefined ? " --allow-undefined" : "",
                       rules.require_hits ? " --require-hits" : "");
}

std::string verdict_words(const CheckReport& r) {
    std::string words(verdict_name(r.verdict));
    if (r.partial())
        words += fmt::format(" (partial: stopped after {} of {} frames)", r.frames, r.frames_asked);
    for (std::size_t i = 0; i < r.untried.size(); ++i)
        words += fmt::format("{}{}", i == 0 ? ", but " : ", and ", r.untried[i]);
    return words;
}

std::string report_text(const CheckReport& r, const RunDescription& run) {
    std::string out;
    const auto line = [&](std::string_view key, std::string_view text) { out += fmt::format("{:<10}{}\n", key, text); };
    line("scene", fmt::format("{}: {} particles, {} frames, {}", run.scene, grouped(r.particles), r.frames, run.mode));
    line("switches", run.settings);
    line("GL", run.context);
    line("shaders", shaders_line(run));
    line("profile", run.profile);
    std::uint64_t nan = 0;
    for (const FieldCount& field : r.total.fields)
        nan += field.nan;
    line("compared",
         fmt::format("{} floats of particles, {} of texels; {} hits, {} texels drawn, {} NaN",
                     grouped(r.total.compared() - r.total[Field::texel].compared),
                     grouped(r.total[Field::texel].compared), grouped(r.hits), grouped(r.drawn_texels), grouped(nan)));
    const FrameTimes seconds = total_times(r);
    line("time", fmt::format("GL frames {:.2f} s, readback {:.2f} s, reference {:.2f} s, comparison {:.2f} s, "
                             "verdicts {:.2f} s",
                             seconds.gpu, seconds.readback, seconds.reference, seconds.compare, seconds.judge));
    if (r.verdict != Verdict::nondeterministic)
        line("hash", r.reference_hash == r.gpu_hash
                         ? fmt::format("{} on both sides after the last frame", hash_text(r.gpu_hash))
                         : fmt::format("reference {}, GPU {}", hash_text(r.reference_hash), hash_text(r.gpu_hash)));
    line("render", render_line(run));
    for (const std::string& note : run.notes)
        line("note", note);
    line("verdict", verdict_line(r));
    if (r.total.agree())
        return out;
    if (r.verdicts)
        out += verdict_text(*r.verdicts, run.width);
    if (!run.explain.empty())
        line("", fmt::format("again: {}", run.explain));

    out += "\n  field         differing floats of compared\n";
    for (std::size_t f = 0; f < field_names.size(); ++f)
        if (r.total.fields[f].differing > 0)
            out += fmt::format("  {:<13} {:>16} of {}\n", field_names[f], grouped(r.total.fields[f].differing),
                               grouped(r.total.fields[f].compared));
    out += fmt::format("\n  worst of frame {}\n", *r.first_frame);
    const std::string_view second = r.verdict == Verdict::nondeterministic ? "second run" : "GPU";
    const std::string_view first = r.verdict == Verdict::nondeterministic ? "first run" : "reference";
    for (const FrameDifference& d : r.worst)
        out += fmt::format("  {}: {} {}, {} {}, {}\n", place(d, run.width), first, value_text(d.difference.reference),
                           second, value_text(d.difference.gpu), ulp_text(d.difference.ulp));
    if (run.mode == "free" && r.verdict == Verdict::differ) {
        out += "\n  growth: frame, differing particles, differing texels, worst ULP\n";
        for (std::size_t i = 0; i < r.counts.size(); ++i)
            if (told(i, r.counts.size()))
                out += fmt::format("  {:>8} {:>12} {:>12} {:>16}\n", r.counts[i].frame, grouped(r.counts[i].particles),
                                   grouped(r.counts[i].texels), ulp_text(r.counts[i].worst_ulp));
    }
    out += fmt::format("\nrepeat    {}\n", run.repeat);
    return out;
}

namespace {

nlohmann::json shaders_json(const RunDescription& run) {
    nlohmann::json files = nlohmann::json::array();
    if (run.shaders)
        for (const UsedShader& used : run.shaders->files)
            files.push_back(
                {{"file", used.file},
                 {"foreign", used.foreign.empty() ? nlohmann::json() : nlohmann::json(used.foreign.string())},
                 {"same_as_shipped", used.foreign.empty() || used.same_as_shipped},
                 {"left_out", used.leaves_out}});
    return {{"text", shaders_line(run)}, {"files", files}};
}

nlohmann::json render_json(const RunDescription& run) {
    nlohmann::json json{{"text", render_line(run)}, {"compared", run.rendered.has_value()}};
    if (run.rendered)
        json.update(
            {{"frame", run.rendered->frame}, {"pixels", run.rendered->pixels}, {"differing", run.rendered->differing}});
    return json;
}

} // namespace

nlohmann::json report_json(const CheckReport& r, const RunDescription& run) {
    using nlohmann::json;
    const auto number = [](float value) -> json {
        return std::isfinite(value) ? json(value) : json(fmt::format("{}", value));
    };
    const FrameTimes seconds = total_times(r);
    json fields = json::object();
    for (std::size_t f = 0; f < field_names.size(); ++f)
        fields[std::string(field_names[f])] = {{"compared", r.total.fields[f].compared},
                                               {"differing", r.total.fields[f].differing},
                                               {"nan", r.total.fields[f].nan}};
    json worst = json::array();
    for (const FrameDifference& d : r.worst)
        worst.push_back({{"frame", d.frame},
                         {"field", field_names[static_cast<std::size_t>(d.difference.field)]},
                         {"index", d.difference.index},
                         {"component", d.difference.component},
                         {"reference", number(d.difference.reference)},
                         {"reference_hex", fmt::format("{:a}", d.difference.reference)},
                         {"gpu", number(d.difference.gpu)},
                         {"gpu_hex", fmt::format("{:a}", d.difference.gpu)},
                         {"ulp", d.difference.ulp}});
    json counts = json::array();
    for (const FrameCount& c : r.counts)
        counts.push_back({c.frame, c.particles, c.texels, c.worst_ulp});
    return {{"verdict", verdict_name(r.verdict)},
            {"verdict_line", verdict_line(r)},
            {"partial", r.partial()},
            {"judged", r.verdicts.has_value()},
            {"untried", r.untried},
            {"scene", run.scene},
            {"mode", run.mode},
            {"switches", run.settings},
            {"context", run.context},
            {"shaders", shaders_json(run)},
            {"render", render_json(run)},
            {"profile", run.profile},
            {"particles", r.particles},
            {"frames", r.frames},
            {"frames_asked", r.frames_asked},
            {"first_frame", r.first_frame ? json(*r.first_frame) : json()},
            {"differing_particles", r.total.differing_particles},
            {"differing_texels", r.total.differing_texels},
            {"hits", r.hits},
            {"drawn_texels", r.drawn_texels},
            {"fields", fields},
            {"worst", worst},
            {"counts", {{"columns", {"frame", "particles", "texels", "worst_ulp"}}, {"rows", counts}}},
            {"hash", {{"reference", hash_text(r.reference_hash)}, {"gpu", hash_text(r.gpu_hash)}}},
            {"seconds",
             {{"gpu", seconds.gpu},
              {"readback", seconds.readback},
              {"reference", seconds.reference},
              {"compare", seconds.compare},
              {"judge", seconds.judge}}},
            {"verdicts", r.verdicts ? verdict_json(*r.verdicts, run.width) : json()},
            {"repeat", run.repeat},
            {"notes", run.notes},
            {"explain", run.explain.empty() ? json() : json(run.explain)}};
}

} // namespace lockstep
