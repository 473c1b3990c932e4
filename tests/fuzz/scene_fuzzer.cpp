#include <cstddef>
#include <cstdint>
#include <string_view>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/record/seal.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "crosscheck/scene/scene_obstacles.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/error.hpp"

using namespace lockstep;

namespace {

template <class Action> void attempt(const Action& action) {
    try {
        action();
    } catch (const Error&) { // what a reader says of a bad file
    }
}

} // namespace

/// Everything that reads a text: scene files without their particles, profiles, seals.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    attempt([&] { parse_seal(text, "seal"); });
    attempt([&] {
        const nlohmann::json document = parse_json(text, "file");
        const JsonValue json(document, "file");
        attempt([&] { read_profile(json); });
        attempt([&] {
            if (const auto obstacles = json.find("obstacles"); obstacles && obstacles->items().size() < 4)
                read_obstacles(*obstacles, std::nullopt);
        });
        Scene scene;
        read_settings(json, {}, {}, scene);
        static_cast<void>(frame_params(scene, 1));
    });
    return 0;
}
