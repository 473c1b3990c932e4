#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "crosscheck/command/verb.hpp"

namespace lockstep {

/// Frames a run may have.
inline constexpr int most_frames = 100'000'000;

/// Each makes an option that keeps its value in `target`, which has to outlive the call of its verb.
/// A text that is no value is refused with what would be one.
Option flag(std::string name, bool& target, std::string description);
Option text_option(std::string name, std::string value, std::string& target, std::string description);
Option text_option(std::string name, std::string value, std::optional<std::string>& target, std::string description);
Option texts_option(std::string name, std::string value, std::vector<std::string>& target, std::string description);

/// NAME=VALUE, repeated; refuses a NAME that is given twice.
Option settings_option(std::string name, std::string value, std::vector<std::string>& target, std::string description);

/// "NAME=VALUE", taken apart; without a sign VALUE is empty.
std::pair<std::string, std::string> setting_parts(const std::string& text);

/// A macro, of NAME=TEXT. Throws Error where NAME is no macro's, or TEXT more than a line.
std::pair<std::string, std::string> macro_of(std::string_view option, const std::string& text);

/// Refuses the empty name. A `value` of DIR is a folder, anything else a file.
Option path_option(std::string name, std::string value, std::filesystem::path& target, std::string description);

struct IntegerRange {
    std::int64_t min = 0, max = 0; ///< both allowed
};

Option integer_option(std::string name, std::string value, IntegerRange range, int& target, std::string description);
Option integer_option(std::string name, std::string value, IntegerRange range, std::size_t& target,
                      std::string description);
Option integer_option(std::string name, std::string value, IntegerRange range, std::optional<std::size_t>& target,
                      std::string description);

/// Frames of a run: "60", the first 60, or "20..59", both counted from 0 and among them.
struct FrameRange {
    int first = 0;
    int end = 60;                           ///< the one after the last
    bool is_part = false;                   ///< written as A..B
    [[nodiscard]] std::string text() const; ///< as it is typed
};
Option frames_option(std::string name, FrameRange& target, std::string description);

/// "1,4"; replaces what the target held, and refuses a number that is given twice.
Option integers_option(std::string name, std::string value, IntegerRange range, std::vector<int>& target,
                       std::string description);
Option integers_option(std::string name, std::string value, IntegerRange range, std::vector<std::size_t>& target,
                       std::string description);

/// A time that ends: seconds above 0.
Option seconds_option(std::string name, double& target, std::string description);

/// A share: "95%" or "0.95".
Option share_option(std::string name, double& target, std::string description);

/// One of a few names, given to `choose` by its place among them.
Option named_option(std::string name, std::vector<std::string> choices, std::function<void(std::size_t)> choose,
                    std::string description);

/// One of a few words, kept as it is.
Option word_option(std::string name, std::vector<std::string> words, std::string& target, std::string description);
Option word_option(std::string name, std::vector<std::string> words, std::optional<std::string>& target,
                   std::string description);

/// Needed, and so without a value of its own.
Option required(Option option);

/// With what help says of the value without it; empty: nothing.
Option otherwise(Option option, std::string initial);

/// A value that has a name.
template <class Value> Option choice_option(std::string name, Value& target,
                                            const std::vector<std::pair<std::string, Value>>& choices,
                                            std::string description) {
    std::vector<std::string> texts;
    std::vector<Value> values;
    for (const auto& [text, value] : choices) {
        texts.push_back(text);
        values.push_back(value);
    }
    std::string initial;
    if constexpr (std::equality_comparable<Value>)
        for (std::size_t i = 0; i < values.size(); ++i)
            if (values[i] == target)
                initial = texts[i];
    const auto choose = [&target, values = std::move(values)](std::size_t place) { target = values[place]; };
    return otherwise(named_option(std::move(name), std::move(texts), choose, std::move(description)),
                     std::move(initial));
}

} // namespace lockstep
