#include "crosscheck/scene/settings_place.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// Of what is wrong: what would be right comes behind a semicolon.
std::vector<std::string> words_of(const std::string& message) {
    std::vector<std::string> words(1);
    for (const char c : message.substr(0, message.find(';'))) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_')
            words.back() += c;
        else if (!words.back().empty())
            words.emplace_back();
    }
    if (words.back().empty())
        words.pop_back();
    return words;
}

/// Those of that name at any depth; "emitter" names "emitters", too.
void find_below(const JsonValue& json, const std::string& word, std::vector<JsonValue>& found) {
    if (json.is_array())
        for (const JsonValue& item : json.items())
            find_below(item, word, found);
    if (!json.is_object())
        return;
    for (const std::string& key : json.keys()) {
        const JsonValue value = json.at(key);
        if (key == word || key == word + "s")
            found.push_back(value);
        find_below(value, word, found);
    }
}

/// The component of a vector, or the object or list of that number.
std::optional<JsonValue> element(const std::vector<JsonValue>& items, const std::string& word) {
    const bool holds_more = !items.empty() && (items.front().is_object() || items.front().is_array());
    std::size_t n = items.size();
    if (holds_more)
        std::from_chars(word.data(), word.data() + word.size(), n);
    else if (items.size() == 3 && word.size() == 1)
        n = std::string_view("xyz").find(word.front());
    return n < items.size() ? std::optional(items[n]) : std::nullopt;
}

std::optional<JsonValue> step(const JsonValue& from, const std::string& word) {
    if (from.is_array())
        if (const auto found = element(from.items(), word))
            return found;
    std::vector<JsonValue> found;
    find_below(from, word, found);
    return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

} // namespace

void fail_settings(const JsonValue& scene, const std::string& message) {
    const auto named = scene.find("system");
    const std::string system = (named && named->is_text() ? named->text() : "") + ": ";
    const std::string said = message.starts_with(system) ? message.substr(system.size()) : message;
    std::optional<JsonValue> place;
    for (const std::string& word : words_of(said))
        if (const auto next = step(place.value_or(scene), word))
            place = next;
    if (place)
        place->fail(said);
    throw Error(fmt::format("{}: {}", scene.file(), message));
}

} // namespace lockstep
