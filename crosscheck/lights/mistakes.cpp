#include "crosscheck/lights/mistakes.hpp"

#include <cmath>
#include <cstddef>

#include "crosscheck/lights/image_mistakes.hpp"
#include "crosscheck/lights/lighting_mistakes.hpp"
#include "crosscheck/lights/mistake_words.hpp"
#include "crosscheck/lights/volume_mistakes.hpp"
#include "reference/lights/sites.hpp"

namespace lockstep::lights {
namespace {

void z_is_y(Words value, const CameBy& /*run*/) { value[2] = value[1]; }
/// As far from the wall across as the place is behind this one.
void from_high(Words value, const CameBy& run) {
    value[0] = first(run, site::wall_high) - (value[0] - first(run, site::wall_low));
}
void from_low(Words value, const CameBy& run) {
    value[0] = first(run, site::wall_low) + (first(run, site::wall_high) - value[0]);
}
template <int sign> void endless_along_z(Words value, const CameBy& /*run*/) {
    value[2] = static_cast<float>(sign) * HUGE_VALF;
}
/// The whole direction is turned at each wall.
void turned_back(Words value, const CameBy& run) {
    const auto& way = run.of(site::way);
    bool back = false;
    for (std::size_t c = 0; c < value.size(); ++c)
        back = back != (value[c] != way[c]);
    for (std::size_t c = 0; c < value.size(); ++c)
        value[c] = back ? -way[c] : way[c];
}

std::vector<NamedMistake> of_steps() {
    static const Mistake high_of_x = spoiled_at(site::high, y_is_x);
    static const Mistake high_of_y = spoiled_at(site::high, z_is_y);
    static const Mistake never_above = mistake_at(site::above, Change::never);
    static const Mistake not_turned = mistake_at(site::turned, Change::negated);
    static const Mistake wrapped_high = with(spoiled_at(site::mirrored_high, from_low), not_turned);
    static const Mistake high_endless = spoiled_at(site::high, endless_along_z<1>);
    return {
        {"step_without_tick", "in each frame lights move as far as in a second", "light_step_pass",
         mistake_at(site::tick, Change::one)},
        {"step_without_speed", "every light goes 1 m a second", "light_step_pass",
         mistake_at(site::speed_before, Change::one)},
        {"bounce_keeps_direction", "at a wall a light keeps its direction", "light_step_pass",
         mistake_at(site::turned, Change::negated)},
        {"stops_at_lower_wall", "at a lower wall a light stops", "light_step_pass",
         mistake_at(site::mirrored_low, Change::instead, -1, &site::wall_low)},
        {"stops_at_upper_wall", "at an upper wall a light stops", "light_step_pass",
         mistake_at(site::mirrored_high, Change::instead, -1, &site::wall_high)},
        {"lower_wall_missing", "at a lower wall a light stops, and keeps its direction", "light_step_pass",
         mistake_at(site::below, Change::never)},
        {"upper_wall_missing", "at an upper wall a light stops, and keeps its direction", "light_step_pass",
         mistake_at(site::above, Change::never)},
        {"steps_backwards", "lights go backwards", "light_step_pass", mistake_at(site::step, Change::negated)},
        {"light_stays", "lights stay where they are", "light_step_pass",
         mistake_at(site::position, Change::instead, -1, &site::before)},
        {.name = "step_left_out",
         .meaning = "lights are as in the frame before",
         .pass = "light_step_pass",
         .mistake = {.change = Change::item_kept}},
        {"place_lost", "a light's step is its place", "light_step_pass",
         mistake_at(site::moved, Change::instead, -1, &site::step)},
        {"walls_by_size", "the upper walls are as far from the world's origin as the grid is large", "light_step_pass",
         mistake_at(site::high, Change::minus, -1, &site::low)},
        {"lower_wall_mirrors_to_zero", "a lower wall mirrors to a place from the world's origin", "light_step_pass",
         mistake_at(site::mirrored_low, Change::minus, -1, &site::wall_low)},
        {"turned_back", "at a wall a light goes back the way it came", "light_step_pass",
         spoiled_at(site::direction, turned_back)},
        {"stops_at_walls", "at a wall a light stops, and keeps its direction", "light_step_pass",
         with(mistake_at(site::below, Change::never), never_above)},
        {"wraps_around", "behind a wall a light goes on at the wall across", "light_step_pass",
         with(spoiled_at(site::mirrored_low, from_high), wrapped_high)},
        {"z_between_walls_of_y", "lights move along z between the walls of y", "light_step_pass",
         with(spoiled_at(site::low, z_is_y), high_of_y)},
        {"y_between_walls_of_x", "lights move along y between the walls of x", "light_step_pass",
         with(spoiled_at(site::low, y_is_x), high_of_x)},
        {"walls_of_z_missing", "lights leave the grid along z", "light_step_pass",
         with(spoiled_at(site::low, endless_along_z<-1>), high_endless)},
    };
}

} // namespace

const std::vector<NamedMistake>& mistakes() {
    static const std::vector<NamedMistake> all = [] {
        std::vector<NamedMistake> made;
        for (const std::vector<NamedMistake>& some :
             {of_steps(), volume_mistakes(), lighting_mistakes(), image_mistakes()})
            made.insert(made.end(), some.begin(), some.end());
        return made;
    }();
    return all;
}

} // namespace lockstep::lights
