#include "crosscheck/scene/ply_counts.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

void fail_on(const std::filesystem::path& file, std::string_view what) {
    throw Error(fmt::format("{}: {}", file.string(), what));
}

namespace {

/// Bytes of a PLY number.
struct Number {
    std::size_t bytes = 0;
    bool is_integer = false, is_signed = false;
};

std::optional<Number> number_type(std::string_view name) {
    static constexpr std::pair<std::string_view, Number> types[] = {
        {"char", {1, true, true}},    {"int8", {1, true, true}},     {"uchar", {1, true, false}},
        {"uint8", {1, true, false}},  {"short", {2, true, true}},    {"int16", {2, true, true}},
        {"ushort", {2, true, false}}, {"uint16", {2, true, false}},  {"int", {4, true, true}},
        {"int32", {4, true, true}},   {"uint", {4, true, false}},    {"uint32", {4, true, false}},
        {"float", {4, false, true}},  {"float32", {4, false, true}}, {"double", {8, false, true}},
        {"float64", {8, false, true}}};
    const auto* const found = std::ranges::find(types, name, &std::pair<std::string_view, Number>::first);
    return found == std::end(types) ? std::nullopt : std::optional(found->second);
}

struct Property {
    Number item;
    std::optional<Number> count; ///< of a list
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    bool ascii = false, big_endian = false;
    std::vector<Element> elements;
    std::size_t size = 0; ///< bytes up to the body
};

Property read_property(std::istringstream& words, const std::filesystem::path& file) {
    const auto type = [&](const std::string& word) {
        const std::optional<Number> number = number_type(word);
        if (!number)
            fail_on(file,
                    fmt::format("not a readable mesh: the PLY header has a property of type '{}'", plain_line(word)));
        return *number;
    };
    std::string first, count, item;
    words >> first;
    if (first != "list")
        return {type(first), {}};
    words >> count >> item;
    if (!type(count).is_integer)
        fail_on(file, fmt::format("not a readable mesh: the PLY header counts a list in {}; expected an integer type",
                                  plain_line(count)));
    return {type(item), type(count)};
}

Header read_header(const std::string& ply, const std::filesystem::path& file) {
    Header header;
    std::istringstream stream(ply);
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "end_header") {
            header.size = stream.eof() ? ply.size() : static_cast<std::size_t>(stream.tellg());
            return header;
        }
        if (word == "format") {
            words >> word;
            header.ascii = word == "ascii";
            header.big_endian = word == "binary_big_endian";
        } else if (word == "element") {
            Element& element = header.elements.emplace_back();
            words >> element.name >> element.count;
        } else if (word == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(read_property(words, file));
        }
    }
    fail_on(file, "not a readable mesh: the PLY header has no end_header");
}

[[noreturn]] void fail_cut(const std::filesystem::path& file, const Element& element, std::size_t found) {
    fail_on(file, fmt::format("cut off: {} of the {} elements '{}' that its header promises are here", found,
                              element.count, plain_line(element.name)));
}

/// A list's length; more than any file holds where it is negative.
std::uint64_t list_length(std::string_view bytes, Number type, bool big_endian) {
    std::uint64_t length = 0;
    for (std::size_t b = 0; b < bytes.size(); ++b)
        length |= std::uint64_t{static_cast<unsigned char>(bytes[big_endian ? bytes.size() - 1 - b : b])} << (8 * b);
    const bool negative = type.is_signed && ((length >> (8 * type.bytes - 1)) & 1U) != 0;
    return negative ? UINT64_MAX : length;
}

void check_binary_body(std::string_view body, const Header& header, const std::filesystem::path& file) {
    for (const Element& element : header.elements)
        for (std::size_t i = 0; i < element.count; ++i)
            for (const Property& property : element.properties) {
                std::uint64_t items = 1;
                if (property.count) {
                    if (body.size() < property.count->bytes)
                        fail_cut(file, element, i);
                    items = list_length(body.substr(0, property.count->bytes), *property.count, header.big_endian);
                    body.remove_prefix(property.count->bytes);
                }
                if (items > body.size() / property.item.bytes)
                    fail_cut(file, element, i);
                body.remove_prefix(items * property.item.bytes);
            }
}

/// Takes a word off the front of a line.
std::string_view next_word(std::string_view& line) {
    constexpr std::string_view blank = " \t\r";
    line.remove_prefix(std::min(line.find_first_not_of(blank), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(blank));
    line.remove_prefix(word.size());
    return word;
}

/// Whether a line has the words of an element.
bool is_whole(std::string_view line, const Element& element) {
    for (const Property& property : element.properties) {
        std::uint64_t items = 1;
        if (property.count) {
            const std::string_view word = next_word(line);
            const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), items);
            if (status != std::errc{} || end != word.data() + word.size())
                return false;
        }
        for (std::uint64_t k = 0; k < items; ++k)
            if (next_word(line).empty())
                return false;
    }
    return true;
}

void check_text_body(std::string_view body, const Header& header, const std::filesystem::path& file) {
    std::vector<std::string_view> lines;
    while (!body.empty()) {
        const std::string_view line = body.substr(0, body.find('\n'));
        body.remove_prefix(std::min(line.size() + 1, body.size()));
        if (line.find_first_not_of(" \t\r") != std::string_view::npos)
            lines.push_back(line);
    }
    std::size_t promised = 0;
    for (const Element& element : header.elements)
        promised += element.count;
    if (lines.size() < promised)
        fail_on(file,
                fmt::format("cut off: {} of the {} lines that its header promises are here", lines.size(), promised));
    auto line = lines.begin();
    for (const Element& element : header.elements)
        for (std::size_t i = 0; i < element.count; ++i)
            if (!is_whole(*line++, element))
                fail_on(file, fmt::format("element {} of '{}' has fewer numbers than its header promises: {}", i,
                                          plain_line(element.name), plain_line(std::string(line[-1]))));
}

} // namespace

std::size_t ply_faces(const std::string& ply, const std::filesystem::path& file) {
    const Header header = read_header(ply, file);
    std::size_t faces = 0, elements = 0;
    for (const Element& element : header.elements) {
        faces += element.name == "face" ? element.count : 0;
        elements = element.count > SIZE_MAX - elements ? SIZE_MAX : elements + element.count;
    }
    if (elements > ply.size())
        fail_on(file, fmt::format("cut off: its header promises {} elements, in {} bytes", elements, ply.size()));
    const std::string_view body = std::string_view(ply).substr(header.size);
    (header.ascii ? check_text_body : check_binary_body)(body, header, file);
    return faces;
}

} // namespace lockstep
