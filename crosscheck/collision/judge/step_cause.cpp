#include "crosscheck/collision/judge/step_cause.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "crosscheck/collision/judge/collision_power.hpp"
#include "crosscheck/collision/judge/step_judge.hpp"
#include "crosscheck/judge/item_likeness.hpp"
#include "crosscheck/judge/item_sample.hpp"
#include "crosscheck/judge/rounding_only.hpp"
#include "reference/collision/collision_mistakes.hpp"
#include "reference/collision/deviating_obstacles.hpp"
#include "reference/collision/deviating_pass.hpp"
#include "reference/collision/formula_mistakes.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/sites.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

constexpr std::size_t pairs_kept = 8;
constexpr std::size_t most_drawn = 64; ///< of more at once, each of which draws a whole image

Deviation deviation_at(std::size_t place) { return static_cast<Deviation>(place); }

Deviations together(const TriedCause& cause) {
    Deviations set;
    for (const std::size_t place : cause.mistakes)
        set.add(deviation_at(place));
    return set;
}

/// GLSL's pow, a depth that went through fixed function, and what may be written in several ways.
bool rounds_freely(Deviation deviation) {
    using enum Deviation;
    return deviation == stores_srgb || deviation == alpha_is_depth || deviation == stores_remapped ||
           deviation == stores_window_coordinates || deviation == stores_clip_space || deviation == stores_ndc ||
           (changes_obstacles(deviation) && deviation < obstacle_depth_not_halved);
}

std::vector<JointMistake> all_deviations() {
    std::vector<JointMistake> all;
    for (const DeviationInfo& info : deviation_table())
        all.push_back({std::string(info.name), std::string(info.meaning),
                       info.deviation == Deviation::cdt_not_drawn || info.deviation == Deviation::obstacles_not_drawn});
    return all;
}

/// The images that deviations would draw of the GPU's own particles.
class TexelTrials {
  public:
    TexelTrials(const JudgedFrame& frame, const FrameInputs& inputs)
        : frame_(frame), inputs_(inputs), obstacles_cdt_(frame.params.width, frame.params.height),
          obstacles_depth_(frame.params.width, frame.params.height, frame.params.clip_depth.cleared()) {
        obstacle_pass(frame.obstacles, frame.params, frame.profile, obstacles_cdt_, obstacles_depth_);
        expected_ = draw({});
        for (std::size_t texel = 0; texel < expected_.texels.size(); ++texel)
            if (same_bits(expected_.texels[texel], frame.gpu_cdt.texels[texel]))
                agreeing_.push_back(texel);
        for (const std::size_t texel : agreeing_)
            particles_agree_ = particles_agree_ || is_particle(expected_, texel);
    }

    void count(std::vector<TriedCause>& causes, const std::vector<std::size_t>& divergent) const {
        const auto n = static_cast<std::ptrdiff_t>(causes.size());
        const bool only_rounds = only_round(divergent);
        const bool worth_threads = causes.size() * (frame_.gpu.size() + agreeing_.size()) > 100'000;
#pragma omp parallel for schedule(dynamic) if (worth_threads)
        for (std::ptrdiff_t c = 0; c < n; ++c) {
            TriedCause& cause = causes[static_cast<std::size_t>(c)];
            const Deviations deviations = together(cause);
            const CollisionImage drawn = draw(deviations);
            const bool rounds = std::any_of(deviations.begin(), deviations.end(), rounds_freely);
            // Interpolating rounds some positions and not others.
            const bool interpolates = deviations.has(Deviation::position_interpolated) && particles_agree_;
            const auto equal = [&](const std::vector<std::size_t>& texels) {
                return static_cast<std::uint64_t>(std::count_if(texels.begin(), texels.end(), [&](std::size_t texel) {
                    const glm::vec4 &a = drawn.texels[texel], &b = frame_.gpu_cdt.texels[texel];
                    const bool near = rounds || (interpolates && is_particle(drawn, texel));
                    return same_bits(a, b) || (near && differ_by_rounding(std::span(&a.x, 4), std::span(&b.x, 4), {}));
                }));
            };
            const std::uint64_t explained = rounds && only_rounds ? 0 : equal(divergent);
            cause.explained += explained;
            if (explained > 0)
                cause.contradicted += agreeing_.size() - equal(agreeing_);
        }
    }

    [[nodiscard]] std::uint64_t contradicted(const Deviations& deviations) const {
        const CollisionImage drawn = draw(deviations);
        return static_cast<std::uint64_t>(std::count_if(agreeing_.begin(), agreeing_.end(), [&](std::size_t texel) {
            return !same_bits(drawn.texels[texel], frame_.gpu_cdt.texels[texel]);
        }));
    }

  private:
    /// Whether most differ by rounding alone: that something comes near says nothing then.
    [[nodiscard]] bool only_round(const std::vector<std::size_t>& texels) const {
        const auto rounded = std::count_if(texels.begin(), texels.end(), [&](std::size_t texel) {
            const glm::vec4 &a = expected_.texels[texel], &b = frame_.gpu_cdt.texels[texel];
            return differ_by_rounding(std::span(&a.x, 4), std::span(&b.x, 4), {});
        });
        return 2 * static_cast<std::size_t>(rounded) >= texels.size();
    }
    [[nodiscard]] bool is_particle(const CollisionImage& drawn, std::size_t texel) const {
        return drawn.texels[texel].a != 0.0F && !same_bits(drawn.texels[texel], obstacles_cdt_.texels[texel]);
    }
    [[nodiscard]] CollisionImage draw(const Deviations& deviations) const {
        CollisionImage cdt, obstacles_cdt = obstacles_cdt_;
        DepthImage obstacles_depth = obstacles_depth_;
        deviating_obstacles(frame_.obstacles, frame_.params, frame_.profile, deviations, obstacles_cdt,
                            obstacles_depth);
        deviating_draw(inputs_, frame_.gpu, frame_.profile, deviations, obstacles_cdt, obstacles_depth, cdt);
        return cdt;
    }

    const JudgedFrame& frame_;
    const FrameInputs& inputs_;
    std::vector<std::size_t> agreeing_;
    CollisionImage expected_;
    bool particles_agree_ = false; ///< in any texel
    CollisionImage obstacles_cdt_;
    DepthImage obstacles_depth_;
};

/// What is drawn in a wrong place because the step computes it wrongly would show in the particles, too.
void contradict_by_steps(std::vector<TriedCause>& causes, std::size_t divergent, const JudgedPass& pass,
                         const Switches& switches, const std::vector<std::size_t>& agreeing) {
    const ItemLikeness likeness(pass);
    for (TriedCause& cause : causes) {
        const std::vector<Mistake> made = mistakes_of(together(cause), switches);
        if (cause.explained < divergent || made.empty())
            continue;
        cause.contradicted +=
            static_cast<std::uint64_t>(std::count_if(agreeing.begin(), agreeing.end(), [&](std::size_t i) {
                return !likeness.are_gpus(i, pass.on_input().mistaken(pass.input(), i, pass.profile, made));
            }));
    }
}

/// A wrong u_ProjView would show in what is drawn, too.
std::uint64_t seen_in_texels(std::span<const NamedMistake* const> made, const JudgedFrame& frame,
                             const FrameInputs& inputs, std::optional<TexelTrials>& trials) {
    const auto is = [&](Deviation deviation) {
        return std::any_of(made.begin(), made.end(),
                           [&](const NamedMistake* m) { return m->name == deviation_name(deviation); });
    };
    if (!is(Deviation::transposed_matrix) && !is(Deviation::matrix_of_earlier_frame))
        return 0;
    if (!trials)
        trials.emplace(frame, inputs);
    Deviations deviations;
    for (const DeviationInfo& info : deviation_table())
        if (is(info.deviation))
            deviations.add(info.deviation);
    return trials->contradicted(deviations);
}

/// Whether it changes which texels are looked at, or which of them is taken.
bool is_of_window(const Mistake& mistake) {
    using namespace lockstep::site;
    static constexpr std::array<std::uint32_t, 6> of_window{own_texel_skipped.id,   rows.id,   columns.id, neighbour.id,
                                                            texel_collide_range.id, nearest.id};
    return std::find(of_window.begin(), of_window.end(), mistake.site) != of_window.end();
}

} // namespace

std::vector<NamedMistake> named_mistakes(const Scene& scene, const Profile& profile) {
    std::vector<NamedMistake> named;
    for (const char* pass : {"collision_pass", "octree_pass", "depth_pass", "layered_collision_pass"})
        for (const DeviationInfo& info : deviation_table())
            if (const auto mistake = step_mistake(info.deviation, scene.switches);
                mistake && can_make(pass, *mistake) && !is_no_mistake(info.deviation, scene.switches, profile))
                named.push_back({.name = std::string(info.name),
                                 .meaning = std::string(info.meaning),
                                 .pass = pass,
                                 .mistake = *mistake,
                                 .describes = info.deviation == Deviation::never_collides,
                                 .of_window = is_of_window(*mistake)});
    for (const SearchMistake& m : search_mistakes())
        named.push_back({std::string(m.name), std::string(m.meaning), std::string(m.pass), m.mistake});
    for (const FormulaMistake& m : formula_mistakes()) {
        NamedMistake& added =
            named.emplace_back(NamedMistake{std::string(m.name), std::string(m.meaning), "collision_pass", m.mistake});
        added.freely_written = true;
        added.of_window = is_of_window(m.mistake);
        for (const float constant : m.constants)
            added.constants.push_back({constant});
        if (m.fit != nullptr)
            added.fit = [fit = m.fit, &constants = scene.constants](std::span<const float> before,
                                                                    std::span<const float> after) {
                return fit(before, after, constants);
            };
    }
    return named;
}

TexelCauses::TexelCauses() : causes_(all_deviations()) {}

void TexelCauses::add(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs) {
    // Texels that only follow their particles are explained with these.
    std::vector<ItemVerdict> drawn_wrong;
    std::copy_if(verdicts.texels.begin(), verdicts.texels.end(), std::back_inserter(drawn_wrong),
                 [](const ItemVerdict& verdict) { return !verdict.follows_particle; });
    const std::vector<std::size_t> wrong = divergent_items(drawn_wrong);
    if (wrong.empty())
        return;
    if (frame.profile.name == "strict") // a driver that was not measured may round in any way
        causes_.leave_out("portable_arithmetic");
    const TexelTrials trials(frame, inputs);
    const std::vector<std::size_t> some = sample(wrong, JointCauses::trial_items);
    const std::vector<std::size_t> equal =
        agreeing_items(frame.gpu.size(), verdicts.particles, JointCauses::trial_items);
    const auto count = [&](std::vector<TriedCause>& causes, const std::vector<std::size_t>& items) {
        trials.count(causes, items);
        with_step_pass(frame, &inputs, [&](const JudgedPass& pass) {
            contradict_by_steps(causes, items.size(), pass, frame.params.switches, equal);
        });
    };
    const auto best_pairs = [&] {
        // Each trial draws a whole image: only what explains something alone is worth a partner.
        std::vector<TriedCause> two = causes_.pairs();
        std::erase_if(two, [&](const TriedCause& pair) {
            // What is drawn beside obstacles that are wrong in their own way fits too much.
            if (changes_obstacles(deviation_at(pair.mistakes.front())) ||
                changes_obstacles(deviation_at(pair.mistakes.back())))
                return true;
            return std::none_of(causes_.tried().begin(), causes_.tried().end(), [&](const TriedCause& alone) {
                return alone.explained > 0 && (alone.mistakes.front() == pair.mistakes.front() ||
                                               alone.mistakes.front() == pair.mistakes.back());
            });
        });
        count(two, some);
        return causes_.best_of(std::move(two), pairs_kept);
    };
    const auto best = [&](std::vector<TriedCause> causes) {
        if (causes.size() > most_drawn)
            causes.resize(most_drawn);
        count(causes, some);
        return causes_.best_of(std::move(causes), pairs_kept);
    };
    const bool placed = places_points(frame.params.switches);
    std::vector<std::size_t> singles;
    for (std::size_t place = 0; place < deviation_count; ++place)
        if (changes_drawing(deviation_at(place), placed))
            singles.push_back(place);
    causes_.hold_against(wrong, singles, {count, best_pairs, best});
}

void add_causes(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs,
                ItemCauseFinder& of_step, TexelCauses& of_texels) {
    const bool draws = is_listing(frame.params.switches);
    std::optional<TexelTrials> trials;
    SeenElsewhere in_texels;
    if (draws)
        in_texels = [&](std::span<const NamedMistake* const> made) {
            return seen_in_texels(made, frame, inputs, trials);
        };
    with_step_pass(frame, &inputs, [&](const JudgedPass& pass) { of_step.add(pass, verdicts.particles, in_texels); });
    if (draws)
        of_texels.add(frame, verdicts, inputs);
}

} // namespace lockstep
