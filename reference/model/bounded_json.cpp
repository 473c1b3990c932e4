#include "reference/model/bounded_json.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

std::string shortened(std::string text, std::size_t longest) {
    if (text.size() > longest)
        text = text.substr(0, longest - 3) + "...";
    return text;
}

/// In ASCII, with escapes for what does not show.
std::string dumped(const json& value) { return value.dump(-1, ' ', true, json::error_handler_t::replace); }

/// The double nearest to `text`, or its neighbour that rounds to the float nearest to `text`.
double rounded_as_float(double nearest, const std::string& text) {
    float once = 0.0F;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), once);
    if (status != std::errc{} || static_cast<float>(nearest) == once)
        return nearest;
    return std::nextafter(nearest, double{once});
}

/// Walks a text for what the parser itself does not report: the place where it breaks off, keys that stand twice, more
/// than a file may ask for, and doubles that would round to another float than the number. The parser needs no stack
/// for depth, but what walks the value does.
class Syntax : public nlohmann::json_sax<json> {
  public:
    explicit Syntax(std::string_view text) : text_(text) {}
    std::string problem;                                   ///< empty: none
    std::vector<std::pair<std::size_t, double>> corrected; ///< by the number of the value that has a fraction

    bool null() override { return count(); }
    bool boolean(bool) override { return count(); }
    bool number_integer(number_integer_t) override { return count(); }
    bool number_unsigned(number_unsigned_t) override { return count(); }
    bool number_float(number_float_t number, const string_t& text) override {
        if (const double rounded = rounded_as_float(number, text); rounded != number)
            corrected.emplace_back(reals_, rounded);
        ++reals_;
        return count();
    }
    bool string(string_t&) override { return count(); }
    bool binary(binary_t&) override { return count(); }
    bool start_array(std::size_t) override { return enter(Level{.is_array = true}); }
    bool end_array() override { return leave(); }
    bool start_object(std::size_t) override { return enter(Level{}); }
    bool end_object() override { return leave(); }
    bool key(string_t& name) override {
        const bool is_new = open_.back().keys.insert(name).second;
        if (!is_new)
            problem = fmt::format(" {}: the key {} stands twice in one object", path(), shown_json(name));
        open_.back().place = name;
        return is_new;
    }
    bool parse_error(std::size_t position, const std::string&, const json::exception& error) override {
        const std::string_view before = text_.substr(0, std::min(position, text_.size()));
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t line_start = before.rfind('\n') + 1; // npos + 1 is 0
        problem = fmt::format("{}:{}: malformed JSON: {}", line, std::max<std::size_t>(before.size() - line_start, 1),
                              text_.empty() ? "it is empty" : detail(error.what())); // libraries differ on that
        return false;
    }

  private:
    /// An array or object that has begun: the keys that it had, and the place of the value that is read.
    struct Level {
        bool is_array = false;
        std::set<std::string> keys = {};
        std::string place = {};
        std::size_t index = 0;
    };

    /// Of the array or object that has begun last.
    [[nodiscard]] std::string path() const {
        std::string text;
        for (const Level& level : std::span(open_).first(open_.size() - 1)) {
            const std::string quoted = dumped(level.place);
            text += '/';
            text += level.is_array ? std::to_string(level.index - 1) : quoted.substr(1, quoted.size() - 2);
        }
        return text.empty() ? "/" : shortened(std::move(text), 200);
    }
    bool count() {
        if (!open_.empty())
            ++open_.back().index;
        if (++values_ <= json_limits::values)
            return true;
        problem = fmt::format(" more than {} values", json_limits::values);
        return false;
    }
    bool enter(Level level) {
        if (open_.size() == json_limits::depth)
            problem = fmt::format(" arrays and objects within each other more than {} deep", json_limits::depth);
        if (!problem.empty() || !count())
            return false;
        open_.push_back(std::move(level));
        return true;
    }
    bool leave() {
        open_.pop_back();
        return true;
    }

    /// "[json.exception...] parse error at line 1, column 2: syntax error ..." without what we say ourselves.
    static std::string detail(std::string text) {
        text.erase(0, text.find("] ") + 2);
        if (text.starts_with("parse error"))
            text.erase(0, text.find(": ") + 2);
        return shortened(std::move(text), 200); // it quotes what it read last, a number of any length
    }

    std::string_view text_;
    std::vector<Level> open_;
    std::size_t values_ = 0, reals_ = 0;
};

} // namespace

std::string shown_json(const json& value) { return shortened(dumped(value), 40); }

json parse_json(std::string_view text, const std::string& name) {
    if (text.size() > json_limits::bytes)
        throw Error(fmt::format("{}: more than {} MiB of JSON", name, json_limits::bytes >> 20U));
    Syntax syntax(text);
    if (!json::sax_parse(text, &syntax))
        throw Error(fmt::format("{}:{}", name, syntax.problem));
    if (const std::size_t null = text.find('\0');
        null != std::string_view::npos) // where the parser stops without a word
        throw Error(fmt::format("{}: a NUL byte behind its end, byte {}; right is the value alone", name, null + 1));
    if (syntax.corrected.empty())
        return json::parse(text);
    auto next = syntax.corrected.begin();
    std::size_t reals = 0;
    return json::parse(text, [&](int, json::parse_event_t event, json& value) {
        if (event != json::parse_event_t::value || !value.is_number_float())
            return true;
        if (next != syntax.corrected.end() && next->first == reals)
            value = (next++)->second;
        ++reals;
        return true;
    });
}

float nearest_float(const json& number) {
    if (number.is_number_unsigned())
        return static_cast<float>(number.get<std::uint64_t>());
    if (number.is_number_integer())
        return static_cast<float>(number.get<std::int64_t>());
    return static_cast<float>(number.get<double>());
}

} // namespace lockstep
