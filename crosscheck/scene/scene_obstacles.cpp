#include "crosscheck/scene/scene_obstacles.hpp"

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/scene/surface.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t most_segments = 512;

/// `before`: triangles of the obstacles before this one.
void expect_room(const JsonValue& json, std::size_t before, std::size_t triangles) {
    if (before + triangles > most_triangles)
        json.fail(
            fmt::format("{} triangles up to here; a scene has at most {} (lockstep-decimate makes smaller meshes)",
                        before + triangles, most_triangles));
}

void check_keys(const JsonValue& json, std::span<const std::string_view> others,
                std::initializer_list<std::string_view> own) {
    std::vector<std::string_view> all(own);
    all.insert(all.end(), others.begin(), others.end());
    json.check_keys(all);
}

Surface read_surface(const JsonValue& json, Placement& placement, const std::optional<std::filesystem::path>& folder,
                     std::size_t before, std::span<const std::string_view> others) {
    const auto real = [&](std::string_view key) { return static_cast<double>(json.at(key).number(number::positive)); };
    const auto segments = [&](int otherwise) {
        const auto value = json.find("segments");
        return value ? static_cast<int>(value->integer(4, most_segments)) : otherwise;
    };
    switch (json.at("shape").choice({"mesh", "plane", "box", "sphere", "torus"})) {
    case 0: {
        check_keys(json, others, {"shape", "file", "height", "position", "rotate_y"});
        const JsonValue file = json.at("file");
        if (!folder)
            file.fail("no mesh file is read here; give its triangles beside the scene");
        const auto path = (*folder / file.text()).lexically_normal();
        placement.height = real("height");
        const Surface surface = [&] {
            try {
                return load_surface(path);
            } catch (const Error& error) {
                file.fail(error.what());
            }
        }();
        expect_room(json, before, surface.indices.size() / 3);
        return surface;
    }
    case 1: {
        check_keys(json, others, {"shape", "size", "position", "rotate_y"});
        const JsonValue size = json.at("size");
        const std::vector<JsonValue> sides = size.items();
        if (sides.size() != 2)
            size.fail("the size of a plane is two numbers above 0, [x, z]");
        expect_room(json, before, 2);
        return plane_surface(sides[0].number(number::positive), sides[1].number(number::positive));
    }
    case 2: {
        check_keys(json, others, {"shape", "size", "position", "rotate_y"});
        const JsonValue size = json.at("size");
        const glm::vec3 sides = size.vector();
        for (const JsonValue& side : size.items())
            static_cast<void>(side.number(number::positive));
        expect_room(json, before, 12);
        return box_surface(sides);
    }
    case 3: {
        check_keys(json, others, {"shape", "radius", "segments", "position", "rotate_y"});
        const int n = segments(16);
        expect_room(json, before, static_cast<std::size_t>(8 * n * n));
        return sphere_surface(real("radius"), n);
    }
    default: {
        check_keys(json, others, {"shape", "radius", "tube_radius", "segments", "position", "rotate_y"});
        const int n = segments(48);
        expect_room(json, before, static_cast<std::size_t>(n * n));
        return torus_surface(real("radius"), real("tube_radius"), n);
    }
    }
}

} // namespace

void read_obstacle(const JsonValue& json, const std::optional<std::filesystem::path>& folder, Mesh& mesh,
                   std::span<const std::string_view> others) {
    Placement placement;
    const Surface surface = read_surface(json, placement, folder, mesh.triangle_count(), others);
    if (const auto position = json.find("position"))
        placement.position = position->vector();
    if (const auto angle = json.find("rotate_y"))
        placement.rotate_y = angle->number();
    try {
        place(surface, placement, mesh);
    } catch (const Error& error) {
        json.fail(error.what());
    }
}

Mesh read_obstacles(const JsonValue& json, const std::optional<std::filesystem::path>& folder) {
    Mesh mesh;
    for (const JsonValue& obstacle : json.items())
        read_obstacle(obstacle, folder, mesh);
    return mesh;
}

} // namespace lockstep
