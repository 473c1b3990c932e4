#include "crosscheck/collision/judge/frame_run.hpp"

#include <exception>
#include <utility>

#include "crosscheck/collision/judge/side_state.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/collision/layered_cdt.hpp"

namespace lockstep {
FrameRun::FrameRun(Scene scene, Profile profile, const KnownOperations& known, const std::filesystem::path& shaders)
    : scene_(std::move(scene)), profile_(std::move(profile)), known_(known),
      simulation_(std::make_unique<GpuSimulation>(scene_, shaders)), gpu_(*simulation_), reference_(scene_, profile_),
      cdt_before_(empty_cdt(scene_)), cdt_after_(cdt_before_) {}

FrameRun::FrameRun(Scene scene, Profile profile, const KnownOperations& known, GpuSide& gpu)
    : scene_(std::move(scene)), profile_(std::move(profile)), known_(known), gpu_(gpu), reference_(scene_, profile_),
      cdt_before_(empty_cdt(scene_)), cdt_after_(cdt_before_) {}

/// From the state in after_, which is kept in before_.
void FrameRun::step(int frame) {
    std::swap(before_, after_);
    std::swap(cdt_before_, cdt_after_);
    absent_.put_back(before_);
    absent_.hide(before_, gpu_.present(frame));
    params_ = frame_params(scene_, frame);
    gpu_.step(params_);
    read_side(gpu_, scene_, after_, cdt_after_);
    absent_.hide(after_, gpu_.present(frame));
    if (!gpu_.has_cdt())
        reference_.draw(before_, after_, params_, cdt_after_);
    frame_ = frame;
}

/// What `on_frame` throws is thrown where the run stands in a frame again, three on.
void FrameRun::go_to(int frame, const std::function<void(int)>& on_frame) {
    if (frame == frame_)
        return;
    if (frame < frame_ || frame_ < 0) {
        after_ = scene_.start;
        absent_ = {};
        cdt_after_ = empty_cdt(scene_);
        gpu_.upload(after_, cdt_after_);
        frame_ = -1;
    }
    // A step from a state that was read takes the two states before it.
    std::exception_ptr thrown;
    for (int earlier = frame_ + 1; earlier < frame - 2; ++earlier) {
        gpu_.step(frame_params(scene_, earlier));
        try {
            if (on_frame)
                on_frame(earlier + 1);
        } catch (...) {
            thrown = std::current_exception();
            frame = earlier + 3;
        }
    }
    if (frame - 2 > frame_) {
        params_ = frame_params(scene_, frame - 2);
        gpu_.step(params_);
        read_side(gpu_, scene_, after_, cdt_after_);
        absent_ = {};
        frame_ = frame - 2;
    }
    while (frame_ < frame)
        step(frame_ + 1);
    reference_.step_from(before_, cdt_before_, params_);
    verdicts_.reset();
    redrawn_.reset();
    obstacle_depth_.reset();
    if (thrown)
        std::rethrow_exception(thrown);
}

StepCapture FrameRun::capture(std::size_t particle) {
    if (simulation_ && (is_listing(scene_.switches) || scene_.switches.search == Search::depth))
        return simulation_->trace(params_, particle);
    StepCapture untold;
    untold.state = after_[particle];
    untold.drawn_alone = false;
    return untold;
}

JudgedFrame FrameRun::judged() const {
    return {scene_.obstacles,       params_,          profile_, known_,    before_, cdt_before_,
            reference_.particles(), reference_.cdt(), after_,   cdt_after_};
}

const FrameVerdicts& FrameRun::verdicts() {
    if (!verdicts_)
        verdicts_ = judge(judged());
    return *verdicts_;
}

const CollisionImage& FrameRun::redrawn() {
    if (!redrawn_)
        redrawn_ = redraw(judged());
    return *redrawn_;
}

const DepthImage& FrameRun::obstacle_depth() {
    if (!obstacle_depth_) {
        CollisionImage cdt(params_.width, params_.height);
        obstacle_depth_.emplace(params_.width, params_.height, params_.clip_depth.cleared());
        obstacle_pass(scene_.obstacles, params_, profile_, cdt, *obstacle_depth_);
    }
    return *obstacle_depth_;
}

} // namespace lockstep
