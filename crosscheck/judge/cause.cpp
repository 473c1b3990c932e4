#include "crosscheck/judge/cause.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/item_sample.hpp"
#include "crosscheck/judge/rounding_only.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/model/ulp.hpp"
#include "reference/parallel_blocks.hpp"

namespace lockstep {
namespace {

constexpr std::size_t first_pair_sample = 8;
constexpr std::size_t first_pairs_kept = 256;
constexpr std::size_t pair_sample = 48;
constexpr std::size_t pairs_kept = 8;
constexpr std::size_t whole_kept = 8;
constexpr std::ptrdiff_t parts_kept = 8;
constexpr std::size_t most_together = 3;
constexpr std::size_t alone_sample = 256;
constexpr std::uint64_t borne_out = 64; ///< items that a cause explains before it is tried with another
constexpr std::size_t most_drawn = 64;  ///< of more at once, each of which draws a whole image

Deviations together(const TriedCause& cause) {
    Deviations set;
    for (const Deviation deviation : cause.deviations)
        set.add(deviation);
    return set;
}

/// Says what is seen, and so cannot be wrong where it explains everything; other causes of it are guesses.
bool describes(const TriedCause& cause) {
    return std::all_of(cause.deviations.begin(), cause.deviations.end(), [](Deviation deviation) {
        return deviation == Deviation::never_collides || deviation == Deviation::cdt_not_drawn ||
               deviation == Deviation::obstacles_not_drawn;
    });
}

/// More explained than contradicted; then the simpler.
bool better(const TriedCause& a, const TriedCause& b) {
    const auto balance = [](const TriedCause& c) {
        return static_cast<std::int64_t>(c.contradicted) - static_cast<std::int64_t>(c.explained);
    };
    return std::tuple(balance(a), a.deviations.size()) < std::tuple(balance(b), b.deviations.size());
}

/// `better`, with a description before its equals.
bool before(const TriedCause& a, const TriedCause& b) {
    return better(a, b) || (!better(b, a) && describes(a) && !describes(b));
}

bool is_whole(const TriedCause& cause, std::uint64_t divergent) {
    return cause.explained == divergent && cause.contradicted == 0;
}

std::vector<TriedCause> singles(bool (*wanted)(Deviation, bool), bool places_points) {
    std::vector<TriedCause> causes;
    for (const DeviationInfo& info : deviation_table())
        if (wanted(info.deviation, places_points))
            causes.push_back({{info.deviation}});
    return causes;
}

bool for_steps(Deviation deviation, bool) { return changes_step(deviation); }

std::vector<TriedCause> pairs(const std::vector<TriedCause>& alone) {
    std::vector<TriedCause> causes;
    for (std::size_t a = 0; a < alone.size(); ++a)
        for (std::size_t b = a + 1; b < alone.size(); ++b)
            if (alone[a].deviations.size() == 1 && alone[b].deviations.size() == 1)
                causes.push_back({{alone[a].deviations.front(), alone[b].deviations.front()}});
    return causes;
}

/// By how many ULP a driver's length and normalize may be off the reference's: as measured, and no more than GLSL
/// allows, 6 and 4.5 times 2^-23 of the value (4.7.1, as the Vulkan environment derives them), an ULP being at least
/// 2^-24 of it.
struct AllowedUlps {
    std::int64_t speed = 0, direction = 0;

    explicit AllowedUlps(const Profile& profile) {
        if (profile.roots != nullptr) // the reference has the driver's own bits
            return;
        speed = std::min<std::int64_t>(profile.errors.length, 12);
        direction = std::min<std::int64_t>(profile.errors.normalize, 9);
    }
};

/// The same bits but for the sign of zero, which depends on how a mistake was written down; or so near.
bool near(float a, float b, std::int64_t ulps) {
    return same_bits(a, b) || (a == 0.0F && b == 0.0F) || ulp_distance(a, b) <= ulps;
}

/// A position is moved by direction * speed, times the tick or not. The two are off by their ULP, at most 2^-23 of them
/// each; two products and the sum round once more on either side.
bool near_position(const ParticleState& a, const ParticleState& b, int c, float tick, AllowedUlps allowed) {
    if (same_bits(a.position[c], b.position[c]) || (a.position[c] == 0.0F && b.position[c] == 0.0F))
        return true;
    if (allowed.speed == 0 && allowed.direction == 0)
        return false;
    const double step = std::abs(double{b.direction[c]} * double{b.speed}) * std::max(1.0, std::abs(double{tick}));
    const double off = step * static_cast<double>(allowed.speed + allowed.direction + 2) * 0x1p-23;
    const double largest = std::max(std::abs(double{a.position[c]}), std::abs(double{b.position[c]}));
    return std::abs(double{a.position[c]} - double{b.position[c]}) <= off + largest * 0x1p-23;
}

bool alike(const ParticleState& a, const ParticleState& b, float tick, AllowedUlps allowed) {
    if (!same_bits(a.collide_time, b.collide_time) || !near(a.speed, b.speed, allowed.speed))
        return false;
    for (int c = 0; c < 3; ++c)
        if (!near(a.direction[c], b.direction[c], allowed.direction) || !near_position(a, b, c, tick, allowed))
            return false;
    return true;
}

/// Counts, for each cause, the particles it explains and contradicts.
void count_particles(std::vector<TriedCause>& causes, const JudgedFrame& frame, const FrameInputs& inputs,
                     const std::vector<std::size_t>& divergent, const std::vector<std::size_t>& agreeing) {
    const auto n = static_cast<std::ptrdiff_t>(causes.size());
    const AllowedUlps allowed(frame.profile);
    const float tick = frame.params.constants.tick;
    const bool worth_threads = causes.size() * (divergent.size() + agreeing.size()) > 100'000;
#pragma omp parallel for schedule(dynamic) if (worth_threads)
    for (std::ptrdiff_t c = 0; c < n; ++c) {
        TriedCause& cause = causes[static_cast<std::size_t>(c)];
        const Deviations deviations = together(cause);
        const auto explains = [&](std::size_t i) {
            return alike(deviating_step(inputs, i, frame.profile, deviations), frame.gpu[i], tick, allowed);
        };
        // What is near without any deviation says nothing about one.
        const auto telling = [&](std::size_t i) { return !alike(frame.reference[i], frame.gpu[i], tick, allowed); };
        const auto explained = static_cast<std::uint64_t>(std::count_if(
            divergent.begin(), divergent.end(), [&](std::size_t i) { return telling(i) && explains(i); }));
        cause.explained += explained;
        if (explained > 0)
            cause.contradicted +=
                agreeing.size() - static_cast<std::uint64_t>(std::count_if(agreeing.begin(), agreeing.end(), explains));
    }
}

/// How many agreeing particles each contradicts, whatever it explains.
void contradict_alone(std::vector<TriedCause>& causes, const JudgedFrame& frame, const FrameInputs& inputs,
                      const std::vector<std::size_t>& agreeing) {
    const AllowedUlps allowed(frame.profile);
    parallel_blocks(static_cast<std::ptrdiff_t>(causes.size()), [&](std::ptrdiff_t c) {
        TriedCause& cause = causes[static_cast<std::size_t>(c)];
        const Deviations deviations = together(cause);
        cause.contradicted +=
            static_cast<std::uint64_t>(std::count_if(agreeing.begin(), agreeing.end(), [&](std::size_t i) {
                return !alike(deviating_step(inputs, i, frame.profile, deviations), frame.gpu[i],
                              frame.params.constants.tick, allowed);
            }));
    });
}

/// The same for texels: the whole image is drawn again.
class TexelTrials {
  public:
    TexelTrials(const JudgedFrame& frame, const FrameInputs& inputs)
        : frame_(frame), inputs_(inputs), obstacles_cdt_(frame.params.width, frame.params.height),
          obstacles_depth_(frame.params.width, frame.params.height, 1.0F) {
        obstacle_pass(frame.obstacles, frame.params, frame.profile, obstacles_cdt_, obstacles_depth_);
        const CollisionImage expected = draw({});
        for (std::size_t texel = 0; texel < expected.texels.size(); ++texel)
            if (same_bits(expected.texels[texel], frame.gpu_cdt.texels[texel]))
                agreeing_.push_back(texel);
    }

    void count(std::vector<TriedCause>& causes, const std::vector<std::size_t>& divergent) const {
        const auto n = static_cast<std::ptrdiff_t>(causes.size());
        const bool worth_threads = causes.size() * (frame_.gpu.size() + agreeing_.size()) > 100'000;
#pragma omp parallel for schedule(dynamic) if (worth_threads)
        for (std::ptrdiff_t c = 0; c < n; ++c) {
            TriedCause& cause = causes[static_cast<std::size_t>(c)];
            const Deviations deviations = together(cause);
            const CollisionImage drawn = draw(deviations);
            // GLSL's pow, and a depth that went through fixed function, round as they like.
            const bool rounds = deviations.has(Deviation::stores_srgb) || deviations.has(Deviation::alpha_is_depth);
            const auto equal = [&](const std::vector<std::size_t>& texels) {
                return static_cast<std::uint64_t>(std::count_if(texels.begin(), texels.end(), [&](std::size_t texel) {
                    const glm::vec4 &a = drawn.texels[texel], &b = frame_.gpu_cdt.texels[texel];
                    return same_bits(a, b) ||
                           (rounds && lockstep::differ_by_rounding(std::span(&a.x, 4), std::span(&b.x, 4), {}));
                }));
            };
            const std::uint64_t explained = equal(divergent);
            cause.explained += explained;
            if (explained > 0)
                cause.contradicted += agreeing_.size() - equal(agreeing_);
        }
    }

    [[nodiscard]] std::uint64_t contradicted(const TriedCause& cause) const {
        const CollisionImage drawn = draw(together(cause));
        return static_cast<std::uint64_t>(std::count_if(agreeing_.begin(), agreeing_.end(), [&](std::size_t texel) {
            return !same_bits(drawn.texels[texel], frame_.gpu_cdt.texels[texel]);
        }));
    }

  private:
    [[nodiscard]] CollisionImage draw(const Deviations& deviations) const {
        CollisionImage cdt;
        deviating_draw(inputs_, frame_.gpu, frame_.profile, deviations, obstacles_cdt_, obstacles_depth_, cdt);
        return cdt;
    }

    const JudgedFrame& frame_;
    const FrameInputs& inputs_;
    std::vector<std::size_t> agreeing_;
    CollisionImage obstacles_cdt_;
    DepthImage obstacles_depth_;
};

/// A wrong u_ProjView would show in what is drawn, too.
void contradict_by_drawing(std::vector<TriedCause>& causes, std::size_t divergent, const JudgedFrame& frame,
                           const FrameInputs& inputs) {
    std::vector<TriedCause*> suspects;
    for (TriedCause& cause : causes)
        if (cause.explained >= divergent && cause.contradicted == 0 &&
            std::any_of(cause.deviations.begin(), cause.deviations.end(), [](Deviation deviation) {
                return deviation == Deviation::transposed_matrix || deviation == Deviation::matrix_of_earlier_frame;
            }))
            suspects.push_back(&cause);
    if (suspects.empty())
        return;
    const TexelTrials trials(frame, inputs);
    for (TriedCause* cause : suspects)
        cause->contradicted += trials.contradicted(*cause);
}

/// What is drawn in a wrong place because the step computes it wrongly would show in the particles, too.
void contradict_by_steps(std::vector<TriedCause>& causes, std::size_t divergent, const JudgedFrame& frame,
                         const FrameInputs& inputs, const std::vector<std::size_t>& agreeing) {
    const AllowedUlps allowed(frame.profile);
    const float tick = frame.params.constants.tick;
    for (TriedCause& cause : causes) {
        if (cause.explained < divergent || std::none_of(cause.deviations.begin(), cause.deviations.end(), changes_step))
            continue;
        const Deviations deviations = together(cause);
        cause.contradicted +=
            static_cast<std::uint64_t>(std::count_if(agreeing.begin(), agreeing.end(), [&](std::size_t i) {
                return !alike(deviating_step(inputs, i, frame.profile, deviations), frame.gpu[i], tick, allowed);
            }));
    }
}

bool differ_by_rounding(const ParticleState& a, const ParticleState& b, const ParticleState& before) {
    const auto same = [](const glm::vec3& x, const glm::vec3& y, const glm::vec3& z) {
        return lockstep::differ_by_rounding(std::span(&x.x, 3), std::span(&y.x, 3), std::span(&z.x, 3));
    };
    const auto same_number = [](const float& x, const float& y, const float& z) {
        return lockstep::differ_by_rounding(std::span(&x, 1), std::span(&y, 1), std::span(&z, 1));
    };
    return same(a.position, b.position, before.position) && same(a.direction, b.direction, before.direction) &&
           same_number(a.speed, b.speed, before.speed) &&
           same_number(a.collide_time, b.collide_time, before.collide_time);
}

bool is_about_rounding(Deviation deviation) {
    return deviation >= Deviation::sums_left_to_right && deviation <= Deviation::subnormals_kept;
}

/// Leaves out what changes the states at hand by rounding alone, as gravity that is next to nothing does: that it has
/// the GPU's bits says nothing.
void drop_what_only_rounds(std::vector<TriedCause>& causes, const JudgedFrame& frame, const FrameInputs& inputs,
                           const std::vector<std::size_t>& items) {
    std::vector<char> only_rounds(causes.size());
    parallel_blocks(static_cast<std::ptrdiff_t>(causes.size()), [&](std::ptrdiff_t c) {
        const auto at = static_cast<std::size_t>(c);
        if (is_about_rounding(causes[at].deviations.front()))
            return;
        const Deviations deviations = together(causes[at]);
        bool changes = false;
        for (const std::size_t i : items) {
            const ParticleState made = deviating_step(inputs, i, frame.profile, deviations);
            const ParticleState right = frame.reference[i];
            if (!differ_by_rounding(made, right, frame.before[i]))
                return;
            changes = changes || !alike(made, right, frame.params.constants.tick, AllowedUlps(frame.profile));
        }
        only_rounds[at] = changes ? 1 : 0;
    });
    std::vector<TriedCause> telling;
    for (std::size_t c = 0; c < causes.size(); ++c)
        if (only_rounds[c] == 0)
            telling.push_back(causes[c]);
    causes = std::move(telling);
}

/// The best few.
std::vector<TriedCause> best_of(std::vector<TriedCause> causes, std::size_t count) {
    std::stable_sort(causes.begin(), causes.end(), before);
    if (causes.size() > count)
        causes.resize(count);
    return causes;
}

/// What has failed to explain everything stays so: only the best of that is kept, to be told as a part.
void drop_hopeless(std::vector<TriedCause>& causes, std::uint64_t divergent) {
    std::stable_sort(causes.begin(), causes.end(), before);
    const auto failed = std::stable_partition(causes.begin(), causes.end(),
                                              [&](const TriedCause& cause) { return is_whole(cause, divergent); });
    if (causes.end() - failed > parts_kept)
        causes.erase(failed + parts_kept, causes.end());
}

/// Whether what explained all `before` items may be tried with one more. Where that only says what is seen, as that
/// nothing collides, its names are guesses.
bool is_base(const std::vector<TriedCause>& held, std::uint64_t before) {
    return !held.empty() && before >= borne_out && std::none_of(held.begin(), held.end(), describes);
}

/// Each with each single that it does not have. `alone`: what contradicted these before.
std::vector<TriedCause> with_one_more(const std::vector<TriedCause>& causes, const std::vector<TriedCause>& singles,
                                      const std::array<std::uint64_t, deviation_count>& alone) {
    std::vector<TriedCause> longer;
    for (const TriedCause& cause : causes)
        for (const TriedCause& single : singles) {
            const Deviation one = single.deviations.front();
            if (cause.deviations.size() >= most_together ||
                std::find(cause.deviations.begin(), cause.deviations.end(), one) != cause.deviations.end())
                continue;
            TriedCause& more = longer.emplace_back(cause);
            more.deviations.push_back(one);
            std::sort(more.deviations.begin(), more.deviations.end());
            more.contradicted_before += alone[static_cast<std::size_t>(one)];
            more.contradicted = more.contradicted_before;
        }
    std::stable_sort(longer.begin(), longer.end(),
                     [](const TriedCause& a, const TriedCause& b) { return a.deviations < b.deviations; });
    longer.erase(std::unique(longer.begin(), longer.end(),
                             [](const TriedCause& a, const TriedCause& b) { return a.deviations == b.deviations; }),
                 longer.end());
    return longer;
}

} // namespace

void CauseFinder::add(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs) {
    try_on_particles(frame, verdicts, inputs);
    try_on_texels(frame, verdicts, inputs);
}

/// `count(causes, divergent)` adds a frame's counts to causes; `pairs()` gives those of the first frame that are worth
/// trying; `best(causes)` the best few of many, counted.
template <class Count, class Pairs, class Best>
void CauseFinder::hold_against(Trial& trial, const std::vector<std::size_t>& divergent,
                               const std::vector<TriedCause>& singles, const Count& count, const Pairs& pairs,
                               const Best& best) {
    if (divergent.empty())
        return;
    const bool first = trial.frames == 0, later = trial.frames >= trial_frames;
    ++trial.frames;
    const auto whole_ones = [&] {
        std::vector<TriedCause> whole = best_of(trial.causes, whole_kept);
        std::erase_if(whole, [&](const TriedCause& cause) { return !is_whole(cause, trial.divergent); });
        return whole;
    };
    std::vector<TriedCause> held = first ? std::vector<TriedCause>() : whole_ones();
    if (later && held.empty())
        return;
    if (first)
        trial.causes = singles;
    else if (later)
        trial.causes = held;
    const std::vector<std::size_t> some = sample(divergent, trial_items);
    count(trial.causes, some);
    trial.divergent += some.size();
    const std::uint64_t before = trial.divergent - some.size();
    if (whole_ones().empty() && trial.extensions < trial_frames && (first || is_base(held, before))) {
        ++trial.extensions;
        /// Adds causes that were counted in this frame, and has them ready for one more.
        const auto add = [&](std::vector<TriedCause> causes) {
            trial.causes.insert(trial.causes.end(), causes.begin(), causes.end());
            for (TriedCause& cause : causes) {
                cause.explained = before;
                cause.contradicted = cause.contradicted_before;
            }
            held = std::move(causes);
        };
        if (first)
            add(pairs());
        for (int more = first ? 1 : 0; more < 2 && whole_ones().empty(); ++more)
            add(best(with_one_more(held, singles, trial.alone)));
    }
    drop_hopeless(trial.causes, trial.divergent);
    std::vector<TriedCause> whole = whole_ones();
    if (whole.empty() || some.size() == divergent.size())
        return;
    std::vector<std::size_t> rest;
    std::set_difference(divergent.begin(), divergent.end(), some.begin(), some.end(), std::back_inserter(rest));
    count(whole, rest);
    trial.divergent += rest.size();
    trial.causes = std::move(whole);
}

void CauseFinder::try_on_particles(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs) {
    const std::vector<std::size_t> equal = agreeing_items(frame.gpu.size(), verdicts.particles, trial_items);
    const std::vector<std::size_t> wrong = divergent_items(verdicts.particles);
    const auto count = [&](std::vector<TriedCause>& causes, const std::vector<std::size_t>& items) {
        count_particles(causes, frame, inputs, items, equal);
        contradict_by_drawing(causes, items.size(), frame, inputs);
    };
    // The best of many, by a few items first: among them those that `known` leaves over, where another shows.
    const auto best_few = [&](std::vector<TriedCause> causes, const TriedCause& known) {
        std::vector<std::size_t> rest;
        for (const std::size_t i : sample(wrong, trial_items))
            if (!alike(deviating_step(inputs, i, frame.profile, together(known)), frame.gpu[i],
                       frame.params.constants.tick, AllowedUlps(frame.profile)))
                rest.push_back(i);
        const auto keep_best = [&](std::size_t items, std::size_t kept) {
            const std::uint64_t before = causes.empty() ? 0 : causes.front().explained;
            std::vector<std::size_t> telling = sample(rest, items);
            const std::vector<std::size_t> others = sample(wrong, items);
            telling.insert(telling.end(), others.begin(), others.end());
            count_particles(causes, frame, inputs, telling, sample(equal, items));
            causes = best_of(std::move(causes), kept);
            for (TriedCause& cause : causes) {
                cause.explained = before;
                cause.contradicted = cause.contradicted_before;
            }
        };
        keep_best(first_pair_sample, first_pairs_kept);
        keep_best(pair_sample, pairs_kept);
        count(causes, sample(wrong, trial_items));
        return causes;
    };
    const auto best_pairs = [&] { return best_few(pairs(particles_.causes), best_of(particles_.causes, 1).front()); };
    const auto best = [&](std::vector<TriedCause> causes) {
        return causes.empty() ? causes : best_few(std::move(causes), best_of(particles_.causes, 1).front());
    };
    const std::vector<TriedCause> all = singles(for_steps, false);
    std::vector<TriedCause> telling = all;
    if (!wrong.empty() && particles_.frames < trial_frames) {
        std::vector<std::size_t> some = sample(wrong, alone_sample);
        const std::vector<std::size_t> others = sample(equal, alone_sample);
        some.insert(some.end(), others.begin(), others.end());
        drop_what_only_rounds(telling, frame, inputs, some);
    }
    hold_against(particles_, wrong, telling, count, best_pairs, best);
    if (wrong.empty() || particles_.frames > trial_frames)
        return;
    std::vector<TriedCause> alone = all;
    contradict_alone(alone, frame, inputs, sample(equal, alone_sample));
    for (const TriedCause& cause : alone)
        particles_.alone[static_cast<std::size_t>(cause.deviations.front())] += cause.contradicted;
}

void CauseFinder::try_on_texels(const JudgedFrame& frame, const FrameVerdicts& verdicts, const FrameInputs& inputs) {
    // Texels that only follow their particles are explained with these.
    std::vector<ItemVerdict> drawn_wrong;
    std::copy_if(verdicts.texels.begin(), verdicts.texels.end(), std::back_inserter(drawn_wrong),
                 [](const ItemVerdict& verdict) { return !verdict.follows_particle; });
    const std::vector<std::size_t> wrong = divergent_items(drawn_wrong);
    if (wrong.empty())
        return;
    const TexelTrials trials(frame, inputs);
    const std::vector<std::size_t> equal = agreeing_items(frame.gpu.size(), verdicts.particles, trial_items);
    const auto count = [&](std::vector<TriedCause>& causes, const std::vector<std::size_t>& items) {
        trials.count(causes, items);
        contradict_by_steps(causes, items.size(), frame, inputs, equal);
    };
    const auto best_pairs = [&] {
        // Each trial draws a whole image: only what explains something alone is worth a partner.
        std::vector<TriedCause> two = pairs(texels_.causes);
        std::erase_if(two, [&](const TriedCause& pair) {
            return std::none_of(texels_.causes.begin(), texels_.causes.end(), [&](const TriedCause& alone) {
                return alone.explained > 0 && (alone.deviations.front() == pair.deviations.front() ||
                                               alone.deviations.front() == pair.deviations.back());
            });
        });
        count(two, sample(wrong, trial_items));
        return best_of(std::move(two), pairs_kept);
    };
    const bool places_points = frame.params.switches.arithmetic == ArithmeticSwitch::exact;
    const auto best = [&](std::vector<TriedCause> causes) {
        if (causes.size() > most_drawn)
            causes.resize(most_drawn);
        count(causes, sample(wrong, trial_items));
        return best_of(std::move(causes), pairs_kept);
    };
    hold_against(texels_, wrong, singles(changes_drawing, places_points), count, best_pairs, best);
}

Cause as_cause(const TriedCause& tried) {
    Cause cause{{}, {}, tried.explained, tried.contradicted};
    for (const Deviation deviation : tried.deviations) {
        const DeviationInfo& info = deviation_table()[static_cast<std::size_t>(deviation)];
        cause.mistakes.emplace_back(info.name);
        cause.meaning += (cause.meaning.empty() ? "" : "; ") + std::string(info.meaning);
    }
    return cause;
}

CauseFindings CauseFinder::findings(const Trial& trial) {
    CauseFindings found;
    found.divergent = trial.divergent;
    const std::vector<TriedCause> sorted = best_of(trial.causes, trial.causes.size());
    for (const TriedCause& cause : sorted) {
        if (cause.explained == 0)
            break;
        if (!found.best.empty() && better(sorted.front(), cause))
            break;
        found.best.push_back(as_cause(cause));
    }
    return found;
}

CauseFindings CauseFinder::particles() const { return findings(particles_); }

CauseFindings CauseFinder::texels() const { return findings(texels_); }

} // namespace lockstep
