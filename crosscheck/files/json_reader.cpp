#include "crosscheck/files/json_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/read_files.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

std::string shortened(std::string text, std::size_t longest) {
    if (text.size() > longest)
        text = text.substr(0, longest - 3) + "...";
    return text;
}

std::string shown(const json& value) {
    return shortened(value.dump(-1, ' ', true, json::error_handler_t::replace), 40);
}

/// Walks a text for what the parser itself does not tell: where it breaks off, keys that stand twice, and more than a
/// file may ask for. The parser needs no stack for depth, but whoever walks the value does.
class Syntax : public nlohmann::json_sax<json> {
  public:
    explicit Syntax(std::string_view text) : text_(text) {}
    std::string problem; ///< empty: none

    bool null() override { return count(); }
    bool boolean(bool) override { return count(); }
    bool number_integer(number_integer_t) override { return count(); }
    bool number_unsigned(number_unsigned_t) override { return count(); }
    bool number_float(number_float_t, const string_t&) override { return count(); }
    bool string(string_t&) override { return count(); }
    bool binary(binary_t&) override { return count(); }
    bool start_array(std::size_t) override { return enter(Level{.is_array = true}); }
    bool end_array() override { return leave(); }
    bool start_object(std::size_t) override { return enter(Level{}); }
    bool end_object() override { return leave(); }
    bool key(string_t& name) override {
        const bool is_new = open_.back().keys.insert(name).second;
        if (!is_new)
            problem = fmt::format(" {}: the key {} stands twice in one object", path(), shown(name));
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
        for (const Level& level : std::span(open_).first(open_.size() - 1))
            text += "/" + (level.is_array ? std::to_string(level.index - 1) : plain_line(level.place));
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
    std::size_t values_ = 0;
};

std::string too_long() { return fmt::format("more than {} MiB of JSON", json_limits::bytes >> 20U); }

/// A pipe is read as well, so that a program may hand a scene over; one that nobody writes to would be waited for
/// without end.
std::string read_text(const std::filesystem::path& file) {
    const auto fail = [&](const std::string& what) { throw Error(fmt::format("{}: {}", file.string(), what)); };
    const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (opened < 0)
        fail(fmt::format("cannot be read: {}", std::strerror(errno)));
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(fdopen(opened, "rb"), &std::fclose);
    std::string text;
    std::array<char, 1U << 16U> block{};
    ssize_t got = ::read(opened, block.data(), block.size());
    struct stat about {};
    if (got == 0 && fstat(opened, &about) == 0 && S_ISFIFO(about.st_mode))
        fail("is a pipe that nobody writes to; right is a file");
    ::fcntl(opened, F_SETFL, O_RDONLY);
    for (; got != 0; got = ::read(opened, block.data(), block.size())) {
        if (got < 0 && errno != EINTR && errno != EAGAIN)
            fail(fmt::format("cannot be read: {}", std::strerror(errno)));
        text.append(block.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
        if (text.size() > json_limits::bytes)
            fail(too_long());
    }
    note_read(file, text);
    return text;
}

} // namespace

json parse_json(std::string_view text, const std::string& name) {
    if (text.size() > json_limits::bytes)
        throw Error(fmt::format("{}: {}", name, too_long()));
    Syntax syntax(text);
    if (!json::sax_parse(text, &syntax))
        throw Error(fmt::format("{}:{}", name, syntax.problem));
    if (const std::size_t null = text.find('\0');
        null != std::string_view::npos) // where the parser stops without a word
        throw Error(fmt::format("{}: a NUL byte behind its end, byte {}; right is the value alone", name, null + 1));
    return json::parse(text);
}

json read_json(const std::filesystem::path& file) { return parse_json(read_text(file), file.string()); }

JsonValue::JsonValue(const json& value, std::string file, std::string path)
    : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

void JsonValue::fail(std::string_view what) const {
    throw Error(fmt::format("{}: {}: {}", file_, path_.empty() ? "/" : path_, what));
}

void JsonValue::fail_not(std::string_view allowed) const { fail(fmt::format("{} is not {}", shown(*value_), allowed)); }

void JsonValue::check_keys(std::span<const std::string_view> allowed) const {
    for (const std::string& key : keys())
        if (std::find(allowed.begin(), allowed.end(), key) == allowed.end())
            fail(fmt::format("unknown key {}; the keys here are {}{}", shown(key), fmt::join(allowed, ", "),
                             did_you_mean(key, {allowed.begin(), allowed.end()})));
}

std::vector<std::string> JsonValue::keys() const {
    if (!value_->is_object())
        fail_not("an object");
    std::vector<std::string> names;
    for (const auto& [key, value] : value_->items())
        names.push_back(key);
    return names;
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
    if (!value_->is_object())
        fail_not("an object");
    const auto found = value_->find(std::string(key));
    if (found == value_->end())
        return std::nullopt;
    return JsonValue(*found, file_, fmt::format("{}/{}", path_, key));
}

JsonValue JsonValue::at(std::string_view key) const {
    const auto found = find(key);
    if (!found)
        fail(fmt::format("the key \"{}\" is missing", key));
    return *found;
}

std::vector<JsonValue> JsonValue::items() const {
    if (!value_->is_array())
        fail_not("an array");
    std::vector<JsonValue> elements;
    for (std::size_t i = 0; i < value_->size(); ++i)
        elements.emplace_back((*value_)[i], file_, fmt::format("{}/{}", path_, i));
    return elements;
}

float JsonValue::number(const NumberRule& rule) const {
    if (!value_->is_number())
        fail_not(rule.text);
    const double number = value_->get<double>();
    if (number > 0.0 && number < rule.min && rule.min == number::positive.min)
        fail_not("a normal float, which is 1.2e-38 or more");
    if (std::abs(number) > number::finite.max && rule.max == number::finite.max && (number > 0 || rule.min < 0))
        fail(fmt::format("{} is beyond what a float holds, 3.4e38", shown(*value_)));
    if (!(number >= rule.min && number <= rule.max))
        fail_not(rule.text);
    return static_cast<float>(number);
}

std::int64_t JsonValue::integer(std::int64_t min, std::int64_t max) const {
    const bool fits = value_->is_number_unsigned()
                          ? value_->get<std::uint64_t>() <= static_cast<std::uint64_t>(std::max<std::int64_t>(max, 0))
                          : value_->is_number_integer();
    const std::int64_t number = fits ? value_->get<std::int64_t>() : 0;
    if (!fits || number < min || number > max)
        fail_not(fmt::format("an integer from {} to {}", min, max));
    return number;
}

glm::vec3 JsonValue::vector() const {
    if (!value_->is_array() || value_->size() != 3)
        fail_not("a vector of three finite numbers, [x, y, z]");
    const std::vector<JsonValue> xyz = items();
    return {xyz[0].number(), xyz[1].number(), xyz[2].number()};
}

std::string JsonValue::text() const {
    if (!value_->is_string())
        fail_not("a text");
    return value_->get<std::string>();
}

std::string JsonValue::label() const { return plain_line(text()); }

std::size_t JsonValue::choice(std::span<const std::string_view> allowed) const {
    const std::string given = value_->is_string()           ? value_->get<std::string>()
                              : value_->is_number_integer() ? value_->dump() // 2 as "2"
                                                            : "";
    const auto found = std::find(allowed.begin(), allowed.end(), given);
    if (found == allowed.end())
        fail_not(fmt::format("one of {}", fmt::join(allowed, ", ")));
    return static_cast<std::size_t>(found - allowed.begin());
}

} // namespace lockstep
