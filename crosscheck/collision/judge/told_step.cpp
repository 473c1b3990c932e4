#include "crosscheck/collision/judge/told_step.hpp"

#include <optional>

#include "crosscheck/judge/item_table.hpp"
#include "reference/collision/depth/depth_twin.hpp"
#include "reference/collision/sites.hpp"
#include "reference/model/collision/collision_state.hpp"

namespace lockstep {
namespace {

/// How far a texel came that was looked at, as trace_neighbour_reached counts.
enum Reached { skipped, read, holds_particle, compared, became_nearest };

class ToldStep {
  public:
    explicit ToldStep(const StepCapture& capture) : capture_(capture), vertex_(capture.vertex) {}

    std::vector<ToldValue> operator()() {
        const auto searches = vertex_.integer(site::searches.output);
        const auto hit = vertex_.integer("trace_hit");
        const auto base = vertex_.integers(site::base_texel.output);
        for (const Site* site : {&site::clip, &site::ndc, &site::texture_coordinate, &site::image_position})
            tell(*site, vertex_);
        // A particle outside the image does not search either, whatever its time.
        if (searches && (*searches != 0 || (base && base->x >= 0)))
            tell(site::searches, {*searches != 0 ? 1.0F : 0.0F});
        if (base)
            tell(site::base_texel, {base->x >= 0 ? 1.0F : 0.0F});
        if (base && base->x >= 0)
            tell(site::base_texel, {static_cast<float>(base->x), static_cast<float>(base->y)});
        if (searches.value_or(1) != 0)
            tell(site::own_position, vertex_);
        for (std::size_t i = 0; i < capture_.neighbours.size(); ++i)
            tell_turn(static_cast<int>(i), capture_.neighbours[i]);
        if (hit) {
            tell(site::nearest, {*hit != 0 ? 1.0F : 0.0F});
            tell(*hit != 0 ? site::away : site::velocity, vertex_);
        }
        return std::move(told_);
    }

    /// Of depth_pass.
    std::vector<ToldValue> against_depth() {
        const auto searches = vertex_.integer(site::searches.output);
        if (!searches)
            return {};
        decide(site::searches, *searches);
        if (*searches != 0)
            tell_surface_hit();
        const bool hit = vertex_.integer("trace_hit").value_or(0) != 0;
        tell(hit ? site::away : site::velocity, vertex_);
        return std::move(told_);
    }

  private:
    void decide(const Site& site, int answer) { tell(site, {answer != 0 ? 1.0F : 0.0F}); }

    void tell_surface_hit() {
        const auto in_front = vertex_.integer(site::in_front.output);
        const auto base = vertex_.integers(site::base_texel.output);
        tell(site::clip, vertex_);
        if (in_front)
            decide(site::in_front, *in_front);
        if (in_front.value_or(1) == 0)
            return;
        for (const Site* site : {&site::ndc, &site::texture_coordinate, &site::image_position})
            tell(*site, vertex_);
        if (base)
            decide(site::base_texel, base->x >= 0 ? 1 : 0);
        if (!base || base->x < 0)
            return;
        tell(site::base_texel, {static_cast<float>(base->x), static_cast<float>(base->y)});
        constexpr int outside = 0, shows = 2; // 1: read
        std::size_t shown = 0;
        for (const CapturedVertex& texel : capture_.neighbours) {
            const int reached = texel.integer(site::shows_surface.output).value_or(outside);
            if (reached != outside)
                decide(site::shows_surface, reached == shows ? 1 : 0);
            if (reached != shows)
                continue;
            ++shown;
            for (const Site* site : {&site::texel_ndc, &site::unprojected, &site::surface, &site::surface_distance})
                tell(*site, texel);
        }
        if (shown > 0) {
            tell(site::depth_behind, vertex_);
            for (const Site* site : {&site::behind_surface, &site::within_thickness})
                if (const auto answer = vertex_.integer(site->output))
                    decide(*site, *answer);
        }
        if (shown == 3)
            for (const Site* site : {&site::to_right, &site::to_upper, &site::normal})
                tell(*site, vertex_);
    }

    void tell_turn(int turn, const CapturedVertex& vertex) {
        const auto texel = vertex.integers(site::neighbour.output);
        const auto reached = vertex.integer(site::nearest.output);
        if (!texel || !reached)
            return;
        tell(site::neighbour,
             {static_cast<float>(texel->x), static_cast<float>(texel->y), *reached >= read ? 1.0F : 0.0F}, turn);
        if (*reached < holds_particle)
            return;
        for (const Site* site : {&site::stored_position, &site::apart, &site::distance})
            tell(*site, vertex, turn);
        tell(site::nearest, {*reached == became_nearest ? 1.0F : 0.0F}, turn);
    }

    void tell(const Site& site, std::vector<float> values, int turn = -1) {
        told_.push_back({std::string(site.output), std::move(values), turn});
    }
    /// As it was captured, if it was.
    void tell(const Site& site, const CapturedVertex& vertex, int turn = -1) {
        for (const CapturedOutput& output : vertex.outputs) {
            if (output.name != site.output || !output.is_float)
                continue;
            std::vector<float> values;
            for (std::size_t c = 0; c < output.words.size(); ++c)
                values.push_back(output.number(c));
            tell(site, std::move(values), turn);
        }
    }

    const StepCapture& capture_;
    const CapturedVertex& vertex_;
    std::vector<ToldValue> told_;
};

} // namespace

std::vector<ToldValue> told_by_capture(const ItemPass& pass, const StepCapture& capture, const ParticleState& state) {
    std::vector<ToldValue> told = pass.name() == "depth_pass" ? ToldStep(capture).against_depth() : ToldStep(capture)();
    const ParticleState left = capture.vertex_state.value_or(state);
    const std::vector<ToldValue> written = told_by_state(pass, view(left), 0);
    told.insert(told.end(), written.begin(), written.end());
    return told;
}

} // namespace lockstep
