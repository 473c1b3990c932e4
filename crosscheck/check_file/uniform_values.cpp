#include "crosscheck/check_file/uniform_values.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/check_file/value_words.hpp"

namespace lockstep::check_file {
namespace {

/// Numbers of a value in the words of its type.
using Words = std::vector<std::uint32_t>;

std::string type_text(const text::BasicType& type) {
    const std::string prefix = type.is_boolean ? "b" : type.is_real ? "" : type.is_signed ? "i" : "u";
    if (type.columns > 1)
        return type.rows == type.columns ? fmt::format("mat{}", type.rows)
                                         : fmt::format("mat{}x{}", type.columns, type.rows);
    if (type.rows > 1)
        return fmt::format("{}vec{}", prefix, type.rows);
    return type.is_boolean ? "bool" : type.is_real ? "float" : type.is_signed ? "int" : "uint";
}

std::uint32_t read_number(const JsonValue& value, const text::BasicType& type) {
    if (value.is_truth() && !type.is_real && !type.is_boolean) // of a block, where a bool is a uint
        return value.truth() ? 1 : 0;
    if (type.is_boolean) {
        if (!value.is_truth())
            value.fail("is not true or false");
        return value.truth() ? 1 : 0;
    }
    return read_word(value, scalar_of(type));
}

/// Of no array.
Words read_value(const JsonValue& value, const text::BasicType& type) {
    const std::uint32_t count = type.rows * type.columns;
    if (count == 1)
        return {read_number(value, type)};
    const std::vector<JsonValue> items = value.items();
    if (items.size() != count)
        value.fail(fmt::format("{} numbers; expected the {} of {}{}", items.size(), count, type_text(type),
                               type.columns > 1 ? ", column by column" : ""));
    Words words;
    for (const JsonValue& item : items)
        words.push_back(read_number(item, type));
    return words;
}

template <class Value> UniformValue of_words(const Words& words) {
    Value value{};
    static_assert(sizeof value % sizeof(std::uint32_t) == 0);
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof value);
    return value;
}

UniformValue value_of(const Words& words, const text::BasicType& type, const JsonValue& place) {
    if (type.is_boolean && type.rows == 1)
        return words.front() != 0;
    if (type.columns > 1 && type.rows == type.columns && type.is_real)
        return type.rows == 2   ? of_words<glm::mat2>(words)
               : type.rows == 3 ? of_words<glm::mat3>(words)
                                : of_words<glm::mat4>(words);
    if (type.columns == 1 && !type.is_boolean)
        switch (type.rows) {
        case 1:
            return type.is_real     ? of_words<float>(words)
                   : type.is_signed ? of_words<int>(words)
                                    : of_words<unsigned>(words);
        case 2:
            return type.is_real     ? of_words<glm::vec2>(words)
                   : type.is_signed ? of_words<glm::ivec2>(words)
                                    : of_words<glm::uvec2>(words);
        case 3:
            return type.is_real     ? of_words<glm::vec3>(words)
                   : type.is_signed ? of_words<glm::ivec3>(words)
                                    : of_words<glm::uvec3>(words);
        default:
            return type.is_real     ? of_words<glm::vec4>(words)
                   : type.is_signed ? of_words<glm::ivec4>(words)
                                    : of_words<glm::uvec4>(words);
        }
    place.fail(fmt::format("is of a uniform {}; expected numbers, vectors of numbers, square matrices or bool",
                           type_text(type)));
}

/// A number that grows.
std::function<UniformValue(int)> growing(const JsonValue& value, const text::BasicType& type) {
    value.check_keys({"frame", "from"});
    if (type.rows * type.columns != 1 || type.is_boolean)
        value.fail(fmt::format("is a number, but the uniform is {}", type_text(type)));
    const auto number = [&](const JsonValue& one) {
        return type.is_real ? double{one.number()}
                            : static_cast<double>(one.integer(std::numeric_limits<std::int32_t>::min(),
                                                              std::numeric_limits<std::int32_t>::max()));
    };
    const double step = number(value.at("frame"));
    const auto from = value.find("from");
    return [step, start = from ? number(*from) : 0.0, type](int frame) {
        const Words words{word_of(start + step * frame, scalar_of(type))};
        return type.is_real     ? of_words<float>(words)
               : type.is_signed ? of_words<int>(words)
                                : of_words<unsigned>(words);
    };
}

std::function<UniformValue(int)> source_of(const JsonValue& value, const text::BasicType& type) {
    if (value.is_object() && value.find("frames")) {
        value.check_keys({"frames"});
        const JsonValue frames = value.at("frames");
        std::vector<UniformValue> values;
        for (const JsonValue& one : frames.items())
            values.push_back(value_of(read_value(one, type), type, one));
        if (values.empty())
            frames.fail("has no value; expected one a frame, the last of which stays");
        return [values](int frame) { return values[std::min(static_cast<std::size_t>(frame), values.size() - 1)]; };
    }
    if (value.is_object())
        return growing(value, type);
    return [one = value_of(read_value(value, type), type, value)](int) { return one; };
}

} // namespace

void UniformValues::add(const std::string& name, const text::BasicType& type, const JsonValue& value) {
    if (type.elements == 0) {
        by_name_[name] = source_of(value, type);
        return;
    }
    const std::vector<JsonValue> items = value.items();
    if (items.size() != type.elements)
        value.fail(fmt::format("{} elements; expected {}, as the shader declares", items.size(), type.elements));
    text::BasicType element = type;
    element.elements = 0;
    for (std::size_t k = 0; k < items.size(); ++k)
        by_name_[fmt::format("{}[{}]", name, k)] = source_of(items[k], element);
}

void UniformValues::rename(const std::string& name, const std::string& other) {
    std::map<std::string, std::function<UniformValue(int frame)>> more;
    for (const auto& [known, value] : by_name_)
        if (known == name || known.starts_with(name + "["))
            more.emplace(other + known.substr(name.size()), value);
    by_name_.merge(more);
}

Uniforms UniformValues::at(int frame) const {
    Uniforms all;
    for (const auto& [name, value] : by_name_)
        all[name] = value(frame);
    return all;
}

} // namespace lockstep::check_file
