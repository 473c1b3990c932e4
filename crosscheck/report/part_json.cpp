#include "crosscheck/report/part_json.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lockstep {
namespace {

using nlohmann::json;

constexpr std::int64_t any_min = std::numeric_limits<std::int64_t>::min(), any_max = INT64_MAX;
constexpr std::int64_t most_frame = 1'000'000'000, most_extent = INT32_MAX;
constexpr std::size_t undefined_count = static_cast<std::size_t>(Undefined::undecided) + 1;

std::int64_t bits(std::uint64_t word) { return std::bit_cast<std::int64_t>(word); }
std::int64_t bits(double number) { return std::bit_cast<std::int64_t>(number); }
std::uint64_t word(const JsonValue& value) { return std::bit_cast<std::uint64_t>(value.integer(any_min, any_max)); }
double real(const JsonValue& value) { return std::bit_cast<double>(value.integer(any_min, any_max)); }
/// As many as still fit when all parts are added up.
std::uint64_t count(const JsonValue& value) { return static_cast<std::uint64_t>(value.integer(0, any_max >> 16)); }
int frame(const JsonValue& value) { return static_cast<int>(value.integer(0, most_frame)); }
bool truth(const JsonValue& value) { return value.integer(0, 1) == 1; }

/// An array of this many.
std::vector<JsonValue> row(const JsonValue& value, std::size_t size) {
    std::vector<JsonValue> items = value.items();
    if (items.size() != size)
        value.fail(fmt::format("has {} elements; right are {}", items.size(), size));
    return items;
}

std::uint8_t resource(const JsonValue& value, const Schema& schema) {
    return static_cast<std::uint8_t>(value.integer(0, static_cast<std::int64_t>(schema.resources.size()) - 1));
}

/// A name that outlives what is read: those of ties are views.
std::string_view lasting(const std::string& name) {
    static std::set<std::string> names;
    return *names.insert(name).first;
}

template <class Items, class Row> json rows(const Items& items, const Row& row) {
    json all = json::array();
    for (const auto& item : items)
        all.push_back(row(item));
    return all;
}

json place_row(const Place& place) { return {place.frame, place.resource, place.index}; }

Place read_place(const JsonValue& value, const Schema& schema) {
    const auto at = row(value, 3);
    return {frame(at[0]), resource(at[1], schema), static_cast<std::size_t>(count(at[2]))};
}

json difference_row(const Difference& d) {
    return {d.field.resource, d.field.field, d.index, d.component, d.reference.bits, d.gpu.bits, d.ulp};
}

Difference read_difference(const JsonValue& value, const Schema& schema) {
    const auto at = row(value, 7);
    Difference d;
    d.field.resource = resource(at[0], schema);
    d.field.field = static_cast<std::uint8_t>(
        at[1].integer(0, static_cast<std::int64_t>(schema.resources[d.field.resource].fields.size()) - 1));
    const Field& field = schema[d.field];
    d.index = static_cast<std::size_t>(count(at[2]));
    d.component = static_cast<int>(at[3].integer(0, field.components - 1));
    d.reference = {field.scalar, static_cast<std::uint32_t>(at[4].integer(0, UINT32_MAX))};
    d.gpu = {field.scalar, static_cast<std::uint32_t>(at[5].integer(0, UINT32_MAX))};
    d.ulp = at[6].integer(0, any_max);
    return d;
}

json total_json(const Comparison& total) {
    return rows(total.resources, [](const ResourceCount& r) {
        return json{{"extent", {r.extent.width, r.extent.height, r.extent.depth}},
                    {"differing", r.differing},
                    {"fields", rows(r.fields, [](const FieldCount& f) {
                         return json{f.compared, f.differing, f.nan};
                     })}};
    });
}

Comparison read_total(const JsonValue& value, const Schema& schema) {
    Comparison total;
    const auto all = value.items();
    if (all.empty() || all.size() > schema.resources.size())
        value.fail(fmt::format("has {} elements; right are 1 to {}", all.size(), schema.resources.size()));
    for (const JsonValue& one : all) {
        one.check_keys({"extent", "differing", "fields"});
        ResourceCount& r = total.resources.emplace_back();
        const auto extent = row(one.at("extent"), 3);
        const auto side = [&](std::size_t i) { return static_cast<std::size_t>(extent[i].integer(1, most_extent)); };
        r.extent = {side(0), side(1), side(2)};
        r.differing = count(one.at("differing"));
        for (const JsonValue& field :
             row(one.at("fields"), schema.resources[total.resources.size() - 1].fields.size())) {
            const auto counts = row(field, 3);
            r.fields.push_back({count(counts[0]), count(counts[1]), count(counts[2])});
        }
    }
    return total;
}

json texel_row(const std::optional<ChosenTexel>& texel) {
    if (!texel)
        return {};
    return {texel->x, texel->y, std::bit_cast<std::uint32_t>(texel->offer)};
}

std::optional<ChosenTexel> read_texel(const JsonValue& value) {
    if (value.is_null())
        return {};
    const auto at = row(value, 3);
    return ChosenTexel{static_cast<int>(at[0].integer(INT32_MIN, INT32_MAX)),
                       static_cast<int>(at[1].integer(INT32_MIN, INT32_MAX)),
                       std::bit_cast<float>(static_cast<std::uint32_t>(at[2].integer(0, UINT32_MAX)))};
}

json choice_json(const std::optional<ChoiceOfTexels>& choice) {
    if (!choice)
        return {};
    return {texel_row(choice->right), texel_row(choice->taken)};
}

std::optional<ChoiceOfTexels> read_choice(const JsonValue& value) {
    if (value.is_null())
        return {};
    const auto at = row(value, 2);
    return ChoiceOfTexels{read_texel(at[0]), read_texel(at[1])};
}

json first_json(const std::optional<FirstDivergence>& first) {
    if (!first)
        return {};
    return {{"place", place_row(first->place)},
            {"class", static_cast<int>(first->verdict.kind)},
            {"undefined", static_cast<int>(first->verdict.undefined)},
            {"step", first->wrong.step},
            {"operation", first->wrong.operation},
            {"gpu", first->wrong.gpu},
            {"where", first->wrong.where},
            {"choice", choice_json(first->wrong.choice)},
            {"margin", first->wrong.margin},
            {"difference", difference_row(first->wrong.difference)},
            {"pass", first->pass}};
}

std::optional<FirstDivergence> read_first(const JsonValue& value, const Schema& schema) {
    if (value.is_null())
        return {};
    value.check_keys(
        {"place", "class", "undefined", "step", "operation", "gpu", "where", "choice", "margin", "difference", "pass"});
    FirstDivergence first;
    first.place = read_place(value.at("place"), schema);
    first.verdict.index = first.place.index;
    first.verdict.kind = static_cast<DifferenceClass>(value.at("class").integer(0, class_names.size() - 1));
    first.verdict.undefined = static_cast<Undefined>(value.at("undefined").integer(0, undefined_count - 1));
    first.wrong = {value.at("step").text(),
                   value.at("operation").text(),
                   value.at("gpu").text(),
                   value.at("where").text(),
                   read_choice(value.at("choice")),
                   value.at("margin").text(),
                   read_difference(value.at("difference"), schema)};
    first.pass = static_cast<std::size_t>(value.at("pass").integer(0, 1000));
    return first;
}

json causes_json(const std::vector<CauseFindings>& causes) {
    return rows(causes, [](const CauseFindings& found) {
        return json{{"divergent", found.divergent}, {"best", rows(found.best, [](const Cause& cause) {
                                                         return json{{"mistakes", cause.mistakes},
                                                                     {"meaning", cause.meaning},
                                                                     {"explained", cause.explained},
                                                                     {"contradicted", cause.contradicted},
                                                                     {"has_name", cause.has_name ? 1 : 0}};
                                                     })}};
    });
}

std::vector<CauseFindings> read_causes(const JsonValue& value, const Schema& schema) {
    std::vector<CauseFindings> causes;
    for (const JsonValue& one : row(value, schema.resources.size())) {
        one.check_keys({"divergent", "best"});
        CauseFindings& found = causes.emplace_back();
        found.divergent = count(one.at("divergent"));
        for (const JsonValue& best : one.at("best").items()) {
            best.check_keys({"mistakes", "meaning", "explained", "contradicted", "has_name"});
            Cause cause{{},
                        best.at("meaning").text(),
                        count(best.at("explained")),
                        count(best.at("contradicted")),
                        truth(best.at("has_name"))};
            for (const JsonValue& mistake : best.at("mistakes").items())
                cause.mistakes.push_back(mistake.text());
            found.best.push_back(std::move(cause));
        }
    }
    return causes;
}

json lean_row(const Lean& lean) {
    const int flags = (lean.direction.x + 1) | (lean.direction.y + 1) << 2 | (lean.right_half ? 16 : 0) |
                      (lean.upper_half ? 32 : 0) | (lean.beyond_rounding ? 64 : 0);
    return {bits(lean.place), flags};
}

Lean read_lean(const JsonValue& value) {
    const auto at = row(value, 2);
    const auto flags = static_cast<int>(at[1].integer(0, 127));
    if ((flags & 3) == 3 || (flags >> 2 & 3) == 3)
        at[1].fail("points nowhere");
    return {
        {(flags & 3) - 1, (flags >> 2 & 3) - 1}, (flags & 16) != 0, (flags & 32) != 0, (flags & 64) != 0, word(at[0])};
}

json widths_json(const LegalWidths& widths) {
    if (!widths.widest())
        return {};
    const auto& [frame, index, floats] = *widths.widest();
    return {{"counts", rows(widths.counts(),
                            [](const auto& e) {
                                return json{e.first, e.second};
                            })},
            {"widest",
             {frame, index, floats.field.field, floats.component, bits(floats.set.low), bits(floats.set.high),
              floats.set.any ? 1 : 0}}};
}

LegalWidths read_widths(const JsonValue& value, const Schema& schema, std::uint8_t resource) {
    if (value.is_null())
        return {schema, resource};
    value.check_keys({"counts", "widest"});
    LegalWidths::Counts counts;
    for (const JsonValue& one : value.at("counts").items()) {
        const auto at = row(one, 2);
        counts[static_cast<int>(at[0].integer(INT32_MIN, INT32_MAX))] = count(at[1]);
    }
    const auto at = row(value.at("widest"), 7);
    const FieldId field{resource, static_cast<std::uint8_t>(at[2].integer(
                                      0, static_cast<std::int64_t>(schema.resources[resource].fields.size()) - 1))};
    Interval set(real(at[4]), real(at[5]));
    set.any = truth(at[6]);
    return {schema, resource, std::move(counts),
            LegalWidths::Widest{frame(at[0]),
                                static_cast<std::size_t>(count(at[1])),
                                {field, static_cast<int>(at[3].integer(0, schema[field].components - 1)), set}}};
}

json verdicts_json(const VerdictSummary& s) {
    return {{"classes", s.classes},
            {"set_sizes", rows(s.set_sizes,
                               [](const auto& e) {
                                   return json{e.first, e.second};
                               })},
            {"widths", rows(s.widths, widths_json)},
            {"ties", rows(s.ties,
                          [](const auto& e) {
                              const TieCount& tie = e.second;
                              return json{{"name", e.first.name},         {"unit", e.first.unit},
                                          {"count", tie.count},           {"smallest", bits(tie.smallest)},
                                          {"largest", bits(tie.largest)}, {"closest", place_row(tie.closest)}};
                          })},
            {"undefined", rows(s.undefined,
                               [](const auto& e) {
                                   return json{static_cast<int>(e.first), e.second};
                               })},
            {"leans", rows(s.leans.counted(), lean_row)},
            {"judges_leans", s.judges_leans ? 1 : 0},
            {"ties_beyond_rounding", s.ties_beyond_rounding},
            {"first_beyond_rounding", first_json(s.first_beyond_rounding)},
            {"first", first_json(s.first)},
            {"divergent_frames", s.divergent_frames},
            {"causes", causes_json(s.causes)}};
}

VerdictSummary read_verdicts(const JsonValue& value, const Schema& schema) {
    value.check_keys({"classes", "set_sizes", "widths", "ties", "undefined", "leans", "judges_leans",
                      "ties_beyond_rounding", "first_beyond_rounding", "first", "divergent_frames", "causes"});
    VerdictSummary s(schema);
    const auto classes = row(value.at("classes"), schema.resources.size());
    for (std::size_t r = 0; r < classes.size(); ++r) {
        const auto counts = row(classes[r], class_names.size());
        for (std::size_t kind = 0; kind < counts.size(); ++kind)
            s.classes[r][kind] = count(counts[kind]);
    }
    for (const JsonValue& size : value.at("set_sizes").items()) {
        const auto at = row(size, 2);
        s.set_sizes[static_cast<std::size_t>(count(at[0]))] = count(at[1]);
    }
    const auto widths = row(value.at("widths"), schema.resources.size());
    for (std::size_t r = 0; r < widths.size(); ++r)
        s.widths[r] = read_widths(widths[r], schema, static_cast<std::uint8_t>(r));
    for (const JsonValue& tie : value.at("ties").items()) {
        tie.check_keys({"name", "unit", "count", "smallest", "largest", "closest"});
        s.ties[{lasting(tie.at("name").text()), lasting(tie.at("unit").text())}] = {
            count(tie.at("count")), real(tie.at("smallest")), real(tie.at("largest")),
            read_place(tie.at("closest"), schema)};
    }
    for (const JsonValue& undefined : value.at("undefined").items()) {
        const auto at = row(undefined, 2);
        s.undefined[static_cast<Undefined>(at[0].integer(0, undefined_count - 1))] = count(at[1]);
    }
    for (const JsonValue& lean : value.at("leans").items())
        s.leans.add(read_lean(lean));
    s.judges_leans = truth(value.at("judges_leans"));
    s.ties_beyond_rounding = count(value.at("ties_beyond_rounding"));
    s.first_beyond_rounding = read_first(value.at("first_beyond_rounding"), schema);
    s.first = read_first(value.at("first"), schema);
    for (const JsonValue& divergent : value.at("divergent_frames").items())
        s.divergent_frames.push_back(frame(divergent));
    s.causes = read_causes(value.at("causes"), schema);
    return s;
}

json power_part_json(const PowerSummary& power) {
    return {{"mistakes", rows(power.mistakes,
                              [](const PowerSummary::Mistake& m) {
                                  return json{{"name", m.name},
                                              {"meaning", m.meaning},
                                              {"pass", m.pass},
                                              {"first_frame", m.first_frame ? json(*m.first_frame) : json()},
                                              {"changes", m.changes ? 1 : 0},
                                              {"reasons", m.reasons},
                                              {"refutes", m.refutes ? 1 : 0}};
                              })},
            {"situations", rows(power.situations, [](const PowerSummary::Situation& s) {
                 return json{{"name", s.name}, {"count", s.count}};
             })}};
}

PowerSummary read_power(const JsonValue& value) {
    value.check_keys({"mistakes", "situations"});
    PowerSummary power;
    for (const JsonValue& one : value.at("mistakes").items()) {
        one.check_keys({"name", "meaning", "pass", "first_frame", "changes", "reasons", "refutes"});
        PowerSummary::Mistake& mistake = power.mistakes.emplace_back();
        mistake.name = one.at("name").text();
        mistake.meaning = one.at("meaning").text();
        mistake.pass = one.at("pass").text();
        if (!one.at("first_frame").is_null())
            mistake.first_frame = frame(one.at("first_frame"));
        mistake.changes = truth(one.at("changes"));
        for (const JsonValue& reason : one.at("reasons").items())
            mistake.reasons.push_back(reason.text());
        mistake.refutes = truth(one.at("refutes"));
    }
    for (const JsonValue& one : value.at("situations").items()) {
        one.check_keys({"name", "count"});
        power.situations.push_back({one.at("name").text(), count(one.at("count"))});
    }
    return power;
}

} // namespace

json part_json(const CheckReport& r) {
    return {{"first", r.first},
            {"frames", r.frames},
            {"frames_asked", r.frames_asked},
            {"particles", r.particles},
            {"total", total_json(r.total)},
            {"first_frame", r.first_frame ? json(*r.first_frame) : json()},
            {"worst", rows(r.worst,
                           [](const FrameDifference& d) {
                               return json{d.frame, difference_row(d.difference)};
                           })},
            {"counts", rows(r.counts,
                            [](const FrameCount& c) {
                                return json{c.frame, c.items, c.worst_ulp};
                            })},
            {"power", power_part_json(r.power)},
            {"wider_rule", r.wider_rule ? json(static_cast<int>(*r.wider_rule)) : json()},
            {"verdicts", verdicts_json(*r.verdicts)},
            {"expects_texels", r.expects_texels ? 1 : 0},
            {"hits", r.hits},
            {"drawn_texels", r.drawn_texels},
            {"hashes", {bits(r.reference_hash), bits(r.gpu_hash)}}};
}

CheckReport read_part(const JsonValue& value, const Schema& schema) {
    value.check_keys({"first", "frames", "frames_asked", "particles", "total", "first_frame", "worst", "counts",
                      "power", "wider_rule", "verdicts", "expects_texels", "hits", "drawn_texels", "hashes"});
    CheckReport r;
    r.schema = schema;
    r.counts_hits = true;
    r.first = frame(value.at("first"));
    r.frames = static_cast<int>(value.at("frames").integer(1, most_frame));
    r.frames_asked = static_cast<int>(value.at("frames_asked").integer(r.frames, most_frame));
    r.particles = static_cast<std::size_t>(value.at("particles").integer(1, UINT32_MAX));
    r.total = read_total(value.at("total"), schema);
    if (!value.at("first_frame").is_null())
        r.first_frame = frame(value.at("first_frame"));
    for (const JsonValue& one : value.at("worst").items()) {
        const auto at = row(one, 2);
        r.worst.push_back({frame(at[0]), read_difference(at[1], schema)});
    }
    for (const JsonValue& one : value.at("counts").items()) {
        const auto at = row(one, 3);
        FrameCount& counts = r.counts.emplace_back();
        counts.frame = frame(at[0]);
        for (const JsonValue& items : row(at[1], schema.resources.size()))
            counts.items.push_back(count(items));
        counts.worst_ulp = at[2].integer(0, any_max);
    }
    r.power = read_power(value.at("power"));
    if (!value.at("wider_rule").is_null())
        r.wider_rule = static_cast<Legal>(value.at("wider_rule").integer(0, static_cast<int>(Legal::any_order)));
    r.verdicts = read_verdicts(value.at("verdicts"), schema);
    r.expects_texels = truth(value.at("expects_texels"));
    r.hits = count(value.at("hits"));
    r.drawn_texels = count(value.at("drawn_texels"));
    const auto hashes = row(value.at("hashes"), 2);
    r.reference_hash = word(hashes[0]);
    r.gpu_hash = word(hashes[1]);
    const VerdictSummary& verdicts = *r.verdicts;
    const bool is_open = verdicts.total(DifferenceClass::divergent) + verdicts.total(DifferenceClass::undefined) > 0;
    if (r.total.agree() == r.first_frame.has_value() || is_open != verdicts.first.has_value() ||
        (verdicts.total(DifferenceClass::divergent) == 0) != verdicts.divergent_frames.empty() ||
        (verdicts.judges_leans && verdicts.ties_beyond_rounding > 0 && !verdicts.first_beyond_rounding))
        value.fail("its counts contradict what it says came first");
    int later = r.first;
    for (const int divergent : verdicts.divergent_frames) {
        if (divergent < later || divergent >= r.first + r.frames)
            value.fail(fmt::format("frame {} diverges out of its order, or is not of the part", divergent));
        later = divergent + 1;
    }
    for (const FrameDifference& worst : r.worst)
        if (worst.difference.field.resource >= r.total.resources.size())
            value.fail("something differs that was not compared");
    return r;
}

} // namespace lockstep
