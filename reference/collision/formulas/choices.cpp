#include "reference/collision/formulas/words.hpp"

#include <string_view>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

namespace lockstep::formulas {
namespace {

constexpr std::array epsilons{1e-1F, 1e-2F, 1e-3F, 1e-4F, 1e-5F, 1e-6F, -1e-1F, -1e-2F, -1e-3F, -1e-4F, -1e-5F, -1e-6F};
constexpr std::array nearnesses{0.5F, 0.25F, 0.2F, 1e-1F, 5e-2F, 1e-2F, 5e-3F, 1e-3F, 1e-4F, 1e-5F, 1e-6F, 1e-7F};
constexpr std::array ranges{0.001F, 0.01F, 0.02F, 0.05F, 0.1F, 0.2F, 0.25F, 0.5F, 1.0F, 2.0F, 5.0F, 10.0F};

/// Of the neighbour that is offered: its place, counted from the base texel.
struct Texels {
    explicit Texels(Run run) : x(run.of(site::own_texel_skipped)[0]), y(run.of(site::own_texel_skipped)[1]) {}
    float x, y;
};

} // namespace

void add_choices(std::vector<FormulaMistake>& all) {
    all.push_back({"chebyshev_distance", "the greatest of |x|, |y| and |z| for the distance",
                   value(site::distance, [](Floats v, Run run) { v[0] = greatest(vec3(run, site::apart)); })});
    all.push_back({"half_distance", "half the distance", value(site::distance, [](Floats v, Run) { v[0] *= 0.5F; })});
    all.push_back({"neighbours_added_up",
                   "away from all in range, added up, not from the nearest",
                   {.site = site::nearest.id, .change = Change::added_up}});
    all.push_back({"units_away_added_up",
                   "away from all in range, added up as unit vectors",
                   {.site = site::nearest.id, .change = Change::units_added_up}});
    all.push_back({"row_left_at_hit",
                   "a row is left at the first in range that is nearest so far",
                   {.site = site::nearest.id, .change = Change::one_a_turn}});
    static const Formula by_texels = [](Floats v, Run run) {
        const Texels from_base(run);
        v[0] = from_base.x * from_base.x + from_base.y * from_base.y;
    };
    static const Mistake last{.site = site::nearest.id, .change = Change::last_of_equals};
    all.push_back({"nearest_in_texels", "the nearest in the image, not in the world",
                   at(site::nearest, Change::chosen_by_formula, by_texels)});
    all.push_back({"last_nearest_in_texels", "the nearest in the image, and the last of equals",
                   at(site::nearest, Change::chosen_by_formula, by_texels, &last)});
    const auto ends_with = [&](std::string_view name, std::string_view meaning, Formula formula) {
        all.push_back({name, meaning, at(site::nearest, Change::chosen_by_formula, formula)});
    };
    ends_with("search_ends_with_first_ring", "the nearest of the first ring of texels that has one in range",
              [](Floats v, Run run) {
                  const Texels from_base(run);
                  v[1] = v[0];
                  v[0] = std::max(std::abs(from_base.x), std::abs(from_base.y));
              });
    ends_with("search_ends_with_first_circle", "the nearest of those in range that are nearest in the image",
              [](Floats v, Run run) {
                  v[1] = v[0];
                  by_texels(v, run);
              });
    ends_with("search_ends_with_first_row", "the nearest of the first row that has one in range",
              [](Floats v, Run run) {
                  v[1] = v[0];
                  v[0] = Texels(run).y;
              });
    ends_with("search_ends_with_first_column", "the nearest of the first column that has one in range",
              [](Floats v, Run run) {
                  v[1] = v[0];
                  v[0] = Texels(run).x;
              });
    all.push_back({"close_neighbours_skipped", "neighbours nearer than a constant are skipped",
                   in_range([](Floats v, Run run) { keep_where(v, [&] { return v[1] > run.constants[0]; }); }),
                   nearnesses});
    ends_with("nearest_in_x_and_y", "the nearest in x and y, whatever its z",
              [](Floats v, Run run) { v[0] = glm::length(glm::vec2(vec3(run, site::apart))); });
    ends_with("nearest_in_z", "the nearest in z alone",
              [](Floats v, Run run) { v[0] = std::abs(vec3(run, site::apart).z); });
    ends_with("nearest_of_last_row", "the nearest of the last row that has one in range", [](Floats v, Run run) {
        v[1] = v[0];
        v[0] = -Texels(run).y;
    });
    ends_with("nearest_of_last_column", "the nearest of the last column that has one in range", [](Floats v, Run run) {
        v[1] = v[0];
        v[0] = -Texels(run).x;
    });
    all.push_back({"range_with_tolerance", "in range up to a tolerance beyond the range",
                   in_range([](Floats v, Run run) {
                       v[0] = v[1] < v[2] + run.constants[0] && (v[0] != 0.0F || v[1] != 0.0F) ? 1.0F : 0.0F;
                   }),
                   epsilons});
    all.push_back({"range_is_a_constant", "a constant for u_CollisionRange",
                   value(site::collision_range, [](Floats v, Run run) { v[0] = run.constants[0]; }), ranges});
    all.push_back({"range_squared", "u_CollisionRange is squared, and not the distance",
                   value(site::collision_range, [](Floats v, Run) { v[0] *= v[0]; })});
    all.push_back(
        {"receding_ignored", "only neighbours that the particle moves towards count", in_range([](Floats v, Run run) {
             keep_where(v, [&] { return glm::dot(old_direction(run), vec3(run, site::apart)) < 0.0F; });
         })});
    all.push_back({"approaching_ignored", "only neighbours that the particle moves away from count",
                   in_range([](Floats v, Run run) {
                       keep_where(v, [&] { return glm::dot(old_direction(run), vec3(run, site::apart)) > 0.0F; });
                   })});
    static const auto neighbour_w = [](Run run) {
        return (params(run).collision_proj_view * glm::vec4(vec3(run, site::stored_position), 1.0F)).w;
    };
    ends_with("nearest_to_camera", "the neighbour in range that is nearest to the camera",
              [](Floats v, Run run) { v[0] = neighbour_w(run); });
    ends_with("farthest_from_camera", "the neighbour in range that is farthest from the camera",
              [](Floats v, Run run) { v[0] = -neighbour_w(run); });
    ends_with("nearest_in_camera_depth", "the neighbour whose distance from the camera differs least",
              [](Floats v, Run run) { v[0] = std::abs(neighbour_w(run) - clip_w(run)); });
    all.push_back({"range_times_w", "u_CollisionRange times clip w",
                   value(site::collision_range, [](Floats v, Run run) { v[0] *= clip_w(run); })});
    all.push_back({"range_over_w", "u_CollisionRange over clip w",
                   value(site::collision_range, [](Floats v, Run run) { v[0] /= clip_w(run); })});
    all.push_back({"only_farther_from_camera", "only neighbours farther from the camera count",
                   in_range([](Floats v, Run run) { keep_where(v, [&] { return neighbour_w(run) > clip_w(run); }); })});
    all.push_back({"only_nearer_to_camera", "only neighbours nearer to the camera count",
                   in_range([](Floats v, Run run) { keep_where(v, [&] { return neighbour_w(run) < clip_w(run); }); })});
    all.push_back({"searches_from_predicted_position", "distances are from the position that free fall would lead to",
                   value(site::own_position,
                         [](Floats v, Run run) { set(v, get(v) + (old_velocity(run) + fall(run)) * tick(run)); })});
    all.push_back(
        {"searches_from_position_ahead", "distances are from position + velocity * tick",
         value(site::own_position, [](Floats v, Run run) { set(v, get(v) + old_velocity(run) * tick(run)); })});
}

} // namespace lockstep::formulas
