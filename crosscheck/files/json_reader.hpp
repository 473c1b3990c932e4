#pragma once
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace lockstep {

/// Which numbers a value may be, and the words for it.
struct NumberRule {
    double min;
    double max;
    std::string_view text; ///< completes "... is not "
};

namespace number {
inline constexpr NumberRule finite{-3.4e38, 3.4e38, "a finite number"};
inline constexpr NumberRule positive{1.2e-38, 3.4e38, "a number above 0"};
inline constexpr NumberRule not_negative{0.0, 3.4e38, "a number from 0 up"};
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
    [[nodiscard]] const std::string& file() const { return file_; } ///< as messages name it
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

/// What a JSON text may ask for: far more than anything read here needs.
namespace json_limits {
inline constexpr std::size_t bytes = std::size_t{64} << 20U;
inline constexpr std::size_t depth = 64; ///< arrays and objects within each other
inline constexpr std::size_t values = 4'000'000;
} // namespace json_limits

/// All JSON from elsewhere is read here. Throws Error, `NAME:LINE:COLUMN: ...`, where the text is malformed, has a key
/// twice in one object, or is beyond the limits.
nlohmann::json parse_json(std::string_view text, const std::string& name);

/// The same of a file.
nlohmann::json read_json(const std::filesystem::path& file);

} // namespace lockstep
