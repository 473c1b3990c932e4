#include "reference/collision/formulas/words.hpp"

#include <bit>
#include <cstdint>
#include <string_view>
#include <utility>

#include "reference/collision/formulas/fits.hpp"
#include "reference/half.hpp"

namespace lockstep::formulas {
namespace {

constexpr std::array added_lengths{1e-1F, 1e-2F, 1e-3F, 1e-4F, 1e-5F, 1e-6F, 1e-7F, 1e-8F};
constexpr std::array parts{0.1F, 0.2F, 0.25F, 0.3F, 0.5F, 0.7F, 0.75F, 0.8F, 0.9F};
constexpr std::array three{0.0F, 1.0F, 2.0F};
constexpr std::array direction_steps{127.0F,  128.0F,  255.0F,  256.0F,   511.0F,
                                     1000.0F, 1023.0F, 1024.0F, 32767.0F, 65535.0F};
constexpr std::array six{0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F};

glm::vec3 in_half_floats(glm::vec3 v) { return {half_round(v.x), half_round(v.y), half_round(v.z)}; }

/// As in Quake III Arena, improved so many times.
float fast_inverse_root(float x, int times) {
    auto y = std::bit_cast<float>(0x5f3759dfU - (std::bit_cast<std::uint32_t>(x) >> 1U));
    for (int i = 0; i < times; ++i)
        y = y * (1.5F - 0.5F * x * y * y);
    return y;
}

/// Who leaves a hit with another velocity.
template <class Velocity>
void leaves_with(std::vector<FormulaMistake>& all, std::string_view name, std::string_view meaning, const Velocity&) {
    static const Mistake speed =
        value(site::speed_at_hit, [](Floats v, Run run) { v[0] = glm::length(Velocity()(run)); });
    all.push_back(
        {name, meaning,
         value(
             site::direction_at_hit, [](Floats v, Run run) { set(v, glm::normalize(Velocity()(run))); }, &speed)});
}

const Mistake mean_of_all = at(site::direction_at_hit, Change::by_formula, [](Floats v, Run run) {
    set(v, vec3(run, site::away) / static_cast<float>(std::max(run.offered, 1)));
});

} // namespace

void add_responses(std::vector<FormulaMistake>& all) {
    static const auto reflected = [](Run run) {
        const glm::vec3 n = unit_away(run), d = old_direction(run);
        return d - 2.0F * glm::dot(n, d) * n;
    };
    all.push_back({"reflected_at_hit", "at a hit: the old direction reflected, not away from the nearest",
                   hit_direction([](Floats v, Run run) { set(v, reflected(run)); })});
    all.push_back({"reflected_where_approaching", "at a hit: the old direction, reflected where it approaches",
                   hit_direction([](Floats v, Run run) {
                       set(v,
                           glm::dot(unit_away(run), old_direction(run)) < 0.0F ? reflected(run) : old_direction(run));
                   })});
    all.push_back({"direction_negated_at_hit", "at a hit: the old direction, negated",
                   hit_direction([](Floats v, Run run) { set(v, -old_direction(run)); })});
    all.push_back({"slides_at_hit", "at a hit: the old direction without its part along away",
                   hit_direction([](Floats v, Run run) {
                       const glm::vec3 n = unit_away(run), d = old_direction(run);
                       set(v, glm::normalize(d - n * glm::dot(d, n)));
                   })});
    all.push_back(
        {"mean_of_away_and_old_direction", "at a hit: the mean of away and the old direction",
         hit_direction([](Floats v, Run run) { set(v, glm::normalize(unit_away(run) + old_direction(run))); })});
    all.push_back(
        {"away_plus_old_direction", "at a hit: away, not normalised, plus the old direction",
         hit_direction([](Floats v, Run run) { set(v, glm::normalize(vec3(run, site::away) + old_direction(run))); })});
    all.push_back({"half_of_away_and_old_direction", "at a hit: half of away plus the old direction, not normalised",
                   hit_direction([](Floats v, Run run) { set(v, 0.5F * (unit_away(run) + old_direction(run))); })});
    all.push_back({"sideways_at_hit", "at a hit: the cross product of away and an axis",
                   hit_direction([](Floats v, Run run) {
                       glm::vec3 axis(0.0F);
                       const auto which = static_cast<int>(run.constants[0]);
                       axis[which % 3] = which < 3 ? 1.0F : -1.0F;
                       set(v, glm::normalize(glm::cross(vec3(run, site::away), axis)));
                   }),
                   six});
    all.push_back({"flat_at_hit", "at a hit: away without x, y or z", hit_direction([](Floats v, Run run) {
                       glm::vec3 away = vec3(run, site::away);
                       away[static_cast<int>(run.constants[0])] = 0.0F;
                       set(v, glm::normalize(away));
                   }),
                   three});
    all.push_back(
        {"away_over_range", "at a hit: away / u_CollisionRange, not normalised", hit_direction([](Floats v, Run run) {
             set(v, vec3(run, site::away) / params(run).constants.collision_range);
         })});
    static const Mistake fall_by_greatest = value(site::direction, [](Floats v, Run run) {
        const glm::vec3 velocity = vec3(run, site::velocity);
        set(v, velocity / greatest(velocity));
    });
    static const Formula by_greatest = [](Floats v, Run run) {
        set(v, vec3(run, site::away) / greatest(vec3(run, site::away)));
    };
    all.push_back({"normalised_by_greatest", "directions are divided by their greatest component",
                   value(site::direction_at_hit, by_greatest, &fall_by_greatest)});
    all.push_back({"normalised_by_greatest_at_hit", "at a hit: away divided by its greatest component",
                   hit_direction(by_greatest)});
    all.push_back({"normalised_by_greatest_in_fall", "no hit: the direction is divided by its greatest component",
                   fall_by_greatest});
    static const auto speed_of_hit = [](Run run) {
        return real(run, site::speed_before) * params(run).switches.speed_factor;
    };
    static const auto velocity_after_hit = [](Run run) { return unit_away(run) * speed_of_hit(run) + fall(run); };
    leaves_with(all, "gravity_at_hit", "at a hit: gravity acts, too", velocity_after_hit);
    all.push_back({"gravity_moves_at_hit", "at a hit: gravity * tick * tick is added to the position",
                   hit_position([](Floats v, Run run) { set(v, get(v) + fall(run) * tick(run)); })});
    all.push_back({"gravity_added_to_position_at_hit", "at a hit: gravity * tick is added to the position",
                   hit_position([](Floats v, Run run) { set(v, get(v) + fall(run)); })});
    static const auto neighbour = [](Run run) { return before(run) - vec3(run, site::away); };
    static const auto hit_step = [](Run run) { return vec3(run, site::moves_along) * real(run, site::moves_by); };
    all.push_back({"pushed_out_to_range", "at a hit: set on the sphere of the range around the neighbour",
                   hit_position([](Floats v, Run run) {
                       set(v, neighbour(run) + unit_away(run) * params(run).constants.collision_range);
                   })});
    all.push_back({"pushed_half_out", "at a hit: moved out by half of what is missing to the range",
                   hit_position([](Floats v, Run run) {
                       const float missing = params(run).constants.collision_range - glm::length(vec3(run, site::away));
                       set(v, before(run) + unit_away(run) * (0.5F * missing));
                   })});
    all.push_back({"pushed_by_range", "at a hit: moves by u_CollisionRange", hit_position([](Floats v, Run run) {
                       set(v, before(run) + unit_away(run) * params(run).constants.collision_range);
                   })});
    all.push_back({"pushed_by_distance", "at a hit: moves by the distance to the neighbour",
                   hit_position([](Floats v, Run run) { set(v, before(run) + vec3(run, site::away)); })});
    static const Mistake falls_to = hit_position([](Floats v, Run run) {
        const bool by_tick = params(run).switches.collision_step == CollisionStep::tick;
        const glm::vec3 step = unit_away(run) * speed_of_hit(run) * (by_tick ? tick(run) : 1.0F);
        set(v, before(run) + step + velocity_after_hit(run) * tick(run));
    });
    static const Mistake falls_faster = value(
        site::speed_at_hit, [](Floats v, Run run) { v[0] = glm::length(velocity_after_hit(run)); }, &falls_to);
    static const Mistake counts_too = value(
        site::collide_time_at_hit, [](Floats v, Run run) { v[0] -= tick(run); }, &falls_faster);
    all.push_back({"falls_after_hit_too", "at a hit: the step of free fall follows",
                   value(
                       site::direction_at_hit,
                       [](Floats v, Run run) { set(v, glm::normalize(velocity_after_hit(run))); }, &counts_too)});
    all.push_back(
        {"speed_less_factor_at_hit", "at a hit: speed - factor", value(site::speed_at_hit, [](Floats v, Run run) {
             v[0] = real(run, site::speed_before) - params(run).switches.speed_factor;
         })});
    all.push_back({"upwards_at_hit", "at a hit: the direction is straight up", hit_direction([](Floats v, Run) {
                       set(v, {0.0F, 1.0F, 0.0F});
                   })});
    all.push_back({"against_gravity_at_hit", "at a hit: the direction is against gravity",
                   hit_direction([](Floats v, Run run) { set(v, -glm::normalize(params(run).constants.gravity)); })});
    all.push_back({"away_from_origin_at_hit", "at a hit: the direction is away from the origin",
                   hit_direction([](Floats v, Run run) { set(v, glm::normalize(before(run))); })});
    all.push_back({"starts_at_neighbour", "at a hit: the step starts at the neighbour's position",
                   hit_position([](Floats v, Run run) { set(v, get(v) - vec3(run, site::away)); })});
    all.push_back(
        {"tick_squared_at_hit", "at a hit: moves by dir * speed * tick * tick",
         hit_position([](Floats v, Run run) { set(v, before(run) + hit_step(run) * (tick(run) * tick(run))); })});
    all.push_back({"moves_back_at_hit", "at a hit: moves backwards",
                   hit_position([](Floats v, Run run) { set(v, before(run) - (get(v) - before(run))); })});
    all.push_back({"old_direction_kept_in_part", "at a hit: away and a part of the old direction, as a unit vector",
                   hit_direction([](Floats v, Run run) {
                       set(v, glm::normalize(unit_away(run) + run.constants[0] * old_direction(run)));
                   }),
                   parts});
    all.push_back({"mixed_with_old_direction", "at a hit: mix(old direction, away, a constant), as a unit vector",
                   hit_direction([](Floats v, Run run) {
                       const float c = run.constants[0];
                       set(v, glm::normalize((1.0F - c) * old_direction(run) + c * unit_away(run)));
                   }),
                   parts});
    all.push_back({"length_with_epsilon_at_hit", "at a hit: away / (length + a constant)",
                   hit_direction([](Floats v, Run run) {
                       const glm::vec3 away = vec3(run, site::away);
                       set(v, away / (glm::length(away) + run.constants[0]));
                   }),
                   added_lengths});
    all.push_back({"speed_factor_by_tick", "at a hit: the factor to the power of 60 u_Tick",
                   value(site::speed_factor, [](Floats v, Run run) { v[0] = std::pow(v[0], 60.0F * tick(run)); })});
    all.push_back({"speed_by_depth", "at a hit: speed * factor * distance / range",
                   value(site::speed_at_hit, [](Floats v, Run run) {
                       v[0] *= glm::length(vec3(run, site::away)) / params(run).constants.collision_range;
                   })});
    all.push_back({"speed_by_penetration", "at a hit: speed * factor * (1 - distance / range)",
                   value(site::speed_at_hit, [](Floats v, Run run) {
                       v[0] *= 1.0F - glm::length(vec3(run, site::away)) / params(run).constants.collision_range;
                   })});
    all.push_back({"speed_is_distance", "at a hit: distance * factor", value(site::speed_at_hit, [](Floats v, Run run) {
                       v[0] = glm::length(vec3(run, site::away)) * params(run).switches.speed_factor;
                   })});
    all.push_back({"speed_is_factor", "at a hit: the speed is the factor",
                   value(site::speed_at_hit, [](Floats v, Run run) { v[0] = params(run).switches.speed_factor; })});
    all.push_back(
        {"speed_divided_by_factor", "at a hit: speed / factor", value(site::speed_at_hit, [](Floats v, Run run) {
             v[0] = real(run, site::speed_before) / params(run).switches.speed_factor;
         })});
    all.push_back({"speed_by_tick", "at a hit: speed * factor * tick",
                   value(site::speed_at_hit, [](Floats v, Run run) { v[0] *= tick(run); })});
    all.push_back({"speed_by_approach", "at a hit: the speed along away, times the factor",
                   value(site::speed_at_hit, [](Floats v, Run run) {
                       v[0] = std::abs(glm::dot(old_velocity(run), unit_away(run))) * params(run).switches.speed_factor;
                   })});
    static const Formula a_constant = [](Floats v, Run run) { v[0] = run.constants[0]; };
    all.push_back({"collision_time_is_a_constant",
                   "a constant for u_CollisionTime",
                   value(site::collide_time_at_hit, a_constant),
                   {},
                   collide_time_of});
    all.push_back({"speed_factor_is_a_constant",
                   "a constant for u_SpeedFactor",
                   value(site::speed_factor, a_constant),
                   {},
                   factor_of});
    all.push_back({"collide_time_counts_on_at_hit", "at a hit: collide time goes on counting, and is not set",
                   value(site::collide_time_at_hit,
                         [](Floats v, Run run) { v[0] = real(run, site::collide_time_before) - tick(run); })});
    all.push_back(
        {"collide_time_added_at_hit", "at a hit: collision time is added to the collide time",
         value(site::collide_time_at_hit, [](Floats v, Run run) { v[0] += real(run, site::collide_time_before); })});
    static const auto offset_of_hit = [](Run run) {
        const auto& texel = run.of_chosen(site::own_texel_skipped);
        return glm::vec3(texel[0], texel[1], 0.0F);
    };
    all.push_back({"direction_from_texels", "at a hit: away in the image, by the texel's offset",
                   hit_direction([](Floats v, Run run) { set(v, -glm::normalize(offset_of_hit(run))); })});
    all.push_back({"direction_towards_texel", "at a hit: towards the texel's offset, in the image",
                   hit_direction([](Floats v, Run run) { set(v, glm::normalize(offset_of_hit(run))); })});
    all.push_back({"dominant_axis_at_hit", "at a hit: away's greatest component alone, as a unit vector",
                   hit_direction([](Floats v, Run run) {
                       const glm::vec3 away = vec3(run, site::away), size = glm::abs(away);
                       const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
                       glm::vec3 along(0.0F);
                       along[axis] = away[axis] < 0.0F ? -1.0F : 1.0F;
                       set(v, along);
                   })});
    all.push_back({"signs_of_away_at_hit", "at a hit: sign(away), not normalised",
                   hit_direction([](Floats v, Run run) { set(v, glm::sign(vec3(run, site::away))); })});
    all.push_back({"direction_in_steps_at_hit", "at a hit: away as a unit vector, rounded to steps of 1 / a constant",
                   hit_direction([](Floats v, Run run) {
                       set(v, glm::round(unit_away(run) * run.constants[0]) / run.constants[0]);
                   }),
                   direction_steps});
    all.push_back({"direction_in_half_floats_at_hit", "at a hit: away as a unit vector, in half floats",
                   hit_direction([](Floats v, Run run) { set(v, in_half_floats(unit_away(run))); })});
    all.push_back({"mean_of_neighbours_at_hit",
                   "at a hit: the mean of what was added up, not normalised",
                   {.site = site::nearest.id, .change = Change::added_up, .also = &mean_of_all}});
    all.push_back(
        {"last_distance_divides", "at a hit: away over the distance that was looked at last",
         hit_direction([](Floats v, Run run) { set(v, vec3(run, site::away) / real(run, site::distance)); })});
    static const Formula by_fast_root = [](Floats v, Run run) {
        const glm::vec3 away = vec3(run, site::away);
        set(v, away * fast_inverse_root(glm::dot(away, away), static_cast<int>(run.constants[0])));
    };
    static const Mistake fall_by_fast_root = value(site::direction, [](Floats v, Run run) {
        const glm::vec3 velocity = vec3(run, site::velocity);
        set(v, velocity * fast_inverse_root(glm::dot(velocity, velocity), static_cast<int>(run.constants[0])));
    });
    all.push_back({"fast_inverse_root_at_hit", "at a hit: 0x5f3759df for the inverse root, improved n times",
                   hit_direction(by_fast_root), three});
    all.push_back({"fast_inverse_root_in_fall", "no hit: 0x5f3759df for the inverse root, improved n times",
                   fall_by_fast_root, three});
    all.push_back({"fast_inverse_root", "0x5f3759df for the inverse root, improved n times",
                   value(site::direction_at_hit, by_fast_root, &fall_by_fast_root), three});
    const auto speeds = [&](std::string_view name, std::string_view meaning, Formula formula,
                            std::span<const float> constants = {}) {
        all.push_back({name, meaning, value(site::speed_at_hit, formula), constants});
    };
    speeds("speed_damped_by_each_nearer", "at a hit: speed * factor for each that was the nearest so far",
           [](Floats v, Run run) {
               v[0] = real(run, site::speed_before);
               for (int i = 0; i < run.taken; ++i)
                   v[0] *= params(run).switches.speed_factor;
           });
    speeds("speed_damped_by_each_in_range", "at a hit: speed * factor for each in range", [](Floats v, Run run) {
        v[0] = real(run, site::speed_before);
        for (int i = 0; i < run.offered; ++i)
            v[0] *= params(run).switches.speed_factor;
    });
    speeds("speed_over_neighbours", "at a hit: speed * factor over the number in range",
           [](Floats v, Run run) { v[0] /= static_cast<float>(std::max(run.offered, 1)); });
    speeds("speed_times_neighbours", "at a hit: speed * factor times the number in range",
           [](Floats v, Run run) { v[0] *= static_cast<float>(run.offered); });
    speeds("speed_by_angle", "at a hit: speed * factor times max(0, -dot(old, new direction))",
           [](Floats v, Run run) { v[0] *= std::max(0.0F, -glm::dot(old_direction(run), unit_away(run))); });
    speeds("speed_by_angle_forwards", "at a hit: speed * factor times max(0, dot(old, new direction))",
           [](Floats v, Run run) { v[0] *= std::max(0.0F, glm::dot(old_direction(run), unit_away(run))); });
    speeds("speed_by_size_of_angle", "at a hit: speed * factor times |dot(old, new direction)|",
           [](Floats v, Run run) { v[0] *= std::abs(glm::dot(old_direction(run), unit_away(run))); });
    speeds("speed_factor_rooted", "at a hit: speed * sqrt(factor)", [](Floats v, Run run) {
        v[0] = real(run, site::speed_before) * std::sqrt(params(run).switches.speed_factor);
    });
    speeds("speed_plus_factor", "at a hit: speed + factor",
           [](Floats v, Run run) { v[0] = real(run, site::speed_before) + params(run).switches.speed_factor; });
    speeds("speed_times_one_more", "at a hit: speed * (1 + factor)", [](Floats v, Run run) {
        v[0] = real(run, site::speed_before) * (1.0F + params(run).switches.speed_factor);
    });
    all.push_back({"speed_capped_at_hit",
                   "at a hit: the speed is at most a constant",
                   value(site::speed_at_hit, [](Floats v, Run run) { v[0] = std::min(v[0], run.constants[0]); }),
                   {},
                   speed_of});
    all.push_back({"speed_at_least_at_hit",
                   "at a hit: the speed is at least a constant",
                   value(site::speed_at_hit, [](Floats v, Run run) { v[0] = std::max(v[0], run.constants[0]); }),
                   {},
                   speed_of});
    leaves_with(all, "bounces_by_factor", "at a hit: velocity - (1 + factor) * its part along away", [](Run run) {
        const glm::vec3 n = unit_away(run), u = old_velocity(run);
        return u - (1.0F + params(run).switches.speed_factor) * glm::dot(u, n) * n;
    });
    leaves_with(all, "slides_with_what_is_left", "at a hit: velocity without its part along away, undamped",
                [](Run run) {
                    const glm::vec3 n = unit_away(run), u = old_velocity(run);
                    return u - glm::dot(u, n) * n;
                });
    leaves_with(all, "velocity_added_at_hit", "at a hit: away * speed * factor is added to the velocity", [](Run run) {
        return old_velocity(run) + unit_away(run) * real(run, site::speed_before) * params(run).switches.speed_factor;
    });
    all.push_back({"moves_on_before_hit", "at a hit: moves by the old velocity, too",
                   hit_position([](Floats v, Run run) { set(v, get(v) + old_velocity(run) * tick(run)); })});
    all.push_back(
        {"falls_on_before_hit", "at a hit: moves by the old velocity and gravity, too",
         hit_position([](Floats v, Run run) { set(v, get(v) + (old_velocity(run) + fall(run)) * tick(run)); })});
    all.push_back({"moves_by_old_velocity_at_hit", "at a hit: moves by the old velocity",
                   hit_position([](Floats v, Run run) { set(v, before(run) + old_velocity(run) * tick(run)); })});
    all.push_back({"moves_twice_at_hit", "at a hit: moves by twice the step",
                   hit_position([](Floats v, Run run) { set(v, get(v) + (get(v) - before(run))); })});
    all.push_back({"moves_back_out_of_step", "at a hit: goes back by the old step, then moves",
                   hit_position([](Floats v, Run run) { set(v, get(v) - old_velocity(run) * tick(run)); })});
    static const Mistake moves_as_unit = value(site::moves_along, [](Floats v, Run run) { set(v, unit_away(run)); });
    static const Formula velocity_of_hit = [](Floats v, Run run) {
        set(v, unit_away(run) * real(run, site::speed_at_hit));
    };
    static const Mistake velocity_at_hit = value(site::direction_at_hit, velocity_of_hit, &moves_as_unit);
    all.push_back(
        {"velocity_stored_as_direction_at_hit", "at a hit: the velocity is stored as the direction", velocity_at_hit});
    static const Mistake falls_by_velocity = value(
        site::step, [](Floats v, Run run) { set(v, vec3(run, site::velocity)); }, &velocity_at_hit);
    all.push_back({"velocity_stored_as_direction_everywhere",
                   "the velocity is stored as the direction",
                   {.site = site::direction.id, .change = Change::not_done, .also = &falls_by_velocity}});
    all.push_back({"collide_time_is_not_below", "at a hit: the greater of collision time and collide time",
                   value(site::collide_time_at_hit,
                         [](Floats v, Run run) { v[0] = std::max(v[0], real(run, site::collide_time_before)); })});
    all.push_back({"collide_time_times_tick", "at a hit: u_CollisionTime * u_Tick",
                   value(site::collide_time_at_hit, [](Floats v, Run run) { v[0] *= tick(run); })});
    all.push_back({"collide_time_over_tick", "at a hit: u_CollisionTime / u_Tick",
                   value(site::collide_time_at_hit, [](Floats v, Run run) { v[0] /= tick(run); })});
    all.push_back({"collide_time_by_distance", "at a hit: u_CollisionTime * distance / range",
                   value(site::collide_time_at_hit, [](Floats v, Run run) {
                       v[0] *= glm::length(vec3(run, site::away)) / params(run).constants.collision_range;
                   })});
    all.push_back({"collide_time_by_speed", "at a hit: u_CollisionTime * the old speed",
                   value(site::collide_time_at_hit, [](Floats v, Run run) { v[0] *= real(run, site::speed_before); })});
}

} // namespace lockstep::formulas
