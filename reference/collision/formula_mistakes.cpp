#include "reference/collision/formula_mistakes.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "reference/collision/sites.hpp"

namespace lockstep {
namespace {

using Floats = std::span<float>;
using Run = const CameBy&;
const FrameParams& params(Run run) { return *static_cast<const FrameParams*>(run.world); }
glm::vec3 vec3(Run run, const Site& site) {
    const auto& v = run.of(site);
    return {v[0], v[1], v[2]};
}
float real(Run run, const Site& site) { return run.of(site)[0]; }
void set(Floats value, glm::vec3 v) {
    for (int c = 0; c < 3; ++c)
        value[static_cast<std::size_t>(c)] = v[c];
}
glm::vec3 get(Floats value) { return {value[0], value[1], value[2]}; }
float greatest(glm::vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
float tick(Run run) { return params(run).constants.tick; }
glm::vec3 fall(Run run) { return params(run).constants.gravity * tick(run); }
glm::vec3 unit_away(Run run) { return glm::normalize(vec3(run, site::away)); }
glm::vec3 before(Run run) { return vec3(run, site::position_before); }
glm::vec3 old_direction(Run run) { return vec3(run, site::direction_before); }
glm::vec3 old_velocity(Run run) { return old_direction(run) * real(run, site::speed_before); }
int reach(Run run) { return params(run).constants.texel_collide_range; }
float clip_w(Run run) { return run.of(site::clip)[3]; }
void leave_out(Floats fetch) { fetch[0] = -1.0F; }
template <class Keep> void keep_where(Floats answer, const Keep& keep) {
    answer[0] = answer[0] != 0.0F && keep() ? 1.0F : 0.0F;
}

Mistake at(const Site& site, Change change, Formula formula, const Mistake* also = nullptr) {
    return {.site = site.id, .change = change, .formula = formula, .also = also};
}
Mistake value(const Site& site, Formula formula, const Mistake* also = nullptr) {
    return at(site, Change::by_formula, formula, also);
}
Mistake skipped(Formula formula) { return at(site::own_texel_skipped, Change::decided_by_formula, formula); }
Mistake search(Formula formula) { return at(site::searches, Change::decided_by_formula, formula); }
Mistake in_range(Formula formula) { return at(site::in_range, Change::decided_by_formula, formula); }
Mistake fetch(Formula formula) { return at(site::neighbour, Change::fetched_by_formula, formula); }
Mistake holds(Formula formula) { return at(site::holds_particle, Change::decided_by_formula, formula); }
Mistake hit_direction(Formula formula) { return value(site::direction_at_hit, formula); }
Mistake hit_position(Formula formula) { return value(site::position_at_hit, formula); }

/// Of a texel that is looked at: which one, counted from the base texel.
struct Offset {
    int x, y;
};
Offset offset(Floats skipped) { return {static_cast<int>(skipped[1]), static_cast<int>(skipped[3])}; }
template <class Skip> void skip_too(Floats answer, const Skip& skip) {
    const Offset o = offset(answer);
    if (skip(o.x, o.y))
        answer[0] = 1.0F;
}

constexpr std::array drags{0.5F, 0.8F, 0.9F, 0.95F, 0.98F, 0.99F, 0.995F, 0.999F, 0.9999F, 1.001F, 1.01F, 1.05F, 1.1F};
constexpr std::array epsilons{1e-1F, 1e-2F, 1e-3F, 1e-4F, 1e-5F, 1e-6F, -1e-1F, -1e-2F, -1e-3F, -1e-4F, -1e-5F, -1e-6F};
constexpr std::array ranges{0.001F, 0.01F, 0.02F, 0.05F, 0.1F, 0.2F, 0.25F, 0.5F, 1.0F, 2.0F, 5.0F, 10.0F};
constexpr std::array four{0.0F, 1.0F, 2.0F, 3.0F};
constexpr std::array three{0.0F, 1.0F, 2.0F};
constexpr std::array six{0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F};

/// To four digits: what a programmer writes down.
float written(float x) {
    if (x == 0.0F || !std::isfinite(x))
        return x;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(double{x}))) - 3);
    return static_cast<float>(std::round(double{x} / unit) * unit);
}

// Words of an item, as Fit has them: position, direction, speed, collide time.
std::array<float, 3> speed_of(std::span<const float>, std::span<const float> after, const Constants&) {
    return {written(after[6])};
}
std::array<float, 3> gravity_of(std::span<const float> before, std::span<const float> after, const Constants& c) {
    std::array<float, 3> g{};
    float largest = 0.0F;
    for (std::size_t i = 0; i < 3; ++i) {
        g[i] = written((after[3 + i] * after[6] - before[3 + i] * before[6]) / c.tick);
        largest = std::max(largest, std::abs(g[i]));
    }
    for (float& x : g)
        if (std::abs(x) < largest * 1e-3F) // what rounding left
            x = 0.0F;
    return g;
}
/// One over a whole number where it is near one, as 1/60 s.
float as_time(float x) {
    const float rate = std::round(1.0F / x);
    return rate >= 2.0F && std::abs(1.0F / rate - x) < 1e-4F * x ? 1.0F / rate : written(x);
}
std::array<float, 3> counted_of(std::span<const float> before, std::span<const float> after, const Constants&) {
    return {as_time(before[7] - after[7])};
}
std::array<float, 3> moved_for(std::span<const float> before, std::span<const float> after, const Constants&) {
    std::size_t along = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(after[3 + i]) > std::abs(after[3 + along]))
            along = i;
    return {as_time((after[along] - before[along]) / (after[3 + along] * after[6]))};
}
std::array<float, 3> collide_time_of(std::span<const float>, std::span<const float> after, const Constants&) {
    return {written(after[7])};
}
std::array<float, 3> factor_of(std::span<const float> before, std::span<const float> after, const Constants&) {
    return {written(after[6] / before[6])};
}
template <int axis>
std::array<float, 3> plane_of(std::span<const float>, std::span<const float> after, const Constants&) {
    return {written(after[axis])};
}
template <int axis, bool floor> Mistake plane() {
    static constexpr Formula keep_off = [](Floats v, Run run) {
        v[axis] = floor ? std::max(v[axis], run.constants[0]) : std::min(v[axis], run.constants[0]);
    };
    static const Mistake too = value(site::position_at_hit, keep_off);
    return value(site::position, keep_off, &too);
}

/// The search: which of the texels round the base texel are looked at.
void add_windows(std::vector<FormulaMistake>& all) {
    all.push_back({"cross_searched", "only the base texel's row and column are searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return x != 0 && y != 0; }); })});
    all.push_back({"own_row_searched", "only the base texel's row is searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int, int y) { return y != 0; }); })});
    all.push_back({"own_column_searched", "only the base texel's column is searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int) { return x != 0; }); })});
    all.push_back({"diagonals_searched", "only the base texel's diagonals are searched", skipped([](Floats v, Run) {
                       skip_too(v, [](int x, int y) { return std::abs(x) != std::abs(y); });
                   })});
    all.push_back({"disc_searched", "a disc of texels is searched, not a square", skipped([](Floats v, Run run) {
                       const int r = reach(run);
                       skip_too(v, [&](int x, int y) { return x * x + y * y > r * r; });
                   })});
    all.push_back({"diamond_searched", "texels with |tx| + |ty| <= range are searched", skipped([](Floats v, Run run) {
                       const int r = reach(run);
                       skip_too(v, [&](int x, int y) { return std::abs(x) + std::abs(y) > r; });
                   })});
    all.push_back(
        {"ring_searched", "only the outermost texels of the window are searched", skipped([](Floats v, Run run) {
             const int r = reach(run);
             skip_too(v, [&](int x, int y) { return std::max(std::abs(x), std::abs(y)) < r; });
         })});
    all.push_back({"checkerboard_searched", "of the image's texels only every other is read, as on a checkerboard",
                   fetch([](Floats v, Run) {
                       if ((static_cast<int>(v[0]) + static_cast<int>(v[1])) % 2 != 0)
                           leave_out(v);
                   })});
    all.push_back({"odd_checkerboard_searched", "only texels with an odd x + y are read", fetch([](Floats v, Run) {
                       if ((static_cast<int>(v[0]) + static_cast<int>(v[1])) % 2 == 0)
                           leave_out(v);
                   })});
    all.push_back({"every_other_offset_searched", "only texels with an even tx + ty are searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return (x + y) % 2 != 0; }); })});
    const auto both_loops = [&](std::string_view name, std::string_view meaning, Formula formula, std::string_view rows,
                                std::string_view columns) {
        static std::deque<Mistake> of_columns; // their place stays
        const Mistake& too = of_columns.emplace_back(at(site::columns, Change::ranged_by_formula, formula));
        all.push_back({name, meaning, at(site::rows, Change::ranged_by_formula, formula, &too)});
        if (rows.empty()) // has a name elsewhere
            return;
        all.push_back({rows, meaning, at(site::rows, Change::ranged_by_formula, formula)});
        all.push_back({columns, meaning, too});
    };
    both_loops(
        "every_second_texel", "loops over the window in steps of 2", [](Floats v, Run) { v[2] = 2.0F; },
        "every_second_row", "every_second_column");
    both_loops(
        "window_shifted_up", "the window is from -range + 1 to range + 1",
        [](Floats v, Run) { v[0] += 1.0F, v[1] += 1.0F; }, "window_shifted_up_in_y", "window_shifted_up_in_x");
    both_loops(
        "window_shifted_down", "the window is from -range - 1 to range - 1",
        [](Floats v, Run) { v[0] -= 1.0F, v[1] -= 1.0F; }, "window_shifted_down_in_y", "window_shifted_down_in_x");
    both_loops(
        "window_from_base_texel_on", "the window is from 0 to range", [](Floats v, Run) { v[0] = 0.0F; },
        "rows_from_base_texel_on", "columns_from_base_texel_on");
    both_loops(
        "window_up_to_base_texel", "the window is from -range to 0", [](Floats v, Run) { v[1] = 0.0F; },
        "rows_up_to_base_texel", "columns_up_to_base_texel");
    both_loops(
        "first_texel_of_window", "a loop over the window has one turn, its first", [](Floats v, Run) { v[1] = v[0]; },
        "first_row_alone", "first_column_alone");
    both_loops(
        "last_texel_of_window", "a loop over the window has one turn, its last", [](Floats v, Run) { v[0] = v[1]; },
        "last_row_alone", "last_column_alone");
    both_loops(
        "window_ends_open", "the loops run to < range", [](Floats v, Run) { v[1] -= 1.0F; }, "", "");
    both_loops(
        "window_begins_late", "the loops run from -range + 1", [](Floats v, Run) { v[0] += 1.0F; }, "", "");
}

/// Which texel is read of one that is looked at.
void add_fetches(std::vector<FormulaMistake>& all) {
    all.push_back(
        {"radius_is_one", "1 for u_TexelCollideRange", {.site = site::texel_collide_range.id, .change = Change::one}});
    all.push_back(
        {"radius_halved", "u_TexelCollideRange / 2", {.site = site::texel_collide_range.id, .change = Change::halved}});
    all.push_back({"radius_doubled",
                   "2 * u_TexelCollideRange",
                   {.site = site::texel_collide_range.id, .change = Change::doubled}});
    all.push_back(
        {"range_doubled", "2 * u_CollisionRange", {.site = site::collision_range.id, .change = Change::doubled}});
    all.push_back(
        {"range_halved", "u_CollisionRange / 2", {.site = site::collision_range.id, .change = Change::halved}});
    all.push_back({"border_never_read", "the image's outermost texels are never read", fetch([](Floats v, Run) {
                       if (v[0] < 1.0F || v[1] < 1.0F || v[0] > v[2] - 2.0F || v[1] > v[3] - 2.0F)
                           leave_out(v);
                   })});
    all.push_back({"last_column_never_read", "the image's last column is never read", fetch([](Floats v, Run) {
                       if (v[0] > v[2] - 2.0F)
                           leave_out(v);
                   })});
    all.push_back({"last_row_never_read", "the image's last row is never read", fetch([](Floats v, Run) {
                       if (v[1] > v[3] - 2.0F)
                           leave_out(v);
                   })});
    all.push_back({"first_column_never_read", "the image's first column is never read", fetch([](Floats v, Run) {
                       if (v[0] < 1.0F)
                           leave_out(v);
                   })});
    all.push_back({"first_row_never_read", "the image's first row is never read", fetch([](Floats v, Run) {
                       if (v[1] < 1.0F)
                           leave_out(v);
                   })});
    all.push_back({"last_texels_never_read", "the image's last row and column are never read", fetch([](Floats v, Run) {
                       if (v[0] > v[2] - 2.0F || v[1] > v[3] - 2.0F)
                           leave_out(v);
                   })});
    all.push_back(
        {"first_texels_never_read", "the image's first row and column are never read", fetch([](Floats v, Run) {
             if (v[0] < 1.0F || v[1] < 1.0F)
                 leave_out(v);
         })});
    all.push_back({"outside_mirrored", "texels outside are mirrored at the border", fetch([](Floats v, Run) {
                       for (std::size_t c = 0; c < 2; ++c)
                           v[c] = v[c] < 0.0F ? -v[c] - 1.0F : v[c] >= v[2 + c] ? 2.0F * v[2 + c] - 1.0F - v[c] : v[c];
                   })});
    all.push_back(
        {"outside_mirrored_without_edge", "texels outside are mirrored at the edge texels", fetch([](Floats v, Run) {
             for (std::size_t c = 0; c < 2; ++c)
                 v[c] = v[c] < 0.0F ? -v[c] : v[c] >= v[2 + c] ? 2.0F * v[2 + c] - 2.0F - v[c] : v[c];
         })});
    all.push_back({"bounds_of_width_alone", "a texel's y is held against the width", fetch([](Floats v, Run) {
                       if (v[1] >= v[2])
                           leave_out(v);
                   })});
    all.push_back({"bounds_of_height_alone", "a texel's x is held against the height", fetch([](Floats v, Run) {
                       if (v[0] >= v[3])
                           leave_out(v);
                   })});
    all.push_back(
        {"bounds_swapped", "a texel's x is held against the height, its y against the width", fetch([](Floats v, Run) {
             if (v[0] >= v[3] || v[1] >= v[2])
                 leave_out(v);
         })});
    all.push_back({"fetched_x_and_y_swapped", "the texel read has x and y swapped",
                   fetch([](Floats v, Run) { std::swap(v[0], v[1]); })});
    all.push_back({"fetched_upside_down", "the texel read is size.y - 1 - y",
                   fetch([](Floats v, Run) { v[1] = v[3] - 1.0F - v[1]; })});
    all.push_back({"fetched_mirrored", "the texel read is size.x - 1 - x",
                   fetch([](Floats v, Run) { v[0] = v[2] - 1.0F - v[0]; })});
    all.push_back(
        {"first_texel_of_row_for_all", "every column reads the row's first texel", fetch([](Floats v, Run run) {
             if (v[0] >= 0.0F && v[0] < v[2])
                 v[0] = std::clamp(run.of(site::base_texel)[0] - static_cast<float>(reach(run)), 0.0F, v[2] - 1.0F);
         })});
    all.push_back(
        {"corner_sampled", "a texel is sampled at its corner, x / width, not at its centre", fetch([](Floats v, Run) {
             for (std::size_t c = 0; c < 2; ++c)
                 if (v[c] >= 0.0F && v[c] < v[2 + c])
                     v[c] = std::floor(v[c] / v[2 + c] * v[2 + c]);
         })});
    all.push_back({"origin_is_empty", "a texel is empty where its position is the origin", holds([](Floats v, Run run) {
                       const auto& texel = run.of(site::neighbour);
                       v[0] = texel[0] != 0.0F || texel[1] != 0.0F || texel[2] != 0.0F ? 1.0F : 0.0F;
                   })});
    all.push_back({"zero_x_is_empty", "a texel is empty where its x is 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[0] != 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"zero_y_is_empty", "a texel is empty where its y is 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[1] != 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"zero_z_is_empty", "a texel is empty where its z is 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[2] != 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"positive_x_is_valid", "a texel holds a particle where its x is above 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[0] > 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"positive_y_is_valid", "a texel holds a particle where its y is above 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[1] > 0.0F ? 1.0F : 0.0F; })});
    all.push_back({"positive_z_is_valid", "a texel holds a particle where its z is above 0",
                   holds([](Floats v, Run run) { v[0] = run.of(site::neighbour)[2] > 0.0F ? 1.0F : 0.0F; })});
}

/// Of the neighbour that is offered: its place, counted from the base texel.
struct Texels {
    explicit Texels(Run run) : x(run.of(site::own_texel_skipped)[0]), y(run.of(site::own_texel_skipped)[1]) {}
    float x, y;
};

/// Which neighbour is answered to.
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

/// Who searches, and round which texel.
void add_base_texels(std::vector<FormulaMistake>& all) {
    static const Mistake clamped = value(site::base_texel, [](Floats v, Run run) {
        const auto& p = run.of(site::image_position);
        v[0] = std::clamp(std::floor(p[0]), 0.0F, static_cast<float>(params(run).width - 1));
        v[1] = std::clamp(std::floor(p[1]), 0.0F, static_cast<float>(params(run).height - 1));
    });
    all.push_back({"base_texel_clamped", "who is outside the image searches from the nearest texel of its border",
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
    all.push_back(
        {"height_for_width", "u_ClientHeight scales x, too", value(site::scale, [](Floats v, Run) { v[0] = v[1]; })});
    all.push_back(
        {"width_for_height", "u_ClientWidth scales y, too", value(site::scale, [](Floats v, Run) { v[1] = v[0]; })});
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
    all.push_back({"behind_camera_skipped", "who is behind the camera, w <= 0, does not search",
                   search([](Floats v, Run run) { keep_where(v, [&] { return clip_w(run) > 0.0F; }); })});
    all.push_back(
        {"outside_depth_skipped", "who is beyond the near or far plane does not search", search([](Floats v, Run run) {
             keep_where(v, [&] { return std::abs(run.of(site::clip)[2]) <= clip_w(run); });
         })});
    all.push_back({"whole_window_required", "who is nearer to the image's border than the range does not search",
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
    all.push_back({"searches_a_tick_late", "searches at collide time < -tick", search([](Floats v, Run run) {
                       v[0] = real(run, site::collide_time_before) < -tick(run) ? 1.0F : 0.0F;
                   })});
    all.push_back({"searches_a_tick_early", "searches at collide time - tick < 0", search([](Floats v, Run run) {
                       v[0] = real(run, site::collide_time_before) - tick(run) < 0.0F ? 1.0F : 0.0F;
                   })});
}

/// What a hit is answered with.
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
    static const auto pulled = [](Run run) {
        return unit_away(run) * (real(run, site::speed_before) * params(run).switches.speed_factor) + fall(run);
    };
    static const Mistake pulled_speed =
        value(site::speed_at_hit, [](Floats v, Run run) { v[0] = glm::length(pulled(run)); });
    all.push_back(
        {"gravity_at_hit", "at a hit: gravity acts, too",
         value(
             site::direction_at_hit, [](Floats v, Run run) { set(v, glm::normalize(pulled(run))); }, &pulled_speed)});
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
    all.push_back({"starts_at_neighbour", "at a hit: the step starts at the neighbour's position",
                   hit_position([](Floats v, Run run) { set(v, get(v) - vec3(run, site::away)); })});
    all.push_back(
        {"tick_squared_at_hit", "at a hit: moves by dir * speed * tick * tick",
         hit_position([](Floats v, Run run) { set(v, before(run) + hit_step(run) * (tick(run) * tick(run))); })});
    all.push_back({"moves_back_at_hit", "at a hit: moves backwards",
                   hit_position([](Floats v, Run run) { set(v, before(run) - (get(v) - before(run))); })});
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
}

/// What free fall comes to.
void add_fall(std::vector<FormulaMistake>& all) {
    all.push_back({"moves_by_mean_velocity", "no hit: moves by the mean of old and new velocity",
                   value(site::step, [](Floats v, Run run) {
                       set(v, 0.5F * (vec3(run, site::velocity_before) + vec3(run, site::velocity)));
                   })});
    all.push_back({"moves_by_speed_before", "no hit: moves along the new direction by the old speed",
                   value(site::step, [](Floats v, Run run) {
                       set(v, vec3(run, site::direction) * real(run, site::speed_before));
                   })});
    static const auto half_gt2 = [](Run run) { return 0.5F * tick(run) * fall(run); };
    all.push_back({"half_gt2_added", "no hit: half g t^2 is added to the move by the new velocity",
                   value(site::position, [](Floats v, Run run) { set(v, get(v) + half_gt2(run)); })});
    all.push_back({"half_gt2_without_half", "no hit: g t^2 is added to the move by the new velocity",
                   value(site::position, [](Floats v, Run run) { set(v, get(v) + 2.0F * half_gt2(run)); })});
    static const Mistake squared_at_hit = hit_position([](Floats v, Run run) {
        const float t = tick(run);
        set(v, before(run) + vec3(run, site::moves_along) * real(run, site::moves_by) * (t * t));
    });
    static const Formula by_tick_twice = [](Floats v, Run run) { set(v, get(v) * tick(run)); };
    all.push_back(
        {"tick_squared", "moves by dir * speed * tick * tick", value(site::move, by_tick_twice, &squared_at_hit)});
    all.push_back(
        {"tick_squared_in_fall", "no hit: moves by dir * speed * tick * tick", value(site::move, by_tick_twice)});
    const auto turned = [&](std::string_view name, std::string_view meaning, Change change) {
        all.push_back({name, meaning, {.site = site::fall.id, .change = change}});
    };
    turned("gravity_x_and_y_swapped", "x and y of gravity are swapped", Change::swapped);
    turned("gravity_y_and_z_swapped", "y and z of gravity are swapped", Change::yz_swapped);
    turned("gravity_x_and_z_swapped", "x and z of gravity are swapped", Change::xz_swapped);
    turned("gravity_rotated", "gravity.yzx for gravity", Change::rotated);
    turned("gravity_rotated_back", "gravity.zxy for gravity", Change::rotated_back);
    all.push_back({"gravity_is_a_constant",
                   "a constant for u_Gravity",
                   value(site::fall,
                         [](Floats v, Run run) {
                             for (std::size_t c = 0; c < 3; ++c)
                                 v[c] = run.constants[c] * tick(run);
                         }),
                   {},
                   gravity_of});
    all.push_back(
        {"gravity_in_y_alone", "only gravity's y acts", value(site::fall, [](Floats v, Run) { v[0] = v[2] = 0.0F; })});
    all.push_back({"gravity_straight_down", "gravity's length acts along -y", value(site::fall, [](Floats v, Run) {
                       set(v, {0.0F, -glm::length(get(v)), 0.0F});
                   })});
    all.push_back({"gravity_waits_for_collide_time", "no gravity while the collide time is above 0",
                   value(site::fall, [](Floats v, Run run) {
                       if (real(run, site::collide_time_before) > 0.0F)
                           set(v, glm::vec3(0.0F));
                   })});
    all.push_back({"gravity_waits_for_search", "no gravity while the collide time is 0 or above",
                   value(site::fall, [](Floats v, Run run) {
                       if (real(run, site::collide_time_before) >= 0.0F)
                           set(v, glm::vec3(0.0F));
                   })});
    all.push_back({"gravity_only_after_hits", "gravity acts only while the collide time is above 0",
                   value(site::fall, [](Floats v, Run run) {
                       if (!(real(run, site::collide_time_before) > 0.0F))
                           set(v, glm::vec3(0.0F));
                   })});
    all.push_back({"gravity_added_to_direction", "no hit: (direction + gravity * tick) * speed",
                   value(site::velocity, [](Floats v, Run run) {
                       set(v, (old_direction(run) + fall(run)) * real(run, site::speed_before));
                   })});
    all.push_back({"gravity_by_tick_twice", "gravity * tick * tick",
                   value(site::fall, [](Floats v, Run run) { set(v, get(v) * tick(run)); })});
    all.push_back({"drag_in_fall", "no hit: the speed is multiplied by a constant",
                   value(site::speed, [](Floats v, Run run) { v[0] *= run.constants[0]; }), drags});
    static const Mistake moves_by_velocity =
        value(site::step, [](Floats v, Run run) { set(v, vec3(run, site::velocity)); });
    all.push_back({"drag_in_stored_speed", "no hit: the stored speed is multiplied by a constant, the step is not",
                   value(
                       site::speed, [](Floats v, Run run) { v[0] *= run.constants[0]; }, &moves_by_velocity),
                   drags});
    all.push_back({"factor_in_fall", "no hit: the speed is multiplied by u_SpeedFactor",
                   value(site::speed, [](Floats v, Run run) { v[0] *= params(run).switches.speed_factor; })});
    all.push_back({"speed_capped",
                   "no hit: the speed is at most a constant",
                   value(site::speed, [](Floats v, Run run) { v[0] = std::min(v[0], run.constants[0]); }),
                   {},
                   speed_of});
    all.push_back({"speed_at_least",
                   "no hit: the speed is at least a constant",
                   value(site::speed, [](Floats v, Run run) { v[0] = std::max(v[0], run.constants[0]); }),
                   {},
                   speed_of});
    all.push_back({"velocity_stored_as_direction",
                   "no hit: the velocity is stored as the direction",
                   {.site = site::direction.id, .change = Change::not_done, .also = &moves_by_velocity}});
    all.push_back({"kept_above_x", "positions are kept above an x", plane<0, true>(), {}, plane_of<0>});
    all.push_back({"kept_above_y", "positions are kept above a y", plane<1, true>(), {}, plane_of<1>});
    all.push_back({"kept_above_z", "positions are kept above a z", plane<2, true>(), {}, plane_of<2>});
    all.push_back({"kept_below_x", "positions are kept below an x", plane<0, false>(), {}, plane_of<0>});
    all.push_back({"kept_below_y", "positions are kept below a y", plane<1, false>(), {}, plane_of<1>});
    all.push_back({"kept_below_z", "positions are kept below a z", plane<2, false>(), {}, plane_of<2>});
    all.push_back({"collide_time_stops_at_zero", "collide time is not counted below 0",
                   value(site::collide_time, [](Floats v, Run) { v[0] = std::max(v[0], 0.0F); })});
    static const Formula a_constant = [](Floats v, Run run) { v[0] = run.constants[0]; };
    all.push_back({"tick_is_a_constant", "a constant for u_Tick", value(site::tick, a_constant), {}, counted_of});
    all.push_back({"collide_time_counted_by_a_constant",
                   "no hit: collide time - a constant, not - u_Tick",
                   value(site::counted, a_constant),
                   {},
                   counted_of});
    all.push_back({"moves_for_a_constant",
                   "no hit: moves for a constant time, not for u_Tick",
                   value(site::move, [](Floats v, Run run) { set(v, vec3(run, site::step) * run.constants[0]); }),
                   {},
                   moved_for});
    all.push_back({"collide_time_counted_by_one",
                   "collide time - 1, not - tick",
                   {.site = site::counted.id, .change = Change::one}});
}

} // namespace

std::span<const FormulaMistake> formula_mistakes() {
    static const std::vector<FormulaMistake> all = [] {
        std::vector<FormulaMistake> made;
        add_windows(made);
        add_fetches(made);
        add_choices(made);
        add_base_texels(made);
        add_responses(made);
        add_fall(made);
        return made;
    }();
    return all;
}

} // namespace lockstep
