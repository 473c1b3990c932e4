#include "crosscheck/report/verdict_text.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "crosscheck/report/value_text.hpp"

namespace lockstep {
namespace {

std::string line(std::string_view key, std::string_view text) { return fmt::format("{:<10}{}\n", key, text); }

/// What the words of verdicts are about.
struct Shape {
    const Schema& schema;
    std::span<const Extent> extents;

    [[nodiscard]] Extent extent(std::size_t resource) const {
        return resource < extents.size() ? extents[resource] : Extent();
    }
};

std::string place_text(const Place& place, const Shape& shape) {
    return fmt::format("frame {} {}", place.frame,
                       item_name(shape.schema.resources[place.resource], shape.extent(place.resource), place.index));
}

std::string classes_text(const std::array<std::uint64_t, class_names.size()>& counts) {
    std::string text;
    for (std::size_t k = 0; k < counts.size(); ++k)
        if (counts[k] > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(counts[k]), class_names[k]);
    return text.empty() ? "none" : text;
}

/// The names of those that explain as much as the first: ", or as well by b, c, or by 4 more".
std::string equals_text(const CauseFindings& found) {
    constexpr std::size_t most_named = 3;
    std::string text;
    for (std::size_t i = 1; i < std::min(found.best.size(), most_named); ++i)
        text += fmt::format(", or as well by {}", found.best[i].name());
    if (found.best.size() > most_named)
        text += fmt::format(", or by {} more", found.best.size() - most_named);
    return text;
}

/// What explains everything, and nothing contradicts. Changes without a name are told where the data leave few of them
/// over: many changes explain a few particles alone.
bool is_told(const CauseFindings& found) {
    constexpr std::size_t enough_items = 8, few_changes = 6;
    return found.explains_all() &&
           (found.best.front().has_name || (found.divergent >= enough_items && found.best.size() <= few_changes));
}

/// "particles", or, where a sample of those that diverge was tried, "particles that were tried".
std::string tried_text(const VerdictSummary& s, const Schema& schema, std::size_t resource) {
    const std::uint64_t all = s.classes[resource][static_cast<std::size_t>(DifferenceClass::divergent)];
    return schema.resources[resource].item + (s.causes[resource].divergent < all ? "s that were tried" : "s");
}

/// "all 12 particles are explained by".
std::string all_explained_text(const CauseFindings& found, std::string_view what) {
    return found.divergent == 1 ? fmt::format("the one that diverges of the {} is explained by", what)
                                : fmt::format("all {} {} are explained by", grouped(found.divergent), what);
}

std::string cause_text(const CauseFindings& found, std::string_view what) {
    if (!is_told(found))
        return fmt::format("no mistake with a name explains what diverges in the {}", what);
    const Cause& best = found.best.front();
    if (!best.has_name)
        return fmt::format("no mistake with a name; {} a change at one site of the twin, {}{}",
                           all_explained_text(found, what), best.name(), equals_text(found));
    std::string text = fmt::format("{} {}: {}", all_explained_text(found, what), best.name(), best.meaning);
    if (best.name() != "never_collides")
        return text + equals_text(found);
    return found.best.size() == 1
               ? text
               : text + (found.best.size() == 2
                             ? std::string("; 1 other mistake has the same end here")
                             : fmt::format("; {} other mistakes have the same end here", found.best.size() - 1));
}

/// What explains a part that is worth a look, and nothing contradicts; else nothing.
std::string closest_text(const CauseFindings& found, std::string_view what) {
    if (is_told(found) || found.best.empty())
        return "";
    const Cause& best = found.best.front();
    if (best.contradicted > 0 || 10 * best.explained < found.divergent || !best.has_name || best.mistakes.size() > 1)
        return "";
    return fmt::format("{} of {} {} are explained by {}: {}{}", grouped(best.explained), grouped(found.divergent), what,
                       best.name(), best.meaning, equals_text(found));
}

std::string first_text(const FirstDivergence& first, const Shape& shape) {
    const WrongStep& wrong = first.wrong;
    std::string text =
        line("first", fmt::format("{}, {}, step {}", place_text(first.place, shape),
                                  class_names[static_cast<std::size_t>(first.verdict.kind)], wrong.step));
    if (first.verdict.undefined != Undefined::none)
        text += line("", fmt::format("left open by GL: {}", undefined_name(first.verdict.undefined)));
    text += line("", wrong_step_text(wrong));
    text += line("", fmt::format("{}{}{}", difference_text(shape.schema, wrong.difference),
                                 wrong.margin.empty() ? "" : "; ", wrong.margin));
    return text;
}

/// The name of a shift: of one that ties convict, or of what all points and sides beyond rounding have in common.
/// Nothing where a mistake explains what was drawn.
std::string shift_name(const VerdictSummary& s) {
    if (std::any_of(s.causes.begin() + (s.causes.empty() ? 0 : 1), s.causes.end(), is_told))
        return "";
    if (const std::string name = s.convicted_shift(); !name.empty())
        return name;
    return s.total(DifferenceClass::divergent) == 0
               ? ""
               : s.leans.shift([&](Leans::Direction d) { return s.leans.all_this_way(d); });
}

std::string width_text(double width, const std::string& unit) {
    if (width == HUGE_VAL)
        return "anything";
    return fmt::format("{:.3g}{}{}", width, unit.empty() ? "" : " ", unit);
}

/// The place of the widest set. Its resource is the field's.
Place place_of(const LegalWidths::Widest& widest) { return {widest.frame, widest.floats.field.resource, widest.index}; }

/// "the normals: 1.2e-07 for half of the pixels that differ, 0.0041 at most: normal.x 0.9 to 0.9041, frame 0 pixel (3,
/// 4)".
std::string leeway_text(const LegalWidths& widths, const Shape& shape) {
    const LegalFloats& floats = widths.widest()->floats;
    const Resource& about = shape.schema.resources[floats.field.resource];
    const Field& field = shape.schema[floats.field];
    return fmt::format("{}: {} for half of the {}s that differ, {} at most: {} {}, {}", about.title,
                       width_text(widths.half(), about.fields.size() == 1 ? field.unit : ""), about.item,
                       width_text(floats.width(), field.unit), component_name(field, floats.component),
                       legal_text(floats.set, Scalar::float32), place_text(place_of(*widths.widest()), shape));
}

/// "7 left, 305 right, 1 down, 0 up".
template <class Count> std::string directions_text(const Count& count) {
    std::string text;
    for (const auto d : {Leans::left, Leans::right, Leans::down, Leans::up})
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count(d)), Leans::names[d]);
    return text;
}

std::string lean_text(const VerdictSummary& s) {
    const auto beyond = [&](Leans::Direction d) { return s.leans.beyond_rounding(d); };
    std::string text = directions_text([&](Leans::Direction d) { return s.leans.count(d); });
    text += "; further than rounding: ";
    text += beyond(Leans::left) + beyond(Leans::right) + beyond(Leans::down) + beyond(Leans::up) == 0
                ? "none"
                : directions_text(beyond);
    return line("lean", "into the pixel beside: " + text);
}

nlohmann::json lean_json(const VerdictSummary& s) {
    nlohmann::json all = nlohmann::json::object(), beyond = nlohmann::json::object();
    for (const auto d : {Leans::left, Leans::right, Leans::down, Leans::up}) {
        all[std::string(Leans::names[d])] = s.leans.count(d);
        beyond[std::string(Leans::names[d])] = s.leans.beyond_rounding(d);
    }
    return {{"into_the_pixel_beside", all}, {"beyond_rounding", beyond}, {"shift", shift_name(s)}};
}

nlohmann::json place_json(const Place& place, const Shape& shape) {
    const Resource& resource = shape.schema.resources[place.resource];
    nlohmann::json item =
        nlohmann::json::parse(fmt::format("[{}]", item_argument(resource, shape.extent(place.resource), place.index)));
    return {{"frame", place.frame}, {item_key(shape.schema, place.resource), item.size() == 1 ? item[0] : item}};
}

nlohmann::json width_json(double width) {
    return width < HUGE_VAL ? nlohmann::json(width) : nlohmann::json("anything");
}

nlohmann::json leeway_json(const LegalWidths& widths, const Shape& shape) {
    if (!widths.widest())
        return nullptr;
    const LegalFloats& floats = widths.widest()->floats;
    return {{"half_at_most", width_json(widths.half())},
            {"widest", width_json(floats.width())},
            {"field", shape.schema[floats.field].name},
            {"component", floats.component},
            {"place", place_json(place_of(*widths.widest()), shape)}};
}

nlohmann::json cause_json(const CauseFindings& found) {
    nlohmann::json best = nlohmann::json::array();
    for (const Cause& cause : found.best) {
        best.push_back({{"deviations", cause.mistakes},
                        {"meaning", cause.meaning},
                        {"explained", cause.explained},
                        {"contradicted", cause.contradicted},
                        {"named", cause.has_name}});
    }
    return {{"divergent", found.divergent},
            {"explains_all", found.explains_all()},
            {"told", is_told(found)},
            {"best", best}};
}

nlohmann::json counts_json(const std::array<std::uint64_t, class_names.size()>& counts) {
    nlohmann::json json = nlohmann::json::object();
    for (std::size_t k = 0; k < counts.size(); ++k)
        json[std::string(class_names[k])] = counts[k];
    return json;
}

} // namespace

bool tells_cause(const VerdictSummary& s) { return std::any_of(s.causes.begin(), s.causes.end(), is_told); }

bool names_cause(const VerdictSummary& s) {
    return std::any_of(s.causes.begin(), s.causes.end(),
                       [](const CauseFindings& found) { return is_told(found) && found.best.front().has_name; });
}

std::string wrong_step_text(const WrongStep& wrong) {
    return fmt::format("{}{}{}{}", wrong.operation, wrong.gpu.empty() ? "" : "; the GPU ", wrong.gpu,
                       wrong.where.empty() ? "" : fmt::format(" ({})", wrong.where));
}

std::string grouped(std::uint64_t value) {
    std::string digits = std::to_string(value);
    for (auto i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > 0; i -= 3)
        digits.insert(static_cast<std::size_t>(i), 1, ',');
    return digits;
}

std::string verdict_text(const VerdictSummary& s, const Schema& schema, std::span<const Extent> extents) {
    const Shape shape{schema, extents};
    // Of many buffers and images those that differ, by title.
    const bool many = s.classes.size() > 2;
    std::string classes;
    for (std::size_t r = 0; r < s.classes.size(); ++r)
        if (const std::string kinds = classes_text(s.classes[r]); !many || kinds != "none")
            classes += fmt::format("{}{}: {}", classes.empty() ? "" : "; ",
                                   many ? schema.resources[r].title : schema.resources[r].item + "s", kinds);
    std::string text = line("classes", classes.empty() ? "none" : classes);
    if (!s.set_sizes.empty())
        text += line("outcomes", fmt::format("legal ones: median {}, largest {}", s.median_set_size(),
                                             s.set_sizes.rbegin()->first));
    for (const LegalWidths& widths : s.widths)
        if (widths.widest())
            text += line("leeway", leeway_text(widths, shape));
    for (const auto& [kind, tie] : s.ties)
        text +=
            line("ties", fmt::format("{}: {}, margins {:.3g} to {:.3g} {}; closest {}", kind.name, grouped(tie.count),
                                     tie.smallest, tie.largest, kind.unit, place_text(tie.closest, shape)));
    if (s.leans.any())
        text += lean_text(s);
    if (const std::string name = shift_name(s); !name.empty())
        text += line("shift", fmt::format("{}: {}", name,
                                          s.convicted_shift().empty()
                                              ? "what lies further than rounding goes this way alone"
                                              : "in both halves of the image, where a fair coin would do it with less "
                                                "than 2^-64"));
    for (const auto& [reason, count] : s.undefined)
        text += line("undefined", fmt::format("{}: {}", undefined_name(reason), grouped(count)));
    for (std::size_t r = 0; r < s.causes.size(); ++r)
        if (s.causes[r].divergent > 0)
            text += line("cause", cause_text(s.causes[r], tried_text(s, schema, r)));
    if (s.first)
        text += first_text(*s.first, shape);
    for (std::size_t r = 0; r < s.causes.size(); ++r)
        if (const std::string closest = closest_text(s.causes[r], tried_text(s, schema, r)); !closest.empty())
            text += line("closest", closest);
    return text;
}

nlohmann::json verdict_json(const VerdictSummary& s, const Schema& schema, std::span<const Extent> extents) {
    const Shape shape{schema, extents};
    using nlohmann::json;
    json ties = json::object();
    for (const auto& [kind, tie] : s.ties)
        ties[std::string(kind.name)] = {{"count", tie.count},
                                        {"smallest_margin", tie.smallest},
                                        {"largest_margin", tie.largest},
                                        {"unit", kind.unit},
                                        {"closest", place_json(tie.closest, shape)}};
    json undefined = json::object();
    for (const auto& [reason, count] : s.undefined)
        undefined[std::string(undefined_name(reason))] = count;
    json first;
    if (s.first) {
        const WrongStep& wrong = s.first->wrong;
        first = {{"place", place_json(s.first->place, shape)},
                 {"class", class_names[static_cast<std::size_t>(s.first->verdict.kind)]},
                 {"step", wrong.step},
                 {"operation", wrong.operation},
                 {"gpu_did", wrong.gpu},
                 {"where", wrong.where},
                 {"margin", wrong.margin},
                 {"field", schema[wrong.difference.field].name},
                 {"component", wrong.difference.component},
                 {"reference", decimal_text(wrong.difference.reference)},
                 {"gpu", decimal_text(wrong.difference.gpu)},
                 {"reference_hex", exact_text(wrong.difference.reference)},
                 {"gpu_hex", exact_text(wrong.difference.gpu)}};
    }
    json verdicts{
        {"set_size",
         {{"median", s.median_set_size()}, {"largest", s.set_sizes.empty() ? 0 : s.set_sizes.rbegin()->first}}},
        {"ties", ties},
        {"undefined", undefined},
        {"lean", lean_json(s)},
        {"first", first}};
    for (std::size_t r = 0; r < s.classes.size(); ++r) {
        const std::string key = item_key(schema, static_cast<std::uint8_t>(r));
        verdicts[key + "s"] = counts_json(s.classes[r]);
        verdicts[key + "_cause"] = cause_json(s.causes[r]);
        verdicts[key + "_leeway"] = leeway_json(s.widths[r], shape);
    }
    return verdicts;
}

} // namespace lockstep
