#include "reference/collision/formulas/words.hpp"

#include <string_view>
#include <utility>

#include <glm/mat4x4.hpp>

#include "reference/half.hpp"

namespace lockstep::formulas {
namespace {

constexpr std::array bands{1.01F, 1.05F, 1.1F, 1.2F, 1.25F, 1.5F, 2.0F};
constexpr std::array sizes{256.0F, 512.0F,  600.0F,  640.0F,  720.0F,  768.0F,
                           800.0F, 1024.0F, 1080.0F, 1280.0F, 1920.0F, 2048.0F};
constexpr std::array least_speeds{0.0F, 1e-6F, 1e-5F, 1e-4F, 1e-3F, 1e-2F, 5e-2F, 0.1F, 0.2F, 0.5F, 1.0F, 2.0F};
constexpr std::array steps{255.0F, 256.0F, 512.0F, 1023.0F, 1024.0F, 2048.0F, 4096.0F, 65535.0F, 65536.0F};
constexpr std::array radii{0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 8.0F, 10.0F, 16.0F};
constexpr std::array middles{0.25F, 0.5F, 0.75F, 0.8F, 0.9F, 0.95F, 0.98F, 0.99F};
constexpr std::array first_indices{1.0F,   32.0F,   64.0F,   100.0F,  128.0F, 256.0F,
                                   512.0F, 1000.0F, 1024.0F, 2048.0F, 4096.0F};
constexpr std::array periods{2.0F, 3.0F, 4.0F, 5.0F, 8.0F, 10.0F, 16.0F, 32.0F, 60.0F, 64.0F, 100.0F, 128.0F, 256.0F};
constexpr std::array four{0.0F, 1.0F, 2.0F, 3.0F};

} // namespace

void add_base_texels(std::vector<FormulaMistake>& all) {
    static const Mistake clamped = value(site::base_texel, [](Floats v, Run run) {
        const auto& p = run.of(site::image_position);
        v[0] = std::clamp(std::floor(p[0]), 0.0F, static_cast<float>(params(run).width - 1));
        v[1] = std::clamp(std::floor(p[1]), 0.0F, static_cast<float>(params(run).height - 1));
    });
    all.push_back({"base_texel_clamped", "a particle outside the image searches from the nearest texel of its border",
                   at(
                       site::base_texel, Change::decided_by_formula, [](Floats v, Run) { v[0] = 1.0F; }, &clamped)});
    all.push_back(
        {"base_texel_rounded", "the base texel is rounded to nearest", value(site::base_texel, [](Floats v, Run run) {
             for (std::size_t c = 0; c < 2; ++c)
                 v[c] = std::round(run.of(site::image_position)[c]);
         })});
    all.push_back(
        {"base_texel_ceiling", "the base texel is the ceiling", value(site::base_texel, [](Floats v, Run run) {
             for (std::size_t c = 0; c < 2; ++c)
                 v[c] = std::ceil(run.of(site::image_position)[c]);
         })});
    static const Formula even = [](Floats v, Run) {
        for (std::size_t c = 0; c < 2; ++c)
            v[c] -= std::fmod(v[c], 2.0F);
    };
    static const Mistake even_offsets =
        skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return x % 2 != 0 || y % 2 != 0; }); });
    all.push_back(
        {"base_texel_even", "the base texel is rounded down to even coordinates", value(site::base_texel, even)});
    all.push_back({"even_offsets_searched", "only texels with even tx and ty are searched", even_offsets});
    all.push_back({"half_resolution",
                   "the base texel is rounded down to even coordinates, and only even offsets are searched",
                   value(site::base_texel, even, &even_offsets)});
    all.push_back(
        {"fetched_at_half_resolution", "the texel read is rounded down to even coordinates", fetch([](Floats v, Run) {
             for (std::size_t c = 0; c < 2; ++c)
                 if (v[c] >= 0.0F)
                     v[c] -= std::fmod(v[c], 2.0F);
         })});
    all.push_back({"base_texel_of_last_rounded", "the base texel is uv * (size - 1), rounded to nearest",
                   value(site::base_texel, [](Floats v, Run run) {
                       const auto& uv = run.of(site::texture_coordinate);
                       v[0] = std::round(uv[0] * static_cast<float>(params(run).width - 1));
                       v[1] = std::round(uv[1] * static_cast<float>(params(run).height - 1));
                   })});
    static const Mistake from_outside = value(site::base_texel, [](Floats v, Run run) {
        const auto& p = run.of(site::image_position);
        for (std::size_t c = 0; c < 2; ++c)
            v[c] = std::floor(p[c]);
    });
    static const auto within = [](Run run, int right, int upper) {
        const auto& p = run.of(site::image_position);
        return p[0] >= 0.0F && p[1] >= 0.0F && p[0] < static_cast<float>(right) && p[1] < static_cast<float>(upper);
    };
    const auto bounds = [&](std::string_view name, std::string_view meaning, Formula formula) {
        all.push_back({name, meaning, at(site::base_texel, Change::decided_by_formula, formula, &from_outside)});
    };
    bounds("base_bounds_of_width_alone", "whether it is on the image is held against the width, of y as well",
           [](Floats v, Run run) { v[0] = within(run, params(run).width, params(run).width) ? 1.0F : 0.0F; });
    bounds("base_bounds_of_height_alone", "whether it is on the image is held against the height, of x as well",
           [](Floats v, Run run) { v[0] = within(run, params(run).height, params(run).height) ? 1.0F : 0.0F; });
    bounds("base_bounds_swapped", "whether it is on the image is held against the height for x, the width for y",
           [](Floats v, Run run) { v[0] = within(run, params(run).height, params(run).width) ? 1.0F : 0.0F; });
    all.push_back({"guard_band_searches", "a particle outside the image by less than a constant of NDC searches, too",
                   at(
                       site::base_texel, Change::decided_by_formula,
                       [](Floats v, Run run) {
                           const auto& ndc = run.of(site::ndc);
                           v[0] =
                               std::abs(ndc[0]) < run.constants[0] && std::abs(ndc[1]) < run.constants[0] ? 1.0F : 0.0F;
                       },
                       &from_outside),
                   bands});
    all.push_back({"outside_half_depth_skipped", "a particle beyond clip z from 0 to w, Direct3D's, does not search",
                   search([](Floats v, Run run) {
                       keep_where(
                           v, [&] { return run.of(site::clip)[2] >= 0.0F && run.of(site::clip)[2] <= clip_w(run); });
                   })});
    all.push_back(
        {"height_for_width", "u_ClientHeight scales x, too", value(site::scale, [](Floats v, Run) { v[0] = v[1]; })});
    all.push_back(
        {"width_for_height", "u_ClientWidth scales y, too", value(site::scale, [](Floats v, Run) { v[1] = v[0]; })});
    const auto coordinate = [&](std::string_view name, std::string_view meaning, Formula formula,
                                std::span<const float> constants = {}) {
        all.push_back({name, meaning, value(site::texture_coordinate, formula), constants});
    };
    coordinate("ndc_clamped_to_one", "clip / w is clamped to 0 to 1 before 1 is added", [](Floats v, Run run) {
        for (std::size_t c = 0; c < 2; ++c)
            v[c] = (std::clamp(run.of(site::ndc)[c], 0.0F, 1.0F) + 1.0F) * 0.5F;
    });
    coordinate("texture_coordinate_clamped", "the texture coordinate is clamped to 0 to 1", [](Floats v, Run) {
        for (std::size_t c = 0; c < 2; ++c)
            v[c] = std::clamp(v[c], 0.0F, 1.0F);
    });
    coordinate("texture_coordinate_wrapped", "the texture coordinate is wrapped, fract()", [](Floats v, Run) {
        for (std::size_t c = 0; c < 2; ++c)
            v[c] -= std::floor(v[c]);
    });
    coordinate("one_added_after_halving", "ndc * 0.5 + 1 for (ndc + 1) * 0.5", [](Floats v, Run) {
        for (std::size_t c = 0; c < 2; ++c)
            v[c] += 0.5F;
    });
    coordinate("half_not_added", "ndc * 0.5 for ndc * 0.5 + 0.5", [](Floats v, Run) {
        for (std::size_t c = 0; c < 2; ++c)
            v[c] -= 0.5F;
    });
    coordinate("ndc_for_texture_coordinate", "ndc for (ndc + 1) * 0.5", [](Floats v, Run run) {
        for (std::size_t c = 0; c < 2; ++c)
            v[c] = run.of(site::ndc)[c];
    });
    coordinate("ndc_size_taken", "|ndc| for (ndc + 1) * 0.5", [](Floats v, Run run) {
        for (std::size_t c = 0; c < 2; ++c)
            v[c] = std::abs(run.of(site::ndc)[c]);
    });
    coordinate(
        "texture_coordinate_in_steps", "the texture coordinate is rounded down to steps of 1 / a constant",
        [](Floats v, Run run) {
            for (std::size_t c = 0; c < 2; ++c)
                v[c] = std::floor(v[c] * run.constants[0]) / run.constants[0];
        },
        steps);
    coordinate(
        "texture_coordinate_in_rounded_steps", "the texture coordinate is rounded to steps of 1 / a constant",
        [](Floats v, Run run) {
            for (std::size_t c = 0; c < 2; ++c)
                v[c] = std::round(v[c] * run.constants[0]) / run.constants[0];
        },
        steps);
    all.push_back({"ndc_in_half_floats", "clip / w is rounded to half floats",
                   value(site::ndc, [](Floats v, Run) { v[0] = half_round(v[0]), v[1] = half_round(v[1]); })});
    all.push_back({"only_x_divided", "clip x is divided by w, and clip y is not",
                   value(site::ndc, [](Floats v, Run run) { v[1] = run.of(site::clip)[1]; })});
    all.push_back({"only_y_divided", "clip y is divided by w, and clip x is not",
                   value(site::ndc, [](Floats v, Run run) { v[0] = run.of(site::clip)[0]; })});
    all.push_back({"multiplied_by_w", "clip xy is multiplied by w", value(site::ndc, [](Floats v, Run run) {
                       v[0] = run.of(site::clip)[0] * clip_w(run), v[1] = run.of(site::clip)[1] * clip_w(run);
                   })});
    all.push_back({"range_over_w_in_texels", "u_TexelCollideRange over clip w",
                   value(site::texel_collide_range, [](Floats v, Run run) { v[0] = std::trunc(v[0] / clip_w(run)); })});
    all.push_back(
        {"range_over_w_rounded", "u_TexelCollideRange over clip w, rounded",
         value(site::texel_collide_range, [](Floats v, Run run) { v[0] = std::trunc(v[0] / clip_w(run) + 0.5F); })});
    all.push_back({"range_over_w_at_least_one", "u_TexelCollideRange over clip w, at least 1",
                   value(site::texel_collide_range,
                         [](Floats v, Run run) { v[0] = std::max(std::trunc(v[0] / clip_w(run)), 1.0F); })});
    all.push_back({"radius_is_a_constant", "a constant for u_TexelCollideRange",
                   value(site::texel_collide_range, [](Floats v, Run run) { v[0] = run.constants[0]; }), radii});
    all.push_back({"radius_at_most", "u_TexelCollideRange is at most a constant",
                   value(site::texel_collide_range, [](Floats v, Run run) { v[0] = std::min(v[0], run.constants[0]); }),
                   radii});
    all.push_back({"radius_at_least", "u_TexelCollideRange is at least a constant",
                   value(site::texel_collide_range, [](Floats v, Run run) { v[0] = std::max(v[0], run.constants[0]); }),
                   radii});
    all.push_back({"width_is_a_constant", "a constant for u_ClientWidth",
                   value(site::scale, [](Floats v, Run run) { v[0] = run.constants[0]; }), sizes});
    all.push_back({"height_is_a_constant", "a constant for u_ClientHeight",
                   value(site::scale, [](Floats v, Run run) { v[1] = run.constants[0]; }), sizes});
    all.push_back({"size_is_a_constant", "one constant for u_ClientWidth and u_ClientHeight",
                   value(site::scale, [](Floats v, Run run) { v[0] = v[1] = run.constants[0]; }), sizes});
    all.push_back({"half_size_after_cast", "the base texel is ivec2(ndc * size / 2) + size / 2",
                   value(site::base_texel, [](Floats v, Run run) {
                       const auto& ndc = run.of(site::ndc);
                       const std::array size{params(run).width, params(run).height};
                       for (std::size_t c = 0; c < 2; ++c)
                           v[c] = std::trunc(ndc[c] * (0.5F * static_cast<float>(size[c]))) +
                                  static_cast<float>(size[c] / 2);
                   })});
    static const auto aspect_in = [](Floats v, Run run, bool divided) {
        const auto w = static_cast<float>(params(run).width), h = static_cast<float>(params(run).height);
        const auto which = static_cast<int>(run.constants[0]);
        const std::size_t c = which < 2 ? 0 : 1;
        const float aspect = which % 2 == 0 ? h / w : w / h;
        v[c] = divided ? v[c] * aspect : run.of(site::clip)[c] * aspect / clip_w(run);
    };
    all.push_back({"aspect_twice", "the aspect ratio is applied once more to x or y",
                   value(site::ndc, [](Floats v, Run run) { aspect_in(v, run, false); }), four});
    all.push_back({"aspect_twice", "the aspect ratio is applied once more to x or y",
                   value(site::ndc, [](Floats v, Run run) { aspect_in(v, run, true); }), four});
    all.push_back({"divided_by_z", "clip xy is divided by z", value(site::ndc, [](Floats v, Run run) {
                       const auto& clip = run.of(site::clip);
                       v[0] = clip[0] / clip[2], v[1] = clip[1] / clip[2];
                   })});
    all.push_back({"x_divided_by_z", "clip x is divided by z",
                   value(site::ndc, [](Floats v, Run run) { v[0] = run.of(site::clip)[0] / run.of(site::clip)[2]; })});
    all.push_back({"y_divided_by_z", "clip y is divided by z",
                   value(site::ndc, [](Floats v, Run run) { v[1] = run.of(site::clip)[1] / run.of(site::clip)[2]; })});
    all.push_back({"divided_by_w_twice", "clip xy is divided by w twice",
                   value(site::ndc, [](Floats v, Run run) { v[0] /= clip_w(run), v[1] /= clip_w(run); })});
    all.push_back({"divided_by_size_of_w", "clip xy is divided by |w|", value(site::ndc, [](Floats v, Run run) {
                       if (clip_w(run) < 0.0F)
                           v[0] = -v[0], v[1] = -v[1];
                   })});
    all.push_back(
        {"projected_as_direction", "the position is projected with w = 0", value(site::clip, [](Floats v, Run run) {
             const glm::vec4 clip = params(run).collision_proj_view * glm::vec4(before(run), 0.0F);
             for (int c = 0; c < 4; ++c)
                 v[static_cast<std::size_t>(c)] = clip[c];
         })});
    all.push_back({"vector_times_matrix", "vec4(position, 1) * u_ProjView in the search",
                   value(site::clip, [](Floats v, Run run) {
                       const glm::vec4 clip = glm::vec4(before(run), 1.0F) * params(run).collision_proj_view;
                       for (int c = 0; c < 4; ++c)
                           v[static_cast<std::size_t>(c)] = clip[c];
                   })});
    static const auto projects = [](Floats v, Run run, glm::vec3 position) {
        const glm::vec4 clip = params(run).collision_proj_view * glm::vec4(position, 1.0F);
        for (int c = 0; c < 4; ++c)
            v[static_cast<std::size_t>(c)] = clip[c];
    };
    static const Mistake own_predicted = value(
        site::own_position, [](Floats v, Run run) { set(v, get(v) + (old_velocity(run) + fall(run)) * tick(run)); });
    static const Formula projects_predicted = [](Floats v, Run run) {
        projects(v, run, before(run) + (old_velocity(run) + fall(run)) * tick(run));
    };
    all.push_back(
        {"base_texel_of_position_ahead", "searches around where position + velocity * tick lies",
         value(site::clip, [](Floats v, Run run) { projects(v, run, before(run) + old_velocity(run) * tick(run)); })});
    all.push_back({"base_texel_of_predicted_position", "searches around where free fall would lead to",
                   value(site::clip, projects_predicted)});
    all.push_back({"all_of_predicted_position", "searches as if it were where free fall would lead to",
                   value(site::clip, projects_predicted, &own_predicted)});
    all.push_back({"behind_camera_skipped", "a particle behind the camera, w <= 0, does not search",
                   search([](Floats v, Run run) { keep_where(v, [&] { return clip_w(run) > 0.0F; }); })});
    all.push_back({"outside_depth_skipped", "a particle beyond the near or far plane does not search",
                   search([](Floats v, Run run) {
                       keep_where(v, [&] { return std::abs(run.of(site::clip)[2]) <= clip_w(run); });
                   })});
    all.push_back({"whole_window_required", "a particle nearer to the image's border than the range does not search",
                   search([](Floats v, Run run) {
                       const FrameParams& p = params(run);
                       const auto& at = run.of(site::image_position);
                       const auto r = static_cast<float>(reach(run));
                       keep_where(v, [&] {
                           return std::floor(at[0]) >= r && std::floor(at[1]) >= r &&
                                  std::floor(at[0]) < static_cast<float>(p.width) - r &&
                                  std::floor(at[1]) < static_cast<float>(p.height) - r;
                       });
                   })});
    const auto searches_where = [&](std::string_view name, std::string_view meaning, Formula formula) {
        all.push_back({name, meaning, search(formula)});
    };
    searches_where("only_falling_search", "only a particle that moves down searches",
                   [](Floats v, Run run) { keep_where(v, [&] { return old_direction(run).y < 0.0F; }); });
    searches_where("only_rising_search", "only a particle that moves up searches",
                   [](Floats v, Run run) { keep_where(v, [&] { return old_direction(run).y > 0.0F; }); });
    searches_where("only_above_zero_search", "only a particle above y = 0 searches",
                   [](Floats v, Run run) { keep_where(v, [&] { return before(run).y > 0.0F; }); });
    all.push_back(
        {"only_middle_searches", "a particle farther from the image's middle than a constant of NDC does not search",
         search([](Floats v, Run run) {
             const auto& ndc = run.of(site::ndc);
             keep_where(v,
                        [&] { return std::abs(ndc[0]) <= run.constants[0] && std::abs(ndc[1]) <= run.constants[0]; });
         }),
         middles});
    all.push_back({"only_right_upper_quarter_searches",
                   "a particle left of the image's middle or below it does not search", search([](Floats v, Run run) {
                       keep_where(v, [&] { return run.of(site::ndc)[0] >= 0.0F && run.of(site::ndc)[1] >= 0.0F; });
                   })});
    all.push_back({"only_some_search", "only every n-th particle searches", search([](Floats v, Run run) {
                       keep_where(v, [&] { return run.item % static_cast<std::size_t>(run.constants[0]) == 0; });
                   }),
                   periods});
    all.push_back({"some_do_not_search", "every n-th particle does not search", search([](Floats v, Run run) {
                       keep_where(v, [&] { return run.item % static_cast<std::size_t>(run.constants[0]) != 0; });
                   }),
                   periods});
    all.push_back({"first_particles_do_not_search", "particles up to an index do not search",
                   search([](Floats v, Run run) {
                       keep_where(v, [&] { return run.item >= static_cast<std::size_t>(run.constants[0]); });
                   }),
                   first_indices});
    all.push_back({"last_particles_do_not_search", "particles from an index on do not search",
                   search([](Floats v, Run run) {
                       keep_where(v, [&] { return run.item < static_cast<std::size_t>(run.constants[0]); });
                   }),
                   first_indices});
    all.push_back({"only_fast_search", "only a particle faster than a constant searches", search([](Floats v, Run run) {
                       keep_where(v, [&] { return real(run, site::speed_before) > run.constants[0]; });
                   }),
                   least_speeds});
    all.push_back({"searches_a_tick_late", "searches at collide time < -tick", search([](Floats v, Run run) {
                       v[0] = real(run, site::collide_time_before) < -tick(run) ? 1.0F : 0.0F;
                   })});
    all.push_back({"searches_a_tick_early", "searches at collide time - tick < 0", search([](Floats v, Run run) {
                       v[0] = real(run, site::collide_time_before) - tick(run) < 0.0F ? 1.0F : 0.0F;
                   })});
}

} // namespace lockstep::formulas
