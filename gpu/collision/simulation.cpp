#include "gpu/collision/simulation.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <fmt/format.h>

#include "gpu/canary.hpp"
#include "gpu/check.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

/// The stored code of a texel that nobody writes. Every half and every byte may be part of a position; with this alpha,
/// neither that of a cleared texel nor of a drawn one, they are none.
glm::vec4 canary_texel(CdtFormat format) {
    switch (format) {
    case CdtFormat::rgba32f:
        return glm::vec4(std::bit_cast<float>(canary_word));
    case CdtFormat::rgba16f:
        return glm::vec4(-12.96875F); // 0xca7c
    case CdtFormat::rgba8:
        break;
    }
    return {0xca, 0x7c, 0xa7, 0x5a};
}

/// Another depth than GL's own is drawn by the listing's vertex step alone.
void check_clip_depth(const Scene& scene) {
    const ClipDepth& depth = scene.clip_space.depth;
    const Switches& s = scene.switches;
    if (depth == ClipDepth{})
        return;
    const bool vertex_step = s.search == Search::cdt && s.step != Step::compute && !has_remedies(s);
    if (vertex_step && s.arithmetic != ArithmeticSwitch::exact && scene.obstacles.positions.empty())
        return;
    throw Error(
        fmt::format("{}: clip_space: depth [{}, {}] is drawn on GL with search=cdt, step=transform_feedback, plain "
                    "arithmetic, no remedies and no obstacles alone; a recording has it with others too",
                    scene.name, depth.near_plane, depth.far_plane));
}

} // namespace

GpuSimulation::GpuSimulation(const Scene& scene, const std::filesystem::path& shaders)
    : switches_(scene.switches), shaders_(shaders), obstacles_(scene.obstacles),
      obstacle_pass_(scene.switches, shaders), particles_{ParticleBuffer(scene.start.size(), largest_group()),
                                                          ParticleBuffer(scene.start.size(), largest_group())},
      cdts_{CollisionTexture(scene.width, scene.height, scene.switches.cdt_format),
            CollisionTexture(scene.width, scene.height, scene.switches.cdt_format)},
      layered_(layered(scene, shaders)) {
    check_clip_depth(scene);
    if (scene.switches.search == Search::octree)
        octree_pass_.emplace(scene, shaders);
    else if (scene.switches.search == Search::depth)
        depth_pass_.emplace(scene, shaders);
    else if (scene.switches.step == Step::compute)
        compute_pass_.emplace(scene, shaders);
    else if (!layered_)
        collision_pass_.emplace(scene.switches, shaders, scene.clip_space.depth);
    upload(scene.start, empty_cdt(scene));
}

std::optional<GpuSimulation::Layered> GpuSimulation::layered(const Scene& scene, const std::filesystem::path& shaders) {
    if (!has_remedies(scene.switches))
        return {};
    const auto cdt = [&] {
        return LayeredTexture(scene.width, scene.height, cdt_planes(scene.switches), scene.switches.cdt_format);
    };
    return Layered{{scene.switches, shaders, scene.width, scene.height}, {cdt(), cdt()}};
}

void GpuSimulation::upload(const Particles& particles, const CollisionImage& cdt) {
    begun_ = false;
    particles_[current_].upload(particles);
    if (layered_)
        layered_->cdts[current_].upload(cdt);
    else
        cdts_[current_].upload(cdt);
}

void GpuSimulation::step(const FrameParams& params) {
    if (!std::exchange(begun_, false))
        begin_frame(params, current_, 1 - current_);
    end_frame(params, current_, 1 - current_);
    current_ = 1 - current_;
}

void GpuSimulation::begin_step(const FrameParams& params) {
    begin_frame(params, current_, 1 - current_);
    begun_ = true;
    gl::Flush();
}

void GpuSimulation::repeat_step(const FrameParams& params) {
    begin_frame(params, 1 - current_, current_);
    end_frame(params, 1 - current_, current_);
}

void GpuSimulation::begin_frame(const FrameParams& params, std::size_t from, std::size_t to) {
    if (octree_pass_)
        octree_pass_->refresh(particles_[from]);
    const RunningTimer timing(timer_);
    run_passes(params, from, to);
}

void GpuSimulation::end_frame(const FrameParams& params, std::size_t from, std::size_t to) {
    gl::Finish();
    frame_seconds_ = seconds_of(timer_);
    verify_written();
    if (octree_pass_)
        octree_pass_->check_ends(particles_[from], particles_[to]);
    if (depth_pass_)
        depth_pass_->check_ends(particles_[from], particles_[to]);
    if (compute_pass_)
        compute_pass_->check_ends(params, particles_[from], particles_[to], cdts_[from], cdts_[to]);
}

void GpuSimulation::run_passes(const FrameParams& params, std::size_t from, std::size_t to) {
    if (layered_)
        return run_layered(params, from, to);
    cdts_[to].clear(params.clip_depth.cleared());
    pass_timer_.mark("clear");
    if (octree_pass_) {
        octree_pass_->run(params, particles_[from], particles_[to]);
        return pass_timer_.mark("octree_pass");
    }
    cdts_[to].bind_target();
    obstacle_pass_.run(obstacles_, params);
    pass_timer_.mark("obstacle_pass");
    if (depth_pass_) {
        depth_pass_->run(params, particles_[from], particles_[to], cdts_[from]);
        return pass_timer_.mark("depth_pass");
    }
    if (compute_pass_)
        return compute_pass_->run(params, particles_[from], particles_[to], cdts_[from], cdts_[to], pass_timer_);
    collision_pass_->run(params, particles_[from], particles_[to], cdts_[from], cdts_[to]);
    pass_timer_.mark("collision_pass");
}

void GpuSimulation::run_layered(const FrameParams& params, std::size_t from, std::size_t to) {
    layered_->pass.run(params, obstacles_, obstacle_pass_, particles_[from], particles_[to], layered_->cdts[from],
                       layered_->cdts[to]);
    pass_timer_.mark("layered_collision_pass");
}

std::vector<std::pair<std::string, double>> GpuSimulation::pass_seconds(const FrameParams& params) {
    GLint bits = 0;
    gl::GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    if (bits == 0)
        return {};
    pass_timer_.start();
    run_passes(params, 1 - current_, current_);
    return pass_timer_.stop();
}

StepCapture GpuSimulation::trace(const FrameParams& params, std::size_t particle) {
    if (compute_pass_ || depth_pass_) {
        if (!compute_trace_)
            compute_trace_.emplace(depth_pass_ ? "depth_pass" : "collision_pass",
                                   depth_pass_ ? set_depth_uniforms : set_collision_uniforms, switches_, shaders_,
                                   params.width, params.height);
        return compute_trace_->run(params, particles_[1 - current_], particle, cdts_[1 - current_]);
    }
    if (!trace_)
        trace_.emplace(switches_, shaders_, params.width, params.height, params.clip_depth);
    return trace_->run(params, particles_[1 - current_], particle, cdts_[1 - current_]);
}

void GpuSimulation::verify_written() const {
    if (layered_)
        layered_->pass.verify_written(particles_[0].size());
    else if (collision_pass_)
        collision_pass_->verify_written(particles_[0].size());
}

void GpuSimulation::read(Particles& particles) const { particles_[current_].read(particles); }

void GpuSimulation::read(CollisionImage& cdt) const {
    if (layered_)
        layered_->cdts[current_].read(cdt);
    else
        cdts_[current_].read(cdt);
}

bool GpuSimulation::holds(const Particles& particles) const { return particles_[current_].holds(particles); }

void GpuSimulation::lay_canary() {
    particles_[1 - current_].fill(canary_word);
    const auto fill = [](auto& target) {
        CollisionImage image;
        target.read(image);
        std::fill(image.texels.begin(), image.texels.end(), canary_texel(target.format()));
        target.upload(image);
    };
    if (layered_)
        fill(layered_->cdts[1 - current_]);
    else
        fill(cdts_[1 - current_]);
}

void GpuSimulation::find_canary(const Particles& particles, const CollisionImage& cdt, int frame) const {
    if (const std::size_t i = find_word(view(particles), canary_word); i < particles.size())
        throw Error(fmt::format("frame {}: the GPU did not write particle {}: its record still holds what was laid "
                                "there before the draw",
                                frame, i));
    if (const std::size_t i = find_word(view(particles), margin_word); i < particles.size())
        throw Error(fmt::format("frame {}: the GPU read past the end of a buffer, and wrote what lies there into "
                                "particle {}",
                                frame, i));
    const glm::vec4 unwritten = canary_texel(switches_.cdt_format);
    for (int y = 0; y < cdt.height; ++y)
        for (int x = 0; x < cdt.width; ++x)
            if (cdt.at(x, y) == unwritten)
                throw Error(
                    fmt::format("frame {}: the GPU neither cleared nor drew texel ({}, {}) of the CDT", frame, x, y));
}

} // namespace lockstep
