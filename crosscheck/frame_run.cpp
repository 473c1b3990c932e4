#include "crosscheck/frame_run.hpp"

#include <utility>

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/model/layered_cdt.hpp"
#include "reference/obstacle_pass.hpp"

namespace lockstep {
namespace {

Scene searched_in_cdt(Scene scene) {
    if (scene.switches.search != Search::cdt)
        throw Error(
            fmt::format("{}: only the search through the CDT is followed step by step; set search=cdt", scene.name));
    for (const std::string_view name : remedy_switches)
        if (const std::string first = switch_value({}, name); switch_value(scene.switches, name) != first)
            throw Error(fmt::format("{}: only the listing's own search is followed step by step; set {}={}", scene.name,
                                    name, first));
    return scene;
}

} // namespace

FrameRun::FrameRun(Scene scene, Profile profile, const KnownOperations& known, std::filesystem::path shaders)
    : scene_(searched_in_cdt(std::move(scene))), profile_(std::move(profile)), known_(known), gpu_(scene_, shaders),
      reference_(scene_, profile_) {}

void FrameRun::go_to(int frame) {
    if (frame == frame_)
        return;
    const bool next = frame_ >= 0 && frame == frame_ + 1;
    if (frame < frame_ || frame_ < 0) {
        gpu_.upload(scene_.start, CollisionImage(scene_.width, scene_.height));
        frame_ = -1;
    }
    for (int earlier = frame_ + 1; earlier < frame; ++earlier)
        gpu_.step(frame_params(scene_, earlier));
    if (next) {
        std::swap(before_, after_);
        std::swap(cdt_before_, cdt_after_);
    } else {
        gpu_.read(before_);
        gpu_.read(cdt_before_);
    }
    params_ = frame_params(scene_, frame);
    gpu_.step(params_);
    gpu_.read(after_);
    gpu_.read(cdt_after_);
    reference_.step_from(before_, cdt_before_, params_);
    frame_ = frame;
    verdicts_.reset();
    redrawn_.reset();
    obstacle_depth_.reset();
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
        obstacle_depth_.emplace(params_.width, params_.height, 1.0F);
        obstacle_pass(scene_.obstacles, params_, profile_, cdt, *obstacle_depth_);
    }
    return *obstacle_depth_;
}

} // namespace lockstep
