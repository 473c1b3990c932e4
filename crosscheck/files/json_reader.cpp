#include "crosscheck/files/json_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
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
            fail(fmt::format("more than {} MiB of JSON", json_limits::bytes >> 20U));
    }
    note_read(file, text);
    return text;
}

} // namespace

json read_json(const std::filesystem::path& file) { return parse_json(read_text(file), file.string()); }

JsonValue::JsonValue(const json& value, std::string file, std::string path)
    : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

void JsonValue::fail(std::string_view what) const {
    throw Error(fmt::format("{}: {}: {}", file_, path_.empty() ? "/" : path_, what));
}

void JsonValue::fail_not(std::string_view allowed) const {
    fail(fmt::format("{} is not {}", shown_json(*value_), allowed));
}

void JsonValue::check_keys(std::span<const std::string_view> allowed) const {
    for (const std::string& key : keys())
        if (std::find(allowed.begin(), allowed.end(), key) == allowed.end())
            fail(fmt::format("unknown key {}; the keys here are {}{}", shown_json(key), fmt::join(allowed, ", "),
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
    double number = value_->get<double>();
    if (std::abs(number) > number::finite.max && std::isfinite(static_cast<float>(number)))
        number = std::copysign(double{number::finite.max}, number); // 3.4028235e38: its nearest float is the largest
    if (number > 0.0 && number < rule.min && rule.min == number::positive.min)
        fail_not("a normal float, which is 1.2e-38 or more");
    if (std::abs(number) > number::finite.max && rule.max == number::finite.max && (number > 0 || rule.min < 0))
        fail(fmt::format("{} is beyond what a float holds, 3.4e38", shown_json(*value_)));
    if (!(number >= rule.min && number <= rule.max))
        fail_not(rule.text);
    return nearest_float(*value_);
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
