#include "crosscheck/judge/step_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/item_table.hpp"
#include "crosscheck/judge/step_judge.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/decoded_terms.hpp"
#include "reference/collision/legal_outcomes.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/legal_arithmetic.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/subnormals.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

constexpr std::string_view axes = "xyzw";

std::string texel_text(glm::ivec2 texel) {
    return texel.x < 0 ? std::string("none") : fmt::format("({}, {})", texel.x, texel.y);
}
glm::ivec2 as_vector(BaseTexelIndex texel) { return {texel.x, texel.y}; }

/// How far a texel of the neighbourhood came, as trace_neighbour_reached counts.
enum class Reached { skipped, read, holds_particle, compared, nearest };

std::string_view reached_text(Reached reached, bool own) {
    switch (reached) {
    case Reached::skipped:
        return own ? "own, skipped" : "outside";
    case Reached::read:
        return "empty";
    case Reached::holds_particle:
        return "skipped";
    case Reached::compared:
        return "not taken";
    case Reached::nearest:
        return "nearest";
    }
    return "";
}

Reached reached(const NeighbourTrace& neighbour) {
    if (neighbour.became_nearest)
        return Reached::nearest;
    if (neighbour.compared)
        return Reached::compared;
    if (neighbour.holds_particle)
        return Reached::holds_particle;
    return neighbour.on_image ? Reached::read : Reached::skipped;
}

/// A texel the GPU looked at.
struct SeenTexel {
    glm::ivec2 texel{-1};
    Reached reached = Reached::skipped;
    glm::vec3 position{0.0F}, apart{0.0F};
    float distance = 0.0F;

    [[nodiscard]] bool has_distance() const { return reached >= Reached::holds_particle; }
};

std::vector<SeenTexel> seen_texels(const StepCapture& capture) {
    std::vector<SeenTexel> seen;
    for (const CapturedVertex& vertex : capture.neighbours) {
        const auto texel = vertex.integers("trace_neighbour_texel");
        if (!texel)
            return {};
        SeenTexel one{.texel = *texel};
        one.reached = static_cast<Reached>(std::clamp(vertex.integer("trace_neighbour_reached").value_or(0), 0, 4));
        one.position = vertex.vec3("trace_neighbour_position").value_or(one.position);
        one.apart = vertex.vec3("trace_neighbour_apart").value_or(one.apart);
        one.distance = vertex.real("trace_neighbour_distance").value_or(0.0F);
        seen.push_back(one);
    }
    return seen;
}

/// Whether the GPU's value may be what it is, and words for it.
struct Legality {
    bool legal = true;
    bool open = false; ///< GL leaves it open
    std::string words;
};

Legality legality(const Interval& set, std::optional<float> value) {
    Legality answer;
    answer.open = set.any;
    answer.legal = !value || set.contains(*value);
    if (!answer.legal)
        answer.words = set.low == set.high ? fmt::format("{:a} follows from the GPU's own values above", set.low)
                                           : fmt::format("{:a} to {:a} would be legal", static_cast<float>(set.low),
                                                         static_cast<float>(set.high));
    return answer;
}

/// Puts rows under each other and judges each.
class Rows {
  public:
    void number(std::string label, std::optional<float> strict, std::optional<float> reference,
                std::optional<float> gpu, const Legality& legality) {
        StepRow row{.label = std::move(label), .strict = {strict, {}}, .reference = {reference, {}}, .gpu = {gpu, {}}};
        if (gpu)
            row.verdict = judge(reference && same_bits(*reference, *gpu), legality, RowVerdict::rounding);
        row.reason = row.verdict == RowVerdict::divergent ? legality.words : "";
        rows_.push_back(std::move(row));
    }

    template <class Vector> void numbers(const std::string& label, const std::optional<Vector>& strict,
                                         const std::optional<Vector>& reference, const std::optional<Vector>& gpu,
                                         const Interval* legal) {
        for (int c = 0; c < Vector::length(); ++c) {
            const auto component = [c](const std::optional<Vector>& v) {
                return v ? std::optional<float>((*v)[c]) : std::nullopt;
            };
            number(fmt::format("{}.{}", label, axes[static_cast<std::size_t>(c)]), component(strict),
                   component(reference), component(gpu), legality(legal[c], component(gpu)));
        }
    }

    /// `follows`: what the GPU has to decide by its own values; `may`: or may, whatever these say.
    void decision(std::string label, std::string strict, std::string reference, std::optional<std::string> gpu,
                  const std::string& follows, bool may = false) {
        StepRow row{.label = std::move(label), .strict = {{}, std::move(strict)}, .reference = {{}, reference}};
        if (gpu) {
            row.gpu.text = *gpu;
            Legality legality;
            legality.legal = may || *gpu == follows;
            row.verdict = judge(*gpu == reference, legality, RowVerdict::tie);
            if (row.verdict == RowVerdict::divergent)
                row.reason = fmt::format("{} follows from the GPU's own values above", follows);
        }
        rows_.push_back(std::move(row));
    }

    /// A texel read: its distance and how far it came.
    void fetch(std::string label, Cell strict, Cell reference, Cell gpu, const Legality& distance, bool reached_follows,
               std::string_view should_be) {
        StepRow row{.label = std::move(label),
                    .strict = std::move(strict),
                    .reference = std::move(reference),
                    .gpu = std::move(gpu),
                    .is_fetch = true};
        if (!row.gpu.empty()) {
            const bool same = row.gpu.text == row.reference.text &&
                              row.gpu.number.has_value() == row.reference.number.has_value() &&
                              (!row.gpu.number || same_bits(*row.gpu.number, *row.reference.number));
            const bool decided_alike = row.gpu.text == row.reference.text;
            Legality both = distance;
            both.legal = distance.legal && reached_follows;
            row.verdict = judge(same, both, decided_alike ? RowVerdict::rounding : RowVerdict::tie);
            if (row.verdict == RowVerdict::divergent)
                row.reason = distance.legal ? fmt::format("\"{}\" follows from the GPU's own values above", should_be)
                                            : distance.words;
        }
        rows_.push_back(std::move(row));
    }

    void only_gpu(std::string label, Cell gpu) { rows_.push_back({.label = std::move(label), .gpu = std::move(gpu)}); }
    void only_reference(std::string label, Cell strict, Cell reference) {
        rows_.push_back({.label = std::move(label), .strict = std::move(strict), .reference = std::move(reference)});
    }

    std::vector<StepRow> take() { return std::move(rows_); }

  private:
    RowVerdict judge(bool same, const Legality& legality, RowVerdict otherwise) {
        if (same)
            return RowVerdict::same;
        RowVerdict verdict = departed_ ? RowVerdict::follows : otherwise;
        if (!legality.legal)
            verdict = RowVerdict::divergent;
        else if (legality.open)
            verdict = RowVerdict::undefined;
        departed_ = departed_ || verdict != RowVerdict::rounding;
        return verdict;
    }

    std::vector<StepRow> rows_;
    bool departed_ = false; ///< a decision was another, or a value none that is legal
};

/// Everything drawn to a texel.
struct Contender {
    std::size_t particle = 0;
    float depth = 1.0F;
};

const std::vector<glm::vec3>& drawn_positions(const JudgedFrame& frame) {
    return frame.params.switches.raster_position == RasterPosition::updated ? frame.gpu.position
                                                                            : frame.before.position;
}

/// The particles that the reference draws to a texel, taking the GPU's state, in drawing order.
std::vector<Contender> contenders(const JudgedFrame& frame, glm::ivec2 texel) {
    std::vector<Contender> found;
    const std::vector<glm::vec3>& positions = drawn_positions(frame);
    const FlushSubnormals guard(frame.profile.flush_subnormals);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const PointFragment point = point_fragment(positions[i], frame.params, frame.profile);
        if (point.x == texel.x && point.y == texel.y && point.x >= 0)
            found.push_back({i, point.depth});
    }
    return found;
}

/// Particles whose stored code a texel holds: candidates first.
std::optional<std::size_t> particle_of(glm::vec4 code, const JudgedFrame& frame,
                                       const std::vector<Contender>& candidates) {
    const CollisionCode encoding(frame.params);
    for (const Contender& candidate : candidates)
        if (same_bits(encoding.encode(frame.gpu.position[candidate.particle]), code))
            return candidate.particle;
    for (std::size_t i = 0; i < frame.gpu.size(); ++i)
        if (same_bits(encoding.encode(frame.gpu.position[i]), code))
            return i;
    return {};
}

std::string owner_text(glm::vec4 code, const std::optional<std::size_t>& particle) {
    if (code.a == 0.0F)
        return "nobody";
    return particle ? fmt::format("particle {}", *particle) : "an obstacle";
}

LegalTexel legal_texel(const JudgedFrame& frame, std::size_t texel) {
    const std::size_t wanted[] = {texel};
    return legal_texels(frame.obstacles, frame.before, frame.gpu, frame.params, frame.profile, frame.known, wanted)
        .front();
}

/// Who won a texel, and what it stores: the last rows of a particle's table, and of a texel's.
void add_winner(FrameRun& run, glm::ivec2 texel, const std::vector<Contender>& wanted, Rows& rows) {
    const JudgedFrame frame = run.judged();
    const std::size_t index = frame.gpu_cdt.index(texel.x, texel.y);
    const glm::vec4 reference = run.redrawn().texels[index];
    const glm::vec4 gpu = frame.gpu_cdt.texels[index];
    const LegalTexel legal = legal_texel(frame, index);
    const bool may = legal.owner_of(gpu) != nullptr;
    const std::string reference_owner = owner_text(reference, particle_of(reference, frame, wanted));
    auto gpu_particle = particle_of(gpu, frame, wanted);
    std::string gpu_owner = owner_text(gpu, gpu_particle);
    if (gpu.a != 0.0F && !gpu_particle && !may)
        gpu_owner = "nobody known";
    rows.decision(fmt::format("owner of texel {}", texel_text(texel)), {}, reference_owner, gpu_owner, reference_owner,
                  may);
    for (int c = 0; c < 4; ++c) {
        Legality legality;
        legality.legal = may;
        legality.words = fmt::format("{} stores {:a}", reference_owner, reference[c]);
        rows.number(fmt::format("stored.{}", axes[static_cast<std::size_t>(c)]), {}, reference[c], gpu[c], legality);
    }
}

std::string list_of(const std::vector<Contender>& contenders, std::optional<std::size_t> except) {
    constexpr std::size_t most = 4;
    std::string text;
    std::size_t count = 0;
    for (const Contender& contender : contenders) {
        if (contender.particle == except)
            continue;
        if (++count <= most)
            text += fmt::format("{}{}", text.empty() ? "" : " ", contender.particle);
    }
    if (count > most)
        text += fmt::format(" and {} more", count - most);
    return text.empty() ? "nobody" : text;
}

/// `A`: the profile's arithmetic.
template <class A> class TableBuilder {
  public:
    /// `run`: null where the particle is alone.
    TableBuilder(A fp, const JudgedFrame& frame, std::size_t particle, StepCapture capture, FrameRun* run)
        : fp_(fp), run_(run), frame_(frame), params_(frame_.params), constants_(params_.constants),
          switches_(params_.switches), particle_(particle), arithmetic_(fp, frame_.known, frame_.profile.other_orders),
          before_(frame_.before[particle]), strict_(trace_step(before_, frame_.cdt, params_, named_profile("strict"))),
          reference_(trace_step(before_, frame_.cdt, params_, frame_.profile)), gpu_(std::move(capture)),
          seen_(seen_texels(gpu_)), state_(gpu_.vertex_state.value_or(frame_.gpu[particle])) {
        const ParticleState captured = frame_.gpu[particle];
        outcomes_ = legal_outcomes(before_, frame_.cdt, params_, frame_.profile, frame_.known, &captured);
        if (const auto hit = gpu_.vertex.integer("trace_hit"))
            gpu_hit_ = *hit != 0;
    }

    StepTable operator()() {
        const FlushSubnormals guard(frame_.known.subnormals && frame_.profile.flush_subnormals);
        place_on_image();
        look_around();
        if (gpu_hit_)
            answer();
        else
            answer_untraced();
        pass_on();
        draw();
        others();
        StepTable table{0, particle_, reference_, std::move(gpu_), rows_.take(), {}};
        if (!same_bits(table.gpu.state, frame_.gpu[particle_]))
            table.warning = "the trace build's outputs are not the ones the frame had; what it tells of the steps "
                            "between may not be what happened";
        return table;
    }

  private:
    using Optional = std::optional<float>;

    /// Lines 2 to 4.
    void place_on_image() {
        const auto clip = gpu_.vertex.vec4("trace_clip");
        const auto legal_clip = arithmetic_.transform(params_.collision_proj_view, arithmetic_.read(before_.position));
        rows_.numbers<glm::vec4>("clip", strict_.clip, reference_.clip, clip, legal_clip.data());

        const glm::vec4 c = clip.value_or(reference_.clip);
        const bool divides = switches_.perspective_divide == PerspectiveDivide::on;
        const auto ndc = gpu_.vertex.vec2("trace_ndc");
        Interval legal_ndc[2];
        for (int k = 0; k < 2; ++k)
            legal_ndc[k] = divides ? arithmetic_.divide(point(c[k]), point(c.w)) : point(c[k]);
        rows_.numbers<glm::vec2>(divides ? "clip / w" : "not divided", strict_.ndc, reference_.ndc, ndc, legal_ndc);

        const auto texture = gpu_.vertex.vec2("trace_texture_coordinate");
        const glm::vec2 n = ndc.value_or(reference_.ndc);
        Interval legal_texture[2];
        for (int k = 0; k < 2; ++k)
            legal_texture[k] = arithmetic_.product(arithmetic_.sum(point(n[k]), 1.0F), 0.5F);
        rows_.numbers<glm::vec2>("texture coordinate", strict_.texture_coordinate, reference_.texture_coordinate,
                                 texture, legal_texture);

        const auto image = gpu_.vertex.vec2("trace_image_position");
        const glm::vec2 t = texture.value_or(reference_.texture_coordinate);
        const glm::vec2 size(params_.width, params_.height);
        Interval legal_image[2];
        for (int k = 0; k < 2; ++k)
            legal_image[k] = arithmetic_.product(point(t[k]), size[k]);
        rows_.numbers<glm::vec2>("image position", strict_.image_position, reference_.image_position, image,
                                 legal_image);

        const auto base = gpu_.vertex.integers("trace_base_texel");
        base_ = base.value_or(as_vector(reference_.base));
        rows_.decision("base texel", texel_text(as_vector(strict_.base)), texel_text(as_vector(reference_.base)),
                       base ? std::optional(texel_text(*base)) : std::nullopt,
                       texel_text(cast(image.value_or(reference_.image_position))));
    }

    [[nodiscard]] glm::ivec2 cast(glm::vec2 p) const {
        const bool floors = switches_.base_texel == BaseTexel::floor;
        const bool left = floors ? p.x >= 0.0F && p.y >= 0.0F : p.x > -1.0F && p.y > -1.0F;
        const bool right = p.x < static_cast<float>(params_.width) && p.y < static_cast<float>(params_.height);
        return left && right ? glm::ivec2(static_cast<int>(p.x), static_cast<int>(p.y)) : glm::ivec2(-1);
    }

    /// Lines 5 to 19.
    void look_around() {
        const auto yes = [](bool searches) { return std::string(searches ? "yes" : "no"); };
        const auto searches = gpu_.vertex.integer("trace_searches");
        const Interval time = arithmetic_.read(before_.collide_time);
        const bool may = base_.x >= 0 && time.low < 0.0;
        const bool must = base_.x >= 0 && time.high < 0.0;
        const bool legal_either = time.any || may != must;
        rows_.decision("searches", yes(strict_.searches), yes(reference_.searches),
                       searches ? std::optional(yes(*searches != 0)) : std::nullopt, yes(must), legal_either);
        gpu_searches_ = searches.value_or(reference_.searches ? 1 : 0) != 0;
        if (!reference_.own_position && !gpu_searches_)
            return;
        own_position();
        neighbours();
        nearest();
    }

    void own_position() {
        glm::vec3 own = before_.position;
        if (switches_.self_position == SelfPosition::texel && frame_.cdt.contains(base_.x, base_.y))
            own = code().decode(frame_.cdt.at(base_.x, base_.y));
        Interval3 legal = arithmetic_.read(own);
        if (switches_.cdt_format == CdtFormat::rgba8 && switches_.self_position == SelfPosition::texel &&
            !arithmetic_.known().sums && frame_.cdt.contains(base_.x, base_.y)) {
            const auto [low, scaled] = decoded_terms(arithmetic_, frame_.cdt.at(base_.x, base_.y), params_);
            legal = arithmetic_.sum(low, scaled);
        }
        gpu_own_ = searching(gpu_.vertex.vec3("trace_own_position"));
        rows_.numbers<glm::vec3>("own position", strict_.own_position, reference_.own_position, gpu_own_, legal.data());
    }

    template <class Value> [[nodiscard]] std::optional<Value> searching(std::optional<Value> value) const {
        return gpu_searches_ ? value : std::nullopt;
    }

    void neighbours() {
        std::vector<glm::ivec2> order = around(as_vector(reference_.base));
        for (const glm::ivec2 texel : around(base_))
            if (std::find(order.begin(), order.end(), texel) == order.end())
                order.push_back(texel);
        for (const SeenTexel& seen : seen_)
            if (std::find(order.begin(), order.end(), seen.texel) == order.end())
                order.push_back(seen.texel);
        for (const glm::ivec2 texel : order)
            neighbour(texel);
    }

    [[nodiscard]] std::vector<glm::ivec2> around(glm::ivec2 base) const {
        std::vector<glm::ivec2> texels;
        const int reach = constants_.texel_collide_range;
        for (int y = -reach; base.x >= 0 && y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x)
                texels.emplace_back(base.x + x, base.y + y);
        return texels;
    }

    static const NeighbourTrace* find(const StepTrace& trace, glm::ivec2 texel) {
        for (const NeighbourTrace& neighbour : trace.neighbours)
            if (as_vector(neighbour.texel) == texel)
                return &neighbour;
        return nullptr;
    }

    Cell cell(const StepTrace& trace, glm::ivec2 texel) const {
        if (!trace.searches)
            return {};
        if (texel == as_vector(trace.base))
            return {{}, std::string(reached_text(Reached::skipped, true))};
        const NeighbourTrace* neighbour = find(trace, texel);
        if (neighbour == nullptr)
            return {{}, "not looked at"};
        return {neighbour->holds_particle ? Optional(neighbour->distance) : std::nullopt,
                std::string(reached_text(reached(*neighbour), false))};
    }

    void neighbour(glm::ivec2 texel) {
        const auto found =
            std::find_if(seen_.begin(), seen_.end(), [&](const SeenTexel& s) { return s.texel == texel; });
        const SeenTexel* seen = found == seen_.end() ? nullptr : &*found;
        const NeighbourTrace* in_reference = find(reference_, texel);
        const bool own = texel == base_;
        if (in_reference == nullptr && (seen == nullptr || seen->reached == Reached::skipped))
            return;
        Cell gpu;
        if (gpu_searches_ && !seen_.empty())
            gpu = seen == nullptr ? Cell{{}, "not looked at"}
                                  : Cell{seen->has_distance() ? Optional(seen->distance) : std::nullopt,
                                         std::string(reached_text(seen->reached, own))};
        Legality distance;
        if (seen != nullptr && seen->has_distance()) {
            stored_and_apart(*seen, in_reference);
            distance = legality(arithmetic_.length(arithmetic_.read(seen->apart)), seen->distance);
        }
        const std::string should = should_reach(texel, seen);
        rows_.fetch(fmt::format("texel ({}, {})", texel.x, texel.y), cell(strict_, texel), cell(reference_, texel), gpu,
                    distance, gpu.text == should, should);
        if (seen != nullptr && seen->reached == Reached::nearest) {
            best_ = seen->distance;
            gpu_nearest_ = seen;
        }
    }

    /// The fetched position and the difference to the own one: rows of their own only where they differ, or are wrong
    /// where the reference reads nothing.
    void stored_and_apart(const SeenTexel& seen, const NeighbourTrace* in_reference) {
        const glm::vec4 stored =
            frame_.cdt.contains(seen.texel.x, seen.texel.y) ? frame_.cdt.at(seen.texel.x, seen.texel.y) : glm::vec4(0);
        Interval3 legal = arithmetic_.read(code().decode(stored));
        const glm::vec3 own = gpu_own_.value_or(reference_.own_position.value_or(before_.position));
        Interval3 apart = arithmetic_.difference(arithmetic_.read(own), arithmetic_.read(seen.position));
        if (switches_.cdt_format == CdtFormat::rgba8 && !arithmetic_.known().sums) {
            const auto [low, scaled] = decoded_terms(arithmetic_, stored, params_);
            legal = arithmetic_.sum(low, scaled);
            for (std::size_t c = 0; c < 3; ++c)
                apart[c] = interval::hull(
                    apart[c],
                    arithmetic_.difference_of_sums({arithmetic_.read(own[static_cast<int>(c)])}, {low[c], scaled[c]}));
        }
        const bool holds = in_reference != nullptr && in_reference->holds_particle;
        const bool right =
            holds ? same_bits(in_reference->position, seen.position) && same_bits(in_reference->apart, seen.apart)
                  : contains(legal, seen.position) && contains(apart, seen.apart);
        if (right)
            return;
        const NeighbourTrace* in_strict = find(strict_, seen.texel);
        const auto of = [](const NeighbourTrace* neighbour, glm::vec3 NeighbourTrace::*field) {
            return neighbour != nullptr && neighbour->holds_particle ? std::optional(neighbour->*field) : std::nullopt;
        };
        const std::string name = fmt::format("({}, {})", seen.texel.x, seen.texel.y);
        rows_.numbers<glm::vec3>("stored " + name, of(in_strict, &NeighbourTrace::position),
                                 of(in_reference, &NeighbourTrace::position), seen.position, legal.data());
        rows_.numbers<glm::vec3>("apart " + name, of(in_strict, &NeighbourTrace::apart),
                                 of(in_reference, &NeighbourTrace::apart), seen.apart, apart.data());
    }

    static bool contains(const Interval3& set, glm::vec3 v) {
        return set[0].contains(v.x) && set[1].contains(v.y) && set[2].contains(v.z);
    }

    /// What the GPU has to do with a texel by its own values.
    [[nodiscard]] std::string should_reach(glm::ivec2 texel, const SeenTexel* seen) const {
        const std::vector<glm::ivec2> wanted = around(base_);
        if (std::find(wanted.begin(), wanted.end(), texel) == wanted.end())
            return "not looked at";
        const bool own = texel == base_;
        Reached should = Reached::skipped;
        if (!own && frame_.cdt.contains(texel.x, texel.y)) {
            const bool phantom = switches_.empty_texel == EmptyTexel::phantom;
            should = Reached::read;
            if (phantom || frame_.cdt.at(texel.x, texel.y).a != 0.0F)
                should = seen != nullptr && seen->has_distance() ? by_distance(seen->distance) : Reached::compared;
        }
        return std::string(reached_text(should, own));
    }

    [[nodiscard]] Reached by_distance(float distance) const {
        if (distance == 0.0F && switches_.zero_distance == ZeroDistance::skip)
            return Reached::holds_particle;
        return constants_.collision_range > distance && distance < best_ ? Reached::nearest : Reached::compared;
    }

    void nearest() {
        const auto text = [](const StepTrace& trace) {
            return trace.nearest ? texel_text(as_vector(trace.neighbours[*trace.nearest].texel)) : std::string("none");
        };
        const std::string follows = gpu_nearest_ != nullptr ? texel_text(gpu_nearest_->texel) : "none";
        std::optional<std::string> gpu;
        if (gpu_hit_)
            gpu = *gpu_hit_ ? (gpu_nearest_ != nullptr ? follows : "some texel") : "none";
        rows_.decision("nearest", text(strict_), text(reference_), gpu, follows);
    }

    /// Lines 21 to 30, as far as the GPU told of them.
    void answer() {
        const bool hit = *gpu_hit_;
        const Interval3 position = arithmetic_.read(before_.position);
        const Interval tick(constants_.tick);
        Interval speed, collide_time;
        Interval3 direction;
        if (hit || reference_.nearest) {
            const auto gpu = hit ? gpu_.vertex.vec3("trace_away") : std::nullopt;
            const glm::vec3 follows = gpu_nearest_ != nullptr ? gpu_nearest_->apart : glm::vec3(0.0F);
            const Interval3 legal = arithmetic_.read(follows);
            rows_.numbers<glm::vec3>("away", away(strict_), away(reference_), gpu, legal.data());
        }
        if (!hit || !reference_.nearest) {
            const auto gpu = hit ? std::nullopt : gpu_.vertex.vec3("trace_velocity");
            const Interval3 legal =
                arithmetic_.sum(arithmetic_.scale(arithmetic_.read(before_.direction), arithmetic_.read(before_.speed)),
                                arithmetic_.scale(arithmetic_.read(constants_.gravity), tick));
            rows_.numbers<glm::vec3>("velocity", velocity(strict_), velocity(reference_), gpu, legal.data());
        }
        if (hit) {
            const glm::vec3 from = gpu_.vertex.vec3("trace_away").value_or(glm::vec3(0.0F));
            direction = arithmetic_.normalize(arithmetic_.read(from));
            speed = arithmetic_.product(arithmetic_.read(before_.speed), switches_.speed_factor);
            collide_time = constants_.collision_time;
        } else {
            const glm::vec3 from = gpu_.vertex.vec3("trace_velocity").value_or(reference_.velocity);
            direction = arithmetic_.normalize(arithmetic_.read(from));
            speed = arithmetic_.length(arithmetic_.read(from));
            collide_time = arithmetic_.difference(arithmetic_.read(before_.collide_time), tick);
        }
        rows_.number("speed", strict_.after.speed, reference_.after.speed, state_.speed, legality(speed, state_.speed));
        rows_.numbers<glm::vec3>("direction", strict_.after.direction, reference_.after.direction, state_.direction,
                                 direction.data());
        rows_.number("collide time", strict_.after.collide_time, reference_.after.collide_time, state_.collide_time,
                     legality(collide_time, state_.collide_time));
        Interval3 step = arithmetic_.scale(arithmetic_.read(state_.direction), arithmetic_.read(state_.speed));
        if (!hit || switches_.collision_step == CollisionStep::tick)
            step = arithmetic_.scale(step, tick);
        const Interval3 moved = arithmetic_.sum(position, step);
        rows_.numbers<glm::vec3>("position", strict_.after.position, reference_.after.position, state_.position,
                                 moved.data());
    }

    static std::optional<glm::vec3> away(const StepTrace& trace) {
        return trace.nearest ? std::optional(trace.neighbours[*trace.nearest].apart) : std::nullopt;
    }
    static std::optional<glm::vec3> velocity(const StepTrace& trace) {
        return trace.nearest ? std::nullopt : std::optional(trace.velocity);
    }

    /// The same of a shader that tells nothing in between: a field is legal if some outcome has it, with the fields
    /// before it.
    void answer_untraced() {
        keep("collide time", strict_.after.collide_time, reference_.after.collide_time, state_.collide_time,
             [](const LegalOutcome& o) { return o.collide_time; });
        keep("speed", strict_.after.speed, reference_.after.speed, state_.speed,
             [](const LegalOutcome& o) { return o.speed; });
        for (int c = 0; c < 3; ++c)
            keep(fmt::format("direction.{}", axes[static_cast<std::size_t>(c)]), strict_.after.direction[c],
                 reference_.after.direction[c], state_.direction[c],
                 [c](const LegalOutcome& o) { return o.direction[static_cast<std::size_t>(c)]; });
        for (int c = 0; c < 3; ++c)
            keep(fmt::format("position.{}", axes[static_cast<std::size_t>(c)]), strict_.after.position[c],
                 reference_.after.position[c], state_.position[c],
                 [c](const LegalOutcome& o) { return o.position[static_cast<std::size_t>(c)]; });
    }

    template <class FieldOf> void keep(std::string label, float strict, float reference, float gpu, FieldOf field) {
        std::vector<LegalOutcome> kept;
        bool open = false;
        for (const LegalOutcome& outcome : outcomes_)
            if (field(outcome).contains(gpu)) {
                kept.push_back(outcome);
                open = open || field(outcome).any;
            }
        Legality legality{.legal = !kept.empty(), .open = open, .words = "no legal outcome has it"};
        rows_.number(std::move(label), strict, reference, gpu, legality);
        if (!kept.empty())
            outcomes_ = kept;
    }

    /// What the stages after the vertex stage, and transform feedback, made of its outputs.
    void pass_on() {
        if (!gpu_.vertex_state || same_bits(*gpu_.vertex_state, frame_.gpu[particle_]))
            return;
        const ParticleState captured = frame_.gpu[particle_];
        const auto row = [&](std::string label, float handed_on, float value) {
            if (!same_bits(handed_on, value))
                rows_.number(label + " captured", {}, handed_on, value,
                             {.legal = false, .words = fmt::format("the vertex stage handed on {:a}", handed_on)});
        };
        row("speed", state_.speed, captured.speed);
        for (int c = 0; c < 3; ++c)
            row(fmt::format("direction.{}", axes[static_cast<std::size_t>(c)]), state_.direction[c],
                captured.direction[c]);
        row("collide time", state_.collide_time, captured.collide_time);
        for (int c = 0; c < 3; ++c)
            row(fmt::format("position.{}", axes[static_cast<std::size_t>(c)]), state_.position[c],
                captured.position[c]);
    }

    /// Where the point goes.
    void draw() {
        const FlushSubnormals flush(frame_.profile.flush_subnormals);
        const bool updated = switches_.raster_position == RasterPosition::updated;
        const auto clip = gpu_.vertex.vec4("trace_point_clip");
        const glm::vec3 drawn_at = updated ? state_.position : before_.position;
        const auto legal_clip = arithmetic_.transform(params_.collision_proj_view, arithmetic_.read(drawn_at));
        rows_.numbers<glm::vec4>("point's clip", strict_.raster_clip, reference_.raster_clip, clip, legal_clip.data());

        const glm::vec4 follows =
            point_position(clip.value_or(fp_.transform(params_.collision_proj_view, drawn_at)), params_);
        if (!gpu_.drawn_alone)
            gpu_.position = follows;
        const bool gpu_drawn = in_clip_volume(gpu_.position);
        const bool reference_drawn = in_clip_volume(reference_.point_position);
        const auto yes = [](bool drawn) { return std::string(drawn ? "yes" : "no"); };
        rows_.decision("in clip volume", yes(in_clip_volume(strict_.point_position)), yes(reference_drawn),
                       told(yes(gpu_drawn)), yes(in_clip_volume(follows)));
        if (!gpu_drawn && !reference_drawn)
            return;
        Interval legal[4];
        for (int c = 0; c < 4; ++c)
            legal[c] = clip || switches_.arithmetic == ArithmeticSwitch::exact
                           ? Interval(follows[c])
                           : legal_clip[static_cast<std::size_t>(c)];
        const auto of = [](glm::vec4 p) { return in_clip_volume(p) ? std::optional(p) : std::nullopt; };
        rows_.numbers<glm::vec4>("gl_Position", of(strict_.point_position), of(reference_.point_position),
                                 gpu_.drawn_alone ? of(gpu_.position) : std::nullopt, legal);
        rasterise();
    }

    [[nodiscard]] std::optional<std::string> told(std::string text) const {
        return gpu_.drawn_alone ? std::optional(std::move(text)) : std::nullopt;
    }

    void rasterise() {
        const auto pixels = [&](const char* label, auto member) {
            for (int c = 0; c < 2; ++c)
                rows_.only_reference(fmt::format("{}.{}", label, axes[static_cast<std::size_t>(c)]), member(strict_, c),
                                     member(reference_, c));
        };
        pixels("window position", [](const StepTrace& t, int c) { return Cell{t.window.position[c], {}}; });
        const int grid = 1 << frame_.profile.raster.subpixel_bits;
        pixels("snapped", [&](const StepTrace& t, int c) {
            return Cell{{}, fmt::format("{}/{} px", t.window.snapped[c] + grid / 2, grid)};
        });
        const auto texel = [](const PointFragment& f) { return texel_text({f.x, f.y}); };
        const PointFragment follows = drawn_point(gpu_.position, params_, frame_.profile.raster);
        if (!gpu_.drawn_alone)
            gpu_.texel = {follows.x, follows.y};
        Interval depth(follows.depth);
        bool may = false;
        if (!arithmetic_.known().points && gpu_.texel.x >= 0) {
            const LegalTexel legal = legal_texel(frame_, frame_.gpu_cdt.index(gpu_.texel.x, gpu_.texel.y));
            for (const TexelOwner& owner : legal.owners)
                if (owner.kind == TexelOwner::Kind::particle && owner.index == particle_) {
                    may = true;
                    depth = owner.depth;
                }
        }
        rows_.decision("texel", texel(strict_.fragment), texel(reference_.fragment), told(texel_text(gpu_.texel)),
                       texel(follows), may);
        if (gpu_.texel.x >= 0 || reference_.fragment.x >= 0) {
            const Optional gpu = gpu_.texel.x >= 0 && gpu_.drawn_alone ? Optional(gpu_.depth) : std::nullopt;
            rows_.number("depth", strict_.fragment.depth, reference_.fragment.depth, gpu, legality(depth, gpu));
        }
        const glm::ivec2 at = gpu_.texel.x >= 0 ? gpu_.texel : glm::ivec2(reference_.fragment.x, reference_.fragment.y);
        if (at.x < 0 || run_ == nullptr)
            return;
        const std::vector<Contender> wanted = contenders(frame_, at);
        std::string rivals = list_of(wanted, particle_);
        if (run_->obstacle_depth().at(at.x, at.y) < 1.0F)
            rivals = rivals == "nobody" ? "an obstacle" : "an obstacle, " + rivals;
        rows_.only_reference("also wanted by", {}, {{}, rivals});
        add_winner(*run_, at, wanted, rows_);
    }

    /// Captured outputs of names this table has no row for.
    void others() {
        static const std::set<std::string_view> known{
            "trace_clip",       "trace_ndc",      "trace_texture_coordinate", "trace_image_position",
            "trace_base_texel", "trace_searches", "trace_own_position",       "trace_neighbour_count",
            "trace_hit",        "trace_away",     "trace_velocity",           "trace_point_clip"};
        for (const CapturedVertex* vertex : {&gpu_.vertex, &gpu_.last})
            for (const CapturedOutput& output : vertex->outputs) {
                if (known.contains(output.name) && vertex == &gpu_.vertex)
                    continue;
                for (std::size_t c = 0; c < output.words.size(); ++c) {
                    std::string label = output.name;
                    if (output.words.size() > 1)
                        label +=
                            output.words.size() <= axes.size() ? fmt::format(".{}", axes[c]) : fmt::format("[{}]", c);
                    rows_.only_gpu(std::move(label), output.is_float ? Cell{output.number(c), {}}
                                                                     : Cell{{}, fmt::format("{}", output.integer(c))});
                }
            }
    }

    static Interval point(float value) { return value != value ? Interval::anything() : Interval(value); }
    [[nodiscard]] CollisionCode code() const { return CollisionCode(params_); }

    A fp_;
    FrameRun* run_;
    JudgedFrame frame_;
    const FrameParams& params_;
    const Constants& constants_;
    const Switches& switches_;
    std::size_t particle_;
    LegalArithmetic<A> arithmetic_;
    ParticleState before_;
    StepTrace strict_, reference_;
    StepCapture gpu_;
    std::vector<SeenTexel> seen_;
    ParticleState state_; ///< the GPU's, as the vertex stage hands it on
    std::vector<LegalOutcome> outcomes_;
    std::optional<bool> gpu_hit_;
    bool gpu_searches_ = false;
    glm::ivec2 base_{-1}; ///< the GPU's
    std::optional<glm::vec3> gpu_own_;
    float best_ = 100000.0F; ///< the GPU's nearest distance so far
    const SeenTexel* gpu_nearest_ = nullptr;
    Rows rows_;
};

} // namespace

const StepRow* StepTable::first_divergent() const {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [](const StepRow& row) { return row.verdict == RowVerdict::divergent; });
    return found == rows.end() ? nullptr : &*found;
}

StepTable step_table(FrameRun& run, std::size_t particle) {
    if (!is_listing(run.scene().switches)) {
        StepTable table = step_table(run.judged(), particle, run.capture(particle));
        table.frame = run.frame();
        return table;
    }
    StepTable table = with_arithmetic(run.profile(), run.scene().switches.arithmetic, [&](auto fp) {
        return TableBuilder(fp, run.judged(), particle, run.capture(particle), &run)();
    });
    table.frame = run.frame();
    return table;
}

StepTable step_table(const JudgedFrame& frame, std::size_t particle, const StepCapture& capture) {
    if (!is_listing(frame.params.switches)) {
        StepTable table;
        table.particle = particle;
        table.gpu = capture;
        table.reference.before = frame.before[particle];
        table.rows = with_step_pass(
            frame, [&](const JudgedPass& pass) { return item_rows(pass, particle, told_by_state(pass, particle)); });
        return table;
    }
    return with_arithmetic(frame.profile, frame.params.switches.arithmetic,
                           [&](auto fp) { return TableBuilder(fp, frame, particle, capture, nullptr)(); });
}

/// Of an image that is drawn otherwise than the listing's: what is stored, beside what the reference draws of the GPU's
/// own particles.
TexelTable drawn_texel_table(FrameRun& run, std::size_t texel) {
    const JudgedFrame frame = run.judged();
    Rows rows;
    const glm::vec4 reference = run.redrawn().texels[texel], gpu = frame.gpu_cdt.texels[texel];
    for (int c = 0; c < 4; ++c)
        rows.number(fmt::format("stored.{}", axes[static_cast<std::size_t>(c)]), {}, reference[c], gpu[c],
                    legality(Interval(reference[c]), gpu[c]));
    return {run.frame(), texel, rows.take(), {}};
}

TexelTable texel_table(FrameRun& run, std::size_t texel) {
    if (!is_listing(run.scene().switches))
        return drawn_texel_table(run, texel);
    const JudgedFrame frame = run.judged();
    const auto width = static_cast<std::size_t>(frame.params.width);
    const glm::ivec2 at(static_cast<int>(texel % width), static_cast<int>(texel / width));
    std::vector<Contender> wanted = contenders(frame, at);
    const auto by_reference = wanted.size();
    const glm::vec4 gpu_code = frame.gpu_cdt.texels[texel];
    const auto gpu_owner = particle_of(gpu_code, frame, wanted);
    const auto reference_owner = particle_of(run.redrawn().texels[texel], frame, wanted);
    const auto has = [&](std::size_t particle) {
        return std::any_of(wanted.begin(), wanted.end(), [&](const Contender& c) { return c.particle == particle; });
    };
    if (gpu_code.a != 0.0F && gpu_owner && !has(*gpu_owner))
        wanted.push_back({*gpu_owner, 1.0F});

    Rows rows;
    if (const float depth = run.obstacle_depth().at(at.x, at.y); depth < 1.0F)
        rows.only_reference("an obstacle's depth", {}, {depth, {}});
    const LegalTexel legal = legal_texel(frame, texel);
    constexpr std::size_t most = 32;
    for (std::size_t i = 0; i < std::min(wanted.size(), most); ++i) {
        const std::size_t particle = wanted[i].particle;
        const StepCapture capture = run.capture(particle);
        const bool drawn = capture.texel == at;
        const std::optional<float> gpu = drawn ? std::optional(capture.depth) : std::nullopt;
        const std::optional<float> reference = i < by_reference ? std::optional(wanted[i].depth) : std::nullopt;
        Interval depth(wanted[i].depth);
        for (const TexelOwner& owner : legal.owners)
            if (owner.kind == TexelOwner::Kind::particle && owner.index == particle)
                depth = owner.depth;
        rows.number(fmt::format("particle {}'s depth", particle), {}, reference, gpu, legality(depth, gpu));
    }
    add_winner(run, at, wanted, rows);
    TexelTable table{run.frame(), texel, rows.take(), {}};
    for (const auto& owner : {reference_owner, gpu_owner})
        if (owner && std::find(table.particles.begin(), table.particles.end(), *owner) == table.particles.end())
            table.particles.push_back(*owner);
    return table;
}

} // namespace lockstep
