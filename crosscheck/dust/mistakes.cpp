#include "crosscheck/dust/mistakes.hpp"

#include <cmath>
#include <span>

#include "reference/dust/sites.hpp"

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

Mistake spoiled_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::spoiled, .formula = formula};
}

} // namespace

const std::vector<NamedMistake>& mistakes() {
    static const std::vector<NamedMistake> all{
        {"gravity_missing", "gravity is not added", "update", mistake_at(site::gravity, Change::zero)},
        {"drag_missing", "the air does not resist", "update", mistake_at(site::drag, Change::zero)},
        {"drag_reversed", "the air pushes along", "update", mistake_at(site::drag, Change::negated)},
        {"elasticity_missing", "a bounce loses nothing", "update", mistake_at(site::elasticity, Change::one)},
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
        {"death_range_ignored", "the mouth has no death range", "vacuum_up",
         mistake_at(site::near_mouth, Change::never)},
        {"lower_walls_open", "grains fall through the floor and the lower walls", "update",
         mistake_at(site::below_wall, Change::never)},
        {"upper_walls_open", "grains leave through the upper walls", "update",
         mistake_at(site::above_wall, Change::never)},
        {"wind_reversed", "the wind sucks", "blow_wind", mistake_at(site::force, Change::negated)},
        {"wind_everywhere", "the wind has no cone", "blow_wind", mistake_at(site::in_cone, Change::always)},
        {"blast_everywhere", "the blast has no range", "explode", mistake_at(site::in_range, Change::always)},
        {"blast_not_fading", "the blast is as strong at its rim", "explode", mistake_at(site::share, Change::one)},
        {"emitted_all", "every dead grain comes back at once", "emit", mistake_at(site::is_lucky, Change::always)},
        {"emitted_none", "no grain comes back", "emit", mistake_at(site::is_lucky, Change::never)},
    };
    return all;
}

} // namespace lockstep::dust
