#include "crosscheck/report/page/system_page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "crosscheck/judge/pass_names.hpp"
#include "crosscheck/report/item_text.hpp"
#include "crosscheck/report/page/rows_json.hpp"
#include "crosscheck/report/value_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

/// Beside the classes, as crosscheck/report_page/src/picture.js has them.
constexpr std::size_t page_unjudged = class_names.size(), page_same = class_names.size() + 1;

json ulp_json(std::int64_t ulp) { return ulp == INT64_MAX ? json() : json(ulp); }

/// Of each field its name and the components' values.
json state_json(const View& state, std::size_t item) {
    json fields = json::array();
    for (std::size_t f = 0; f < state.fields().size(); ++f) {
        json values = json::array();
        for (int c = 0; c < state.fields()[f].components; ++c)
            values.push_back(number_json(state.value(f, item, c)));
        fields.push_back({{"name", state.fields()[f].name}, {"values", values}});
    }
    return fields;
}

/// Any NaN is as any other.
bool same_value(Value a, Value b) {
    return a.bits == b.bits || (a.scalar == Scalar::float32 && std::isnan(a.real()) && std::isnan(b.real()));
}

/// Both sides of an item, value by value.
json values_json(const JudgedPass& judged, std::size_t item) {
    json values = json::array();
    for (const Component& c : components(judged.gpu.about())) {
        const Value reference = judged.reference.value(c.field, item, c.component);
        const Value gpu = judged.gpu.value(c.field, item, c.component);
        values.push_back({{"name", component_name(judged.gpu.fields()[c.field], c.component)},
                          {"reference", number_json(reference)},
                          {"gpu", number_json(gpu)},
                          {"same", same_value(reference, gpu)}});
    }
    return values;
}

/// The items that differ, with their classes.
std::vector<std::pair<std::size_t, std::size_t>> differing(const CheckedPass& checked) {
    std::vector<std::pair<std::size_t, std::size_t>> items;
    for (const ItemVerdict& verdict : checked.verdicts)
        items.emplace_back(verdict.index, static_cast<std::size_t>(verdict.kind));
    if (items.empty())
        for (const std::size_t item : differing_items(checked.judged.reference, checked.judged.gpu))
            items.emplace_back(item, page_unjudged);
    return items;
}

} // namespace

void SystemPage::add(const CheckedPass& checked) {
    const JudgedPass& judged = checked.judged;
    const std::uint8_t resource = judged.pass.resource();
    Total& total = totals_[checked.pass];
    ++total.frames;
    total.compared += judged.gpu.count();
    if (checked.comparison.differing(resource) == 0) {
        if (judged.frame + 1 == frames_ &&
            std::all_of(totals_.begin(), totals_.end(), [](const auto& of) { return of.second.differing == 0; }))
            note_examples(checked);
        return;
    }
    const auto items = differing(checked);
    Counts classes{};
    for (const auto& [index, kind] : items)
        ++classes[kind];
    const std::int64_t worst = checked.comparison.worst.empty() ? 0 : checked.comparison.worst.front().ulp;
    total.differing += items.size();
    for (std::size_t k = 0; k < classes.size(); ++k)
        total.classes[k] += classes[k];
    total.worst_ulp = std::max(total.worst_ulp, worst);
    if (total.first_frame < 0)
        total.first_frame = judged.frame;
    if (rows_.size() < counted_rows)
        rows_.push_back({judged.frame, checked.pass, items.size(), classes, ulp_json(worst)});
    else if (left_out_from_ < 0)
        left_out_from_ = judged.frame;
    note_items(checked);
}

void SystemPage::note_items(const CheckedPass& checked) {
    const JudgedPass& judged = checked.judged;
    const auto items = differing(checked);
    std::vector<std::pair<std::size_t, std::size_t>> worst_first = items;
    std::stable_sort(worst_first.begin(), worst_first.end(), [](auto a, auto b) { return a.second > b.second; });
    if (!checked.verdicts.empty())
        for (const auto& [index, kind] : worst_first) {
            std::size_t& count = kept_[{checked.pass, kind}];
            if (items_.size() < most_items && count++ < items_of_class)
                keep(checked, index, kind);
        }
    if (details_.size() >= detailed)
        return;
    json detail{{"frame", judged.frame}, {"pass", checked.pass}, {"more", 0}, {"items", json::array()}};
    for (std::size_t i = 0; i < std::min(worst_first.size(), items_told); ++i) {
        const auto& [index, kind] = worst_first[i];
        detail["items"].push_back({{"name", item_name(judged.gpu.about(), judged.gpu.extent, index)},
                                   {"class", kind},
                                   {"values", values_json(judged, index)}});
    }
    detail["more"] = worst_first.size() - detail["items"].size();
    if (judged.gpu.about().dimensions > 1) {
        json texels = json::array(), classes = json::array();
        for (std::size_t i = 0; i < std::min(items.size(), texels_told); ++i) {
            texels.push_back(items[i].first);
            classes.push_back(items[i].second);
        }
        detail["texels"] = std::move(texels);
        detail["classes"] = std::move(classes);
    }
    details_.push_back(std::move(detail));
}

void SystemPage::note_examples(const CheckedPass& checked) {
    const JudgedPass& judged = checked.judged;
    const View& before = judged.before[judged.pass.resource()];
    std::vector<std::size_t> changed = differing_items(before, judged.reference);
    const std::size_t each = std::max<std::size_t>(1, examples / system_.passes.size());
    for (std::size_t i = 0; i < std::min(changed.size(), each); ++i)
        if (std::count_if(items_.begin(), items_.end(), [](const Item& item) { return item.kind == page_same; }) <
            static_cast<std::ptrdiff_t>(examples))
            keep(checked, changed[i], page_same);
}

void SystemPage::keep(const CheckedPass& checked, std::size_t index, std::size_t kind) {
    const JudgedPass& judged = checked.judged;
    Item item{judged.frame, checked.pass, index, kind, {}};
    try {
        const std::vector<ToldValue> told = told_of(gpu_, checked.pass, judged, index);
        const std::vector<StepRow> rows = item_rows(judged, index, told);
        item.told = {{"name", item_name(judged.gpu.about(), judged.gpu.extent, index)},
                     {"before", state_json(judged.before[judged.pass.resource()], index)},
                     {"rows", rows_json(rows)},
                     {"why", item_verdict_text(judged, index, rows)}};
    } catch (const Error&) { // the command below it says why; the verdicts stand
    }
    items_.push_back(std::move(item));
}

json SystemPage::item_json(const Item& item) const {
    json out{{"frame", item.frame},
             {"pass", item.pass},
             {"class", item.kind},
             {"name", item_name(system_.schema.resources[system_.passes[item.pass]->resource()],
                                system_.start.extent(system_.passes[item.pass]->resource()), item.index)}};
    if (item.told.is_null())
        return out;
    for (const json& row : item.told.at("rows"))
        if (row.at("verdict") == "DIVERGENT" && !out.contains("step"))
            out["step"] = row.at("label");
    return out;
}

json SystemPage::passes_json() const {
    json passes = json::array();
    for (std::size_t p = 0; p < system_.passes.size(); ++p) {
        const auto found = totals_.find(p);
        const Total total = found == totals_.end() ? Total{} : found->second;
        passes.push_back({{"name", system_.passes[p]->name()},
                          {"resource", system_.passes[p]->resource()},
                          {"frames", total.frames},
                          {"compared", total.compared},
                          {"differing", total.differing},
                          {"classes", total.classes},
                          {"ulp", ulp_json(total.worst_ulp)},
                          {"first_frame", total.first_frame < 0 ? json() : json(total.first_frame)}});
    }
    return passes;
}

std::string SystemPage::text(std::string_view page_template, const CheckReport& report,
                             const RunDescription& description, const std::vector<PageCommand>& commands,
                             const ExplainLine& explain_line, const std::string& drawn) const {
    json listed = json::array(), tables = json::array(), extents = json::array();
    for (const Item& item : items_) {
        const std::uint8_t resource = system_.passes[item.pass]->resource();
        listed.push_back(item_json(item));
        listed.back()["command"] = explain_line(
            {"--frame", std::to_string(item.frame), "--pass", pass_argument(system_, item.pass, item.frame), "--item",
             item_argument(system_.schema.resources[resource], system_.start.extent(resource), item.index)});
        tables.push_back(item.told);
    }
    for (std::uint8_t r = 0; r < system_.schema.resources.size(); ++r) {
        const Extent extent = system_.start.extent(r);
        extents.push_back({extent.width, extent.height, extent.depth});
    }
    json head = page_head(report, description, commands);
    head["items"] = std::move(listed);
    head["system"] = {{"passes", passes_json()},
                      {"extents", std::move(extents)},
                      {"drawn", drawn},
                      {"left_out_from", left_out_from_ < 0 ? json() : json(left_out_from_)}};
    const auto page_with = [&](const json& with_tables, const json& with_details) {
        return filled_page(page_template, head,
                           blob_element("tables", packed_json(with_tables)) +
                               blob_element("passes", packed_json({{"rows", rows_}, {"details", with_details}})));
    };
    std::string page = page_with(tables, details_);
    if (page.size() <= largest_page)
        return page;
    // Tables of what comes first stay; a command stands beside each that does not.
    for (std::size_t i = tables.size() / 2; i < tables.size(); ++i)
        tables[i] = nullptr;
    page = page_with(tables, json::array());
    return page.size() <= largest_page ? page : page_with(json::array(), json::array());
}

} // namespace lockstep
