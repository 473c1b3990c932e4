#include "crosscheck/collision/report/pixel_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/report/row_text.hpp"
#include "crosscheck/report/verdict_text.hpp"

namespace lockstep {
namespace {

std::array<int, 4> channels(Rgba8 c) { return {c.r, c.g, c.b, c.a}; }

/// Codes between a colour and the nearest legal one, of the channel that is farthest.
int codes_apart(const PixelCandidate& candidate, Rgba8 color) {
    const auto low = channels(candidate.low), high = channels(candidate.high), at = channels(color);
    int most = 0;
    for (std::size_t c = 0; c < at.size(); ++c)
        most = std::max({most, low[c] - at[c], at[c] - high[c]});
    return most;
}

/// "red 32, legal 64 to 65".
std::string wrong_channels(const PixelCandidate& candidate, Rgba8 color) {
    constexpr std::array<std::string_view, 4> names{"red", "green", "blue", "alpha"};
    const auto low = channels(candidate.low), high = channels(candidate.high), at = channels(color);
    std::string text;
    for (std::size_t c = 0; c < at.size(); ++c)
        if (at[c] < low[c] || at[c] > high[c])
            text +=
                fmt::format("{}{} {}, legal {}", text.empty() ? "" : "; ", names[c], at[c],
                            low[c] == high[c] ? fmt::format("{}", low[c]) : fmt::format("{} to {}", low[c], high[c]));
    return text;
}

std::string colors_text(const PixelCandidate& candidate) {
    return candidate.low == candidate.high
               ? color_text(candidate.low)
               : fmt::format("{} to {}", color_text(candidate.low), color_text(candidate.high));
}

std::string depth_text(const Interval& depth, NumberFormat format) {
    if (depth.any)
        return "depth any, ";
    if (std::isnan(depth.low))
        return "";
    const std::string low = number_text(static_cast<float>(depth.low), format);
    const std::string high = number_text(static_cast<float>(depth.high), format);
    return low == high ? fmt::format("depth {}, ", low) : fmt::format("depth {} to {}, ", low, high);
}

/// Those drawn here whose colour the GPU's may be: of what may be seen, or of what is hidden.
std::vector<std::string> owners_like(const PixelTable& table, bool hidden) {
    std::vector<std::string> owners;
    for (const DrawnHere& here : table.drawn)
        if (here.fragment.hidden_by.has_value() == hidden && here.fragment.candidate.may_be(table.gpu))
            owners.push_back(owner_text(here.fragment.candidate.owner));
    return owners;
}

/// Who the GPU shows, as far as its colour says.
std::string gpu_owner(const PixelTable& table) {
    if (const auto seen = owners_like(table, false); !seen.empty())
        return fmt::format("as of {}", fmt::join(seen, " or "));
    const DrawnHere* nearest = nullptr;
    for (const DrawnHere& here : table.drawn) {
        const PixelCandidate& candidate = here.fragment.candidate;
        if (here.fragment.hidden_by && candidate.may_be(table.gpu))
            return fmt::format("as of {}, which {} hides", owner_text(candidate.owner),
                               owner_text(*here.fragment.hidden_by));
        if (!here.fragment.hidden_by && (nearest == nullptr || codes_apart(candidate, table.gpu) <
                                                                   codes_apart(nearest->fragment.candidate, table.gpu)))
            nearest = &here;
    }
    return nearest == nullptr ? std::string()
                              : fmt::format("of nothing that is drawn there; nearest {}, but for {}",
                                            owner_text(nearest->fragment.candidate.owner),
                                            wrong_channels(nearest->fragment.candidate, table.gpu));
}

std::string place_of(const PixelTable& table) {
    const auto width = static_cast<std::size_t>(table.width);
    return fmt::format("({}, {})", table.pixel % width, table.pixel / width);
}

std::string verdict_of(const PixelTable& table) {
    if (!table.kind)
        return "every bit agrees";
    std::string text(class_names[static_cast<std::size_t>(*table.kind)]);
    if (*table.kind == DifferenceClass::undefined)
        for (const DrawnHere& here : table.drawn)
            if (!here.fragment.hidden_by && here.fragment.candidate.open)
                return text +
                       fmt::format(": {} rests on what GL leaves open", owner_text(here.fragment.candidate.owner));
    if (*table.kind != DifferenceClass::tie)
        return text;
    for (const DrawnHere& here : table.drawn)
        if (!here.fragment.hidden_by && !here.fragment.candidate.sure)
            return text + fmt::format(": a side or rim of {} is {:.3g}/256 pixel from the pixel's centre",
                                      owner_text(here.fragment.candidate.owner), here.fragment.candidate.edge_margin);
    return text + ": of depths that rounding may swap";
}

std::string drawn_text(const DrawnHere& here, const PixelTable& table, NumberFormat format) {
    const PixelCandidate& candidate = here.fragment.candidate;
    std::string seen = "may be seen";
    if (here.fragment.hidden_by)
        seen = fmt::format("hidden by {}", owner_text(*here.fragment.hidden_by));
    else if (candidate.owner == table.owner)
        seen = "seen";
    if (candidate.open)
        seen += ", on what GL leaves open";
    std::string text = fmt::format("    {:<28} {:<22} {}{}\n", owner_text(candidate.owner), colors_text(candidate),
                                   depth_text(candidate.depth, format), seen);
    if (!candidate.sure)
        text += fmt::format("      drawn here or not: its side or rim is {:.3g}/256 pixel from the pixel's centre\n",
                            candidate.edge_margin);
    if (!here.square)
        return text;
    const glm::vec2 centre = here.square->centre, half = here.square->half;
    const auto columns = static_cast<std::size_t>(table.width);
    const float x = (static_cast<float>(table.pixel % columns) + 0.5F - centre.x) / half.x;
    const float y = (static_cast<float>(table.pixel / columns) + 0.5F - centre.y) / half.y;
    return text + fmt::format("      its square: window ({}, {}), half sides {} and {}; the pixel's centre is ({:.3g}, "
                              "{:.3g}) of them from there\n",
                              number_text(centre.x, format), number_text(centre.y, format), number_text(half.x, format),
                              number_text(half.y, format), x, y);
}

std::string near_text(const PixelTable& table) {
    std::string text;
    for (const NearDisc& disc : table.near)
        text += fmt::format("{}particle {} ({})", text.empty() ? "" : ", ", disc.particle,
                            disc.apart > 0.0 ? fmt::format("{:.3g} pixels from its rim", disc.apart)
                                             : std::string("inside its rim"));
    return text.empty() ? "  no other particle is drawn into the frame\n" : "  beside it: " + text + "\n";
}

std::string causes_text(const PixelTable& table) {
    if (table.divergent == 0)
        return "";
    std::string text = fmt::format("frame     {} of its pixels are divergent\n", grouped(table.divergent));
    if (table.causes.empty())
        return text + "cause     no named mistake explains the whole frame\n";
    for (std::size_t i = 0; i < table.causes.size(); ++i) {
        const MistakenPixel& m = table.causes[i];
        text += fmt::format("{:<10}{}: {}; here it shows {}, {}{}\n", i == 0 ? "cause" : "or", m.cause.name,
                            m.cause.meaning, color_text(m.color), owner_text(m.owner),
                            m.color == table.gpu ? ", as the GPU does" : "");
    }
    return text;
}

} // namespace

std::string pixel_text(const PixelTable& table, NumberFormat format) {
    std::string text =
        fmt::format("pixel {} in frame {}: {}\n  reference  {}, {}\n  GPU        {}, {}\n", place_of(table),
                    table.frame, verdict_of(table), color_text(table.reference), owner_text(table.owner),
                    color_text(table.gpu), table.kind ? gpu_owner(table) : owner_text(table.owner));
    text += "\n  drawn there, the nearest first\n";
    for (const DrawnHere& here : table.drawn)
        text += drawn_text(here, table, format);
    text += near_text(table);
    const std::string causes = causes_text(table);
    return causes.empty() ? text : text + "\n" + causes;
}

JudgedPicture::JudgedPicture(const FrameRun& run, ColorImage gpu)
    : frame_(run.judged()), earlier_params_(frame_params(run.scene(), std::max(run.frame() - 1, 0))),
      gpu_(std::move(gpu)), verdict_(judge_render(inputs(), frame_.profile, frame_.known, gpu_)) {
    verdict_.frame = run.frame();
}

RenderInputs JudgedPicture::inputs() const {
    return {frame_.gpu, frame_.obstacles, frame_.params, &frame_.before, &earlier_params_};
}

PixelTable JudgedPicture::table(std::size_t pixel) const {
    return pixel_table(inputs(), frame_.profile, frame_.known, pixel, gpu_.texels[pixel], verdict_);
}

} // namespace lockstep
