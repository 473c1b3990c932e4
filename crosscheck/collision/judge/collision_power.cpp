#include "crosscheck/collision/judge/collision_power.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <initializer_list>
#include <map>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include <omp.h>

#include "crosscheck/judge/item_sample.hpp"
#include "reference/collision/collision_mistakes.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/parallel_blocks.hpp"

namespace lockstep {
namespace {

constexpr std::size_t looked_at = 8192;      ///< particles of a frame, of those without a hit
constexpr std::size_t drawn_at_most = 16384; ///< particles, where it does not matter which of two is nearer
constexpr std::size_t drawn_whole = 131072;  ///< particles at most, where it does: of more, those of some tiles
constexpr std::size_t texels_judged = 16;

/// On so many particles of a frame a mistake is tried that has not shown yet. This follows from the frame alone, so
/// that parts of a run come together to what the whole run shows. Most show in the first frames; the rest takes more.
std::size_t particles_tried(int frame) { return std::min<std::size_t>(48 + 16 * static_cast<std::size_t>(frame), 256); }

bool among(Deviation deviation, std::initializer_list<Deviation> all) {
    return std::find(all.begin(), all.end(), deviation) != all.end();
}

/// Whether it changes who wins a texel: a few particles alone do not show it.
bool is_about_depth(Deviation deviation) {
    return among(deviation,
                 {Deviation::depth_greater, Deviation::depth_not_tested, Deviation::depth_equal_passes,
                  Deviation::depth_not_cleared, Deviation::obstacles_never_hide, Deviation::cdt_not_cleared});
}

/// Whether it can show in one of these situations alone, which are counted over all particles, and nobody was in them.
bool has_no_place(Deviation deviation, const Situations& met) {
    if (among(deviation, {Deviation::outside_fetched_as_edge, Deviation::outside_fetched_as_opposite_side,
                          Deviation::outside_fetched_as_origin}))
        return met.of(Situation::at_border) == 0;
    return among(deviation, {Deviation::truncate_instead_of_floor, Deviation::floor_instead_of_truncate}) &&
           met.of(Situation::left_of_image) == 0;
}

/// Which particles are drawn again, and which texels are looked at then.
struct DrawnAgain {
    bool all = true;                    ///< every particle and texel
    std::vector<std::size_t> particles; ///< otherwise: these
    std::vector<char> texels;           ///< 1: looked at; empty: every texel is

    [[nodiscard]] bool has(std::size_t texel) const { return texels.empty() || texels[texel] != 0; }
};

DrawnAgain every(std::size_t stride, std::size_t particles) {
    DrawnAgain some;
    some.all = stride == 1;
    for (std::size_t i = 0; !some.all && i < particles; i += stride)
        some.particles.push_back(i);
    return some;
}

/// Whoever the reference draws in some tiles of the image or next to them, so that in these tiles nobody is missing;
/// tiles from all over the image, until about `most` particles are in them.
DrawnAgain in_some_tiles(const PowerFrame& frame, const Profile& profile, std::size_t most) {
    constexpr int side = 16;
    const FrameParams& params = *frame.inputs.params;
    const bool updated = params.switches.raster_position == RasterPosition::updated;
    const auto& points = updated ? frame.after.position : frame.inputs.before->position;
    std::vector<std::int32_t> drawn(points.size());
    point_texels_fast(points, params, profile, drawn);
    const int across = (params.width + side - 1) / side, tiles = across * ((params.height + side - 1) / side);
    const auto tile_of = [&](std::int32_t texel) {
        return static_cast<std::size_t>(texel / params.width / side * across + texel % params.width / side);
    };
    std::vector<std::size_t> in_tile(static_cast<std::size_t>(tiles), 0);
    for (const std::int32_t texel : drawn)
        if (texel != no_texel)
            ++in_tile[tile_of(texel)];
    int step = tiles / 2 + 1; // prime to their number: every tile has its turn
    while (std::gcd(step, tiles) != 1)
        ++step;
    std::vector<char> taken(in_tile.size(), 0);
    std::size_t count = 0;
    for (int i = 0, tile = 0; i < tiles && count < most; ++i, tile = (tile + step) % tiles) {
        taken[static_cast<std::size_t>(tile)] = 1;
        count += in_tile[static_cast<std::size_t>(tile)];
    }
    DrawnAgain some;
    some.all = false;
    for (std::int32_t texel = 0; texel < params.width * params.height; ++texel)
        some.texels.push_back(taken[tile_of(texel)]);
    const auto is_beside_taken = [&](std::int32_t texel) { // the texels around it lie in the tiles of these four
        const int x = texel % params.width, y = texel / params.width;
        for (const int ny : {std::max(y - 1, 0), std::min(y + 1, params.height - 1)})
            for (const int nx : {std::max(x - 1, 0), std::min(x + 1, params.width - 1)})
                if (some.has(static_cast<std::size_t>(ny * params.width + nx)))
                    return true;
        return false;
    };
    for (std::size_t i = 0; i < drawn.size(); ++i)
        if (drawn[i] != no_texel && is_beside_taken(drawn[i]))
            some.particles.push_back(i);
    return some;
}

/// Those of a state; where that is all of them, no copy is made.
class Chosen {
  public:
    Chosen(const Particles& all, const DrawnAgain& chosen) : all_(chosen.all ? &all : nullptr) {
        if (all_ != nullptr)
            return;
        some_.resize(chosen.particles.size());
        for (std::size_t i = 0; i < some_.size(); ++i)
            some_.set(i, all[chosen.particles[i]]);
    }
    [[nodiscard]] const Particles& particles() const { return all_ != nullptr ? *all_ : some_; }

  private:
    const Particles* all_;
    Particles some_;
};

/// In which frames something is drawn again: in the first few, then in ever fewer; of many particles in fewer still.
bool draws_in(int frame, std::size_t particles) {
    if (particles > 2 * drawn_at_most)
        return frame == 2 || frame == 16 || frame % 64 == 0;
    return frame < 4 || std::has_single_bit(static_cast<unsigned>(frame)) || frame % 16 == 0;
}

/// Drawing with deviations, of all particles or of a few.
class Drawing {
  public:
    Drawing(const PowerFrame& frame, const Scene& scene, const Profile& profile, const KnownOperations& known,
            DrawnAgain chosen)
        : scene_(scene), profile_(profile), known_(known), params_(*frame.inputs.params), chosen_(std::move(chosen)),
          before_(*frame.inputs.before, chosen_), after_(frame.after, chosen_), inputs_(frame.inputs),
          obstacles_cdt_(params_.width, params_.height),
          obstacles_depth_(params_.width, params_.height, params_.clip_depth.cleared()) {
        inputs_.before = &before_.particles();
        if (inputs_.earlier != nullptr)
            inputs_.earlier = &earlier_.emplace(*inputs_.earlier, chosen_).particles();
        obstacle_pass(scene.obstacles, params_, profile, obstacles_cdt_, obstacles_depth_);
        draw({}, right_);
    }
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    /// What each of them makes of the image, judged by a few texels that it changes.
    [[nodiscard]] std::vector<MistakenItem> judge(const std::vector<Deviation>& deviations) const {
        std::vector<std::vector<Changed>> changed(deviations.size());
        std::atomic<std::size_t> next = 0;
        parallel_blocks(omp_get_max_threads(), [&](std::ptrdiff_t) {
            CollisionImage drawn; // one a thread, since each is megabytes
            for (std::size_t d = next++; d < deviations.size(); d = next++)
                changed[d] = changed_by(deviations[d], drawn);
        });
        std::map<std::size_t, std::size_t> place; // of a texel among those judged
        for (const std::vector<Changed>& some : changed)
            for (const Changed& texel : some)
                place.emplace(texel.index, 0);
        std::vector<std::size_t> texels;
        for (auto& [index, at] : place) {
            at = texels.size();
            texels.push_back(index);
        }
        const std::vector<LegalTexel> legal =
            legal_texels(scene_.obstacles, before_.particles(), after_.particles(), params_, profile_, known_, texels);
        std::vector<MistakenItem> judged;
        for (const std::vector<Changed>& some : changed) {
            const bool divergent = std::any_of(some.begin(), some.end(), [&](const Changed& texel) {
                return legal[place[texel.index]].owner_of(texel.code) == nullptr;
            });
            judged.push_back(some.empty() ? MistakenItem::same
                             : divergent  ? MistakenItem::divergent
                                          : MistakenItem::legal);
        }
        return judged;
    }

  private:
    struct Changed {
        std::size_t index;
        glm::vec4 code;
    };
    [[nodiscard]] std::vector<Changed> changed_by(Deviation deviation, CollisionImage& drawn) const {
        draw(deviation, drawn);
        std::vector<std::size_t> differing;
        for (std::size_t t = 0; t < drawn.texels.size(); ++t)
            if (chosen_.has(t) && !same_bits(drawn.texels[t], right_.texels[t]))
                differing.push_back(t);
        std::vector<Changed> some;
        for (const std::size_t t : sample(differing, texels_judged))
            some.push_back({t, drawn.texels[t]});
        return some;
    }
    void draw(const Deviations& deviations, CollisionImage& cdt) const {
        deviating_draw(inputs_, after_.particles(), profile_, deviations, obstacles_cdt_, obstacles_depth_, cdt);
    }

    const Scene& scene_;
    const Profile& profile_;
    const KnownOperations& known_;
    const FrameParams& params_;
    DrawnAgain chosen_;
    Chosen before_, after_;
    std::optional<Chosen> earlier_;
    FrameInputs inputs_;
    CollisionImage obstacles_cdt_;
    DepthImage obstacles_depth_;
    CollisionImage right_;
};

} // namespace

bool is_no_mistake(Deviation deviation, const Switches& s, const Profile& profile) {
    const bool exact = s.arithmetic == ArithmeticSwitch::exact;
    switch (deviation) {
    case Deviation::no_perspective_divide:
        return s.perspective_divide == PerspectiveDivide::off;
    case Deviation::truncate_instead_of_floor:
        return s.base_texel == BaseTexel::truncate;
    case Deviation::floor_instead_of_truncate:
        return s.base_texel == BaseTexel::floor;
    case Deviation::stands_unless_it_searches:
        return s.not_searching == NotSearching::stands;
    case Deviation::moves_without_search:
        return s.not_searching == NotSearching::moves;
    case Deviation::own_position_from_texel:
        return s.self_position == SelfPosition::texel;
    case Deviation::own_position_from_vertex:
        return s.self_position == SelfPosition::vertex;
    case Deviation::phantom_origin:
        return s.empty_texel == EmptyTexel::phantom;
    case Deviation::empty_texels_skipped:
        return s.empty_texel == EmptyTexel::skip;
    case Deviation::zero_distance_hits:
        return s.zero_distance == ZeroDistance::hit;
    case Deviation::zero_distance_skipped:
        return s.zero_distance == ZeroDistance::skip;
    case Deviation::tick_missing_in_collision_step:
        return s.collision_step == CollisionStep::full;
    case Deviation::tick_added_to_collision_step:
        return s.collision_step == CollisionStep::tick;
    case Deviation::half_cdt:
        return s.cdt_format == CdtFormat::rgba16f;
    case Deviation::unorm8_cdt:
        return s.cdt_format == CdtFormat::rgba8;
    case Deviation::point_of_position_before:
        return s.raster_position == RasterPosition::before_step;
    case Deviation::point_of_position_after:
        return s.raster_position == RasterPosition::updated;
    case Deviation::portable_arithmetic:
        return exact;
    case Deviation::sums_left_to_right: // exact sums so; of the profile's order a driver sums itself
        return exact || profile.dot == DotOrder::left_to_right;
    case Deviation::sums_right_to_left:
        return !exact && profile.dot == DotOrder::right_to_left;
    case Deviation::sums_fused:
        return exact || profile.dot == DotOrder::fused_chain;
    case Deviation::subnormals_kept:
        return exact || !(s.step == Step::compute ? profile.compute_flush_subnormals : profile.flush_subnormals);
    case Deviation::point_on_upper_pixel:
    case Deviation::point_viewport_swapped: // the stage itself finds the texel that it draws to
        return places_points(s);
    default:
        return false;
    }
}

CollisionPower::CollisionPower(const Scene& scene, const Profile& profile, const KnownOperations& known)
    : scene_(scene), profile_(profile), known_(known) {
    for (std::size_t d = 0; d < deviation_count; ++d)
        tried_[d].is_mistake = counts_in_power(static_cast<Deviation>(d)) &&
                               !is_no_mistake(static_cast<Deviation>(d), scene.switches, profile);
}

std::vector<Deviation> CollisionPower::unseen(bool of_drawing) const {
    std::vector<Deviation> all;
    for (const DeviationInfo& info : deviation_table()) {
        const Tried& tried = tried_[static_cast<std::size_t>(info.deviation)];
        const bool wanted =
            of_drawing ? changes_drawing(info.deviation, places_points(scene_.switches)) : changes_step(info.deviation);
        if (tried.is_mistake && tried.first_frame < 0 && wanted)
            all.push_back(info.deviation);
    }
    return all;
}

void CollisionPower::add(const PowerFrame& frame) {
    const FrameInputs& in = frame.inputs;
    if (in.earlier_params != nullptr)
        camera_moves_ = camera_moves_ || in.earlier_params->collision_proj_view != in.params->collision_proj_view;
    const Situations found = situations_of(*in.before, *in.cdt, *in.params, profile_, frame.after, looked_at);
    for (std::size_t s = 0; s < situation_count; ++s)
        met_.count[s] += found.count[s];
    try_steps(frame, found);
    if (draws_in(frame.number, frame.after.size()))
        try_drawing(frame);
}

void CollisionPower::try_steps(const PowerFrame& frame, const Situations& found) {
    std::vector<Deviation> all = unseen(false);
    if (all.empty() || frame.after.size() == 0)
        return;
    const std::size_t most = particles_tried(frame.number);
    std::erase_if(all, [&](Deviation deviation) { return has_no_place(deviation, found); });
    const FrameInputs& in = frame.inputs;
    const StepInputs step_inputs{*in.before, *in.cdt, scene_.obstacles, *in.params, &in};
    const auto pass = step_pass(step_inputs);
    const SystemView before = step_state(step_inputs);
    const View reference = view(frame.after);
    const JudgedPass judged{*pass, profile_, known_, frame.number, before, reference, reference};
    std::vector<std::size_t> telling;
    const auto take = [&](const std::vector<std::size_t>& some, std::size_t count) { // others in every frame
        for (std::size_t i = 0; i < std::min(count, some.size()); ++i)
            telling.push_back(
                some[(i * some.size() / std::min(count, some.size()) + static_cast<std::size_t>(frame.number) * 7) %
                     some.size()]);
    };
    for (const std::vector<std::size_t>& some : found.some)
        take(some, most / (2 * situation_count));
    take(found.some[static_cast<std::size_t>(Situation::search)], most / 4);
    const std::vector<std::size_t> items = items_to_try(judged, telling, most);
    parallel_blocks(static_cast<std::ptrdiff_t>(all.size()), [&](std::ptrdiff_t d) {
        const Deviation deviation = all[static_cast<std::size_t>(d)];
        Tried& tried = tried_[static_cast<std::size_t>(deviation)];
        const std::vector<Mistake> made = mistakes_of(deviation, scene_.switches);
        for (const std::size_t item : items) {
            const MistakenItem is = judge_mistaken(judged, item, pass->mistaken(judged.input(), item, profile_, made));
            tried.changes = tried.changes || is != MistakenItem::same;
            if (is == MistakenItem::divergent) {
                tried.first_frame = frame.number;
                return;
            }
        }
    });
}

void CollisionPower::try_drawing(const PowerFrame& frame) {
    const std::vector<Deviation> all = unseen(true);
    if (all.empty())
        return;
    const std::size_t n = frame.after.size(), stride = std::max<std::size_t>(1, n / drawn_at_most);
    const auto try_all = [&](const std::vector<Deviation>& some, const auto& chosen) {
        if (some.empty())
            return;
        const Drawing drawing(frame, scene_, profile_, known_, chosen());
        const std::vector<MistakenItem> judged = drawing.judge(some);
        for (std::size_t d = 0; d < some.size(); ++d) {
            Tried& tried = tried_[static_cast<std::size_t>(some[d])];
            tried.changes = tried.changes || judged[d] != MistakenItem::same;
            if (judged[d] == MistakenItem::divergent)
                tried.first_frame = frame.number;
        }
    };
    std::vector<Deviation> of_few, of_all;
    for (const Deviation deviation : all)
        (stride == 1 || is_about_depth(deviation) ? of_all : of_few).push_back(deviation);
    try_all(of_all, [&] { return n > drawn_whole ? in_some_tiles(frame, profile_, drawn_whole) : DrawnAgain{}; });
    try_all(of_few, [&] { return every(stride, n); });
}

/// Why it could not show, as far as the states tell.
std::vector<std::string> CollisionPower::reasons(Deviation deviation) const {
    struct Reason {
        bool holds;
        std::initializer_list<Deviation> of;
        std::string_view text;
    };
    const auto none = [&](Situation situation) { return met_.of(situation) == 0; };
    const bool no_obstacles =
        scene_.obstacles.indices.empty() || scene_.switches.obstacles_in_cdt == ObstaclesInCdt::off;
    const Reason known[] = {
        {no_obstacles,
         {Deviation::obstacles_not_drawn, Deviation::obstacles_never_hide},
         "there are no obstacles in the CDT"},
        {scene_.width == scene_.height,
         {Deviation::width_and_height_swapped, Deviation::point_viewport_swapped},
         "the image is square"},
        {!camera_moves_, {Deviation::matrix_of_earlier_frame}, "the camera stands still"},
        {scene_.constants.gravity == glm::vec3(0.0F),
         {Deviation::gravity_missing, Deviation::gravity_doubled, Deviation::gravity_reversed,
          Deviation::gravity_without_tick, Deviation::moves_before_gravity},
         "there is no gravity"},
        {none(Situation::left_of_image),
         {Deviation::truncate_instead_of_floor, Deviation::floor_instead_of_truncate},
         "no search lay between -1 and 0 in the image"},
        {none(Situation::at_border),
         {Deviation::outside_fetched_as_edge, Deviation::outside_fetched_as_opposite_side,
          Deviation::outside_fetched_as_origin},
         "no search reached over the image's border"},
        {none(Situation::at_range), {Deviation::range_included}, "no distance was exactly the collision range"},
        {none(Situation::at_no_distance),
         {Deviation::zero_distance_hits, Deviation::zero_distance_skipped},
         "no distance was 0"},
        {none(Situation::timer_at_zero),
         {Deviation::collide_time_zero_searches},
         "no particle with collide time 0 had another in range"},
        {none(Situation::waiting),
         {Deviation::collide_time_not_tested, Deviation::collide_time_test_reversed},
         "no particle that waited had another in range"},
        {none(Situation::hit), {}, "nothing collided"},
        {none(Situation::two_in_range),
         {Deviation::last_found_instead_of_nearest, Deviation::first_found_instead_of_nearest,
          Deviation::farthest_instead_of_nearest},
         "no hit had two in range"},
        {true,
         {Deviation::last_found_instead_of_nearest, Deviation::first_found_instead_of_nearest,
          Deviation::farthest_instead_of_nearest},
         "no hit with two in range would have ended otherwise"},
        {none(Situation::equally_near), {Deviation::less_or_equal_for_less}, "no hit had two equally near"},
        {true, {Deviation::phantom_origin}, "no search was in range of the origin"},
        {true, {Deviation::subnormals_kept}, "nothing was subnormal"},
        {true, {Deviation::depth_equal_passes}, "no two had the same depth in a texel"},
        {true, {Deviation::point_on_upper_pixel}, "no point lay on a pixel's edge"},
        {true,
         {Deviation::outside_fetched_as_edge, Deviation::outside_fetched_as_opposite_side,
          Deviation::outside_fetched_as_origin},
         "no particle in range would have been found outside the image"},
    };
    std::vector<std::string> holding;
    for (const Reason& reason : known) {
        const bool of_hit = reason.of.size() == 0 && changes_step(deviation) && deviation < Deviation::gravity_missing;
        if (reason.holds && (of_hit || among(deviation, reason.of)))
            holding.emplace_back(reason.text);
    }
    return holding;
}

PowerSummary CollisionPower::summary() const {
    PowerSummary summary;
    for (const DeviationInfo& info : deviation_table()) {
        const Tried& tried = tried_[static_cast<std::size_t>(info.deviation)];
        if (!tried.is_mistake)
            continue;
        PowerSummary::Mistake& mistake = summary.mistakes.emplace_back();
        mistake.name = info.name;
        mistake.meaning = info.meaning;
        if (tried.first_frame >= 0)
            mistake.first_frame = tried.first_frame;
        mistake.changes = tried.changes;
        mistake.reasons = reasons(info.deviation);
    }
    summary.situations = {{"hits", met_.of(Situation::hit)},
                          {"hits with two in range", met_.of(Situation::two_in_range)},
                          {"searches at the image's border", met_.of(Situation::at_border)},
                          {"behind the camera", met_.of(Situation::behind_camera)},
                          {"NaN", met_.of(Situation::not_a_number)}};
    return summary;
}

} // namespace lockstep
