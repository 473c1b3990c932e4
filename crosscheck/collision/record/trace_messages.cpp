#include "crosscheck/collision/record/trace_messages.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/asked_memory.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/record/layout.hpp"
#include "crosscheck/record/root_offsets.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "crosscheck/scene/scene_obstacles.hpp"
#include "crosscheck/scene/scene_settings.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t largest_mesh = 3 * most_triangles * sizeof(glm::vec3); // bytes
constexpr std::int64_t most_trace_frames = 100'000'000;

/// The scene without start and stored obstacles.
Scene read_scene(const JsonValue& contents, const std::string& file) {
    const std::string text = contents.at("scene").text();
    const std::string name = fmt::format("{}: {}", file, layout::scene);
    if (text.empty())
        throw Error(fmt::format("{}: missing; right is the text of a scene file", name));
    const nlohmann::json document = parse_json(text, name);
    const JsonValue json(document, name);
    json.check_keys(scene_keys);
    Scene scene;
    read_settings(json, {}, {}, scene);
    if (const auto velocity = contents.find("has_velocity"); velocity && velocity->integer(0, 1) == 1)
        scene.switches.velocity = Velocity::vector;
    check_switches(scene.switches);
    scene.name = contents.at("name").label();
    if (scene.name.empty())
        scene.name = "trace";
    if (const auto obstacles = json.find("obstacles"); obstacles && !contents.at("has_obstacles").integer(0, 1))
        scene.obstacles = read_obstacles(*obstacles, std::nullopt);
    return scene;
}

std::optional<Profile> read_recorded_profile(const JsonValue& contents, const std::string& file) {
    const std::string text = contents.at("profile").text();
    if (text.empty())
        return {};
    const std::string name = fmt::format("{}: {}", file, layout::profile);
    const nlohmann::json document = parse_json(text, name);
    return read_profile(JsonValue(document, name));
}

void check_obstacles(const Mesh& mesh, const std::string& file) {
    const auto finite = [](glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), finite))
        throw Error(fmt::format("{}: {}: holds a coordinate that is not finite", file, layout::obstacle_positions));
    if (mesh.indices.size() % 3 != 0)
        throw Error(fmt::format("{}: {}: no whole number of triangles", file, layout::obstacle_triangles));
    const auto beyond = std::find_if(mesh.indices.begin(), mesh.indices.end(),
                                     [&](std::uint32_t index) { return index >= mesh.positions.size(); });
    if (beyond != mesh.indices.end())
        throw Error(fmt::format("{}: {}: names corner {}, there are {}", file, layout::obstacle_triangles, *beyond,
                                mesh.positions.size()));
}

void check_frames(const TraceInfo& info) {
    const std::vector<FrameSettings>& frames = info.scene.frames;
    if (!frames.empty() && frames.back().frame >= info.frames)
        throw Error(fmt::format("{}: {}: /frames/{}: frame {}; {} were recorded, counted from 0", info.file,
                                layout::scene, frames.size() - 1, frames.back().frame, info.frames));
}

void check_cdt_size(const JsonValue& contents, const Scene& scene, const std::string& file) {
    const auto width = contents.at("cdt_width").integer(1, INT32_MAX);
    const auto height = contents.at("cdt_height").integer(1, INT32_MAX);
    if (width != scene.width || height != cdt_height(scene))
        throw Error(fmt::format("{}: {}: is {}x{} texels, the scene's is {}x{}", file, layout::cdt, width, height,
                                scene.width, cdt_height(scene)));
}

} // namespace

TraceInfo read_contents(ByteSource& source, const std::string& file, std::uint64_t file_bytes) {
    Messages messages(source, file);
    const std::string text = messages.text(messages.expect(MessageKind::contents));
    const nlohmann::json document = parse_json(text, file);
    const JsonValue contents(document, file);
    TraceInfo info;
    info.file = file;
    info.frames = static_cast<int>(contents.at("rows").integer(2, most_trace_frames + 1) - 1);
    const auto particles = static_cast<std::size_t>(contents.at("particles").integer(1, most_particles));
    info.renderer = contents.at("renderer").label();
    info.settings = contents.at("settings").label();
    if (const auto shaders = contents.find("shaders"))
        info.shaders = shaders->label();
    info.probe = contents.at("probe").text();
    info.program = contents.at("program").label();
    for (const JsonValue& warning : contents.at("warnings").items())
        info.warnings.push_back(warning.label());
    info.has_cdt = contents.at("has_cdt").integer(0, 1) == 1;
    if (const auto counts = contents.find("counts"))
        for (const JsonValue& count : counts->items())
            info.counts.push_back(static_cast<std::uint32_t>(count.integer(0, static_cast<std::int64_t>(particles))));
    if (!info.counts.empty() && info.counts.size() != static_cast<std::size_t>(info.frames))
        throw Error(fmt::format("{}: its reading process broke: {} counts of {} frames", file, info.counts.size(),
                                info.frames));
    info.scene = read_scene(contents, file);
    check_frames(info);
    const auto texels =
        static_cast<std::uint64_t>(info.scene.width) * static_cast<std::uint64_t>(cdt_height(info.scene));
    expect_affordable({texels, particles}, file_bytes, file);
    if (info.has_cdt)
        check_cdt_size(contents, info.scene, file);
    info.profile = read_recorded_profile(contents, file);
    if (contents.at("has_obstacles").integer(0, 1) == 1) {
        info.scene.obstacles.positions = messages.values<glm::vec3>(MessageKind::positions, largest_mesh);
        info.scene.obstacles.indices = messages.values<std::uint32_t>(MessageKind::triangles, largest_mesh);
        check_obstacles(info.scene.obstacles, file);
    }
    if (contents.at("has_roots").integer(0, 1) == 1) {
        const RootOffsets offsets{messages.values<std::int8_t>(MessageKind::reciprocals, reciprocal_count),
                                  messages.values<std::int8_t>(MessageKind::inverse_sqrts, inverse_sqrt_count)};
        if (offsets.reciprocal.size() != reciprocal_count || offsets.inverse_sqrt.size() != inverse_sqrt_count)
            messages.fail("its reading process broke: tables of another size");
        if (info.profile)
            info.profile->roots = std::make_shared<const RootTables>(root_tables(offsets));
    }
    info.scene.start.resize(particles);
    read_particles(source, file, 0, info.scene.start);
    return info;
}

void read_particles(ByteSource& source, const std::string& file, std::uint32_t row, Particles& particles) {
    Messages messages(source, file);
    const WritableView state = view(particles);
    if (messages.expect(MessageKind::particles, row) != particles.size() * item_bytes(state.about()))
        messages.fail("its reading process broke: another number of particles");
    for (std::size_t f = 0; f < state.columns.size(); ++f)
        messages.fill(state.columns[f],
                      state.count() * static_cast<std::size_t>(state.fields()[f].components) * sizeof(std::uint32_t));
}

void read_cdt(ByteSource& source, const std::string& file, std::uint32_t frame, CollisionImage& cdt) {
    Messages messages(source, file);
    if (messages.expect(MessageKind::cdt, frame) != cdt.texels.size() * sizeof(glm::vec4))
        messages.fail("its reading process broke: a CDT of another size");
    messages.fill(cdt.texels);
}

} // namespace lockstep
