#include "reference/collision/formulas/words.hpp"

#include <string_view>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "reference/half.hpp"

namespace lockstep::formulas {
namespace {

constexpr std::array epsilons{1e-1F, 1e-2F, 1e-3F, 1e-4F, 1e-5F, 1e-6F, -1e-1F, -1e-2F, -1e-3F, -1e-4F, -1e-5F, -1e-6F};
constexpr std::array nearnesses{0.5F, 0.25F, 0.2F, 1e-1F, 5e-2F, 1e-2F, 5e-3F, 1e-3F, 1e-4F, 1e-5F, 1e-6F, 1e-7F};
constexpr std::array ranges{0.001F, 0.01F, 0.02F, 0.05F, 0.1F, 0.2F, 0.25F, 0.5F, 0.75F, 1.0F, 2.0F, 5.0F, 10.0F};

constexpr std::array shares{0.001F, 0.01F, 0.05F, 0.1F, 0.2F, 0.25F, 0.5F};
constexpr std::array factors{0.1F,  0.25F, 0.7F, 0.75F, 0.8F,  0.9F, 0.95F, 0.99F,
                             1.01F, 1.05F, 1.1F, 1.2F,  1.25F, 1.5F, 3.0F,  4.0F};
constexpr std::array betas{0.25F, 0.3F, 0.34F, 0.375F, 0.4F, 0.5F};
constexpr std::array scales{1.0F,    10.0F,   15.0F,    16.0F,    31.0F,    63.0F,   64.0F,   100.0F,
                            127.0F,  128.0F,  255.0F,   256.0F,   1000.0F,  1023.0F, 1024.0F, 4095.0F,
                            4096.0F, 8191.0F, 10000.0F, 32767.0F, 65535.0F, 65536.0F};

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
    all.push_back({"improving_neighbours_added_up",
                   "away from all that were the nearest so far, added up",
                   {.site = site::nearest.id, .change = Change::improving_added_up}});
    all.push_back({"improving_units_added_up",
                   "away from all that were the nearest so far, added up as unit vectors",
                   {.site = site::nearest.id, .change = Change::improving_units_added_up}});
    all.push_back({"compared_with_first",
                   "each is compared with the first in range: the last that is nearer is taken",
                   {.site = site::nearest.id, .change = Change::compared_with_first}});
    all.push_back({"compared_with_one_before",
                   "each is compared with the one before it: the last that is nearer is taken",
                   {.site = site::nearest.id, .change = Change::compared_with_last}});
    all.push_back({"second_nearest",
                   "the second nearest in range, where there are two",
                   {.site = site::nearest.id, .change = Change::second_least}});
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
    ends_with("search_ends_with_last_ring", "the nearest of the outermost ring of texels that has one in range",
              [](Floats v, Run run) {
                  const Texels from_base(run);
                  v[1] = v[0];
                  v[0] = -std::max(std::abs(from_base.x), std::abs(from_base.y));
              });
    ends_with("most_ahead", "the one that lies most along the direction of flight",
              [](Floats v, Run run) { v[0] = glm::dot(old_direction(run), vec3(run, site::apart)); });
    ends_with("most_straight_ahead", "the one whose direction is nearest to the direction of flight",
              [](Floats v, Run run) { v[0] = glm::dot(old_direction(run), glm::normalize(vec3(run, site::apart))); });
    ends_with("lowest_taken", "the one with the lowest y",
              [](Floats v, Run run) { v[0] = vec3(run, site::stored_position).y; });
    ends_with("first_of_equals_by_columns", "among equals, the first column's, as where the loops are swapped",
              [](Floats v, Run run) { v[1] = Texels(run).x; });
    static const auto rounded_key = [](Floats v, Run run, bool by_range, bool nearest) {
        const float range = by_range ? params(run).constants.collision_range : 1.0F;
        const float key = v[0] / range * run.constants[0];
        v[0] = (nearest ? std::round(key) : std::floor(key)) / run.constants[0];
    };
    const auto keyed = [&](std::string_view name, std::string_view meaning, Formula formula) {
        all.push_back({name, meaning, at(site::nearest, Change::chosen_by_formula, formula), scales});
    };
    keyed("distance_as_whole_number", "the nearest by int(distance * a constant)",
          [](Floats v, Run run) { rounded_key(v, run, false, false); });
    keyed("distance_as_rounded_number", "the nearest by round(distance * a constant)",
          [](Floats v, Run run) { rounded_key(v, run, false, true); });
    keyed("share_as_whole_number", "the nearest by int(distance / range * a constant)",
          [](Floats v, Run run) { rounded_key(v, run, true, false); });
    keyed("share_as_rounded_number", "the nearest by round(distance / range * a constant)",
          [](Floats v, Run run) { rounded_key(v, run, true, true); });
    ends_with("distance_as_half_float", "the nearest by distances in half floats",
              [](Floats v, Run) { v[0] = half_round(v[0]); });
    all.push_back({"least_begins_too_near", "the least distance begins with a constant below the range",
                   in_range([](Floats v, Run run) { keep_where(v, [&] { return v[1] < run.constants[0]; }); }),
                   ranges});
    all.push_back({"distance_in_ndc", "the distance is that of normalised device coordinates",
                   value(site::distance, [](Floats v, Run run) {
                       const glm::vec4 a = projected(run, before(run)),
                                       b = projected(run, vec3(run, site::stored_position));
                       v[0] = glm::length(glm::vec3(a) / a.w - glm::vec3(b) / b.w);
                   })});
    all.push_back(
        {"distance_in_clip_space", "the distance is that of clip space", value(site::distance, [](Floats v, Run run) {
             v[0] = glm::length(glm::vec3(projected(run, before(run))) -
                                glm::vec3(projected(run, vec3(run, site::stored_position))));
         })});
    all.push_back({"close_share_skipped", "neighbours nearer than a share of the range are skipped",
                   in_range([](Floats v, Run run) { keep_where(v, [&] { return v[1] > v[2] * run.constants[0]; }); }),
                   shares});
    all.push_back({"range_times_a_constant", "the range times a constant",
                   value(site::collision_range, [](Floats v, Run run) { v[0] *= run.constants[0]; }), factors});
    all.push_back({"range_times_tick", "the range times u_Tick",
                   value(site::collision_range, [](Floats v, Run run) { v[0] *= tick(run); })});
    all.push_back({"range_times_speed", "the range times the speed",
                   value(site::collision_range, [](Floats v, Run run) { v[0] *= real(run, site::speed_before); })});
    all.push_back(
        {"range_plus_step", "the range plus the distance moved in one tick",
         value(site::collision_range, [](Floats v, Run run) { v[0] += real(run, site::speed_before) * tick(run); })});
    all.push_back(
        {"collision_time_for_range", "u_CollisionTime for u_CollisionRange",
         value(site::collision_range, [](Floats v, Run run) { v[0] = params(run).constants.collision_time; })});
    all.push_back({"speed_factor_for_range", "u_SpeedFactor for u_CollisionRange",
                   value(site::collision_range, [](Floats v, Run run) { v[0] = params(run).switches.speed_factor; })});
    all.push_back({"distance_truncated", "int(distance) for the distance",
                   value(site::distance, [](Floats v, Run) { v[0] = std::floor(v[0]); })});
    all.push_back({"range_of_truncated_distance", "int(distance) is held against the range",
                   in_range([](Floats v, Run) { v[0] = std::floor(v[1]) < v[2] && v[1] != 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"range_in_each_axis", "in range where |x|, |y| and |z| are", in_range([](Floats v, Run run) {
                       v[0] = greatest(vec3(run, site::apart)) < v[2] && v[1] != 0.0F ? 1.0F : 0.0F;
                   })});
    all.push_back({"estimated_distance", "the greatest component plus a constant times the others, for the length",
                   value(site::distance,
                         [](Floats v, Run run) {
                             const glm::vec3 a = glm::abs(vec3(run, site::apart));
                             const float most = greatest(a);
                             v[0] = most + run.constants[0] * (a.x + a.y + a.z - most);
                         }),
                   betas});
    all.push_back(
        {"positions_added", "both positions are added, and not subtracted", value(site::apart, [](Floats v, Run run) {
             set(v, vec3(run, site::own_position) + vec3(run, site::stored_position));
         })});
    all.push_back(
        {"distance_of_sum", "the length of the sum of both positions", value(site::distance, [](Floats v, Run run) {
             v[0] = glm::length(before(run) + vec3(run, site::stored_position));
         })});
    all.push_back({"only_lower_neighbours", "only neighbours that lie lower count", in_range([](Floats v, Run run) {
                       keep_where(v, [&] { return vec3(run, site::apart).y > 0.0F; });
                   })});
    all.push_back({"only_higher_neighbours", "only neighbours that lie higher count", in_range([](Floats v, Run run) {
                       keep_where(v, [&] { return vec3(run, site::apart).y < 0.0F; });
                   })});
    const auto counts = [&](std::string_view name, std::string_view meaning, Formula formula) {
        all.push_back({name, meaning, at(site::nearest, Change::found_by_formula, formula)});
    };
    static const auto parting = [](Run run) { return glm::dot(old_direction(run), chosen_vec3(run, site::apart)); };
    counts("receding_hit_ignored", "a hit counts only where the particle moves towards the nearest",
           [](Floats v, Run run) { v[0] = parting(run) < 0.0F ? 1.0F : 0.0F; });
    counts("approaching_hit_ignored", "a hit counts only where the particle moves away from the nearest",
           [](Floats v, Run run) { v[0] = parting(run) > 0.0F ? 1.0F : 0.0F; });
    counts("lone_neighbour_ignored", "a hit counts only where two are in range",
           [](Floats v, Run run) { v[0] = run.offered > 1 ? 1.0F : 0.0F; });
    counts("crowded_hit_ignored", "a hit counts only where no more than one is in range",
           [](Floats v, Run run) { v[0] = run.offered == 1 ? 1.0F : 0.0F; });
    counts("lower_neighbour_hit_ignored", "a hit counts only where the nearest lies higher",
           [](Floats v, Run run) { v[0] = run.of_chosen(site::apart)[1] < 0.0F ? 1.0F : 0.0F; });
    counts("higher_neighbour_hit_ignored", "a hit counts only where the nearest lies lower",
           [](Floats v, Run run) { v[0] = run.of_chosen(site::apart)[1] > 0.0F ? 1.0F : 0.0F; });
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
    all.push_back({"own_position_in_clip_space", "distances are from the own position in clip space",
                   value(site::own_position, [](Floats v, Run run) { set(v, glm::vec3(projected(run, get(v)))); })});
    all.push_back({"own_position_in_ndc", "distances are from the own position in normalised device coordinates",
                   value(site::own_position, [](Floats v, Run run) {
                       const glm::vec4 clip = projected(run, get(v));
                       set(v, glm::vec3(clip) / clip.w);
                   })});
    all.push_back({"distances_of_cells", "positions are rounded down to cells of the range's size",
                   value(site::apart, [](Floats v, Run run) {
                       const float cell = params(run).constants.collision_range;
                       const glm::vec3 own = vec3(run, site::own_position), other = vec3(run, site::stored_position);
                       set(v, glm::floor(own / cell) * cell - glm::floor(other / cell) * cell);
                   })});
    all.push_back({"searches_from_predicted_position", "distances are from the position that free fall would lead to",
                   value(site::own_position,
                         [](Floats v, Run run) { set(v, get(v) + (old_velocity(run) + fall(run)) * tick(run)); })});
    all.push_back(
        {"searches_from_position_ahead", "distances are from position + velocity * tick",
         value(site::own_position, [](Floats v, Run run) { set(v, get(v) + old_velocity(run) * tick(run)); })});
}

} // namespace lockstep::formulas
