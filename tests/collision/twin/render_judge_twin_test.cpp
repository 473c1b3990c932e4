#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/matrix.hpp>

#include "crosscheck/collision/judge/render_judge.hpp"
#include "crosscheck/judge/legal.hpp"
#include "gpu/collision/render_pass.hpp"
#include "tests/collision/twin/llvmpipe.hpp"
#include "tests/collision/twin/random_scenes.hpp"
#include "tests/planted_shader.hpp"

namespace lockstep::test::render_judge_twin_test {
namespace {

/// What a frame is drawn of.
struct Frame {
    Particles particles, earlier;
    Mesh obstacles;
    FrameParams params, earlier_params;
};

/// Spheres that overlap each other and triangles, some of them twice at one place.
Frame crowded_frame() {
    test::RandomScenes scenes(12);
    Frame frame;
    frame.particles = scenes.particles(500, 1.1F);
    for (std::size_t i = 0; i < 40; ++i)
        frame.particles.position[i] = frame.particles.position[i + 40];
    frame.earlier = frame.particles;
    for (glm::vec3& position : frame.earlier.position)
        position.y += 0.02F;
    frame.obstacles = scenes.triangles(30, 1.0F, 0.5F);
    Camera camera;
    frame.params.render_width = 160;
    frame.params.render_height = 120;
    frame.params.constants.billboard_radius = 0.06F;
    frame.params.render_view = view_matrix(camera);
    frame.params.render_projection = projection_matrix(camera, 160.0F / 120.0F);
    frame.earlier_params = frame.params;
    camera.eye.x += 0.05F;
    frame.earlier_params.render_view = view_matrix(camera);
    return frame;
}

ColorImage drawn(const Frame& frame, const std::filesystem::path& shaders = {}) {
    RenderPass pass(frame.params.switches, shaders, frame.params.render_width, frame.params.render_height);
    ParticleBuffer buffer(frame.particles.size());
    buffer.upload(frame.particles);
    pass.run(buffer, MeshBuffer(frame.obstacles), frame.params);
    ColorImage image;
    pass.read(image);
    return image;
}

RenderVerdict judged(const Frame& frame, const ColorImage& gpu, Legal legal = Legal::measured) {
    const Profile profile = test::llvmpipe_profile();
    return judge_render({frame.particles, frame.obstacles, frame.params, &frame.earlier, &frame.earlier_params},
                        profile, known_operations(legal, profile), gpu);
}

/// Texts of shipped shaders, and what stands there instead.
struct Plant {
    const char* file;
    const char* text;
    const char* replacement;
};

struct Mutant {
    const char* cause; ///< empty: none of those with a name
    std::vector<Plant> plants;
};

constexpr const char* frag = "render_pass.frag";
constexpr const char* geom = "render_pass.geom";
constexpr const char* shading = "shading.glsl";
constexpr const char* colored = "quantised(particle_color(normal,";
constexpr const char* corner =
    "gl_Position = vec4((i & 1) == 0 ? low.x : high.x, i < 2 ? low.y : high.y, low.z, low.w);";

std::vector<Mutant> mutants() {
    return {
        {"sprites_not_drawn", {{geom, "EmitVertex();", ";"}}},
        {"sprites_not_drawn", {{frag, "void main() {", "void main() {\n    if (true) discard;"}}},
        {"sprites_not_drawn", {{geom, "if (!is_visible(low, high))", "if (is_visible(low, high))"}}},
        {"sprites_not_drawn", {{frag, "gl_FragDepth = clamp_to(depth, 1.0)", "gl_FragDepth = 1.0"}}},
        {"sprites_half_size",
         {{geom, "void main() {", "#define u_BillboardRadius (0.5 * u_BillboardRadius)\nvoid main() {"}}},
        {"sprites_twice_size",
         {{geom, "void main() {", "#define u_BillboardRadius (2.0 * u_BillboardRadius)\nvoid main() {"}}},
        {"quads_half_size",
         {{geom, corner,
           "vec2 m = (low.xy + high.xy) * 0.5, h = (high.xy - low.xy) * 0.25;\n"
           "gl_Position = vec4((i & 1) == 0 ? m.x - h.x : m.x + h.x, i < 2 ? m.y - h.y : m.y + h.y, low.zw);"}}},
        {"sphere_twice_size", {{geom, "(window_high - window_low) * 0.5", "window_high - window_low"}}},
        {"radius_in_clip_space",
         {{geom, "vec4 low = ls_transform(u_Projection, low_corner);",
           "vec4 c = ls_transform(u_Projection, centre), low = vec4(c.xy - u_BillboardRadius, c.zw);"},
          {geom, "vec4 high = ls_transform(u_Projection, high_corner);",
           "vec4 high = vec4(c.xy + u_BillboardRadius, c.zw);"}}},
        {"radius_in_ndc",
         {{geom, "vec4 low = ls_transform(u_Projection, low_corner);",
           "vec4 c = ls_transform(u_Projection, centre), low = vec4(c.xy - c.w * u_BillboardRadius, c.zw);"},
          {geom, "vec4 high = ls_transform(u_Projection, high_corner);",
           "vec4 high = vec4(c.xy + c.w * u_BillboardRadius, c.zw);"}}},
        {"square_on_centre",
         {{geom, "centre.y - u_BillboardRadius", "centre.y"},
          {geom, "centre.y + u_BillboardRadius", "centre.y + 2.0 * u_BillboardRadius"}}},
        {"square_below_centre",
         {{geom, "centre.y - u_BillboardRadius", "centre.y - 2.0 * u_BillboardRadius"},
          {geom, "centre.y + u_BillboardRadius", "centre.y"}}},
        {"square_right_of_centre",
         {{geom, "centre.x - u_BillboardRadius", "centre.x"},
          {geom, "centre.x + u_BillboardRadius", "centre.x + 2.0 * u_BillboardRadius"}}},
        {"square_left_of_centre",
         {{geom, "centre.x - u_BillboardRadius", "centre.x - 2.0 * u_BillboardRadius"},
          {geom, "centre.x + u_BillboardRadius", "centre.x"}}},
        {"normal_x_and_y_swapped", {{frag, colored, "quantised(particle_color(normal.yxz,"}}},
        {"disc_of_half_area", {{frag, "if (!in_unit_interval(squared))", "if (!(squared <= 0.5))"}}},
        {"heat_divided_twice",
         {{shading, "ls_divide(collide_time, collision_time)",
           "ls_divide(ls_divide(collide_time, collision_time), collision_time)"}}},
        {"sphere_ambient_added", {{shading, "0.3125 + 0.6875 * lambert", "0.3125 + lambert"}}},
        {"obstacle_normal_not_normalised",
         {{shading, "ls_divide(written_dot(normal, light), ls_sqrt(squared))", "written_dot(normal, light)"}}},
        {"obstacles_shaded_in_world_space",
         {{"render_obstacles.vert", "v_Position = ls_transform(u_View, a_Position).xyz", "v_Position = a_Position"},
          {"render_obstacles.vert", "ls_transform(u_Projection, v_Position)",
           "ls_transform(u_Projection, ls_transform(u_View, a_Position).xyz)"}}},
        {"radius_halved",
         {{geom, "void main() {", "#define u_BillboardRadius (0.5 * u_BillboardRadius)\nvoid main() {"},
          {frag, "void main() {", "#define u_BillboardRadius (0.5 * u_BillboardRadius)\nvoid main() {"}}},
        {"radius_doubled",
         {{geom, "void main() {", "#define u_BillboardRadius (2.0 * u_BillboardRadius)\nvoid main() {"},
          {frag, "void main() {", "#define u_BillboardRadius (2.0 * u_BillboardRadius)\nvoid main() {"}}},
        {"sprites_square", {{frag, "if (!in_unit_interval(squared))\n        discard;", ""}}},
        {"sprites_square_and_flat",
         {{frag, "if (!in_unit_interval(squared))\n        discard;", ""},
          {frag, "rest = 1.0 - squared", "rest = max(1.0 - squared, 0.0)"}}},
        {"depth_reversed",
         {{frag, "clamp_to(depth, 1.0)", "1.0 - clamp_to(depth, 1.0)"},
          {"render_obstacles.frag", "gl_FragDepth = fragment.depth", "gl_FragDepth = 1.0 - fragment.depth"}}},
        {"sphere_is_flat_in_depth", {{frag, "g_Centre.z + normal.z * u_BillboardRadius", "g_Centre.z"}}},
        {"sphere_is_flat_in_depth", {{frag, "    gl_FragDepth = clamp_to(depth, 1.0);\n", ""}}},
        {"sphere_reversed_in_depth", {{frag, "g_Centre.z + normal.z", "g_Centre.z - normal.z"}}},
        {"normal_flipped", {{frag, colored, "quantised(particle_color(-normal,"}}},
        {"normal_x_flipped", {{frag, colored, "quantised(particle_color(vec3(-normal.x, normal.yz),"}}},
        {"normal_y_flipped", {{frag, colored, "quantised(particle_color(vec3(normal.x, -normal.y, normal.z),"}}},
        {"normal_z_flipped", {{frag, colored, "quantised(particle_color(vec3(normal.xy, -normal.z),"}}},
        {"half_pixel_off", {{frag, "(floor(gl_FragCoord.xy) + 0.5)", "floor(gl_FragCoord.xy)"}}},
        {"half_pixel_further", {{frag, "(floor(gl_FragCoord.xy) + 0.5)", "(floor(gl_FragCoord.xy) + 1.0)"}}},
        {"disc_half_size", {{frag, "if (!in_unit_interval(squared))", "if (!(squared <= 0.25))"}}},
        {"sphere_root_left_out", {{frag, "vec3(dx, dy, ls_sqrt(rest))", "vec3(dx, dy, rest)"}}},
        {"sphere_z_is_one", {{frag, "vec3(dx, dy, ls_sqrt(rest))", "vec3(dx, dy, 1.0)"}}},
        {"sphere_depth_by_diameter", {{frag, "normal.z * u_BillboardRadius", "normal.z * (2.0 * u_BillboardRadius)"}}},
        {"sphere_depth_without_radius", {{frag, "normal.z * u_BillboardRadius", "normal.z"}}},
        {"sprite_depth_not_halved", {{frag, "ls_divide(clip.z, clip.w) * 0.5 + 0.5", "ls_divide(clip.z, clip.w)"}}},
        {"sprite_depth_zero", {{frag, "gl_FragDepth = clamp_to(depth, 1.0)", "gl_FragDepth = 0.0"}}},
        {"sprite_red_and_green_swapped", {{frag, "u_CollisionTime));", "u_CollisionTime)).grba;"}}},
        {"sprite_green_and_blue_swapped", {{frag, "u_CollisionTime));", "u_CollisionTime)).rbga;"}}},
        {"sprite_colours_squared",
         {{shading, "    return shaded;", "    precise vec3 squares = shaded * shaded;\n    return squares;"}}},
        {"sprite_colours_rooted",
         {{shading, "    return shaded;",
           "    return vec3(ls_sqrt(shaded.r), ls_sqrt(shaded.g), ls_sqrt(shaded.b));"}}},
        {"codes_truncated", {{shading, "* 255.0 + 0.5;", "* 255.0;"}}},
        {"codes_of_256", {{shading, "* 255.0 + 0.5;", "* 256.0;\n    code = min(code, 255.0);"}}},
        {"speed_quartered", {{shading, "share(speed * 0.5)", "share(speed * 0.25)"}}},
        {"speed_doubled", {{shading, "share(speed * 0.5)", "share(speed * 2.0)"}}},
        {"speed_colours_swapped", {{shading, "fast = share(speed * 0.5)", "fast = 1.0 - share(speed * 0.5)"}}},
        {"heat_not_divided", {{shading, "ls_divide(collide_time, collision_time)", "collide_time"}}},
        {"heat_reversed",
         {{shading, "share(ls_divide(collide_time, collision_time))",
           "1.0 - share(ls_divide(collide_time, collision_time))"}}},
        {"heat_whole", {{shading, "share(ls_divide(collide_time, collision_time))", "1.0"}}},
        {"sphere_lit_from_behind_too",
         {{shading, "share(written_dot(normal, light))", "share(abs(written_dot(normal, light)))"}}},
        {"sphere_lambert_wrapped",
         {{shading, "share(written_dot(normal, light))", "share(written_dot(normal, light) * 0.5 + 0.5)"}}},
        {"sphere_ambient_missing", {{shading, "lit = 0.3125 + 0.6875 * lambert", "lit = 0.6875 * lambert"}}},
        {"gleam_of_fourth_power", {{shading, "gleam = 0.25 * (fourth * fourth)", "gleam = 0.25 * fourth"}}},
        {"gleam_of_square", {{shading, "gleam = 0.25 * (fourth * fourth)", "gleam = 0.25 * (lambert * lambert)"}}},
        {"gleam_of_sixteenth_power",
         {{shading, "gleam = 0.25 * (fourth * fourth)", "gleam = 0.25 * ((fourth * fourth) * (fourth * fourth))"}}},
        {"gleam_not_weakened", {{shading, "gleam = 0.25 * (fourth * fourth)", "gleam = fourth * fourth"}}},
        {"gleam_doubled", {{shading, "gleam = 0.25 *", "gleam = 0.5 *"}}},
        {"gleam_halved", {{shading, "gleam = 0.25 *", "gleam = 0.125 *"}}},
        {"background_bottom_alone", {{shading, "float up = ls_divide(", "float up = 0.0 * ls_divide("}}},
        {"background_top_alone", {{shading, "float up = ls_divide(", "float up = 1.0 + 0.0 * ls_divide("}}},
        {"background_half_pixel_off",
         {{shading, "ls_divide(float(2 * y + 1), float(2 * height))", "ls_divide(float(y), float(height))"}}},
        {"background_to_last_row",
         {{shading, "ls_divide(float(2 * y + 1), float(2 * height))", "ls_divide(float(y), float(height - 1))"}}},
        {"obstacle_light_x_flipped",
         {{shading, "ls_divide(written_dot(normal, light), ls_sqrt(squared))",
           "ls_divide(written_dot(normal, vec3(-light.x, light.yz)), ls_sqrt(squared))"}}},
        {"obstacle_light_y_flipped",
         {{shading, "ls_divide(written_dot(normal, light), ls_sqrt(squared))",
           "ls_divide(written_dot(normal, vec3(light.x, -light.y, light.z)), ls_sqrt(squared))"}}},
        {"obstacle_light_z_flipped",
         {{shading, "ls_divide(written_dot(normal, light), ls_sqrt(squared))",
           "ls_divide(written_dot(normal, vec3(light.xy, -light.z)), ls_sqrt(squared))"}}},
        {"obstacle_lambert_not_wrapped",
         {{shading, "0.125 + 0.875 * (wrapped * wrapped)", "0.125 + 0.875 * share(lambert)"}}},
        {"obstacle_lambert_squared",
         {{shading, "0.125 + 0.875 * (wrapped * wrapped)", "0.125 + 0.875 * (share(lambert) * share(lambert))"}}},
        {"background_smoothed",
         {{shading, "return blend(vec3(0.1875, 0.203125, 0.234375), vec3(0.046875, 0.0546875, 0.078125), up);",
           "return blend(vec3(0.1875, 0.203125, 0.234375), vec3(0.046875, 0.0546875, 0.078125), "
           "smoothstep(0.0, 1.0, up));"}}},
        {"obstacle_wrap_not_squared", {{shading, "0.125 + 0.875 * (wrapped * wrapped)", "0.125 + 0.875 * wrapped"}}},
        {"obstacle_ambient_missing", {{shading, "0.125 + 0.875 * (wrapped * wrapped)", "0.875 * (wrapped * wrapped)"}}},
        {"colour_swapped", {{shading, "vec4(floor(code) / 255.0, 1.0)", "vec4(floor(code.bgr) / 255.0, 1.0)"}}},
        {"sprite_colour_swapped", {{frag, "u_CollisionTime));", "u_CollisionTime)).bgra;"}}},
        {"alpha_missing", {{shading, "vec4(floor(code) / 255.0, 1.0)", "vec4(floor(code) / 255.0, 0.0)"}}},
        {"sprite_alpha_missing", {{frag, "u_CollisionTime));", "u_CollisionTime)) * vec4(1.0, 1.0, 1.0, 0.0);"}}},
        {"colour_of_speed_missing", {{shading, "fast = share(speed * 0.5)", "fast = 0.0"}}},
        {"speed_not_halved", {{shading, "fast = share(speed * 0.5)", "fast = share(speed)"}}},
        {"colour_of_collision_missing", {{shading, "heat = collide_time > 0.0 ?", "heat = false ?"}}},
        {"sphere_unlit", {{shading, "lambert = share(written_dot(normal, light))", "lambert = 1.0"}}},
        {"gleam_missing", {{shading, "gleam = 0.25", "gleam = 0.0"}}},
        {"glow_missing", {{shading, "glow = lit + heat * (0.5 * (1.0 - lit))", "glow = lit"}}},
        {"background_flipped", {{shading, "up = ls_divide(float(2 * y + 1)", "up = 1.0 - ls_divide(float(2 * y + 1)"}}},
        {"background_black",
         {{"render_background.frag", "o_Color = quantised(", "o_Color = vec4(0.0, 0.0, 0.0, 1.0) + 0.0 * quantised("}}},
        {"background_not_drawn", {{"render_background.frag", "void main() { ", "void main() { if (true) discard; "}}},
        {"obstacles_not_drawn", {{"whole_triangle.glsl", "    EmitVertex();", ""}}},
        {"obstacles_unlit",
         {{shading, "squared > 0.0 ? ls_divide(written_dot(normal, light), ls_sqrt(squared)) : 0.0", "1.0"}}},
        {"obstacles_lit_from_one_side",
         {{shading, "    if (written_dot(normal, corner[0]) > 0.0)\n        normal = -normal;\n", ""}}},
        {"obstacle_normal_flipped",
         {{shading, "written_dot(normal, corner[0]) > 0.0", "written_dot(normal, corner[0]) < 0.0"}}},
        {"sprite_width_and_height_swapped",
         {{geom, "window_place(low.xy, low.w)",
           "window_place(low.xy, low.w) / vec2(u_ClientWidth, u_ClientHeight) * "
           "vec2(u_ClientHeight, u_ClientWidth)"},
          {geom, "window_place(high.xy, low.w)",
           "window_place(high.xy, low.w) / vec2(u_ClientWidth, u_ClientHeight) * "
           "vec2(u_ClientHeight, u_ClientWidth)"}}},
        {"", {{shading, "vec3(0.125, 0.40625, 0.875)", "vec3(0.25, 0.40625, 0.875)"}}},
        {"", {{shading, "vec3(0.8125, 0.78125, 0.734375)", "vec3(0.8125, 0.75, 0.734375)"}}},
    };
}

} // namespace

TEST_CASE("render judge: mutants of the render shaders are divergent, with their cause") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Frame frame = crowded_frame();
    int named = 0, with_name = 0;
    for (const Mutant& mutant : mutants()) {
        const test::TemporaryFolder folder;
        for (const Plant& plant : mutant.plants)
            test::plant(folder, plant.file, plant.text, plant.replacement);
        const RenderVerdict verdict = judged(frame, drawn(frame, folder.path()));
        INFO(mutant.cause << ": " << mutant.plants[0].file << ", " << mutant.plants[0].replacement);
        INFO("divergent " << verdict.count(DifferenceClass::divergent) << ", rest "
                          << verdict.differing - verdict.count(DifferenceClass::divergent));
        CHECK(verdict.count(DifferenceClass::divergent) > 0);
        CHECK(verdict.first.has_value());
        const std::string first = verdict.causes.empty() ? "" : std::string(verdict.causes.front().name);
        CHECK(first == mutant.cause);
        with_name += *mutant.cause != 0 ? 1 : 0;
        named += *mutant.cause != 0 && first == mutant.cause ? 1 : 0;
    }
    CHECK(with_name >= 20);
    CHECK(10 * named >= 9 * with_name);
}

TEST_CASE("render judge: faults of a host are divergent, with their cause") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Frame right = crowded_frame();
    const auto flipped = [](ColorImage image) {
        for (int y = 0; y < image.height / 2; ++y)
            for (int x = 0; x < image.width; ++x)
                std::swap(image.at(x, y), image.at(x, image.height - 1 - y));
        return image;
    };
    const std::pair<const char*, std::function<ColorImage(Frame)>> faults[] = {
        {"frame_not_drawn", [](const Frame& f) { return ColorImage(f.params.render_width, f.params.render_height); }},
        {"only_background_drawn", [](Frame f) { return f.particles = {}, f.obstacles = {}, drawn(f); }},
        {"obstacles_not_drawn", [](Frame f) { return f.obstacles = {}, drawn(f); }},
        {"y_flipped", [&](const Frame& f) { return flipped(drawn(f)); }},
        {"view_transposed",
         [](Frame f) { return f.params.render_view = glm::transpose(f.params.render_view), drawn(f); }},
        {"view_of_earlier_frame",
         [](Frame f) { return f.params.render_view = f.earlier_params.render_view, drawn(f); }},
        {"state_of_earlier_frame", [](Frame f) { return f.particles = f.earlier, drawn(f); }},
        {"radius_halved", [](Frame f) { return f.params.constants.billboard_radius *= 0.5F, drawn(f); }},
    };
    for (const auto& [cause, draw] : faults) {
        const RenderVerdict verdict = judged(right, draw(right));
        INFO(cause);
        CHECK(verdict.count(DifferenceClass::divergent) > 0);
        CHECK((verdict.causes.empty() ? "" : verdict.causes.front().name) == cause);
    }
}

TEST_CASE("render judge: the shipped shaders agree, and a driver that rounds otherwise is legal") {
    const auto context = test::open_llvmpipe();
    if (!context)
        return;
    const Frame frame = crowded_frame();
    CHECK(judged(frame, drawn(frame)).differing == 0);
    CHECK(judged(frame, drawn(frame), Legal::glsl).differing == 0);
    std::uint64_t differing = 0;
    for (const char* error : {"1.00000012", "0.99999988"}) {
        const test::TemporaryFolder folder;
        test::plant(folder, "plain.glsl", "precise float quotient = a / b;",
                    fmt::format("precise float quotient = (a / b) * {};", error).c_str());
        test::plant(folder, "plain.glsl", "precise float root = sqrt(a);",
                    fmt::format("precise float root = sqrt(a) * {};", error).c_str());
        const RenderVerdict verdict = judged(frame, drawn(frame, folder.path()), Legal::glsl);
        differing += verdict.differing;
        CHECK(verdict.count(DifferenceClass::divergent) == 0);
        CHECK(verdict.count(DifferenceClass::undefined) == 0);
        CHECK(passes(verdict, false));
    }
    CHECK(differing > 0);
}

} // namespace lockstep::test::render_judge_twin_test
