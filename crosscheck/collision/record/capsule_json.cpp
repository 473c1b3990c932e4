#include "crosscheck/collision/record/capsule_json.hpp"

#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "crosscheck/collision/record/particle_json.hpp"
#include "crosscheck/files/asked_memory.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/record/capsule_parts.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

constexpr std::int64_t version = 1;

/// Texels that hold something: [x, y, code].
json texels_json(const CollisionImage& cdt) {
    json texels = json::array();
    for (int y = 0; y < cdt.height; ++y)
        for (int x = 0; x < cdt.width; ++x)
            if (cdt.at(x, y) != glm::vec4(0.0F))
                texels.push_back({x, y, vector_text(cdt.at(x, y))});
    return texels;
}

json entries_json(const std::vector<glm::vec3>& entries) {
    json list = json::array();
    for (const glm::vec3& entry : entries)
        list.push_back(vector_text(entry));
    return list;
}

void read_texels(const JsonValue& value, CollisionImage& cdt) {
    for (const JsonValue& texel : value.items()) {
        const std::vector<JsonValue> parts = texel.items();
        if (parts.size() != 3)
            texel.fail("not [x, y, code]");
        const auto x = static_cast<int>(parts[0].integer(0, cdt.width - 1));
        const auto y = static_cast<int>(parts[1].integer(0, cdt.height - 1));
        cdt.at(x, y) = read_vector<4>(parts[2]);
    }
}

json vertex_json(const CapturedVertex& vertex) {
    json outputs = json::array();
    for (const CapturedOutput& output : vertex.outputs)
        outputs.push_back({output.name, output.type, output.is_float ? 1 : 0, words_text(output.words)});
    return outputs;
}

CapturedVertex read_vertex(const JsonValue& value) {
    CapturedVertex vertex;
    for (const JsonValue& item : value.items()) {
        const std::vector<JsonValue> parts = item.items();
        if (parts.size() != 4)
            item.fail("not [name, type, 1 for floats, words]");
        const std::vector<std::uint32_t> words = read_words(parts[3], 0);
        const std::string type = parts[1].label();
        const bool vector = !type.empty() && type.back() >= '2' && type.back() <= '4';
        if (words.size() < (vector ? static_cast<std::size_t>(type.back() - '0') : 1))
            parts[3].fail(fmt::format("fewer values than {} has", type));
        vertex.outputs.push_back({parts[0].label(), type, parts[2].integer(0, 1) == 1, words});
    }
    return vertex;
}

json capture_json(const StepCapture& capture) {
    json neighbours = json::array();
    for (const CapturedVertex& neighbour : capture.neighbours)
        neighbours.push_back(vertex_json(neighbour));
    return {{"vertex", vertex_json(capture.vertex)},
            {"neighbours", neighbours},
            {"vertex_state", capture.vertex_state ? state_json(*capture.vertex_state) : json()},
            {"last", vertex_json(capture.last)},
            {"state", state_json(capture.state)},
            {"drawn_alone", capture.drawn_alone ? 1 : 0},
            {"position", vector_text(capture.position)},
            {"texel", {capture.texel.x, capture.texel.y}},
            {"depth", word_text(capture.depth)},
            {"code", vector_text(capture.code)}};
}

StepCapture read_capture(const JsonValue& value, const Scene& scene) {
    value.check_keys(
        {"vertex", "neighbours", "vertex_state", "last", "state", "drawn_alone", "position", "texel", "depth", "code"});
    StepCapture capture;
    capture.vertex = read_vertex(value.at("vertex"));
    for (const JsonValue& neighbour : value.at("neighbours").items())
        capture.neighbours.push_back(read_vertex(neighbour));
    if (const JsonValue state = value.at("vertex_state"); !state.is_null())
        capture.vertex_state = read_state(state);
    capture.last = read_vertex(value.at("last"));
    capture.state = read_state(value.at("state"));
    capture.drawn_alone = value.at("drawn_alone").integer(0, 1) == 1;
    capture.position = read_vector<4>(value.at("position"));
    const std::vector<JsonValue> texel = value.at("texel").items();
    if (texel.size() != 2)
        value.at("texel").fail("not [x, y]");
    capture.texel = {static_cast<int>(texel[0].integer(-1, scene.width - 1)),
                     static_cast<int>(texel[1].integer(-1, scene.height - 1))};
    if ((capture.texel.x < 0) != (capture.texel.y < 0))
        value.at("texel").fail("neither a texel nor [-1, -1]");
    capture.depth = read_float(value.at("depth"));
    capture.code = read_vector<4>(value.at("code"));
    return capture;
}

} // namespace

std::string capsule_file(const Capsule& cut) {
    Capsule capsule = cut;
    for (std::string* text : {&capsule.scene.name, &capsule.renderer, &capsule.settings})
        *text = as_utf8(*text);
    const json document{{"lockstep_capsule", version},
                        {"scene", capsule.scene.name},
                        {"settings", settings_json(capsule.scene)},
                        {"renderer", capsule.renderer},
                        {"switches", capsule.settings},
                        {"frame", capsule.frame},
                        {"particle", capsule.particle},
                        {"profile", profile_json(capsule.profile)},
                        {"roots", roots_json(capsule.profile,
                                             [&](const Profile& watched) {
                                                 Capsule looked_into = capsule;
                                                 looked_into.profile = watched;
                                                 static_cast<void>(capsule_text(looked_into, NumberFormat::decimal));
                                             })},
                        {"known", known_json(capsule.known)},
                        {"before", state_json(capsule.before)},
                        {"gpu", state_json(capsule.gpu)},
                        {"cdt", texels_json(capsule.cdt)},
                        {"entries", entries_json(capsule.entries)},
                        {"capture", capture_json(capsule.capture)}};
    const std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
    if (text.size() > largest_capsule)
        throw Error(fmt::format("particle {} in frame {}: its capsule would be {} bytes, right is at most {}; a trace "
                                "holds the whole run",
                                capsule.particle, capsule.frame, text.size(), largest_capsule));
    const json back = parse_json(text, "capsule");
    if (capsule_text(read_capsule(JsonValue(back, "capsule")), NumberFormat::hexadecimal) !=
        capsule_text(capsule, NumberFormat::hexadecimal))
        throw Error(fmt::format("particle {} in frame {}: read back, its capsule says something else; this is a bug",
                                capsule.particle, capsule.frame));
    return text;
}

Capsule read_capsule(const JsonValue& value) {
    if (!value.find("lockstep_capsule"))
        value.fail("no capsule: the key \"lockstep_capsule\" is missing");
    static_cast<void>(value.at("lockstep_capsule").integer(version, version));
    value.check_keys({"lockstep_capsule", "scene", "settings", "renderer", "switches", "frame", "particle", "profile",
                      "roots", "known", "before", "gpu", "cdt", "entries", "capture"});
    Capsule capsule;
    const JsonValue settings = value.at("settings");
    settings.check_keys(scene_keys);
    read_settings(settings, {}, {}, capsule.scene);
    capsule.scene.name = value.at("scene").label();
    capsule.renderer = value.at("renderer").label();
    capsule.settings = value.at("switches").label();
    capsule.frame = static_cast<int>(value.at("frame").integer(0, 1'000'000'000));
    capsule.particle = static_cast<std::size_t>(value.at("particle").integer(0, INT32_MAX));
    capsule.profile = read_profile(value.at("profile"));
    capsule.profile.roots = read_roots(value.at("roots"));
    capsule.known = read_known(value.at("known"));
    capsule.before = read_state(value.at("before"));
    capsule.gpu = read_state(value.at("gpu"));
    const int height = cdt_height(capsule.scene);
    const auto texels = static_cast<std::uint64_t>(capsule.scene.width) * static_cast<std::uint64_t>(height);
    expect_affordable({texels, 1}, 0, "capsule");
    capsule.cdt = CollisionImage(capsule.scene.width, height);
    read_texels(value.at("cdt"), capsule.cdt);
    if (const auto entries = value.find("entries"))
        for (const JsonValue& entry : entries->items())
            capsule.entries.push_back(read_vector<3>(entry));
    capsule.capture = read_capture(value.at("capture"), capsule.scene);
    return capsule;
}

} // namespace lockstep
