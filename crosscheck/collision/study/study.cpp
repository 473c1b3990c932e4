#include "crosscheck/collision/study/study.hpp"

#include <algorithm>

#include "gpu/collision/simulation.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/layered_collision_pass.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/collision/simulation.hpp"

namespace lockstep {

namespace {

/// The GL side, read back after every frame.
class ReadBack {
  public:
    ReadBack(const Scene& scene, GpuSimulation& gpu) : gpu_(gpu), cdt_(empty_cdt(scene)) {
        gpu_.upload(scene.start, cdt_);
        particles_ = scene.start;
    }
    void step(const FrameParams& params) {
        gpu_.step(params);
        gpu_.read(particles_);
        gpu_.read(cdt_);
    }
    [[nodiscard]] const Particles& particles() const { return particles_; }
    [[nodiscard]] const CollisionImage& cdt() const { return cdt_; }

  private:
    GpuSimulation& gpu_;
    Particles particles_;
    CollisionImage cdt_;
};

template <class Simulation> std::vector<StudyFrame> run(const Scene& scene, const Profile& profile,
                                                        Simulation simulation, const StudyOptions& options) {
    std::vector<StudyFrame> studied;
    Particles previous;
    for (int frame = 0; frame < options.frames; ++frame) {
        const FrameParams params = frame_params(scene, frame);
        const Particles before = simulation.particles();
        if (frame > 0 && (frame - 1) % options.every == 0) {
            const TrueNeighbours truth = find_truth(before.position, params.constants.collision_range);
            const FrameParams drawn = frame_params(scene, frame - 1);
            const SearchStudy study =
                has_remedies(scene.switches)
                    ? study_layered_search(before, simulation.cdt(), draw_layered_owners(before, drawn, profile), truth,
                                           params, profile)
                    : study_search(before, simulation.cdt(),
                                   draw_owners(previous, before, scene.obstacles, drawn, profile), truth, params,
                                   profile);
            studied.push_back({frame, study.counts, {}});
            if (options.on_state)
                options.on_state({frame, before, params, study.findings});
        }
        simulation.step(params);
        if (!studied.empty() && studied.back().frame == frame)
            studied.back().drift = drift(before, simulation.particles(), params.constants);
        previous = before;
        if (options.on_frame)
            options.on_frame(frame + 1);
    }
    return studied;
}

} // namespace

std::vector<StudyFrame> study_run(const Scene& scene, const Profile& profile, const StudyOptions& options) {
    return run(scene, profile, ReferenceSimulation(scene, profile), options);
}

std::vector<StudyFrame> study_run(const Scene& scene, const Profile& profile, GpuSimulation& gpu,
                                  const StudyOptions& options) {
    return run(scene, profile, ReadBack(scene, gpu), options);
}

SearchStudy study_start(const Scene& scene, const TrueNeighbours& truth, const Profile& profile) {
    Particles particles = scene.start;
    std::fill(particles.collide_time.begin(), particles.collide_time.end(), -1.0F);
    const FrameParams params = frame_params(scene, 0);
    CollisionImage cdt = empty_cdt(scene);
    if (has_remedies(scene.switches)) {
        draw_layered_cdt(particles, scene.obstacles, params, profile, cdt);
        return study_layered_search(particles, cdt, draw_layered_owners(particles, params, profile), truth, params,
                                    profile);
    }
    DepthImage depth(scene.width, scene.height, 1.0F);
    obstacle_pass(scene.obstacles, params, profile, cdt, depth);
    rasterise_particles(particles, particles, params, profile, cdt, depth);
    const Owners owners = draw_owners(particles, particles, scene.obstacles, params, profile);
    return study_search(particles, cdt, owners, truth, params, profile);
}

SearchStudy study_start(const Scene& scene, const Profile& profile) {
    return study_start(scene, find_truth(scene.start.position, scene.constants.collision_range), profile);
}

} // namespace lockstep
