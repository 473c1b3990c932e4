#include "crosscheck/collision/judge/drawn_rows.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/collision/judge/texel_table.hpp"
#include "crosscheck/judge/step_rows.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/legal_arithmetic.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/window.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

/// `A`: the profile's arithmetic.
template <class A> class DrawnRows {
  public:
    DrawnRows(A fp, std::vector<StepRow> step, const JudgedFrame& frame, std::size_t particle,
              const StepCapture& capture, const StepTrace& reference, FrameRun* run)
        : fp_(fp), run_(run), frame_(frame), params_(frame.params), particle_(particle),
          arithmetic_(fp, known_in_step(frame.params.switches, frame.known, frame.profile), frame.profile.other_orders),
          before_(frame.before[particle]), strict_(trace_step(before_, frame.cdt, params_, named_profile("strict"))),
          reference_(reference), gpu_(capture), state_(capture.vertex_state.value_or(frame.gpu[particle])),
          rows_(std::move(step)) {}

    std::vector<StepRow> operator()() {
        pass_on();
        draw();
        return rows_.take();
    }

  private:
    /// What the stages after the vertex stage, and transform feedback, made of its outputs.
    void pass_on() {
        const ParticleState captured = frame_.gpu[particle_];
        const View handed_on = view(state_), got = view(captured);
        for (const FieldId id : {collision::speed, collision::direction, collision::collide_time, collision::position})
            for (int c = 0; c < got.fields()[id.field].components; ++c) {
                const float from = handed_on.value(id.field, 0, c).real(), to = got.value(id.field, 0, c).real();
                if (same_bits(from, to))
                    continue;
                std::string name = component_name(got.fields()[id.field], c);
                std::replace(name.begin(), name.end(), '_', ' ');
                rows_.number(name + " captured", {}, from, to,
                             {{.legal = false}, fmt::format("the vertex stage handed on {:.9g}", from)});
            }
    }

    /// Where the point goes.
    void draw() {
        const FlushSubnormals flush = flush_in_step(params_.switches, frame_.profile);
        const auto clip = gpu_.vertex.vec4("trace_point_clip");
        const glm::vec3 drawn_at =
            params_.switches.raster_position == RasterPosition::updated ? state_.position : before_.position;
        const auto legal_clip = arithmetic_.transform(params_.collision_proj_view, arithmetic_.read(drawn_at));
        rows_.numbers<glm::vec4>("point's clip", strict_.raster_clip, reference_.raster_clip, clip, legal_clip.data());

        if (params_.switches.step == Step::compute)
            return place(clip.value_or(fp_.transform(params_.collision_proj_view, drawn_at)));
        const glm::vec4 follows =
            point_position(clip.value_or(fp_.transform(params_.collision_proj_view, drawn_at)), params_);
        if (!gpu_.drawn_alone)
            gpu_.position = follows;
        const bool gpu_drawn = in_clip_volume(gpu_.position, params_.clip_depth);
        const bool reference_drawn = in_clip_volume(reference_.point_position, params_.clip_depth);
        const auto yes = [](bool drawn) { return std::string(drawn ? "yes" : "no"); };
        rows_.decision("in clip volume", yes(in_clip_volume(strict_.point_position, params_.clip_depth)),
                       yes(reference_drawn), told(yes(gpu_drawn)), yes(in_clip_volume(follows, params_.clip_depth)));
        if (!gpu_drawn && !reference_drawn)
            return;
        Interval legal[4];
        for (int c = 0; c < 4; ++c)
            legal[c] = clip || params_.switches.arithmetic == ArithmeticSwitch::exact
                           ? Interval(follows[c])
                           : legal_clip[static_cast<std::size_t>(c)];
        const auto of = [&](glm::vec4 p) {
            return in_clip_volume(p, params_.clip_depth) ? std::optional(p) : std::nullopt;
        };
        rows_.numbers<glm::vec4>("gl_Position", of(strict_.point_position), of(reference_.point_position),
                                 gpu_.drawn_alone ? of(gpu_.position) : std::nullopt, legal);
        rasterise();
    }

    /// Where the pass itself puts the point.
    void place(glm::vec4 clip) {
        const KnownOperations& known = arithmetic_.known();
        fall_on(placed_fragment(clip, params_, frame_.profile), known.sums && known.divide && known.subnormals);
    }

    [[nodiscard]] std::optional<std::string> told(std::string text) const {
        return gpu_.drawn_alone ? std::optional(std::move(text)) : std::nullopt;
    }

    void rasterise() {
        const auto pixels = [&](const char* label, auto member) {
            for (int c = 0; c < 2; ++c)
                rows_.only_reference(fmt::format("{}.{}", label, "xy"[c]), member(strict_, c), member(reference_, c));
        };
        pixels("window position", [](const StepTrace& t, int c) { return Cell{t.window.position[c], {}}; });
        const int grid = 1 << frame_.profile.raster.subpixel_bits;
        pixels("snapped", [&](const StepTrace& t, int c) {
            return Cell{{}, fmt::format("{}/{} px", t.window.snapped[c] + grid / 2, grid)};
        });
        fall_on(drawn_point(gpu_.position, params_, frame_.profile.raster), arithmetic_.known().points);
    }

    /// `follows`: the texel and depth that follow from what the GPU told; `known`: they are the only legal ones.
    void fall_on(const PointFragment& follows, bool known) {
        const auto texel = [](const PointFragment& f) { return texel_text({f.x, f.y}); };
        if (!gpu_.drawn_alone)
            gpu_.texel = {follows.x, follows.y};
        const std::optional<Interval> may =
            !known && gpu_.texel.x >= 0 ? legal_depth(frame_, gpu_.texel, particle_) : std::nullopt;
        rows_.decision("texel", texel(strict_.fragment), texel(reference_.fragment), told(texel_text(gpu_.texel)),
                       texel(follows), may.has_value());
        if (gpu_.texel.x >= 0 || reference_.fragment.x >= 0) {
            const auto gpu = gpu_.texel.x >= 0 && gpu_.drawn_alone ? std::optional(gpu_.depth) : std::nullopt;
            rows_.number("depth", strict_.fragment.depth, reference_.fragment.depth, gpu,
                         legal_value(may.value_or(Interval(follows.depth)), gpu));
        }
        const glm::ivec2 at = gpu_.texel.x >= 0 ? gpu_.texel : glm::ivec2(reference_.fragment.x, reference_.fragment.y);
        if (at.x >= 0 && run_ != nullptr)
            add_contest(*run_, at, particle_, rows_);
    }

    A fp_;
    FrameRun* run_;
    const JudgedFrame& frame_;
    const FrameParams& params_;
    std::size_t particle_;
    LegalArithmetic<A> arithmetic_;
    ParticleState before_;
    StepTrace strict_;
    const StepTrace& reference_;
    StepCapture gpu_;
    ParticleState state_; ///< the GPU's, as the vertex stage hands it on
    StepRows rows_;
};

} // namespace

std::vector<StepRow> with_drawn_rows(std::vector<StepRow> step, const JudgedFrame& frame, std::size_t particle,
                                     const StepCapture& capture, const StepTrace& reference, FrameRun* run) {
    return with_arithmetic(frame.profile, frame.params.switches.arithmetic, [&](auto fp) {
        return DrawnRows(fp, std::move(step), frame, particle, capture, reference, run)();
    });
}

} // namespace lockstep
