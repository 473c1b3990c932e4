#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crosscheck/report/report.hpp"

namespace lockstep {

/// Bytes that a report page has at most.
inline constexpr std::size_t largest_page = 5'000'000;

/// A command line, and what it shows again.
struct PageCommand {
    std::string what;
    std::string line;
};

/// A picture for people, PNG.
struct PagePicture {
    std::string title, png;
};

/// JSON as one line; bytes that are no UTF-8 become U+FFFD.
std::string page_text(const nlohmann::json& data);

/// The same as a blob: base64 of a zlib stream.
std::string packed_json(const nlohmann::json& data);

/// The element of a page that holds a blob, which data.js finds by its id.
std::string blob_element(std::string_view id, std::string_view base64);

/// What the head of every page has: the report as data and as text, the schema with a key for each buffer and image,
/// the command lines.
nlohmann::json page_head(const CheckReport& report, const RunDescription& description,
                         const std::vector<PageCommand>& commands);

/// A page: the template with the head and blobs where its data goes.
std::string filled_page(std::string_view page_template, const nlohmann::json& head, std::string_view blobs);

} // namespace lockstep
