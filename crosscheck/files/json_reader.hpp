#pragma once
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "reference/model/bounded_json.hpp"

namespace lockstep {

/// Which numbers a value may be, and the words for it.
struct NumberRule {
    double min;
    double max;
    std::string_view text; ///< completes "... is not "
};

namespace number {
inline constexpr double most = std::numeric_limits<float>::max();
inline constexpr NumberRule finite{-most, most, "a finite number"};
inline constexpr NumberRule positive{std::numeric_limits<float>::min(), most, "a number above 0"};
inline constexpr NumberRule not_negative{0.0, most, "a number from 0 up"};
} // namespace number

/// A value of a JSON file that knows where it stands. Every getter throws Error as
/// `FILE: /json/pointer: VALUE is not WHAT IS ALLOWED`.
class JsonValue {
  public:
    JsonValue(const nlohmann::json& value, std::string file, std::string path = "");

    /// Throws Error: `FILE: PATH: what`.
    [[noreturn]] void fail(std::string_view what) const;

    /// An object with no keys but these.
    void check_keys(std::span<const std::string_view> allowed) const;
    void check_keys(std::initializer_list<std::string_view> allowed) const {
        check_keys(std::span(allowed.begin(), allowed.size()));
    }
    [[nodiscard]] std::vector<std::string> keys() const;
    [[nodiscard]] std::optional<JsonValue> find(std::string_view key) const;
    [[nodiscard]] JsonValue at(std::string_view key) const;
    /// The elements of an array.
    [[nodiscard]] std::vector<JsonValue> items() const;

    [[nodiscard]] float number(const NumberRule& rule = number::finite) const;
    [[nodiscard]] std::int64_t integer(std::int64_t min, std::int64_t max) const;
    [[nodiscard]] glm::vec3 vector() const;
    [[nodiscard]] const nlohmann::json& raw() const { return *value_; } ///< for what is read by another reader
    [[nodiscard]] const std::string& file() const { return file_; }     ///< as messages name it
    [[nodiscard]] bool is_null() const { return value_->is_null(); }
    [[nodiscard]] bool is_text() const { return value_->is_string(); }
    [[nodiscard]] bool is_object() const { return value_->is_object(); }
    [[nodiscard]] bool is_array() const { return value_->is_array(); }
    [[nodiscard]] bool is_truth() const { return value_->is_boolean(); }
    [[nodiscard]] bool truth() const { return is_truth() && value_->get<bool>(); }
    [[nodiscard]] std::string text() const;
    /// A text that is only shown: what plain_line (plain_text.hpp) makes of it.
    [[nodiscard]] std::string label() const;
    /// The index of a text, or of a whole number, among `allowed`.
    [[nodiscard]] std::size_t choice(std::span<const std::string_view> allowed) const;
    [[nodiscard]] std::size_t choice(std::initializer_list<std::string_view> allowed) const {
        return choice(std::span(allowed.begin(), allowed.size()));
    }

  private:
    [[noreturn]] void fail_not(std::string_view allowed) const;

    const nlohmann::json* value_;
    std::string file_;
    std::string path_;
};

/// The value of a file, as parse_json reads it.
nlohmann::json read_json(const std::filesystem::path& file);

} // namespace lockstep
