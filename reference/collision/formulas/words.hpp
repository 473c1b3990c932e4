#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "reference/collision/formula_mistakes.hpp"
#include "reference/collision/sites.hpp"

/// The words in which the formulas of mistakes are written.
namespace lockstep::formulas {

using Floats = std::span<float>;
using Run = const CameBy&;
inline const FrameParams& params(Run run) { return run.foretold<FrameParams>(); }
inline glm::vec3 vec3(Run run, const Site& site) {
    const auto& v = run.of(site);
    return {v[0], v[1], v[2]};
}
/// Of the neighbour that is taken.
inline glm::vec3 chosen_vec3(Run run, const Site& site) {
    const auto& v = run.of_chosen(site);
    return {v[0], v[1], v[2]};
}
inline float real(Run run, const Site& site) { return run.of(site)[0]; }
inline void set(Floats value, glm::vec3 v) {
    for (int c = 0; c < 3; ++c)
        value[static_cast<std::size_t>(c)] = v[c];
}
inline glm::vec3 get(Floats value) { return {value[0], value[1], value[2]}; }
inline float greatest(glm::vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }
inline float tick(Run run) { return params(run).constants.tick; }
inline glm::vec3 fall(Run run) { return params(run).constants.gravity * tick(run); }
inline glm::vec3 unit_away(Run run) { return glm::normalize(vec3(run, site::away)); }
inline glm::vec3 before(Run run) { return vec3(run, site::position_before); }
inline glm::vec3 old_direction(Run run) { return vec3(run, site::direction_before); }
inline glm::vec3 old_velocity(Run run) { return old_direction(run) * real(run, site::speed_before); }
inline int reach(Run run) { return params(run).constants.texel_collide_range; }
inline float clip_w(Run run) { return run.of(site::clip)[3]; }
inline glm::vec4 projected(Run run, glm::vec3 position) {
    return params(run).collision_proj_view * glm::vec4(position, 1.0F);
}
inline void leave_out(Floats fetch) { fetch[0] = -1.0F; }
/// Of a texel that is looked at: which one, counted from the base texel.
struct Offset {
    int x, y;
};
inline Offset offset(Floats skipped) { return {static_cast<int>(skipped[1]), static_cast<int>(skipped[3])}; }
template <class Skip> void skip_too(Floats answer, const Skip& skip) {
    const Offset o = offset(answer);
    if (skip(o.x, o.y))
        answer[0] = 1.0F;
}
inline void skip_instead(Floats answer, int x, int y) {
    const Offset o = offset(answer);
    answer[0] = o.x == x && o.y == y ? 1.0F : 0.0F;
}
template <class Keep> void keep_where(Floats answer, const Keep& keep) {
    answer[0] = answer[0] != 0.0F && keep() ? 1.0F : 0.0F;
}

inline Mistake at(const Site& site, Change change, Formula formula, const Mistake* also = nullptr) {
    return {.site = site.id, .change = change, .formula = formula, .also = also};
}
inline Mistake value(const Site& site, Formula formula, const Mistake* also = nullptr) {
    return at(site, Change::by_formula, formula, also);
}
inline Mistake skipped(Formula formula) { return at(site::own_texel_skipped, Change::decided_by_formula, formula); }
inline Mistake search(Formula formula) { return at(site::searches, Change::decided_by_formula, formula); }
inline Mistake in_range(Formula formula) { return at(site::in_range, Change::decided_by_formula, formula); }
inline Mistake fetch(Formula formula) { return at(site::neighbour, Change::fetched_by_formula, formula); }
inline Mistake holds(Formula formula) { return at(site::holds_particle, Change::decided_by_formula, formula); }
inline Mistake hit_direction(Formula formula) { return value(site::direction_at_hit, formula); }
inline Mistake hit_position(Formula formula) { return value(site::position_at_hit, formula); }

/// Which of the texels around the base texel are looked at, and which is read.
void add_windows(std::vector<FormulaMistake>& all);
void add_fetches(std::vector<FormulaMistake>& all);
/// Which neighbour is answered to.
void add_choices(std::vector<FormulaMistake>& all);
/// Who searches, and around which texel.
void add_base_texels(std::vector<FormulaMistake>& all);
/// What a hit is answered with.
void add_responses(std::vector<FormulaMistake>& all);
/// What free fall comes to.
void add_fall(std::vector<FormulaMistake>& all);

} // namespace lockstep::formulas
