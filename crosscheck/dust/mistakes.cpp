#include "crosscheck/dust/mistakes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "crosscheck/dust/mistake_words.hpp"
#include "reference/dust/handed.hpp"
#include "reference/dust/random.hpp"
#include "reference/dust/sites.hpp"
#include "reference/model/dust/schema.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::dust {
namespace {

/// What the host should have squared.
void not_squared(std::span<float> value, const CameBy& /*run*/) {
    for (float& x : value)
        x = std::sqrt(x);
}

/// The source's 0.02 s, whatever a frame takes.
void constant_time(std::span<float> value, const CameBy& /*run*/) {
    for (float& x : value)
        x = 0.02F;
}

/// Of a vector's three squares two.
template <const Site& of> void without_z(std::span<float> value, const CameBy& run) {
    const auto& v = run.of(of);
    value[0] = v[0] * v[0] + v[1] * v[1];
}

/// A velocity of a vec3[], whose elements take the room of four floats. Behind the last there is 0.
void at_stride_16(std::span<float> value, const CameBy& run) {
    const View& grains = run.foretold<PassInput>().before[grain_buffer];
    const auto first = 4 * static_cast<std::size_t>(run.of(site::index)[0]);
    for (std::size_t c = 0; c < value.size(); ++c) {
        const std::size_t word = first + c;
        value[c] = word < 3 * grains.count()
                       ? grains.value(field::velocity.field, word / 3, static_cast<int>(word % 3)).real()
                       : 0.0F;
    }
}

/// A cone that opens to the back as well, and pulls there as in front.
void without_sign(std::span<float> value, const CameBy& /*run*/) { value[0] = std::abs(value[0]); }

void by_cube(std::span<float> value, const CameBy& run) {
    const float d2 = run.of(site::sqr_dist)[0];
    value[0] = run.of(site::cleaner_sqr_force)[0] / (d2 * std::sqrt(d2));
}

void of_length_one(std::span<float> value, const CameBy& /*run*/) {
    const float length = std::sqrt(value[0] * value[0] + value[1] * value[1] + value[2] * value[2]);
    for (float& x : value)
        x /= length;
}

void forecast_of_two_frames(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::before)[c] + run.of(site::pulled)[c] * (2.0F * run.of(site::dt)[0]);
}

void y_alone(std::span<float> value, const CameBy& /*run*/) { value[0] = value[2] = 0.0F; }

void by_distance(std::span<float> value, const CameBy& run) {
    value[0] = run.of(site::cleaner_sqr_force)[0] / std::sqrt(run.of(site::sqr_dist)[0]);
}

void normal_of_next(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::from_centre)[c] / run.of(site::reach)[0];
}

template <const Site& by> void normal_by(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = (run.of(site::contact)[c] - run.of(site::sphere_centre)[c]) / run.of(by)[0];
}

void reach_not_squared(std::span<float> value, const CameBy& run) {
    value[0] = run.of(site::reach)[0] - run.of(site::missed)[0];
}

void from_the_end(std::span<float> value, const CameBy& run) {
    float square = 0.0F;
    for (std::size_t c = 0; c < 3; ++c) {
        const float way = run.of(site::next)[c] - run.of(site::contact)[c];
        square += way * way;
    }
    value[0] = std::sqrt(square);
}

void z_is_y(std::span<float> value, const CameBy& /*run*/) { value[2] = value[1]; }

void colours_swapped(std::span<float> value, const CameBy& run) {
    const auto &a = run.of(site::colour_a), &b = run.of(site::colour_b);
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = b[c] + (a[c] - b[c]) * run.of(site::shade)[0];
}

void one_in_ten(std::span<float> decision, const CameBy& /*run*/) { decision[0] = decision[1] <= 0.1F ? 1.0F : 0.0F; }

/// Gravity first, then drag of what it made.
void drag_after_gravity(std::span<float> value, const CameBy& run) {
    const float dt = run.of(site::dt)[0];
    for (std::size_t c = 0; c < value.size(); ++c) {
        const float fallen = run.of(site::speed)[c] + run.of(site::gravity)[c] * dt;
        value[c] = fallen - fallen * run.of(site::air_resistance)[0] * dt;
    }
}

void drag_squared(std::span<float> value, const CameBy& run) {
    const auto& v = run.of(site::speed);
    const float length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (float& x : value)
        x *= length;
}

/// Of the velocities before the frame and after it.
void mean_velocity(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = 0.5F * (run.of(site::speed)[c] + value[c]);
}

void way_of_constant_time(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::fall)[c] * 0.02F;
}

/// A bounce slows the normal part alone: (1 + e) times it is taken away, not twice.
void slowed_normal_part(std::span<float> value, const CameBy& run) {
    value[0] *= 0.5F * (1.0F + run.of(site::elasticity)[0]);
}

float left_of_range(const CameBy& run, const Site& sqr_range) {
    return 1.0F - run.of(site::sqr_dist)[0] / run.of(sqr_range)[0];
}

void suction_to_the_rim(std::span<float> value, const CameBy& run) {
    value[0] = run.of(site::cleaner_sqr_force)[0] * left_of_range(run, site::cleaner_sqr_dist);
}

void wind_to_the_rim(std::span<float> value, const CameBy& run) {
    for (float& x : value)
        x *= left_of_range(run, site::blower_sqr_dist);
}

/// A force along the tool's axis, not along the way to the grain.
template <int sign> void along_the_axis(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = sign * run.of(site::controller_forward)[c] * run.of(site::pull)[0] * run.of(site::along)[0];
}

void both_cones(std::span<float> decision, const CameBy& /*run*/) {
    decision[0] = std::abs(decision[1]) > decision[2] ? 1.0F : 0.0F;
}

void forecast_of_a_second(std::span<float> value, const CameBy& run) {
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = run.of(site::before)[c] + run.of(site::pulled)[c];
}

void blast_by_distance(std::span<float> value, const CameBy& run) {
    value[0] = 1.0F - std::sqrt(run.of(site::sqr_dist)[0] / run.of(site::explosion_sqr_range)[0]);
}

void upwards(std::span<float> value, const CameBy& /*run*/) {
    value[0] = value[2] = 0.0F;
    value[1] = 1.0F;
}

/// The number's bits, as its kernel drew them with a generator.
template <class Pcg> std::uint32_t drawn(const CameBy& run, const Pcg& generator) {
    const Draw& draw = run.foretold<Draw>();
    const auto of = [&](const Site& place) { return static_cast<std::uint32_t>(run.of(place)[0]); };
    return generator(draw.item + generator(of(site::stream) + generator(of(site::drawn_in) + generator(draw.seed))));
}

void of_32_bits(std::span<float> value, const CameBy& run) {
    value[0] = static_cast<float>(drawn(run, pcg)) * 0x1p-32F;
}

void shifted_by_3(std::span<float> value, const CameBy& run) {
    const auto wrong = [](std::uint32_t x) {
        const std::uint32_t s = x * 747796405U + 2891336453U;
        const std::uint32_t y = ((s >> ((s >> 28U) + 3U)) ^ s) * 277803737U;
        return (y >> 22U) ^ y;
    };
    value[0] = static_cast<float>(drawn(run, wrong) >> 8U) * 0x1p-24F;
}

/// The last grains, which fill no group of so many, stay as they were.
template <const Site& was> void tail_left_out(std::span<float> value, const CameBy& run) {
    const std::size_t count = run.foretold<PassInput>().before[grain_buffer].count();
    const std::size_t group = std::max<std::size_t>(static_cast<std::size_t>(run.constants[0]), 64);
    if (run.of(site::index)[0] >= static_cast<float>(count - count % group))
        std::copy_n(run.of(was).begin(), value.size(), value.begin());
}

} // namespace

const std::vector<NamedMistake>& mistakes() {
    static const Mistake next_without_z = spoiled_at(site::sqr_dist_next, without_z<site::mouth_to_forecast>);
    static const Mistake way_without_z = spoiled_at(site::sqr_way, without_z<site::to_centre>);
    static const Mistake sphere_keeps_speed = mistake_at(site::sphere_speed_kept, Change::one);
    static const Mistake speed_halved = mistake_at(site::speed_into, Change::halved);
    static const Mistake speed_negated = mistake_at(site::speed_into, Change::negated);
    static const Mistake passes_down = mistake_at(site::passes_down, Change::always);
    static const Mistake contact_behind{.site = site::comes_to_contact.id, .change = Change::dropped, .part = 0};
    static const Mistake same_velocity = spoiled_at(site::velocity, tail_left_out<site::speed>);
    static const std::vector<NamedMistake> all{
        {"gravity_missing", "gravity is not added", "update", mistake_at(site::gravity, Change::zero)},
        {"gravity_down_alone", "only gravity's y acts", "update", spoiled_at(site::gravity, y_alone)},
        {"gravity_reversed", "grains fall upwards", "update", mistake_at(site::gravity, Change::negated)},
        {"drag_missing", "the air does not resist", "update", mistake_at(site::drag, Change::zero)},
        {"drag_reversed", "the air pushes grains on", "update", mistake_at(site::drag, Change::negated)},
        {"elasticity_missing", "a bounce loses nothing", "update", mistake_at(site::elasticity, Change::one)},
        {"boxes_elastic", "a bounce off a box loses nothing", "update", mistake_at(site::box_speed_kept, Change::one)},
        {"radius_missing", "grains are points", "update", mistake_at(site::radius, Change::zero)},
        {"radius_doubled", "the radius is the whole scale", "update", mistake_at(site::radius, Change::doubled)},
        {"spheres_missing", "grains do not see the spheres", "update", mistake_at(site::has_spheres, Change::inverted)},
        {"boxes_missing", "grains do not see the boxes", "update", mistake_at(site::has_boxes, Change::inverted)},
        {"force_not_squared", "the host hands over the vacuum's force, not its square", "vacuum_up",
         spoiled_at(site::cleaner_sqr_force, not_squared)},
        {"range_not_squared", "the host hands over the vacuum's range, not its square", "vacuum_up",
         spoiled_at(site::cleaner_sqr_dist, not_squared)},
        {"death_range_not_squared", "the host hands over the death range, not its square", "vacuum_up",
         spoiled_at(site::cleaner_sqr_death, not_squared)},
        {"wind_not_squared", "the host hands over the wind's force, not its square", "blow_wind",
         spoiled_at(site::blower_sqr_force, not_squared)},
        {"wind_by_frames", "wind of a fixed time a frame", "blow_wind", spoiled_at(site::impulse_dt, constant_time)},
        {"blast_range_not_squared", "the host hands over the blast's range, not its square", "explode",
         spoiled_at(site::explosion_sqr_range, not_squared)},
        {"cone_ignored", "the vacuum pulls from all around", "vacuum_up", mistake_at(site::in_cone, Change::always)},
        {"range_ignored", "the vacuum has no range", "vacuum_up", mistake_at(site::in_range, Change::always)},
        {"suction_reversed", "the vacuum blows", "vacuum_up", mistake_at(site::force, Change::negated)},
        {"never_dies", "nothing dies in the mouth", "vacuum_up", mistake_at(site::alive, Change::one)},
        {"side_exit_survived", "what leaves the cone sideways lives", "vacuum_up",
         mistake_at(site::left_cone, Change::never)},
        {"pulled_die", "what is pulled dies at once", "vacuum_up", mistake_at(site::left_cone, Change::always)},
        {"death_range_ignored", "no grain dies for being near the mouth", "vacuum_up",
         mistake_at(site::near_mouth, Change::never)},
        {"lower_walls_open", "grains fall through the floor and the lower walls", "update",
         mistake_at(site::below_wall, Change::never)},
        {"upper_walls_open", "grains leave through the upper walls", "update",
         mistake_at(site::above_wall, Change::never)},
        {"wind_reversed", "the wind sucks", "blow_wind", mistake_at(site::force, Change::negated)},
        {"wind_behind", "the wind blows behind the tool, towards its mouth", "blow_wind",
         mistake_at(site::from_mouth, Change::negated)},
        {"wind_not_fading", "the wind is as strong far away", "blow_wind", mistake_at(site::pull, Change::not_done)},
        {"wind_by_squared_cosine", "the wind fades to the side by the square of the cosine", "blow_wind",
         mistake_at(site::force_along, Change::times, -1, &site::along)},
        {"wind_everywhere", "the wind has no cone", "blow_wind", mistake_at(site::in_cone, Change::always)},
        {"blast_everywhere", "the blast has no range", "explode", mistake_at(site::in_range, Change::always)},
        {"blast_not_fading", "the blast is as strong at its rim", "explode", mistake_at(site::share, Change::one)},
        {"square_without_z", "squared lengths leave z out", "vacuum_up",
         with(spoiled_at(site::sqr_dist, without_z<site::to_mouth>), next_without_z)},
        {"square_without_z", "squared lengths leave z out", "blow_wind",
         spoiled_at(site::sqr_dist, without_z<site::from_mouth>)},
        {"square_without_z", "squared lengths leave z out", "explode",
         spoiled_at(site::sqr_dist, without_z<site::from_mouth>)},
        {"square_without_z", "squared lengths leave z out", "update",
         with(spoiled_at(site::sqr_dist, without_z<site::from_centre>), way_without_z)},
        {"suction_by_distance", "the pull fades with the distance, not its square", "vacuum_up",
         formula_at(site::pull, by_distance)},
        {"matrices_by_rows", "a matrix is read by rows", "update", mistake_at(site::by_columns, Change::inverted)},
        {"translation_missing", "places are turned as directions are", "update",
         mistake_at(site::translation, Change::zero)},
        {"box_velocity_as_point", "velocities are moved into the box as places are", "update",
         mistake_at(site::speed_in_box, Change::plus, -1, &site::translation)},
        {"normal_of_next", "the sphere's normal is that of the next position, not of the contact", "update",
         formula_at(site::normal, normal_of_next)},
        {"normal_not_grown", "the sphere's normal is divided by its radius, without the grain's", "update",
         spoiled_at(site::normal, normal_by<site::sphere_half>)},
        {"normal_by_grain", "the sphere's normal is divided by the grain's radius alone", "update",
         spoiled_at(site::normal, normal_by<site::radius>)},
        {"reach_not_squared", "a chord is made of the reach, not of its square", "update",
         spoiled_at(site::chord, reach_not_squared)},
        free_formula("way_in_from_the_end", "the way to a contact is taken from where the movement ends", "update",
                     spoiled_at(site::way_in, from_the_end)),
        {"lower_walls_further_out", "a grain's radius is taken away at the lower walls, not added", "update",
         mistake_at(site::lower_margin, Change::negated)},
        {"upper_walls_further_out", "a grain's radius is added at the upper walls, not taken away", "update",
         mistake_at(site::upper_margin, Change::negated)},
        {"lower_walls_without_grain", "lower walls are met by the grains' centres", "update",
         mistake_at(site::lower_margin, Change::zero)},
        {"upper_walls_without_grain", "upper walls are met by the grains' centres", "update",
         mistake_at(site::upper_margin, Change::zero)},
        {"path_not_cut", "the whole movement is mirrored, not what is left of it", "update",
         mistake_at(site::rest, Change::instead, -1, &site::movement)},
        {"reflected_once", "a reflection takes its normal part away once, not twice", "update",
         with(mistake_at(site::into, Change::halved), speed_halved)},
        {"reflection_adds", "a reflection adds its normal part", "update",
         with(mistake_at(site::into, Change::negated), speed_negated)},
        {"contact_off_the_face", "a contact is not put on its face", "update",
         mistake_at(site::on_face, Change::inverted)},
        {"forecast_not_repeated", "Update no longer asks which grains die in the mouth", "update",
         mistake_at(site::asks_again, Change::inverted)},
        {"forecast_of_all", "in Update grains die that were not pulled", "update",
         mistake_at(site::pulled_alone, Change::inverted)},
        {"forecast_from_the_end", "Update asks where a movement ends, not where it began, which grains die", "update",
         mistake_at(site::asks_where_it_was, Change::inverted)},
        {"swept_contact_behind", "contacts behind a movement are hit, too", "update", contact_behind},
        {"swept_line_alone", "a movement hits what its line comes to beyond it", "update",
         with(mistake_at(site::passes_up, Change::always), passes_down)},
        {"swept_up_alone", "of the faces that a movement passes, only those it meets moving upwards are hit", "update",
         mistake_at(site::passes_down, Change::never)},
        {"swept_down_alone", "of the faces that a movement passes, only those it meets moving downwards are hit",
         "update", mistake_at(site::passes_up, Change::never)},
        {"never_started_beyond", "a grain that started beyond a wall bounces off it, too", "update",
         mistake_at(site::started_beyond, Change::never)},
        {"upper_wall_not_alone", "after an upper wall other walls answer, too", "update",
         mistake_at(site::upper_alone, Change::inverted)},
        {"lower_wall_not_alone", "after a lower wall other walls answer, too", "update",
         mistake_at(site::lower_alone, Change::inverted)},
        {"upper_wall_at_the_lower", "upper walls answer from the lower ones' places", "update",
         mistake_at(site::upper_limit, Change::instead, -1, &site::lower_limit)},
        {"world_turned_over", "the world's least corner is its greatest", "update",
         mistake_at(site::world_min, Change::instead, -1, &site::world_max)},
        {"spheres_padded", "the host pads its spheres' records to 144 bytes", "update",
         handed_over(Deviation::spheres_padded)},
        {"boxes_padded", "the host pads its boxes' records to 144 bytes", "update",
         handed_over(Deviation::boxes_padded)},
        {"spheres_at_144_bytes", "spheres' records are read 144 bytes apart", "update",
         handed_over(Deviation::spheres_at_144_bytes)},
        {"boxes_at_144_bytes", "boxes' records are read 144 bytes apart", "update",
         handed_over(Deviation::boxes_at_144_bytes)},
        {"spheres_at_140_bytes", "spheres of 16 bytes are read 140 bytes apart", "update",
         handed_over(Deviation::spheres_at_140_bytes)},
        {"boxes_unturned", "boxes are in their places, but not turned", "update",
         handed_over(Deviation::boxes_unturned)},
        {"cone_of_the_angle", "the host hands over a cone's angle, not its cosine", "vacuum_up",
         handed_over(Deviation::angle_for_cosine)},
        {"cone_of_the_angle", "the host hands over a cone's angle, not its cosine", "blow_wind",
         handed_over(Deviation::angle_for_cosine)},
        {"angle_for_tangent", "the emitter's angle is taken for its tangent", "emit",
         handed_over(Deviation::angle_for_tangent)},
        {"first_frame_again", "the chance is drawn for the first frame in every frame", "emit",
         handed_over(Deviation::first_frame)},
        {"blast_at_the_tool", "a blast is where the tool is, not where its ball hit", "explode",
         handed_over(Deviation::blast_at_the_tool)},
        {"blast_by_frames", "a blast lasts a frame", "explode", handed_over(Deviation::impulses_of_frame)},
        {"emitted_by_frames", "an emission lasts a frame", "emit", handed_over(Deviation::impulses_of_frame)},
        {"tool_a_frame_late", "the tool is where it was in the frame before", "vacuum_up",
         handed_over(Deviation::pose_late)},
        {"tool_a_frame_late", "the tool is where it was in the frame before", "emit",
         handed_over(Deviation::pose_late)},
        {"tool_a_frame_late", "the tool is where it was in the frame before", "blow_wind",
         handed_over(Deviation::pose_late)},
        {"colours_swapped", "from the second colour to the first", "populate",
         spoiled_at(site::colour, colours_swapped)},
        {"z_of_y", "z is drawn as y is", "populate", spoiled_at(site::triple, z_is_y)},
        {"random_of_32_bits", "numbers are made of 32 bits, not of 24", "populate",
         spoiled_at(site::random, of_32_bits)},
        {"random_of_32_bits", "numbers are made of 32 bits, not of 24", "emit", spoiled_at(site::random, of_32_bits)},
        {"pcg_shift", "the generator shifts by 3 more, not by 4", "populate", spoiled_at(site::random, shifted_by_3)},
        {"emitted_all", "every dead grain comes back at once", "emit", mistake_at(site::is_lucky, Change::always)},
        {"deaths_not_counted", "the count leaves out the grains that died", "vacuum_up_count",
         mistake_at(site::change, Change::zero)},
        {"deaths_counted_up", "the count rises with each death", "vacuum_up_count",
         mistake_at(site::change, Change::negated)},
        {"deaths_counted_twice", "each death counts twice", "vacuum_up_count",
         mistake_at(site::change, Change::doubled)},
        {"births_not_counted", "the count leaves out the grains that came back", "emit_count",
         mistake_at(site::change, Change::zero)},
        {"births_counted_down", "the count falls with each that comes back", "emit_count",
         mistake_at(site::change, Change::negated)},
        {"births_counted_twice", "each that comes back counts twice", "emit_count",
         mistake_at(site::change, Change::doubled)},
        {"emitted_ten_times",
         "one dead grain in ten comes back, not one in a hundred",
         "emit",
         {.site = site::is_lucky.id, .change = Change::decided_by_formula, .formula = one_in_ten}},
        {"emitted_none", "no grain comes back", "emit", mistake_at(site::is_lucky, Change::never)},
        {"moved_by_old_velocity", "grains move by the velocity before the frame, not by the new one", "update",
         mistake_at(site::mover, Change::instead, -1, &site::speed)},
        free_formula("moved_by_mean_velocity", "grains move by the mean of the old and the new velocity", "update",
                     spoiled_at(site::mover, mean_velocity)),
        free_formula("moved_by_constant_time", "grains move for 0.02 s, whatever a frame takes", "update",
                     spoiled_at(site::way_of_frame, way_of_constant_time)),
        free_formula("drag_after_gravity", "the air resists what gravity made of the velocity", "update",
                     spoiled_at(site::fall, drag_after_gravity)),
        free_formula("drag_squared", "the air resists by the square of the speed", "update",
                     spoiled_at(site::drag, drag_squared)),
        free_formula("bounce_slows_normal_part", "a sphere slows the normal part of the velocity alone", "update",
                     with(spoiled_at(site::speed_into, slowed_normal_part), sphere_keeps_speed)),
        {"spheres_without_grain", "spheres are met by the grains' centres", "update",
         mistake_at(site::reach, Change::minus, -1, &site::radius)},
        free_formula("suction_to_the_rim", "the pull fades evenly to the rim of the range", "vacuum_up",
                     spoiled_at(site::pull, suction_to_the_rim)),
        free_formula("suction_along_the_axis", "the vacuum pulls along its axis, not to its mouth", "vacuum_up",
                     spoiled_at(site::force, along_the_axis<-1>)),
        {"both_cones",
         "the vacuum has a second cone behind it",
         "vacuum_up",
         {.site = site::in_cone.id, .change = Change::decided_by_formula, .formula = both_cones}},
        free_formula("forecast_of_a_second", "the forecast is of a second, not of a frame", "vacuum_up",
                     spoiled_at(site::forecast, forecast_of_a_second)),
        free_formula("cosine_without_sign", "the vacuum pulls behind it as in front of it", "vacuum_up",
                     spoiled_at(site::along, without_sign)),
        free_formula("suction_by_cube", "the pull fades with the cube of the distance", "vacuum_up",
                     spoiled_at(site::pull, by_cube)),
        free_formula("forecast_of_two_frames", "the forecast is of two frames, not of one", "vacuum_up",
                     spoiled_at(site::forecast, forecast_of_two_frames)),
        free_formula("emitted_at_length_one", "the direction emitted is made as long as 1", "emit",
                     spoiled_at(site::emitted, of_length_one)),
        free_formula("wind_to_the_rim", "the wind fades to the rim of its range as well", "blow_wind",
                     spoiled_at(site::force, wind_to_the_rim)),
        free_formula("wind_along_the_axis", "the wind blows along its axis, not away from the mouth", "blow_wind",
                     spoiled_at(site::force, along_the_axis<1>)),
        free_formula("blast_by_distance", "the blast fades with the distance, not its square", "explode",
                     spoiled_at(site::share, blast_by_distance)),
        free_formula("blast_upwards", "the blast throws everything straight up", "explode",
                     spoiled_at(site::blast_direction, upwards)),
    };
    static const std::vector<NamedMistake> with_kernels = [] {
        std::vector<NamedMistake> more = all;
        for (const char* const kernel : {"update", "vacuum_up", "blow_wind", "explode"}) {
            more.push_back({"stride_16_read", "velocities are read at a stride of 16 bytes", kernel,
                            spoiled_at(site::speed, at_stride_16)});
            more.push_back({.name = "tail_left_out",
                            .meaning = "the last grains, which fill no group of so many, are left out",
                            .pass = kernel,
                            .mistake = with(spoiled_at(site::position, tail_left_out<site::before>), same_velocity),
                            .constants = {{64.0F}, {128.0F}, {256.0F}, {512.0F}, {1024.0F}}});
        }
        return more;
    }();
    return with_kernels;
}

} // namespace lockstep::dust
