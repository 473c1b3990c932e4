#include "crosscheck/report/page/page_parts.hpp"

#include <array>
#include <cstdlib>
#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/base64.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/report/page/blob.hpp"
#include "crosscheck/report/page/template.hpp"
#include "crosscheck/scene/schema_json.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

/// JSON that no HTML parser takes for the end of the script element.
std::string inside_script(std::string text) {
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos; at += 6)
        text.replace(at, 1, "\\u003c");
    return text;
}

std::string element(std::string_view id, std::string_view type, std::string_view content) {
    return fmt::format("<script type=\"{}\" id=\"lockstep-{}\">{}</script>\n", type, id, content);
}

/// "2026-11-24 13:05 UTC"; SOURCE_DATE_EPOCH (reproducible-builds.org) may say another time.
std::string written() {
    std::time_t time = std::time(nullptr);
    if (const char* given = std::getenv("SOURCE_DATE_EPOCH"); given != nullptr && *given != '\0')
        time = std::strtoll(given, nullptr, 10);
    std::tm parts{};
    std::array<char, 32> text{};
    const std::size_t size =
        gmtime_r(&time, &parts) == nullptr ? 0 : std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &parts);
    return {text.data(), size};
}

} // namespace

std::string page_text(const json& data) { return data.dump(-1, ' ', false, json::error_handler_t::replace); }

std::string packed_json(const json& data) { return base64(deflated(page_text(data))); }

std::string blob_element(std::string_view id, std::string_view base64) {
    return element(id, "application/octet-stream", base64);
}

json page_head(const CheckReport& report, const RunDescription& description, const std::vector<PageCommand>& commands) {
    json lines = json::array(), schema = schema_json(report.schema);
    for (const PageCommand& command : commands)
        lines.push_back({{"what", command.what}, {"line", command.line}});
    for (std::uint8_t r = 0; r < report.schema.resources.size(); ++r)
        schema["resources"][r]["key"] = item_key(report.schema, r);
    return {{"report", report_json(report, description)},
            {"text", report_text(report, description)},
            {"schema", std::move(schema)},
            {"commands", std::move(lines)},
            {"written", written()},
            {"version", LOCKSTEP_VERSION}};
}

std::string filled_page(std::string_view page_template, const json& head, std::string_view blobs) {
    const std::size_t place = page_template.find(page_data_marker);
    std::string page(page_template.substr(0, place));
    page += element("head", "application/json", inside_script(page_text(head)));
    page += blobs;
    page += page_template.substr(place + page_data_marker.size());
    return page;
}

} // namespace lockstep
