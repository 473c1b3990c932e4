#include "crosscheck/report/value_text.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/report/verdict_text.hpp"

namespace lockstep {

std::string exact_text(Value value) {
    return value.scalar == Scalar::float32 ? fmt::format("{:a}", value.real()) : std::to_string(value.integer());
}

std::string decimal_text(Value value) {
    return value.scalar == Scalar::float32 ? fmt::format("{:.9g}", value.real()) : std::to_string(value.integer());
}

std::string value_text(Value value, NumberFormat format) {
    return format == NumberFormat::hexadecimal ? exact_text(value) : decimal_text(value);
}

nlohmann::json value_json(Value value) {
    if (value.scalar != Scalar::float32)
        return value.integer();
    return std::isfinite(value.real()) ? nlohmann::json(value.real()) : nlohmann::json(fmt::format("{}", value.real()));
}

std::string distance_text(std::int64_t distance, Scalar scalar) {
    if (distance == INT64_MAX)
        return "NaN on one side";
    if (scalar != Scalar::float32)
        return grouped(static_cast<std::uint64_t>(distance)) + " apart";
    return distance == 0 ? "sign of zero" : grouped(static_cast<std::uint64_t>(distance)) + " ULP";
}

bool of_other_sign(float reference, float gpu, std::int64_t ulp) {
    constexpr std::int64_t one_octave = std::int64_t{1} << 23;
    return ulp > one_octave && ulp != INT64_MAX && std::signbit(reference) != std::signbit(gpu);
}

std::string distance_text(const Difference& difference) {
    const Value &reference = difference.reference, &gpu = difference.gpu;
    const bool signs =
        reference.scalar == Scalar::float32 && of_other_sign(reference.real(), gpu.real(), difference.ulp);
    return signs ? "other sign" : distance_text(difference.ulp, reference.scalar);
}

std::string difference_text(const Schema& schema, const Difference& difference) {
    return fmt::format("{}: reference {}, GPU {}", component_name(schema[difference.field], difference.component),
                       decimal_text(difference.reference), decimal_text(difference.gpu));
}

std::string color_text(Rgba8 c) {
    return fmt::format("#{:02x}{:02x}{:02x}{}", c.r, c.g, c.b, c.a == 255 ? "" : fmt::format(" alpha {}", c.a));
}

} // namespace lockstep
