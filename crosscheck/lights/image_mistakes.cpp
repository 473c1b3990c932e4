#include "crosscheck/lights/image_mistakes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "crosscheck/lights/mistake_words.hpp"
#include "reference/lights/sites.hpp"
#include "reference/lights/wrong_drawing.hpp"
#include "reference/model/srgb_table.hpp"
#include "reference/system/encode_twin.hpp"

namespace lockstep::lights {
namespace {

void cross_product(Words value, const CameBy& run) {
    const auto& cross = run.of(site::normal_sum);
    const float along = value[0] * cross[0] + value[1] * cross[1] + value[2] * cross[2];
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = along < 0.0F ? -cross[c] : cross[c];
}
void at_most_127(Words value, const CameBy& /*run*/) { value[0] = std::min(value[0], 127.0F); }
/// Wherever the pixels lie that are drawn for a disc (shaders/pixel_box.glsl).
void in_box_of_disc(Words value, const CameBy& run) {
    const float reach = first(run, site::glow_radius) + 0.0625F;
    const bool in_box = std::abs(first(run, site::centre_x) - first(run, site::glow_x)) <= reach &&
                        std::abs(first(run, site::centre_y) - first(run, site::glow_y)) <= reach;
    value[0] = in_box ? 1.0F : 0.0F;
}
/// Of discs about a place half a pixel aside: no more pixels are drawn.
void in_box_of_disc_beside(Words value, const CameBy& run) {
    const float centre = first(run, site::centre_x) + 0.5F;
    if (std::abs(centre - first(run, site::glow_x)) > first(run, site::glow_radius) + 0.0625F)
        value[0] = 0.0F;
}
void to_0_1(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = x * 0.5F + 0.5F;
}
/// What GL makes of a number that is not rescaled.
void of_255(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = std::floor(x * 255.0F + 0.5F) / 256.0F;
}
void encoded(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = std::floor(std::pow(x, 1.0F / 2.2F) * 255.0F + 0.5F) / 256.0F;
}
void white(Words value, const CameBy& /*run*/) { std::fill(value.begin(), value.end(), 255.0F / 256.0F); }
void even_code(Words value, const CameBy& /*run*/) { value[0] = 2.0F * std::floor(value[0] / 2.0F); }
void over_256(Words value, const CameBy& /*run*/) { value[0] = std::floor(value[0] * 255.0F / 256.0F + 0.5F); }
void from_minus_1(Words value, const CameBy& /*run*/) { value[0] = value[0] * 2.0F - 1.0F; }
void by_distance(Words value, const CameBy& run) { value[0] = 1.0F - std::sqrt(first(run, site::disc)); }

// Codes of numbers from 0 to 1.
float of_line(float x) { return std::floor(255.0F * x + 0.5F); }
float of_line_of_256(float x) { return std::min(std::floor(256.0F * x), 255.0F); }
float of_power(float x) { return std::floor(255.0F * std::pow(x, 1.0F / 2.2F) + 0.5F); }
float of_inverse_power(float x) { return std::floor(255.0F * std::pow(x, 2.2F) + 0.5F); }
float of_curve(float x) { return static_cast<float>(std::floor(255.0 * srgb_curve(double{x}) + 0.5)); }
float of_curve_without_line(float x) {
    return std::max(std::floor(255.0F * (1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F) + 0.5F), 0.0F);
}

/// The number whose code by sRGB's thresholds it is.
float number_of(float code) {
    return code < 255.0F ? std::nextafter(srgb_threshold(static_cast<std::size_t>(code)), 0.0F) : 1.0F;
}
float clamped(float x) { return x > 0.0F ? std::min(x, 1.0F) : 0.0F; }
template <float (*code)(float)> void coded(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = number_of(code(clamped(x)));
}
/// Likewise where codes are rounded, not looked up.
template <float (*code)(float)> void coded_evenly(Words value, const CameBy& /*run*/) {
    for (float& x : value)
        x = code(clamped(x)) / 255.0F;
}

Mistake drawn_as(WrongDrawing how) { return {.change = Change::handed_over, .part = static_cast<int>(how)}; }

/// Where obstacles are drawn.
std::vector<NamedMistake> of_obstacles() {
    static const Mistake in_planes = mistake_at(site::in_planes, Change::always);
    static const Mistake in_front = with(mistake_at(site::in_front, Change::always), in_planes);
    static const Mistake never_flat = with(mistake_at(site::is_flat, Change::never), in_front);
    const Mistake all_covered = with(mistake_at(site::is_front, Change::always), never_flat);
    std::vector<NamedMistake> all{
        {"albedo_turned", "red and blue of the albedo are swapped", "gbuffer_pass_albedo",
         mistake_at(site::albedo, Change::xz_swapped)},
        {"depth_turned", "depth is stored from the far plane", "gbuffer_pass_depth",
         mistake_at(site::depth, Change::opposite)},
        {"normal_of_position", "the position is stored as the normal", "gbuffer_pass_normal",
         mistake_at(site::own_value, Change::never)},
        {"normal_never_turned", "normals face as their triangle does, not the viewer", "gbuffer_pass_normal",
         mistake_at(site::faces_away, Change::never)},
        {"normal_turned_away", "normals are turned from the viewer", "gbuffer_pass_normal",
         mistake_at(site::faces_away, Change::inverted)},
        {"normal_not_unit", "normals are as long as the triangle is large", "gbuffer_pass_normal",
         spoiled_at(site::surface_normal, cross_product)},
        {"normal_from_0_to_1", "normals are stored from 0 to 1, and not decoded", "gbuffer_pass_normal",
         spoiled_at(site::surface_normal, to_0_1)},
        {"nothing_valid", "alpha says that there is no surface", "gbuffer_pass", mistake_at(site::valid, Change::zero)},
        {"position_of_a_corner", "the whole triangle has the position of its first corner", "gbuffer_pass",
         mistake_at(site::surface_point, Change::instead, -1, &site::corner_a)},
        {"position_from_eye", "positions are stored from the eye, not from the world's origin", "gbuffer_pass",
         mistake_at(site::from_origin, Change::never)},
        {"position_y_and_z_swapped", "a position's y is taken for its z", "gbuffer_pass",
         mistake_at(site::surface_point, Change::yz_swapped)},
        {"normal_y_and_z_swapped", "a normal's y is taken for its z", "gbuffer_pass_normal",
         mistake_at(site::surface_normal, Change::yz_swapped)},
        {"albedo_encoded", "the albedo is encoded by a power of 1 / 2.2", "gbuffer_pass_albedo",
         spoiled_at(site::albedo, encoded)},
        {"albedo_white", "every albedo is white", "gbuffer_pass_albedo", spoiled_at(site::albedo, white)},
        {"albedo_not_rescaled", "an albedo of 255 / 256 is stored as such, not as 1", "gbuffer_pass_albedo",
         spoiled_at(site::albedo, of_255)},
    };
    for (const char* const pass : {"gbuffer_pass", "gbuffer_pass_normal", "gbuffer_pass_albedo", "gbuffer_pass_depth",
                                   "forward_light_pass", "forward_light_pass_depth"})
        all.insert(
            all.end(),
            {{"first_triangle_stays", "the triangle that is drawn first stays, whatever its depth", pass,
              mistake_at(site::nearest, Change::first_taken)},
             {"last_triangle_stays", "the triangle that is drawn last stays, whatever its depth", pass,
              mistake_at(site::nearest, Change::last_taken)},
             {"clockwise_missing", "triangles that are seen clockwise are not drawn", pass,
              mistake_at(site::is_back, Change::never)},
             {"counterclockwise_missing", "triangles that are seen counterclockwise are not drawn", pass,
              mistake_at(site::is_front, Change::never)},
             {"coverage_ignored", "triangles cover all pixels that are drawn for them", pass, all_covered},
             {"projection_transposed", "the matrix to clip space is transposed", pass,
              mistake_at(site::projection, Change::transposed)},
             {"upside_down", "y of clip space points down", pass, mistake_at(site::clip, Change::negated, 1)},
             {"mirrored", "x of clip space points to the left", pass, mistake_at(site::clip, Change::negated, 0)},
             {"view_missing", "the matrix to clip space lacks the camera's place", pass,
              drawn_as(WrongDrawing::view_missing)},
             {"depth_from_minus_1", "depths are from -1 to 1, not from 0", pass,
              formula_at(site::depth_value, from_minus_1)}});
    for (const char* const pass : {"gbuffer_pass", "gbuffer_pass_normal", "gbuffer_pass_albedo", "gbuffer_pass_depth",
                                   "forward_light_pass", "forward_light_pass_depth"})
        all.push_back({.name = "nothing_drawn",
                       .meaning = "no triangle is drawn",
                       .pass = pass,
                       .mistake = mistake_at(site::in_planes, Change::never),
                       .describes = true});
    for (const char* const pass : {"gbuffer_pass_depth", "forward_light_pass_depth"})
        all.push_back(
            {"depth_from_minus_1", "depths are from -1 to 1, not from 0", pass, formula_at(site::depth, from_minus_1)});
    return all;
}

/// Where discs are drawn around the lights.
std::vector<NamedMistake> of_glows() {
    static const Mistake drawn{
        .site = site::on_disc.id, .change = Change::decided_by_formula, .formula = in_box_of_disc_beside};
    static const Mistake lower_y = mistake_at(site::glow_y, Change::half_less);
    const Mistake beside = with(mistake_at(site::centre_x, Change::half_less), drawn);
    return {
        {.name = "glow_missing",
         .meaning = "glows add nothing",
         .pass = "glow_pass",
         .mistake = mistake_at(site::glow_colour, Change::zero),
         .describes = true},
        {"glow_through_walls", "glows are seen through what is before them: their depth is not tested, or too small",
         "glow_pass", mistake_at(site::glow_nearer, Change::always)},
        {"glow_square",
         "glows are as large as what is drawn for them",
         "glow_pass",
         {.site = site::on_disc.id, .change = Change::decided_by_formula, .formula = in_box_of_disc}},
        {"glow_by_corner", "discs are measured from the corners of pixels", "glow_pass", beside},
        {"glow_without_gain", "glows are not multiplied by their gain", "glow_pass",
         mistake_at(site::glow_gain, Change::one)},
        {"glow_not_fading", "glows are even discs", "glow_pass", mistake_at(site::glow_share, Change::one)},
        {"projection_transposed", "the matrix to clip space is transposed", "glow_pass",
         mistake_at(site::projection, Change::transposed)},
        {"upside_down", "y of clip space points down", "glow_pass", mistake_at(site::clip, Change::negated, 1)},
        {"mirrored", "x of clip space points to the left", "glow_pass", mistake_at(site::clip, Change::negated, 0)},
        {"view_missing", "the matrix to clip space lacks the camera's place", "glow_pass",
         drawn_as(WrongDrawing::view_missing)},
        {"discs_half_as_large", "a glow's radius is taken for its side", "glow_pass",
         mistake_at(site::disc_scale, Change::halved)},
        {"discs_twice_as_large", "a glow's radius is doubled", "glow_pass",
         mistake_at(site::disc_scale, Change::doubled)},
        {"discs_not_smaller_afar", "a glow's radius is not divided by w", "glow_pass",
         mistake_at(site::glow_radius, Change::not_done)},
        {"glow_behind_walls", "glows are seen where something is before them, and nowhere else", "glow_pass",
         mistake_at(site::glow_nearer, Change::reversed, 0)},
        {"glow_half_a_pixel_aside", "discs lie half a pixel lower along x and y", "glow_pass",
         with(mistake_at(site::glow_x, Change::half_less), lower_y)},
        {"glow_inverted", "glows are brightest at their rims", "glow_pass",
         mistake_at(site::glow_share, Change::instead, -1, &site::disc)},
        {"glow_by_distance", "glows fade with the distance, not with its square", "glow_pass",
         formula_at(site::glow_share, by_distance)},
        {"glow_share_squared", "glows fade twice", "glow_pass",
         mistake_at(site::glow_share, Change::times, -1, &site::glow_share)},
        {"glow_white", "glows are white", "glow_pass", mistake_at(site::colour_before, Change::one)},
        {"glow_turned", "red and blue of glows are swapped", "glow_pass",
         mistake_at(site::colour_before, Change::xz_swapped)},
        {"glow_not_blended", "a glow replaces what is there", "glow_pass", mistake_at(site::blends, Change::never)},
        {"glow_adds_alpha", "a glow adds 1 to alpha", "glow_pass", mistake_at(site::keeps_alpha, Change::never)},
    };
}

/// Where numbers become codes.
std::vector<NamedMistake> of_codes() {
    std::vector<NamedMistake> all;
    for (const char* const pass : {"encode_pass", "encode_by_gl_pass"}) {
        const auto add = [&](const char* name, const char* meaning, const Mistake& mistake) {
            all.push_back({name, meaning, pass, mistake});
        };
        add("encoded_turned", "red and blue are swapped", mistake_at(site::radiance_in, Change::xz_swapped));
        add("half_of_the_table", "codes above 127 become 127", spoiled_at(site::code, at_most_127));
        add("code_cut", "codes are cut, not rounded", mistake_at(site::code_value, Change::half_less));
        add("curve_missing", "numbers do not go through sRGB's curve", spoiled_at(site::radiance_in, coded<of_line>));
        add("curve_is_a_power", "codes are by a power of 1 / 2.2, not by sRGB's curve",
            spoiled_at(site::radiance_in, coded<of_power>));
        add("curve_inverted", "codes are by the inverse of the curve",
            spoiled_at(site::radiance_in, coded<of_inverse_power>));
        add("curve_without_line", "sRGB's curve lacks the line near 0",
            spoiled_at(site::radiance_in, coded<of_curve_without_line>));
        add("encoded_by_curve", "numbers go through sRGB's curve once too often",
            spoiled_at(site::radiance_in, coded_evenly<of_curve>));
        add("last_step_left_out", "the search for a code ends one step early", spoiled_at(site::code, even_code));
        add("codes_over_256", "codes are divided by 256", spoiled_at(site::code, over_256));
        add("codes_of_256", "numbers are multiplied by 256 and cut",
            spoiled_at(site::radiance_in, coded_evenly<of_line_of_256>));
    }
    return all;
}

} // namespace

std::vector<NamedMistake> image_mistakes() {
    std::vector<NamedMistake> all;
    for (const std::vector<NamedMistake>& some : {of_obstacles(), of_glows(), of_codes()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

} // namespace lockstep::lights
