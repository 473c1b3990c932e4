#include <cstddef>
#include <cstdint>
#include <string_view>

#include "crosscheck/collision/record/capsule_json.hpp"
#include "reference/model/error.hpp"

using namespace lockstep;

/// Reads a capsule, judges it, and writes its text. Large images and wide searches only cost time, so they are left
/// out.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const nlohmann::json document = parse_json({reinterpret_cast<const char*>(data), size}, "capsule");
        const JsonValue json(document, "capsule");
        const auto settings = json.find("settings");
        if (!settings || !settings->find("image") || json.find("roots").value_or(json).find("reciprocal"))
            return 0;
        for (const JsonValue& side : settings->at("image").items())
            static_cast<void>(side.integer(1, 64));
        const Capsule capsule = read_capsule(json);
        if (capsule.scene.constants.texel_collide_range <= 2)
            static_cast<void>(capsule_text(capsule, NumberFormat::hexadecimal));
    } catch (const Error&) { // what a reader says of a bad file
    }
    return 0;
}
